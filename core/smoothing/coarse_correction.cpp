#include "smoothing/coarse_correction.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// More groups than this are put together once more: factors of the system are not to outgrow the mesh. Twice
/// put together, groups say little: a sphere of 600,000 triangles took 139 steps with them, and 22 without.
constexpr Index kMostGroups = 100000;
/// Share of the mean diagonal that is added to it: a closed surface may turn about itself for nothing, and on
/// a line there is no second unknown.
constexpr double kCoarseShift = 1e-6;
/// Pairs of corners, those with themselves first.
constexpr std::array<std::array<unsigned, 2>, 6> kCornerPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {1, 0}, {2, 0}, {2, 1}}};

using Neighbours = std::vector<std::vector<Index>>;

void sort_each(Neighbours& neighbours) {
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

/// Vertices that may move, along the edges of the treated triangles.
Neighbours mobile_neighbours(const SmoothingProblem& problem) {
  Neighbours neighbours(problem.vertex_count());
  const auto is_mobile = [&](Index v) { return problem.mobility[v] != Mobility::none; };
  for (Index t = 0; t < problem.triangle_count(); ++t) {
    if (problem.treated[t] == 0) continue;
    for (unsigned k = 0; k < 3; ++k) {
      const Index a = problem.triangles[t][k];
      const Index b = problem.triangles[t][next(k)];
      if (!is_mobile(a) || !is_mobile(b)) continue;
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
  }
  sort_each(neighbours);
  return neighbours;
}

/// The same for groups of vertices.
Neighbours group_neighbours(const Neighbours& vertices, std::span<const Index> group_of, Index groups) {
  Neighbours neighbours(groups);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    for (const Index w : vertices[v])
      if (group_of[w] != group_of[v]) neighbours[group_of[v]].push_back(group_of[w]);
  }
  sort_each(neighbours);
  return neighbours;
}

/// Vertices that may move, those whose triangles have the most energy first; what differs by rounding only
/// counts as alike.
std::vector<Index> worst_first(const SmoothingProblem& problem, const Objective& here) {
  constexpr double kDigits = 1e9;
  std::vector<std::pair<double, Index>> ranked;
  for (Index v = 0; v < problem.vertex_count(); ++v) {
    if (problem.mobility[v] == Mobility::none) continue;
    double sum = 0;
    for (const Corner c : problem.topology.corners_of(v)) sum += here.powered()[c / 3];
    ranked.emplace_back(-std::round(kDigits * std::log1p(sum)), v);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<Index> order;
  order.reserve(ranked.size());
  for (const auto& [rank, v] : ranked) order.push_back(v);
  return order;
}

/// Puts the nodes of `order` into groups: whole neighbourhoods that do not touch first, then what is left to
/// one next to it. All others get kNone. Returns the number of groups.
Index group_nodes(const Neighbours& neighbours, std::span<const Index> order, std::vector<Index>& group_of) {
  constexpr Index kWaiting = kNone - 1;
  group_of.assign(neighbours.size(), kNone);
  for (const Index v : order) group_of[v] = kWaiting;
  const auto is_free = [&](Index v) { return group_of[v] == kWaiting; };
  Index count = 0;
  for (const Index v : order) {
    if (!is_free(v) || !std::all_of(neighbours[v].begin(), neighbours[v].end(), is_free)) continue;
    group_of[v] = count;
    for (const Index w : neighbours[v]) group_of[w] = count;
    ++count;
  }
  // A node that is left has a neighbour in a whole neighbourhood, else it would have begun one.
  const std::vector<Index> whole = group_of;
  for (const Index v : order) {
    if (!is_free(v)) continue;
    for (const Index w : neighbours[v])
      if (whole[w] != kWaiting) group_of[v] = std::min(group_of[v], whole[w]);
  }
  return count;
}

}  // namespace

CoarseCorrection::CoarseCorrection(const SmoothingProblem& problem, const Objective& here)
    : problem_(problem) {
  find_groups(here);
  find_pattern();
}

void CoarseCorrection::find_groups(const Objective& here) {
  const Neighbours vertices = mobile_neighbours(problem_);
  const std::vector<Index> order = worst_first(problem_, here);
  Index count = group_nodes(vertices, order, group_of_);
  while (count > kMostGroups) {
    std::vector<Index> all(count);
    std::iota(all.begin(), all.end(), 0);
    std::vector<Index> merged;
    const Index fewer = group_nodes(group_neighbours(vertices, group_of_, count), all, merged);
    for (Index& g : group_of_)
      if (g != kNone) g = merged[g];
    if (fewer == count) break;
    count = fewer;
  }
  groups_.resize(count);
  // In this order, the first vertex of a group does not depend on the numbers either.
  for (const Index v : order) groups_[group_of_[v]].push_back(v);
  // Tangent planes rather than lines come first: a line spans only half of what the others need.
  for (auto& group : groups_) {
    const auto in_plane = [&](Index v) { return problem_.mobility[v] == Mobility::plane; };
    std::stable_partition(group.begin(), group.end(), in_plane);
  }
  frames_.resize(count);
}

void CoarseCorrection::find_pattern() {
  const auto place = [&](const Triangle& x, const std::array<unsigned, 2>& pair) {
    const Index a = group_of_[x[pair[0]]];
    const Index b = group_of_[x[pair[1]]];
    return std::array{std::min(a, b), std::max(a, b)};
  };
  for (Index g = 0; g < groups_.size(); ++g) places_.push_back({g, g});
  for (Index t = 0; t < problem_.triangle_count(); ++t) {
    if (problem_.treated[t] == 0) continue;
    const Triangle& x = problem_.triangles[t];
    if (group_of_[x[0]] == group_of_[x[1]] && group_of_[x[1]] == group_of_[x[2]]) continue;
    elements_.push_back({t, {}});
    for (const auto& pair : kCornerPairs)
      if (place(x, pair)[1] != kNone) places_.push_back(place(x, pair));
  }
  std::sort(places_.begin(), places_.end());
  places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  blocks_.resize(places_.size());
  for (Element& element : elements_) {
    for (unsigned i = 0; i < kCornerPairs.size(); ++i) {
      const auto wanted = place(problem_.triangles[element.triangle], kCornerPairs[i]);
      const auto found = std::lower_bound(places_.begin(), places_.end(), wanted);
      element.slots[i] = wanted[1] == kNone ? kNone : static_cast<std::uint32_t>(found - places_.begin());
    }
  }
  const auto unknowns = static_cast<Eigen::Index>(2 * groups_.size());
  matrix_.resize(unknowns, unknowns);
  right_.setZero(unknowns);
  solution_.setZero(unknowns);
}

/// The terms are those of `block_terms`, here between any two corners.
CoarseCorrection::ElementMatrix CoarseCorrection::matrix_of(Index triangle, const Objective& here,
                                                            std::span<const NewtonBlock> blocks) const {
  const Triangle& x = problem_.triangles[triangle];
  const TriangleState& s = here.state(triangle);
  const ReferenceTriangle reference = problem_.reference[triangle];
  const EnergyWeights w = problem_.weights;
  const Vec3 e1(s.e1x, s.e1y, s.e1z);
  const Vec3 e2(s.e2x, s.e2y, s.e2z);
  const std::array<Vec3, 3> l{e2 - e1, -e2, e1};
  const Vec3 area = e1.cross(e2);
  const double d2 = area.norm();
  const Vec3 n = area / d2;
  const double root = std::sqrt(d2 / reference.d1);
  const double convex = 0.75 / root;
  const double area_curvature = std::max(convex - 0.25 * root, kLeastAreaCurvature * convex);
  const double energy = here.energy(triangle);
  const double first = problem_.exponent * s.powered / energy;
  const double excess = energy / (kSliverEnergy * (w.shape + w.area));
  const double second = (problem_.exponent - 1) * first / energy / (1 + excess * excess);
  const double mixed = -first * w.shape / (d2 * d2);
  const double along = first * (2 * w.shape * s.shape + w.area * area_curvature) / (d2 * d2);
  const double tangent = (0.5 * w.area * (root - 1 / root) - w.shape * s.shape) / d2;

  // Of each unknown: the move of its corner in the triangle's plane, and what it makes of dD2, d(K D2) and
  // dE.
  std::array<Vec3, 6> move;
  Eigen::Matrix<double, 6, 1> u, q, g;
  for (unsigned i = 0; i < 3; ++i) {
    const Vec3 du = n.cross(l[i]);
    const Vec3 dq = 2 * (reference.cot[next(i)] * l[next(i)] - reference.cot[previous(i)] * l[previous(i)]);
    const Index group = group_of_[x[i]];
    for (unsigned c = 0; c < 2; ++c) {
      const unsigned a = 2 * i + c;
      const Vec3 moved = group == kNone ? Vec3(Vec3::Zero()) : blocks[x[i]].tangent(frames_[group][c]);
      move[a] = moved - n * n.dot(moved);
      u[a] = du.dot(moved);
      q[a] = dq.dot(moved);
      g[a] = w.shape * q[a] / d2 + tangent * u[a];
    }
  }
  ElementMatrix matrix = mixed * (q * u.transpose() + u * q.transpose()) + along * u * u.transpose() +
                         second * g * g.transpose();
  for (unsigned a = 0; a < 6; ++a) {
    for (unsigned b = 0; b < 6; ++b) {
      const unsigned i = a / 2, j = b / 2;
      const double cot =
          i == j ? reference.cot[next(i)] + reference.cot[previous(i)] : -reference.cot[3 - i - j];
      matrix(a, b) += 2 * first * w.shape / d2 * cot * move[a].dot(move[b]);
    }
  }
  return matrix;
}

void CoarseCorrection::add(const Element& element, const ElementMatrix& matrix) {
  const Triangle& x = problem_.triangles[element.triangle];
  for (unsigned p = 0; p < kCornerPairs.size(); ++p) {
    if (element.slots[p] == kNone) continue;
    auto [row, column] = kCornerPairs[p];
    if (group_of_[x[row]] < group_of_[x[column]]) std::swap(row, column);
    const Eigen::Matrix2d block = matrix.block<2, 2>(2 * row, 2 * column);
    blocks_[element.slots[p]] += block;
    // Two corners in one group: the pair counts both ways there.
    if (row != column && group_of_[x[row]] == group_of_[x[column]])
      blocks_[element.slots[p]] += block.transpose();
  }
}

void CoarseCorrection::refresh(const Objective& here, std::span<const NewtonBlock> blocks) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const NewtonBlock& block = blocks[groups_[g].front()];
    frames_[g] = {block.t1, block.t2};
  }
  for (Eigen::Matrix2d& block : blocks_) block.setZero();
  for (const Element& element : elements_) add(element, matrix_of(element.triangle, here, blocks));
  factor();
}

