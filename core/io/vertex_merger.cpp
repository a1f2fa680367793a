#include "io/vertex_merger.h"

#include <bit>
#include <cstdint>

namespace isorelax {
namespace {

std::uint64_t mixed(std::uint64_t value) {
  value ^= value >> 32;
  value *= 0xd6e8feb86659fd93ULL;
  value ^= value >> 32;
  value *= 0xd6e8feb86659fd93ULL;
  return value ^ (value >> 32);
}

std::size_t hash(const Vec3& position) {
  std::uint64_t result = 0;
  for (unsigned k = 0; k < 3; ++k) {
    // Adding zero turns -0 into 0.
    result = mixed(result + std::bit_cast<std::uint64_t>(position[k] + 0.0) + 0x9e3779b97f4a7c15ULL);
  }
  return result;
}

}  // namespace

VertexMerger::VertexMerger(std::size_t expected_positions)
    : slots_(std::bit_ceil(expected_positions + 8), kNone) {
  positions_.reserve(expected_positions / 4);
}

void VertexMerger::grow() {
  std::vector<Index> slots(slots_.size() * 2, kNone);
  for (Index vertex = 0; vertex < positions_.size(); ++vertex) {
    std::size_t slot = hash(positions_[vertex]) & (slots.size() - 1);
    while (slots[slot] != kNone) {
      slot = (slot + 1) & (slots.size() - 1);
    }
    slots[slot] = vertex;
  }
  slots_ = std::move(slots);
}

Index VertexMerger::add(const Vec3& position) {
  if (2 * positions_.size() >= slots_.size()) {
    grow();
  }
  std::size_t slot = hash(position) & (slots_.size() - 1);
  while (slots_[slot] != kNone) {
    if (positions_[slots_[slot]] == position) {
      return slots_[slot];
    }
    slot = (slot + 1) & (slots_.size() - 1);
  }
  slots_[slot] = static_cast<Index>(positions_.size());
  positions_.push_back(position);
  return slots_[slot];
}

}  // namespace isorelax
