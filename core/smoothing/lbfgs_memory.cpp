#include "smoothing/lbfgs_memory.h"

#include <algorithm>
#include <cmath>

namespace isorelax {
namespace {

/// Curvature below this share of |move| |change| is rounding.
constexpr double kLeastCurvature = 1e-8;

}  // namespace

LbfgsMemory::LbfgsMemory(std::size_t vertices, unsigned pairs, unsigned threads)
    : vertices_(vertices), pairs_(pairs), threads_(threads), slots_(pairs + 1) {
  for (Pair& slot : slots_) slot.with_changes.assign(slots_.size(), 0);
}

template <typename Body>
void LbfgsMemory::reduce(std::size_t count, const Body& body) {
  partials_.assign(count * block_count(vertices_), 0);
  parallel_for_blocks(vertices_, threads_, [&](std::size_t begin, std::size_t end) {
    body(begin, end, partials_.data() + count * (begin / kBlockSize));
  });
  totals_.assign(count, 0);
  for (std::size_t i = 0; i < partials_.size(); ++i) totals_[i % count] += partials_[i];
}

void LbfgsMemory::arrive(std::span<const Vec3> positions, const Field& gradient, const Field& wanted,
                         double useless) {
  if (last_positions_.empty()) {
    last_positions_.assign(positions.begin(), positions.end());
    last_gradient_ = gradient;
    return;
  }
  std::uint32_t free = 0;
  while (std::find(used_.begin(), used_.end(), free) != used_.end()) ++free;
  Pair& made = slots_[free];
  made.move.resize(vertices_);
  made.change.resize(vertices_);
  const std::size_t n = used_.size();
  // What every remembered move makes with the new change and with the gradient, then what the new one makes.
  reduce(2 * n + 4, [&](std::size_t begin, std::size_t end, double* sums) {
    double* own = sums + 2 * n;
    for (std::size_t v = begin; v < end; ++v) {
      made.move[v] = positions[v] - last_positions_[v];
      made.change[v] = gradient[v] - last_gradient_[v];
      last_positions_[v] = positions[v];
      last_gradient_[v] = gradient[v];
      own[0] += made.move[v].dot(made.change[v]);
      own[1] += made.move[v].dot(wanted[v]);
      own[2] += made.move[v].squaredNorm();
      own[3] += made.change[v].squaredNorm();
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Field& move = slots_[used_[k]].move;
      double change = 0, along = 0;
      for (std::size_t v = begin; v < end; ++v) {
        change += move[v].dot(made.change[v]);
        along += move[v].dot(wanted[v]);
      }
      sums[2 * k] = change;
      sums[2 * k + 1] = along;
    }
  });
  for (std::size_t k = 0; k < n; ++k) {
    pair(k).with_changes[free] = totals_[2 * k];
    pair(k).along_gradient = totals_[2 * k + 1];
  }
  const double* own = totals_.data() + 2 * n;
  made.with_changes[free] = own[0];
  made.along_gradient = own[1];
  if (own[2] < useless * useless) {
    clear();
  } else if (own[0] > kLeastCurvature * std::sqrt(own[2] * own[3])) {
    used_.push_back(free);
    if (used_.size() > pairs_) used_.erase(used_.begin());
  }
}

double LbfgsMemory::direction(const Field& wanted, std::span<const NewtonBlock> blocks,
                              CoarseCorrection* coarse, Field& direction) {
  const std::size_t n = used_.size();
  std::vector<double> alpha(n), share(n);
  for (std::size_t k = n; k-- > 0;) {
    double along = pair(k).along_gradient;
    for (std::size_t j = k + 1; j < n; ++j) along -= alpha[j] * pair(k).with_changes[used_[j]];
    alpha[k] = along / pair(k).with_changes[used_[k]];
  }
  parallel_for_blocks(vertices_, threads_, [&](std::size_t begin, std::size_t end) {
    std::copy(wanted.begin() + begin, wanted.begin() + end, direction.begin() + begin);
    for (std::size_t k = n; k-- > 0;) {
      const Field& change = slots_[used_[k]].change;
      for (std::size_t v = begin; v < end; ++v) direction[v] -= alpha[k] * change[v];
    }
  });
  if (coarse) coarse->solve(direction, blocks);
  reduce(n, [&](std::size_t begin, std::size_t end, double* sums) {
    for (std::size_t v = begin; v < end; ++v) {
      direction[v] = blocks[v].solve(direction[v]);
      if (coarse) direction[v] += coarse->at(static_cast<Index>(v), blocks[v]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Field& change = slots_[used_[k]].change;
      for (std::size_t v = begin; v < end; ++v) sums[k] += change[v].dot(direction[v]);
    }
  });
  for (std::size_t k = 0; k < n; ++k) {
    double along = totals_[k];
    for (std::size_t j = 0; j < k; ++j) along += share[j] * pair(j).with_changes[used_[k]];
    share[k] = alpha[k] - along / pair(k).with_changes[used_[k]];
  }
  reduce(1, [&](std::size_t begin, std::size_t end, double* sums) {
    for (std::size_t k = 0; k < n; ++k) {
      const Field& move = slots_[used_[k]].move;
      for (std::size_t v = begin; v < end; ++v) direction[v] += share[k] * move[v];
    }
    for (std::size_t v = begin; v < end; ++v) {
      direction[v] = -blocks[v].tangent(direction[v]);
      sums[0] += direction[v].dot(wanted[v]);
    }
  });
  return totals_[0];
}

}  // namespace isorelax
