#pragma once

#include <algorithm>
#include <span>

#include "mesh/triangle_mesh.h"

// Functions whose loops the compiler turns into vector instructions exist twice: for processors with AVX2 and
// for all. Both give the same bits: no operation is reordered or fused. Sanitizers cannot start a program
// that picks functions at load time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ISORELAX_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define ISORELAX_VECTOR_CLONES
#endif

namespace isorelax {

/// Triangles handled together: the loops over lanes are what gets vectorised.
inline constexpr unsigned kLanes = 8;

/// One number of each lane.
struct alignas(64) Lanes {
  double at[kLanes];
};

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

}  // namespace isorelax
