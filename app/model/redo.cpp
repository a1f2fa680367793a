#include "model/redo.h"

#include "mesh/error.h"
#include "trace/trace_parts.h"

namespace isorelax::model {
namespace {

/// Whether its steps are made as its parts say, and not with the settings of a branch.
bool follows_parts(const Recording* recording) {
  return recording != nullptr && recording->read_as() != nullptr && !recording->read_as()->plans.empty();
}

bool is_recorded(const Place& place) {
  return place.recording && place.recording->has_begun() && place.iteration > 0 &&
         place.iteration <= place.recording->size();
}

std::vector<Vec3> positions_before(const Place& place, const StepMaking& making) {
  if (making.from_base && place.iteration == making.from + 1) {
    const Trace& trace = place.recording->trace();
    return base_of(trace, *part_of(trace, place.iteration));
  }
  return place.recording->positions_at(place.iteration - 1);
}

/// One step of a smoother that knows nothing.
std::shared_ptr<StepRecord> lone_step(const StepMaking& making, std::span<const Vec3> before) {
  auto record = std::make_shared<StepRecord>();
  making.smoother()->step(before, *record);
  return record;
}

bool leads_to(const StepRecord& record, std::vector<Vec3> positions, std::span<const Vec3> after) {
  apply_step(record, positions);
  return same_bits(positions, after);
}

/// Does all steps since the smoother last began afresh again, and keeps their records.
std::shared_ptr<StepRecord> redo_from_start(const JobContext& context, const StepMaking& making,
                                            const Place& place) {
  Recording& recording = *place.recording;
  std::vector<Vec3> positions = positions_before({place.recording, making.from + 1, {}}, making);
  const auto smoother = making.smoother();
  for (unsigned k = making.from + 1;; ++k) {
    context.progress("Doing the steps again",
                     static_cast<double>(k - making.from) / (place.iteration - making.from));
    auto record = std::make_shared<StepRecord>();
    smoother->step(positions, *record);
    if (k == place.iteration) return record;
    if (context.cancelled()) throw Error("Doing the steps again was cancelled");
    apply_step(*record, positions);
    context.bench().steps().add(recording.number(), k, std::move(record));
  }
}

std::string elsewhere_text(const StepRecord& record, std::vector<Vec3> before, std::span<const Vec3> after) {
  apply_step(record, before);
  const auto parting = find_parting(after, before, 0);
  if (!parting) return {};
  return "Done again, this step leads elsewhere: " + std::to_string(parting->vertices) +
         " vertices differ from the recording, the first is vertex " + std::to_string(parting->vertex) +
         ". The run was made by another program, or with options that are not known here.";
}

}  // namespace

std::vector<Vec3> positions_of(const Document& document, const Place& place) {
  return place.recording && place.recording->has_begun() ? place.recording->positions_at(place.iteration)
                                                         : document.mesh().positions;
}

BasePtr base_at(const Document& document, const Place& place) {
  if (!place.recording || !place.recording->has_begun()) return {};
  if (place.recording->can_grow()) return place.recording->base();
  // The start itself is not untangled yet.
  const TracePart* part = part_of(place.recording->trace(), place.iteration);
  if (part == nullptr) return {};
  std::vector<Vec3> base = base_of(place.recording->trace(), *part);
  if (same_bits(base, document.mesh().positions)) return {};
  return std::make_shared<const std::vector<Vec3>>(std::move(base));
}

StepMaking making_of(Workbench& bench, const DocumentPtr& document, const SmoothingSettings& settings,
                     const Place& place) {
  const Recording* recording = place.recording.get();
  const TracePart* part = nullptr;
  if (is_recorded(place)) part = part_of(recording->trace(), place.iteration);
  StepMaking making;
  if (part != nullptr) {
    making.from = static_cast<unsigned>(part->done);
    making.from_base = part->from_base;
  }
  if (part != nullptr && follows_parts(recording)) {
    const auto index = static_cast<std::size_t>(part - recording->trace().parts.data());
    const auto plan = recording->read_as()->plans[index];
    making.problem = bench.part_problem(*recording, index);
    making.features = plan->problem.features;
    making.smoother = [problem = making.problem, plan, part] {
      return make_part_smoother(*problem, *part, *plan);
    };
    making.part = part;
    return making;
  }
  making.problem = bench.problem(document, settings, recording != nullptr ? recording->base() : BasePtr());
  making.features = feature_options(settings);
  if (recording == nullptr || !recording->has_begun()) making.start = bench.start_of(document, settings).base;
  // All steps of a recording that grows are of one kind.
  if (part == nullptr && recording != nullptr && recording->can_grow() && !recording->trace().parts.empty())
    part = &recording->trace().parts.back();
  const PartKind kind = part != nullptr ? part->kind : PartKind::solver;
  making.smoother = [problem = making.problem, settings, kind] {
    return make_smoother(*problem, settings, kind);
  };
  return making;
}

FoundStep find_step(const JobContext& context, const DocumentPtr& document, const StepMaking& making,
                    const Place& place) {
  FoundStep found;
  Recording* recording = place.recording.get();
  if (!is_recorded(place)) {
    // The step that would be made next.
    const unsigned last = recording != nullptr && recording->has_begun() ? recording->size() : 0;
    found.before = positions_of(*document, {place.recording, last, {}});
    if (making.start && last == 0) found.before = *making.start;
    found.record = lone_step(making, found.before);
    return found;
  }
  const unsigned k = place.iteration;
  found.before = positions_before(place, making);
  Workbench& bench = context.bench();
  found.record = bench.steps().find(recording->number(), k);
  if (found.record) return found;
  if (!place.not_redone.empty()) throw Error("The step cannot be looked into: " + place.not_redone);
  context.progress("Doing the step again", -1);
  const std::vector<Vec3> after = recording->positions_at(k);
  // Most steps depend on nothing but where they begin; the bits tell.
  auto record = lone_step(making, found.before);
  if (!leads_to(*record, found.before, after)) record = redo_from_start(context, making, place);
  found.mismatch = elsewhere_text(*record, found.before, after);
  if (found.mismatch.empty()) bench.steps().add(recording->number(), k, record);
  found.record = std::move(record);
  return found;
}

std::shared_ptr<const EnergyState> energy_at(Workbench& bench, const DocumentPtr& document,
                                             const SmoothingSettings& settings, const Place& place,
                                             std::span<const Vec3> positions) {
  if (!follows_parts(place.recording.get()) || !same_energy(place.recording->read_as()->settings, settings))
    return measure_energy(
        *bench.problem(document, settings, place.recording ? place.recording->base() : BasePtr()), settings,
        positions);
  const Trace& trace = place.recording->trace();
  // The part that led there; to the start none did.
  const TracePart* part = part_of(trace, std::max(1U, place.iteration));
  const auto index = static_cast<std::size_t>(part - trace.parts.data());
  auto energy = std::make_shared<EnergyState>(
      *measure_energy(*bench.part_problem(*place.recording, index), settings, positions));
  energy->of_record = !place.recording->read_as()->exact || part->exponent != settings.exponent;
  return energy;
}

}  // namespace isorelax::model
