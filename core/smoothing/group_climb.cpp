#include "smoothing/group_climb.h"

#include <algorithm>
#include <cmath>

#include "mesh/disjoint_sets.h"
#include "smoothing/trial.h"

namespace isorelax {
namespace {

/// Share of each unknown's own curvature that is added to it.
constexpr double kGroupDamping = 0.03;
/// No vertex goes farther than this share of its shortest edge.
constexpr double kGroupReach = 0.2;
constexpr unsigned kGroupHalvings = 8;
/// Share of the sum below which an angle counts nothing.
constexpr double kNoWeight = 1e-12;
/// Where the smallest angles would fall by too much together, they rise by this much of it instead, by moves
/// for which an unknown's curvature is at least this share of the largest.
constexpr double kBack = 2;
constexpr double kBackDamping = 1e-4;
/// Share of the largest that an unknown of no angle that counts has as its curvature, so that it has any.
constexpr double kFree = 1e-8;

}  // namespace

GroupClimb::GroupClimb(const SmoothingProblem& problem)
    : problem_(problem), place_(problem.vertex_count(), kNone) {}

std::vector<GroupClimb::Group> GroupClimb::find_groups(const PolishState& state,
                                                       std::span<const std::uint8_t> flags) const {
  const std::size_t n = problem_.vertex_count();
  DisjointSets sets(n);
  std::vector<std::uint8_t> is_in(n, 0);
  for (Index t = 0; t < problem_.triangle_count(); ++t) {
    if (flags[t] == 0) continue;
    Index last = kNone;
    for (const Index v : problem_.triangles[t]) {
      if (problem_.mobility[v] == Mobility::none) continue;
      is_in[v] = 1;
      if (last != kNone) sets.join(last, v);
      last = v;
    }
  }
  std::vector<Group> groups;
  std::vector<Index> group_of(n, kNone);
  for (Index v = 0; v < n; ++v) {
    if (is_in[v] == 0) continue;
    Index& number = group_of[sets.find(v)];
    if (number == kNone) {
      number = static_cast<Index>(groups.size());
      groups.emplace_back();
    }
    groups[number].vertices.push_back(v);
    for (const Corner c : problem_.topology.corners_of(v))
      if (state.can_change(c / 3)) groups[number].triangles.push_back(c / 3);
  }
  for (Group& group : groups) {
    std::sort(group.triangles.begin(), group.triangles.end());
    group.triangles.erase(std::unique(group.triangles.begin(), group.triangles.end()), group.triangles.end());
  }
  return groups;
}

double GroupClimb::sweep(PolishState& state, Aim aim, std::span<const std::uint8_t> flags) {
  there_ = state.positions();
  double most = 0;
  for (const Group& group : find_groups(state, flags)) most = std::max(most, climb(state, aim, group));
  return most;
}

double GroupClimb::climb(PolishState& state, Aim& aim, const Group& group) {
  const std::optional<double> before = value(aim, group);
  if (!before) return 0;
  const double smallest = smallest_;
  find_moves(state, aim, group, *before);
  const std::vector<Vec3>& from = state.positions();
  double gain = 0, share = 1;
  for (unsigned halvings = 0; halvings <= kGroupHalvings && gain == 0; ++halvings, share /= 2) {
    for (std::size_t i = 0; i < group.vertices.size(); ++i) {
      const Index v = group.vertices[i];
      there_[v] = bring_back(problem_, v, from[v] + share * moves_[i]);
    }
    const std::optional<double> after = value(aim, group);
    if (!after || !(*after > *before) || smallest - smallest_ > aim.spare) continue;
    if (!state.move_together(group.vertices, there_)) continue;
    gain = *after - *before;
    aim.spare += smallest_ - smallest;
  }
  for (const Index v : group.vertices) there_[v] = from[v];
  return gain;
}

std::optional<double> GroupClimb::value(const Aim& aim, const Group& group) {
  scores_.clear();
  smallest_ = 0;
  double least = INFINITY;
  for (const Index t : group.triangles) {
    const auto& [a, b, c] = problem_.triangles[t];
    const std::array<double, 3> angles = triangle_angles(there_[a], there_[b], there_[c]);
    smallest_ += std::min({angles[0], angles[1], angles[2]});
    for (const double angle : angles) {
      if (angle < aim.bound.min || angle > aim.bound.max) return std::nullopt;
      for (const double score : {aim.goal.of_small(angle), aim.goal.of_large(angle)}) {
        scores_.push_back(score);
        least = std::min(least, score);
      }
    }
  }
  double sum = 0;
  for (const double score : scores_) sum += std::exp(-aim.sharpness * (score - least));
  return least - std::log(sum) / aim.sharpness;
}

/// With weights p that add up to 1, the slope is sum p g, and the second derivative -b (sum p g g^T - slope
/// slope^T). The latter term only makes the step longer: by 1 / (1 - b slope . d), where d is the step
/// without.
void GroupClimb::find_moves(PolishState& state, const Aim& aim, const Group& group, double value) {
  const auto count = static_cast<Index>(group.vertices.size());
  spaces_.clear();
  for (Index i = 0; i < count; ++i) {
    const Index v = group.vertices[i];
    place_[v] = i;
    spaces_.emplace_back(problem_.mobility[v], tangent_axis(problem_, there_, v));
  }
  entries_.clear();
  slope_.setZero(2 * count);
  smallest_slope_.setZero(2 * count);
  for (const Index t : group.triangles) add_triangle(aim, t, value);
  Eigen::SparseMatrix<double> matrix(2 * count, 2 * count);
  for (Index i = 0; i < 2 * count; ++i) entries_.emplace_back(i, i, 0);
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  double largest = 0;
  for (Index i = 0; i < 2 * count; ++i) largest = std::max(largest, matrix.coeff(i, i));
  if (largest == 0) largest = 1;
  for (Index i = 0; i < 2 * count; ++i) {
    double& own = matrix.coeffRef(i, i);
    own = own > 0 ? (1 + kGroupDamping) * own : kFree * largest;
  }
  using Factors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>;
  Eigen::VectorXd step = Factors(matrix).solve(slope_);
  double share = 1 / std::max(1 - aim.sharpness * slope_.dot(step), kGroupDamping);
  const double loss = -smallest_slope_.dot(step);
  if (loss * share > aim.spare) {
    for (Index i = 0; i < 2 * count; ++i) matrix.coeffRef(i, i) += kBackDamping * largest;
    const Eigen::VectorXd back = Factors(matrix).solve(smallest_slope_);
    step += kBack * loss / smallest_slope_.dot(back) * back;
  }
  moves_.clear();
  for (Index i = 0; i < count; ++i) {
    const Index v = group.vertices[i];
    place_[v] = kNone;
    moves_.emplace_back(step[2 * i] * spaces_[i].t1 + step[2 * i + 1] * spaces_[i].t2);
    const double reach = kGroupReach * state.look_at(v).shortest_edge(there_[v]);
    if (moves_.back().norm() * share > reach) share = reach / moves_.back().norm();
  }
  for (Vec3& move : moves_) move *= share;
}

void GroupClimb::add_triangle(const Aim& aim, Index triangle, double value) {
  const Triangle& t = problem_.triangles[triangle];
  const std::array<Vec3, 3> x = {there_[t[0]], there_[t[1]], there_[t[2]]};
  const std::array<double, 3> angles = triangle_angles(x[0], x[1], x[2]);
  std::array<std::array<Vec3, 3>, 3> gradients;  // for each corner, of each angle
  for (unsigned k = 0; k < 3; ++k) {
    const std::array<Vec3, 3> around = angle_gradients(x[k], x[next(k)], x[previous(k)]);
    for (unsigned j = 0; j < 3; ++j) gradients[k][(k + j) % 3] = around[j];
  }
  const auto least = static_cast<unsigned>(std::ranges::min_element(angles) - angles.begin());
  for (unsigned k = 0; k < 3; ++k) {
    const Index place = place_[t[k]];
    if (place == kNone) continue;
    smallest_slope_[2 * place] += gradients[k][least].dot(spaces_[place].t1);
    smallest_slope_[2 * place + 1] += gradients[k][least].dot(spaces_[place].t2);
  }
  for (unsigned j = 0; j < 3; ++j) {
    const double small = std::exp(-aim.sharpness * (aim.goal.of_small(angles[j]) - value));
    const double large = std::exp(-aim.sharpness * (aim.goal.of_large(angles[j]) - value));
    const double obtuse = aim.goal.obtuse_weight;
    if (small + large < kNoWeight) continue;
    const double curvature = aim.sharpness * (small + obtuse * obtuse * large);
    std::array<double, 6> row;
    std::array<Index, 6> at;
    for (unsigned k = 0; k < 3; ++k) {
      const Index place = place_[t[k]];
      for (unsigned s = 0; s < 2; ++s) {
        at[2 * k + s] = place == kNone ? kNone : 2 * place + s;
        if (place != kNone)
          row[2 * k + s] = gradients[k][j].dot(s == 0 ? spaces_[place].t1 : spaces_[place].t2);
      }
    }
    for (unsigned p = 0; p < 6; ++p) {
      if (at[p] == kNone) continue;
      slope_[at[p]] += (small - obtuse * large) * row[p];
      for (unsigned q = 0; q < 6; ++q)
        if (at[q] != kNone && at[q] <= at[p])
          entries_.emplace_back(at[p], at[q], curvature * row[p] * row[q]);
    }
  }
}

}  // namespace isorelax
