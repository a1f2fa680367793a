#include "motion/block_system.h"

#include <algorithm>

namespace isorelax {

BlockSystem::BlockSystem(std::span<const Triangle> triangles, Index vertex_count)
    : triangles_(triangles.begin(), triangles.end()) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index v = 0; v < vertex_count; ++v)
    for (const auto& [row, column] : {std::pair{0, 0}, {1, 0}, {1, 1}})
      entries.emplace_back(2 * v + row, 2 * v + column, 1);
  for (const Triangle& t : triangles_) {
    for (unsigned k = 0; k < 3; ++k) {
      const Index high = std::max(t[k], t[next(k)]);
      const Index low = std::min(t[k], t[next(k)]);
      for (Index i = 0; i < 4; ++i) entries.emplace_back(2 * high + i / 2, 2 * low + i % 2, 0);
    }
  }
  const auto size = static_cast<Eigen::Index>(2) * vertex_count;
  matrix_.resize(size, size);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  matrix_.makeCompressed();
  shift_.assign(vertex_count, 0);
  right_.setZero(size);
  solution_.setZero(size);
  for (Index v = 0; v < vertex_count; ++v)
    diagonal_.push_back({slot(2 * v, 2 * v), slot(2 * v + 1, 2 * v), slot(2 * v + 1, 2 * v + 1)});
  for (const Triangle& t : triangles_) {
    std::array<Eigen::Index, 36> slots{};
    for (Index i = 0; i < 36; ++i) {
      const Index row = 2 * t[i / 6 / 2] + i / 6 % 2;
      const Index column = 2 * t[i % 6 / 2] + i % 6 % 2;
      slots[i] = row >= column ? slot(row, column) : -1;
    }
    slots_.push_back(slots);
  }
  factor_.analyzePattern(matrix_);
}

Eigen::Index BlockSystem::slot(Index row, Index column) const {
  const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
  const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
  return std::lower_bound(begin, end, static_cast<int>(row)) - matrix_.innerIndexPtr();
}

void BlockSystem::clear() {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  right_.setZero();
}

void BlockSystem::add(Index triangle, const Eigen::Matrix<double, 6, 6>& matrix,
                      const Eigen::Matrix<double, 6, 1>& gradient) {
  const auto& slots = slots_[triangle];
  double* values = matrix_.valuePtr();
  for (int i = 0; i < 36; ++i)
    if (slots[i] >= 0) values[slots[i]] += matrix(i / 6, i % 6);
  for (unsigned k = 0; k < 3; ++k)
    right_.segment<2>(2 * triangles_[triangle][k]) -= gradient.segment<2>(2 * k);
}

void BlockSystem::add_diagonal(Index vertex, const Eigen::Matrix2d& matrix) {
  double* values = matrix_.valuePtr();
  values[diagonal_[vertex][0]] += matrix(0, 0);
  values[diagonal_[vertex][1]] += matrix(1, 0);
  values[diagonal_[vertex][2]] += matrix(1, 1);
}

void BlockSystem::hold(Index vertex) {
  // So stiff that it does not move: the pattern stays.
  constexpr double kStiff = 1e12;
  const double scale =
      std::max({matrix_.valuePtr()[diagonal_[vertex][0]], matrix_.valuePtr()[diagonal_[vertex][2]], 1.0});
  add_diagonal(vertex, kStiff * scale * Eigen::Matrix2d::Identity());
  right_.segment<2>(2 * vertex).setZero();
}

bool BlockSystem::solve(double shift) {
  const auto add_shift = [&](double sign) {
    for (std::size_t v = 0; v < shift_.size(); ++v) {
      matrix_.valuePtr()[diagonal_[v][0]] += sign * shift * shift_[v];
      matrix_.valuePtr()[diagonal_[v][2]] += sign * shift * shift_[v];
    }
  };
  add_shift(1);
  factor_.factorize(matrix_);
  add_shift(-1);
  if (factor_.info() != Eigen::Success) return false;
  solution_ = factor_.solve(right_);
  return solution_.allFinite();
}

}  // namespace isorelax
