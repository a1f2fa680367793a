#include "smoothing/step_record.h"

namespace isorelax {

std::array<std::size_t, 8> count_limits(std::span<const std::uint16_t> all) {
  std::array<std::size_t, 8> counts{};
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

void apply_step(const StepRecord& record, std::span<Vec3> positions) {
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += record.alpha[v] * record.displacement[v];
}

}  // namespace isorelax
