#pragma once

#include <algorithm>
#include <span>

#include "energy/reference.h"
#include "mesh/lanes.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// The triangles of one batch: the last one repeated to fill it up.
struct BatchIds {
  Index at[kLanes];
  unsigned count;

  /// Triangles first, first + 1, ... below end.
  static BatchIds of_range(std::size_t first, std::size_t end) {
    BatchIds ids;
    ids.count = static_cast<unsigned>(std::min<std::size_t>(kLanes, end - first));
    for (unsigned i = 0; i < kLanes; ++i) ids.at[i] = static_cast<Index>(first + std::min(i, ids.count - 1));
    return ids;
  }
  /// list[first], list[first + 1], ...
  static BatchIds of_list(std::span<const Index> list, std::size_t first) {
    BatchIds ids = of_range(first, list.size());
    for (Index& id : ids.at) id = list[id];
    return ids;
  }
};

/// The edges of eight triangles from their first vertex, one number per lane.
struct EdgeBatch {
  Lanes e1x, e1y, e1z, e2x, e2y, e2z;

  void load(std::span<const Vec3> positions, std::span<const Triangle> triangles, const BatchIds& ids) {
    for (unsigned i = 0; i < kLanes; ++i) {
      const Triangle& t = triangles[ids.at[i]];
      const double* a = positions[t[0]].data();
      const double* b = positions[t[1]].data();
      const double* c = positions[t[2]].data();
      e1x.at[i] = b[0] - a[0];
      e1y.at[i] = b[1] - a[1];
      e1z.at[i] = b[2] - a[2];
      e2x.at[i] = c[0] - a[0];
      e2y.at[i] = c[1] - a[1];
      e2z.at[i] = c[2] - a[2];
    }
  }
};

/// The reference triangles of a batch.
struct ReferenceBatch {
  Lanes cot0, cot1, cot2, inverse_d1;

  static ReferenceBatch load(const ReferenceMesh& reference, const BatchIds& ids) {
    ReferenceBatch batch;
    for (unsigned i = 0; i < kLanes; ++i) {
      const ReferenceTriangle r = reference[ids.at[i]];
      batch.cot0.at[i] = r.cot[0];
      batch.cot1.at[i] = r.cot[1];
      batch.cot2.at[i] = r.cot[2];
      batch.inverse_d1.at[i] = 1 / r.d1;
    }
    return batch;
  }
};

}  // namespace isorelax