void CoarseCorrection::factor() {
  double trace = 0;
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (places_[i][0] == places_[i][1]) trace += blocks_[i].trace();
  const double shift = kCoarseShift * trace / static_cast<double>(right_.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const int row = static_cast<int>(2 * places_[i][1]);
    const int column = static_cast<int>(2 * places_[i][0]);
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 2; ++c) {
        const bool on_diagonal = row + r == column + c;
        if (row + r >= column + c)
          entries.emplace_back(row + r, column + c, blocks_[i](r, c) + (on_diagonal ? shift : 0));
      }
    }
  }
  matrix_.setFromTriplets(entries.begin(), entries.end());
  if (!analysed_) factor_.analyzePattern(matrix_);
  analysed_ = true;
  factor_.factorize(matrix_);
  factored_ = factor_.info() == Eigen::Success;
}

void CoarseCorrection::solve(std::span<const Vec3> residual, std::span<const NewtonBlock> blocks) {
  if (!factored_) return;
  parallel_for_blocks(groups_.size(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      Vec3 sum = Vec3::Zero();
      for (const Index v : groups_[g]) sum += blocks[v].tangent(residual[v]);
      right_[static_cast<Eigen::Index>(2 * g)] = sum.dot(frames_[g][0]);
      right_[static_cast<Eigen::Index>(2 * g + 1)] = sum.dot(frames_[g][1]);
    }
  });
  solution_ = factor_.solve(right_);
}

}  // namespace isorelax
