#include "trace/redo.h"

#include "smoothing/polish.h"
#include "smoothing/step_detail.h"
#include "trace/trace_parts.h"

namespace isorelax {
namespace {

/// A polish is not led by the energy, and leaves out of its records what belongs to it.
class ExplainedPolish : public Smoother {
 public:
  ExplainedPolish(const SmoothingProblem& problem, const PolishOptions& options)
      : problem_(problem), polish_(make_polish(problem, options)) {}

  [[nodiscard]] bool descends() const override { return polish_->descends(); }

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    polish_->step(positions, record);
    Objective here(problem_);
    here.evaluate(positions);
    for (Index v = 0; v < problem_.vertex_count(); ++v) record.gradient[v] = here.gather(v).gradient;
    record_triangles(here, record);
    record_stages(problem_, here, positions, record);
  }

 private:
  const SmoothingProblem& problem_;
  std::unique_ptr<Smoother> polish_;
};

}  // namespace

SmoothingProblem make_part_problem(const Trace& trace, const TracePart& part, const RunPlan& plan) {
  ProblemOptions options = plan.problem;
  options.exponent = part.exponent;
  options.holds = part.holds;
  return make_problem(base_of(trace, part), trace.triangles, options);
}

std::unique_ptr<Smoother> make_explained_polish(const SmoothingProblem& problem,
                                                const PolishOptions& options) {
  return std::make_unique<ExplainedPolish>(problem, options);
}

std::unique_ptr<Smoother> make_part_smoother(const SmoothingProblem& problem, const TracePart& part,
                                             const RunPlan& plan) {
  if (part.kind == PartKind::polish) return make_explained_polish(problem, plan.polish);
  return plan.make_smoother(problem);
}

std::optional<TraceParting> replay_parts(const Trace& trace, const PlanReader& read_plan) {
  const TriangleMesh mesh{trace.positions, trace.triangles, {}};
  TraceCursor cursor(trace);
  for (std::size_t p = 0; p < trace.parts.size(); ++p) {
    const TracePart& part = trace.parts[p];
    const std::size_t end = p + 1 < trace.parts.size() ? trace.parts[p + 1].done : trace.iterations.size();
    if (end == part.done) continue;
    const RunPlan plan = read_plan(words_of(trace, part), mesh);
    const SmoothingProblem problem = make_part_problem(trace, part, plan);
    const auto smoother = make_part_smoother(problem, part, plan);
    std::vector<Vec3> positions = part.from_base ? base_of(trace, part) : cursor.go_to(part.done);
    StepRecord record;
    for (std::size_t k = part.done + 1; k <= end; ++k) {
      smoother->step(positions, record);
      apply_step(record, positions);
      if (auto parting = find_parting(cursor.go_to(k), positions, k)) return parting;
    }
  }
  return std::nullopt;
}

}  // namespace isorelax
