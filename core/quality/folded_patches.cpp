#include "quality/folded_patches.h"

#include <algorithm>

#include "mesh/disjoint_sets.h"
#include "quality/triangle_metrics.h"

namespace isorelax {
namespace {

constexpr std::size_t kLargestShare = 10;

struct Fold {
  Index from, to;
};

class Patches {
 public:
  Patches(std::span<const Vec3> positions, std::span<const Triangle> triangles, const Topology& topology)
      : triangles_(triangles), topology_(topology), parts_(triangles.size()), patches_(triangles.size()) {
    normals_.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles) {
      const bool flat = measure_triangle(positions[a], positions[b], positions[c]).degenerate;
      normals_.push_back(flat ? Vec3(Vec3::Zero())
                              : area_vector(positions[a], positions[b], positions[c]).stableNormalized());
    }
    join();
  }

  std::vector<std::uint8_t> folded() {
    std::vector<std::uint8_t> result(triangles_.size(), 0);
    if (folds_.empty()) return result;
    const std::vector<Index> order = largest_first();
    std::vector<std::uint8_t> side(triangles_.size(), 0);  // by patch; 0: unknown, 1: up, 2: down
    std::vector<Index> large;
    for (const Index patch : order)
      if (!is_small(patch)) large.push_back(patch);
    spread(large, side);
    for (const Index patch : order) spread({patch}, side);
    for (Index t = 0; t < triangles_.size(); ++t) {
      const Index patch = patches_.find(t);
      result[t] = side[patch] == 2 ? 1 : 0;
    }
    return result;
  }

 private:
  void join() {
    for (Corner c = 0; c < 3 * triangles_.size(); ++c) {
      const Corner beyond = topology_.opposite(c);
      if (beyond == kNone || beyond < c) continue;
      const Index t = c / 3, u = beyond / 3;
      if (triangles_[u][next(beyond % 3)] != triangles_[t][previous(c % 3)]) continue;
      parts_.join(t, u);
      if (normals_[t].isZero(0) || normals_[u].isZero(0)) continue;
      if (normals_[t].dot(normals_[u]) < kPatchFoldCosine) {
        folds_.push_back({t, u});
        folds_.push_back({u, t});
      } else {
        patches_.join(t, u);
      }
    }
  }

  /// Patches that have a fold, larger ones first.
  std::vector<Index> largest_first() {
    patch_size_.assign(triangles_.size(), 0);
    part_size_.assign(triangles_.size(), 0);
    for (Index t = 0; t < triangles_.size(); ++t) {
      ++patch_size_[patches_.find(t)];
      ++part_size_[parts_.find(t)];
    }
    std::vector<Index> order;
    for (Fold& fold : folds_) {
      fold = {patches_.find(fold.from), patches_.find(fold.to)};
      order.push_back(fold.from);
    }
    std::sort(folds_.begin(), folds_.end(),
              [](const Fold& a, const Fold& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; });
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      return patch_size_[a] != patch_size_[b] ? patch_size_[a] > patch_size_[b] : a < b;
    });
    order.erase(std::unique(order.begin(), order.end()), order.end());
    return order;
  }

  bool is_small(Index patch) { return kLargestShare * patch_size_[patch] <= part_size_[parts_.find(patch)]; }

  /// Sets these patches right side up where they have no side yet, and from there all that folds lead
  /// to.
  void spread(const std::vector<Index>& starts, std::vector<std::uint8_t>& side) const {
    std::vector<Index> waiting;
    for (const Index patch : starts) {
      if (side[patch] != 0) continue;
      side[patch] = 1;
      waiting.push_back(patch);
    }
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      const Index patch = waiting[i];
      auto fold = std::lower_bound(folds_.begin(), folds_.end(), patch,
                                   [](const Fold& f, Index p) { return f.from < p; });
      for (; fold != folds_.end() && fold->from == patch; ++fold) {
        if (side[fold->to] != 0) continue;
        side[fold->to] = side[patch] == 1 ? 2 : 1;
        waiting.push_back(fold->to);
      }
    }
  }

  std::span<const Triangle> triangles_;
  const Topology& topology_;
  std::vector<Vec3> normals_;
  DisjointSets parts_, patches_;
  std::vector<Fold> folds_;
  std::vector<std::size_t> patch_size_, part_size_;
};

}  // namespace

std::vector<std::uint8_t> folded_patches(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                         const Topology& topology) {
  return Patches(positions, triangles, topology).folded();
}

}  // namespace isorelax
