#include "smoothing/step_detail.h"

#include "smoothing/tangent.h"

namespace isorelax {

void record_triangles(const Objective& here, StepRecord& record) {
  record.shape.assign(here.shape().begin(), here.shape().end());
  record.area.assign(here.area().begin(), here.area().end());
  record.energy.resize(record.shape.size());
  for (Index t = 0; t < record.energy.size(); ++t) record.energy[t] = here.energy(t);
}

void record_stages(const SmoothingProblem& problem, const Objective& here, std::span<const Vec3> positions,
                   StepRecord& record) {
  const std::size_t n = problem.vertex_count();
  StepDetail& detail = record.detail.emplace();
  detail.dimensions.resize(n);
  detail.axis.resize(n);
  detail.tangent.resize(n);
  detail.proposed = record.displacement;
  TangentSweep(problem).run(here, positions, [&](const TangentBatch& batch) {
    for (unsigned i = 0; i < batch.count; ++i) {
      const Index v = batch.vertices[i];
      const Mobility mobility = problem.mobility[v];
      detail.dimensions[v] = static_cast<std::uint8_t>(mobility);
      detail.axis[v] = mobility == Mobility::none ? Vec3(Vec3::Zero()) : batch.axes[i];
      detail.tangent[v] = batch.gradients[i];
    }
  });
}

}  // namespace isorelax
