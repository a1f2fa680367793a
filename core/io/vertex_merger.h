#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Gives the same vertex to positions that are the same bit for bit (-0 counts as 0), numbered in order of
/// first appearance. Expected O(1) per position.
class VertexMerger {
 public:
  explicit VertexMerger(std::size_t expected_positions);

  /// The vertex at `position`, new or known.
  Index add(const Vec3& position);

  [[nodiscard]] std::size_t size() const { return positions_.size(); }
  [[nodiscard]] std::vector<Vec3>& positions() { return positions_; }

 private:
  void grow();

  std::vector<Vec3> positions_;
  /// Open addressing, a power of two, at most half full.
  std::vector<Index> slots_;
};

}  // namespace isorelax
