#include "smoothing/step_record.h"

#include <algorithm>
#include <array>

namespace isorelax {

namespace {

template <typename T>
std::size_t held(const std::vector<T>& array) {
  return array.capacity() * sizeof(T);
}

}  // namespace

void begin_pass(StepRecord& record, Limit why) {
  if (record.detail) record.detail->passes.push_back({why, {}});
}

void note_cut(StepRecord& record, Index vertex, Index triangle) {
  if (record.detail) record.detail->passes.back().cuts.push_back({vertex, record.alpha[vertex], triangle});
}

std::vector<double> alpha_after(const StepRecord& record, std::size_t passes) {
  std::vector<double> alpha(record.alpha.size(), 1);
  for (std::size_t k = 0; k < std::min(passes, record.detail->passes.size()); ++k)
    for (const ControlCut& cut : record.detail->passes[k].cuts) alpha[cut.vertex] = cut.alpha;
  return alpha;
}

Index triangle_that_cut(const StepRecord& record, Index vertex) {
  Index triangle = kNone;
  if (!record.detail) return triangle;
  for (const ControlPass& pass : record.detail->passes)
    for (const ControlCut& cut : pass.cuts)
      if (cut.vertex == vertex) triangle = cut.triangle;
  return triangle;
}

std::size_t bytes_of(const StepRecord& r) {
  std::size_t bytes = sizeof r + held(r.gradient) + held(r.displacement) + held(r.alpha) + held(r.limits) +
                      held(r.tangent_class) + held(r.shape) + held(r.area) + held(r.energy);
  if (!r.detail) return bytes;
  bytes += held(r.detail->dimensions) + held(r.detail->axis) + held(r.detail->tangent) +
           held(r.detail->proposed) + held(r.detail->passes);
  for (const ControlPass& pass : r.detail->passes) bytes += held(pass.cuts);
  return bytes;
}

std::array<std::size_t, kLimitBits> count_limits(std::span<const std::uint16_t> all) {
  std::array<std::size_t, kLimitBits> counts{};
  for (const std::uint16_t limits : all) {
    for (unsigned bit = 0; bit < counts.size(); ++bit) counts[bit] += (limits >> bit) & 1U;
  }
  return counts;
}

std::string_view limit_name(Limit limit) {
  switch (limit) {
    case kLimitPinned:
      return "pinned";
    case kLimitCorner:
      return "corner";
    case kLimitRidge:
      return "ridge";
    case kLimitBoundary:
      return "boundary";
    case kLimitFold:
      return "fold";
    case kLimitEnergy:
      return "energy";
    case kLimitSurface:
      return "surface";
    case kLimitConverged:
      return "converged";
  }
  return "unknown";
}

std::string_view step_kind_name(StepKind kind) {
  constexpr std::array<std::string_view, kStepKinds> kNames{
      "unknown",    "Jacobi",    "Newton",      "L-BFGS",       "even out",
      "one by one", "Laplacian", "angle-based", "worst angles", "mean angle"};
  return kNames.at(static_cast<std::size_t>(kind));
}

void apply_step(const StepRecord& record, std::span<Vec3> positions) {
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += record.alpha[v] * record.displacement[v];
}

}  // namespace isorelax
