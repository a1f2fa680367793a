#include "model/workbench.h"

#include <algorithm>

#include "io/mesh_file.h"
#include "mesh/error.h"
#include "model/arguments.h"
#include "smoothing/baselines.h"
#include "smoothing/limit_choice.h"
#include "smoothing/surface_watch.h"
#include "trace/trace_parts.h"

namespace isorelax::model {
namespace {

/// Problems are large: those of the branches that are looked at in turn.
constexpr std::size_t kProblemsKept = 4;

// Settings that take no part in the problem do not make a new one.
SmoothingSettings problem_part(const SmoothingSettings& all) {
  SmoothingSettings settings = without_unused(all);
  settings.iterations = 0;
  settings.tolerance = 0;
  settings.method = Method::near_isometry;
  settings.solver = Solver::automatic;
  settings.polish = Polish::none;
  return settings;
}

// Those that decide how triangles are turned that lie upside down.
SmoothingSettings start_part(const SmoothingSettings& settings) {
  SmoothingSettings part;
  part.features = settings.features;
  part.feature_deg = settings.feature_deg;
  part.pinned = settings.pinned;
  if (settings.reach == Reach::typed) part.reach = Reach::typed;
  part.max_deviation = settings.max_deviation;
  return without_unused(part);
}

ReferenceChoice reference_choice(const SmoothingSettings& settings) {
  switch (settings.reference) {
    case ReferenceKind::mean_area:
      return MeanAreaReference{};
    case ReferenceKind::edge_length:
      return EdgeLengthReference{settings.edge_length};
    case ReferenceKind::initial:
      return InitialReference{};
    case ReferenceKind::file:
      break;
  }
  if (settings.reference_file.empty()) throw UsageError("reference: no file was chosen");
  return MeshReference{read_mesh(settings.reference_file).mesh.positions};
}

}  // namespace

FeatureOptions feature_options(const SmoothingSettings& settings) {
  switch (settings.features) {
    case FeatureRule::automatic:
      break;
    case FeatureRule::none:
      return FeatureOptions::none();
    case FeatureRule::angle:
      return FeatureOptions::ridges_from(settings.feature_deg);
  }
  return {};
}

ProblemOptions problem_options(const SmoothingSettings& settings) {
  ProblemOptions options;
  options.weights = EnergyWeights::from_mu(settings.mu_a);
  options.exponent = settings.exponent;
  options.reference = reference_choice(settings);
  options.boundary = settings.boundary;
  options.pinned = settings.pinned;
  options.features = feature_options(settings);
  return options;
}

std::span<const Vec3> limited_from(const SmoothingSettings& settings, const TriangleMesh& mesh,
                                   std::span<const Vec3> start) {
  return settings.reach == Reach::typed ? mesh.positions : start;
}

KeptNear kept_near(const SmoothingSettings& settings, std::span<const Vec3> original,
                   const SmoothingProblem& problem) {
  switch (settings.reach) {
    case Reach::any:
      return {std::numeric_limits<double>::infinity(), false};
    case Reach::typed:
      return {settings.max_deviation, false};
    case Reach::nearest:
    case Reach::widest:
      break;
  }
  const AutomaticLimits limits = automatic_limits(original, problem, problem_options(settings));
  return {settings.reach == Reach::nearest ? limits.nearest : limits.widest, limits.on_fits};
}

namespace {

PolishOptions polish_options(const SmoothingSettings& settings) {
  PolishOptions options;
  if (settings.polish == Polish::mean) options.goal = PolishGoal::mean;
  if (settings.polish == Polish::both) options.goal = PolishGoal::both;
  return options;
}

/// The problem with what keeps every step near the surface.
SmoothingProblem make_near_problem(std::span<const Vec3> original, const TriangleMesh& mesh,
                                   const SmoothingSettings& settings) {
  SmoothingProblem problem = make_problem(original, mesh.triangles, problem_options(settings));
  const auto [limit, on_fits] = kept_near(settings, original, problem);
  const SurfaceWatch watch(limited_from(settings, mesh, original), original, problem);
  hold(problem, {.still = {}, .distance = watch.largest_distance(limit), .on_fits = on_fits}, original);
  return problem;
}

}  // namespace

std::unique_ptr<Smoother> make_smoother(const SmoothingProblem& problem, const SmoothingSettings& settings,
                                        PartKind kind) {
  constexpr RecordDetail kAll = RecordDetail::stages;
  if (kind == PartKind::polish) return make_explained_polish(problem, polish_options(settings));
  switch (settings.method) {
    case Method::laplacian: {
      LaplacianOptions options;
      options.detail = kAll;
      return make_laplacian(problem, options);
    }
    case Method::angle_based: {
      AngleBasedOptions options;
      options.detail = kAll;
      return make_angle_based(problem, options);
    }
    case Method::near_isometry:
      break;
  }
  return isorelax::make_smoother(problem, settings.solver, kAll);
}

RunPlan plan_of(const SmoothingSettings& settings) {
  const auto make = [settings](const SmoothingProblem& problem) { return make_smoother(problem, settings); };
  return {problem_options(settings), make, polish_options(settings)};
}

const Workbench::Start& Workbench::start_of(const DocumentPtr& document, const SmoothingSettings& settings) {
  const SmoothingSettings wanted = start_part(settings);
  if (start_ && start_->document == document &&
      (start_->settings == wanted || start_->start.untangled.result.before == 0))
    return start_->start;
  const TriangleMesh& mesh = document->mesh();
  std::vector<Vec3> positions = mesh.positions;
  DeviationLimit limit;
  if (wanted.reach == Reach::typed) limit.max = wanted.max_deviation;
  MadeStart made{document, wanted, {}};
  made.start.untangled = untangle_start(positions, mesh.triangles, problem_options(wanted), limit);
  if (made.start.untangled.result.before > 0)
    made.start.base = std::make_shared<const std::vector<Vec3>>(std::move(positions));
  start_ = std::move(made);
  return start_->start;
}

BasePtr Workbench::base_or_start(const DocumentPtr& document, const SmoothingSettings& settings,
                                 const BasePtr& known) {
  return known ? known : start_of(document, settings).base;
}

Workbench::ProblemPtr Workbench::problem(const DocumentPtr& document, const SmoothingSettings& settings,
                                         const BasePtr& base) {
  const BasePtr made_from = base_or_start(document, settings, base);
  const SmoothingSettings wanted = problem_part(settings);
  const auto found = std::ranges::find_if(problems_, [&](const Made& made) {
    return made.document == document && made.settings == wanted && made.base == made_from;
  });
  if (found != problems_.end()) {
    std::rotate(problems_.begin(), found, std::next(found));
  } else {
    while (problems_.size() >= kProblemsKept) problems_.pop_back();
    const TriangleMesh& mesh = document->mesh();
    problems_.push_front({document, wanted, made_from,
                          std::make_shared<const SmoothingProblem>(
                              make_near_problem(made_from ? *made_from : mesh.positions, mesh, settings))});
  }
  return problems_.front().problem;
}

std::vector<std::shared_ptr<const RunPlan>> Workbench::read_plans(const Trace& trace) const {
  const TriangleMesh mesh{trace.positions, trace.triangles, {}};
  std::vector<std::shared_ptr<const RunPlan>> plans;
  for (std::size_t p = 0; p < trace.parts.size(); ++p) {
    const RunWords& words = words_of(trace, trace.parts[p]);
    if (p > 0 && words == words_of(trace, trace.parts[p - 1])) {
      plans.push_back(plans.back());
      continue;
    }
    check_resources(words);
    plans.push_back(std::make_shared<const RunPlan>(read_words_ ? read_words_(words, mesh)
                                                                : plan_of(settings_of(words))));
  }
  return plans;
}

Workbench::ProblemPtr Workbench::part_problem(const Recording& recording, std::size_t part) {
  const auto found = std::ranges::find_if(parts_, [&](const MadePart& made) {
    return made.recording == recording.number() && made.part == part;
  });
  if (found != parts_.end()) {
    std::rotate(parts_.begin(), found, std::next(found));
    return parts_.front().problem;
  }
  const Trace& trace = recording.trace();
  const TracePart& wanted = trace.parts[part];
  const auto& plans = recording.read_as()->plans;
  // The stages of a run differ by their exponent alone.
  const auto sibling = std::ranges::find_if(parts_, [&](const MadePart& made) {
    if (made.recording != recording.number() || plans[made.part] != plans[part]) return false;
    const TracePart& other = trace.parts[made.part];
    return other.base == wanted.base && other.holds == wanted.holds;
  });
  ProblemPtr problem;
  if (sibling != parts_.end() && trace.parts[sibling->part].exponent == wanted.exponent) {
    problem = sibling->problem;
  } else if (sibling != parts_.end()) {
    auto stage = std::make_shared<SmoothingProblem>(*sibling->problem);
    stage->exponent = wanted.exponent;
    problem = std::move(stage);
  } else {
    problem = std::make_shared<const SmoothingProblem>(make_part_problem(trace, wanted, *plans[part]));
  }
  while (parts_.size() >= kProblemsKept) parts_.pop_back();
  parts_.push_front({recording.number(), part, problem});
  return problem;
}

Smoother& Workbench::smoother(const DocumentPtr& document, const SmoothingSettings& settings, PartKind kind,
                              Recording& recording) {
  if (smoother_ && recording_ == recording.number() && at_ > 0 && at_ == recording.size()) return *smoother_;
  smoother_.reset();
  smoothed_ = problem(document, settings, recording.base());
  smoother_ = make_smoother(*smoothed_, settings, kind);
  recording.note_fresh_start(kind, *smoothed_);
  recording_ = recording.number();
  at_ = recording.size();
  return *smoother_;
}

MotionRun& Workbench::motion_run(const std::shared_ptr<MotionTrack>& track) {
  if (moved_ && moved_ != track) moved_->run.reset();
  moved_ = track;
  if (!track->run) {
    auto run = std::make_unique<MotionRun>(track->setup, 0);
    if (track->tip.step > 0) run->restore(track->tip);
    track->run = std::move(run);
  }
  return *track->run;
}

void Workbench::forget() {
  moved_.reset();
  start_.reset();
  problems_.clear();
  parts_.clear();
  smoother_.reset();
  smoothed_.reset();
  recording_ = 0;
  steps_.clear();
  geometries_.clear();
}

std::shared_ptr<const Geometry> Workbench::geometry(std::uint64_t recording, unsigned iteration) {
  const auto found = geometries_.find({recording, iteration});
  return found == geometries_.end() ? nullptr : found->second.lock();
}

void Workbench::note_geometry(std::uint64_t recording, unsigned iteration,
                              const std::shared_ptr<const Geometry>& geometry) {
  std::erase_if(geometries_, [](const auto& entry) { return entry.second.expired(); });
  geometries_[{recording, iteration}] = geometry;
}

}  // namespace isorelax::model
