#include "smoothing/harmonic.h"

#include <Eigen/SparseCholesky>
#include <vector>

namespace isorelax {
namespace {

/// Whether every free vertex is connected to one that is not.
bool all_are_held(std::span<const Triangle> triangles, const Topology& topology, std::span<const Index> free,
                  std::span<const Index> number_of) {
  std::vector<std::uint8_t> held(free.size(), 0);
  std::vector<Index> waiting;
  const auto visit = [&](Index v, const auto& what) {
    for (const Corner c : topology.corners_of(v))
      for (const unsigned k : {next(c % 3), previous(c % 3)}) what(number_of[triangles[c / 3][k]]);
  };
  const auto hold = [&](Index i) {
    if (held[i] != 0) return;
    held[i] = 1;
    waiting.push_back(i);
  };
  for (Index i = 0; i < free.size(); ++i)
    visit(free[i], [&](Index other) {
      if (other == kNone) hold(i);
    });
  std::size_t count = 0;
  for (; !waiting.empty(); ++count) {
    const Index i = waiting.back();
    waiting.pop_back();
    visit(free[i], [&](Index other) {
      if (other != kNone) hold(other);
    });
  }
  return count == free.size();
}

}  // namespace

bool place_harmonically(std::span<Vec3> positions, std::span<const Triangle> triangles,
                        const Topology& topology, std::span<const Index> free) {
  std::vector<Index> number_of(positions.size(), kNone);
  for (Index i = 0; i < free.size(); ++i) number_of[free[i]] = i;
  if (!all_are_held(triangles, topology, free, number_of)) return false;
  const auto size = static_cast<Eigen::Index>(free.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(13 * free.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> right = Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(size, 3);
  for (Index i = 0; i < free.size(); ++i) {
    double weights = 0;
    for (const Corner c : topology.corners_of(free[i])) {
      for (const unsigned k : {next(c % 3), previous(c % 3)}) {
        const Index v = triangles[c / 3][k];
        weights += 1;
        if (number_of[v] == kNone) {
          right.row(i) += positions[v].transpose();
        } else {
          entries.emplace_back(static_cast<int>(i), static_cast<int>(number_of[v]), -1.0);
        }
      }
    }
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), weights);
  }
  Eigen::SparseMatrix<double> laplacian(size, size);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(laplacian);
  if (factors.info() != Eigen::Success) return false;
  const Eigen::Matrix<double, Eigen::Dynamic, 3> solution = factors.solve(right);
  if (!solution.allFinite()) return false;
  for (Index i = 0; i < free.size(); ++i) positions[free[i]] = solution.row(i).transpose();
  return true;
}

}  // namespace isorelax
