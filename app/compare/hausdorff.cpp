#include "compare/hausdorff.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "mesh/parallel.h"
#include "surface/closest_point.h"

namespace isorelax::compare {
namespace {

constexpr std::size_t kRefined = 64;
constexpr int kGridSteps = 24;

/// Weights of a triangle's corners: vertices, midpoints, centroid, three points inside.
const std::array<Vec3, 10>& samples() {
  static const std::array<Vec3, 10> points{
      Vec3(1, 0, 0),
      Vec3(0, 1, 0),
      Vec3(0, 0, 1),
      Vec3(0.5, 0.5, 0),
      Vec3(0, 0.5, 0.5),
      Vec3(0.5, 0, 0.5),
      Vec3(1.0 / 3, 1.0 / 3, 1.0 / 3),
      Vec3(2.0 / 3, 1.0 / 6, 1.0 / 6),
      Vec3(1.0 / 6, 2.0 / 3, 1.0 / 6),
      Vec3(1.0 / 6, 1.0 / 6, 2.0 / 3),
  };
  return points;
}

class Search {
 public:
  Search(const TriangleMesh& from, const TriangleMesh& to)
      : from_(from), index_(to.positions, to.triangles), found_(from.triangles.size()) {}

  OneSided run() {
    parallel_for_blocks(found_.size(), 0, [&](std::size_t begin, std::size_t end) {
      Index hint = kNone;
      for (std::size_t t = begin; t < end; ++t)
        for (const Vec3& weights : samples()) hint = look(t, weights, hint);
    });
    refine();
    return *std::ranges::max_element(found_, {}, &OneSided::distance);
  }

 private:
  Index look(std::size_t t, const Vec3& weights, Index hint) {
    const Triangle& v = from_.triangles[t];
    const Vec3 point = weights[0] * from_.positions[v[0]] + weights[1] * from_.positions[v[1]] +
                       weights[2] * from_.positions[v[2]];
    const SurfacePoint closest = index_.closest(point, hint);
    if (closest.distance > found_[t].distance) found_[t] = {closest.distance, point, closest.point};
    return closest.triangle;
  }

  void refine() {
    std::vector<std::size_t> order(found_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto count = static_cast<std::ptrdiff_t>(std::min(kRefined, order.size()));
    std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](std::size_t a, std::size_t b) {
      return found_[a].distance != found_[b].distance ? found_[a].distance > found_[b].distance : a < b;
    });
    for (std::ptrdiff_t k = 0; k < count; ++k)
      for (int i = 0; i <= kGridSteps; ++i)
        for (int j = 0; i + j <= kGridSteps; ++j)
          look(order[static_cast<std::size_t>(k)], Vec3(i, j, kGridSteps - i - j) / kGridSteps, kNone);
  }

  const TriangleMesh& from_;
  ClosestPointIndex index_;
  std::vector<OneSided> found_;
};

}  // namespace

OneSided farthest(const TriangleMesh& from, const TriangleMesh& to) {
  return Search(from, to).run();
}

}  // namespace isorelax::compare
