#include "smoothing/angle_ring.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/angle.h"
#include "mesh/lane_math.h"

namespace isorelax {

AngleRange angle_range(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto [at_a, at_b, at_c] = triangle_angles(a, b, c);
  return {std::min({at_a, at_b, at_c}), std::max({at_a, at_b, at_c})};
}

std::array<double, 3> triangle_angles(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double at_a = angle_between_deg(b - a, c - a);
  const double at_b = angle_between_deg(c - b, a - b);
  return {at_a, at_b, 180 - at_a - at_b};
}

std::array<Vec3, 3> angle_gradients(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 to_b = b - a;
  const Vec3 to_c = c - a;
  const Vec3 normal = to_b.cross(to_c);
  const Vec3 n = normal * (kDegrees / normal.norm());
  // Turning the ray from b to a about the normal opens the angle at b; at c it closes it.
  const Vec3 at_b = -n.cross(to_b) / to_b.squaredNorm();
  const Vec3 at_c = n.cross(to_c) / to_c.squaredNorm();
  return {-at_b - at_c, at_b, at_c};
}

void AngleRing::look_at(std::span<const Vec3> positions, Index vertex) {
  measured_at_.reset();
  triangles_.clear();
  sides_.clear();
  for (const Corner c : problem_.topology.corners_of(vertex)) {
    if (problem_.treated[c / 3] == 0) continue;
    const Triangle& t = problem_.triangles[c / 3];
    const Vec3& a = positions[t[next(c % 3)]];
    const Vec3& b = positions[t[previous(c % 3)]];
    triangles_.push_back(c / 3);
    sides_.push_back({a, b, area_vector(positions[vertex], a, b)});
  }
  if (turns_.applies()) find_neighbours(positions, vertex);
}

/// Of the edges at the vertex one for each triangle: the other one belongs to its neighbour as well.
void AngleRing::find_neighbours(std::span<const Vec3> positions, Index vertex) {
  neighbours_.clear();
  std::size_t side = 0;
  for (const Corner c : problem_.topology.corners_of(vertex)) {
    if (problem_.treated[c / 3] == 0) continue;
    const Corner beyond = problem_.topology.opposite(c);
    if (beyond != kNone) {
      const Triangle& t = problem_.triangles[beyond / 3];
      neighbours_.push_back({side, kOutside, beyond / 3,
                             area_vector(positions[t[0]], positions[t[1]], positions[t[2]]),
                             turns_.folds_of(positions, beyond / 3, c / 3)});
    }
    const Corner beside = problem_.topology.opposite(c - c % 3 + next(c % 3));
    const auto other = std::ranges::lower_bound(triangles_, beside / 3);
    if (beside != kNone && other != triangles_.end() && *other == beside / 3)
      neighbours_.push_back(
          {side, static_cast<std::size_t>(other - triangles_.begin()), *other, Vec3::Zero(), {}});
    ++side;
  }
}

std::span<const AngleRange> AngleRing::ranges(const Vec3& at) {
  measure(at);
  ranges_.clear();
  for (std::size_t i = 0; i < angles_.size(); i += 3) {
    const double a = angles_[i], b = angles_[i + 1], c = angles_[i + 2];
    ranges_.push_back({std::min({a, b, c}), std::max({a, b, c})});
  }
  return ranges_;
}

std::vector<MoveBound> AngleRing::move_bounds(const Vec3& at, std::span<const AngleRange> bounds) {
  measure(at);
  std::vector<MoveBound> found;
  found.reserve(6 * sides_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const std::array<Vec3, 3> g = angle_gradients(at, sides_[i].a, sides_[i].b);
    const AngleRange& bound = bounds[triangles_[i]];
    for (unsigned k = 0; k < 3; ++k) {
      found.push_back({g[k], angles_[3 * i + k] - bound.min});
      found.push_back({-g[k], bound.max - angles_[3 * i + k]});
    }
  }
  return found;
}

bool AngleRing::is_upright(const Vec3& at) {
  areas_.clear();
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Vec3 area = area_vector(at, sides_[i].a, sides_[i].b);
    if (!(area.dot(sides_[i].normal) > 0)) return false;
    areas_.push_back(area);
    if (!turns_.applies()) continue;
    const double along = area.dot(problem_.initial_normals[triangles_[i]]);
    constexpr double kLeast = TurnLimit::kLeastCosine * TurnLimit::kLeastCosine;
    if (!(along > 0 && along * along > kLeast * area.squaredNorm()) &&
        !turns_.lets_go(triangles_[i], sides_[i].normal, area))
      return false;
    if (along * along < TurnLimit::kLittleTurned2 * area.squaredNorm() &&
        turns_.faces_away(triangles_[i], {at, sides_[i].a, sides_[i].b}))
      return false;
  }
  return !turns_.applies() || !turns_back();
}

/// Whether a triangle of the ring or next to it turns back from its neighbours with the areas as they are.
bool AngleRing::turns_back() {
  folds_.assign(sides_.size(), {});
  for (const Neighbour& n : neighbours_) {
    const Folds fold = turns_.fold_between(triangles_[n.side], areas_[n.side], n.triangle,
                                           n.other == kOutside ? n.area : areas_[n.other]);
    if (!fold.any()) continue;
    folds_[n.side] += fold;
    if (n.other != kOutside) {
      folds_[n.other] += fold;
      continue;
    }
    Folds outside = n.folds;
    outside += fold;
    if (turns_.turns_back(n.triangle, outside)) return true;
  }
  for (std::size_t i = 0; i < sides_.size(); ++i)
    if (folds_[i].any() && turns_.turns_back(triangles_[i], folds_[i])) return true;
  return false;
}

void AngleRing::measure(const Vec3& at) {
  if (measured_at_ == at) return;
  measured_at_ = at;
  angles_.resize(3 * sides_.size());
  Lanes y, x, angles;
  for (std::size_t first = 0; first < sides_.size(); first += kLanes / 2) {
    const auto side_of = [&](unsigned i) { return std::min(first + i / 2, sides_.size() - 1); };
    for (unsigned i = 0; i < kLanes; i += 2) {
      const Side& side = sides_[side_of(i)];
      const Vec3 to_a = side.a - at, to_b = side.b - at, ab = side.b - side.a;
      y.at[i] = y.at[i + 1] = to_a.cross(to_b).norm();
      x.at[i] = -to_a.dot(ab);
      x.at[i + 1] = to_b.dot(ab);
    }
    angles_deg(y, x, angles);
    for (unsigned i = 0; i < kLanes; i += 2) {
      const double at_a = angles.at[i], at_b = angles.at[i + 1];
      double* const of_side = &angles_[3 * side_of(i)];
      of_side[0] = 180 - at_a - at_b;
      of_side[1] = at_a;
      of_side[2] = at_b;
    }
  }
}

/// All scores of the ring.
void AngleRing::collect(const Vec3& at) {
  measure(at);
  scores_.clear();
  for (const double angle : angles_) {
    scores_.push_back(goal_.of_small(angle));
    scores_.push_back(goal_.of_large(angle));
  }
}

/// Finds the least and the weights of a soft minimum for each group of scores.
void AngleRing::weigh(std::span<const double> scores, std::size_t group, double sharpness) {
  least_.clear();
  weights_.resize((scores.size() + kLanes - 1) / kLanes * kLanes);
  for (std::size_t first = 0; first < scores.size(); first += group) {
    const auto of_group = scores.subspan(first, group);
    const double least = *std::ranges::min_element(of_group);
    least_.push_back(least);
    for (std::size_t i = 0; i < group; ++i) weights_[first + i] = -sharpness * (of_group[i] - least);
  }
  Lanes exponents, powers;
  for (std::size_t first = 0; first < scores.size(); first += kLanes) {
    std::copy_n(weights_.begin() + static_cast<std::ptrdiff_t>(first), kLanes, exponents.at);
    exp_of_negative(exponents, powers);
    std::copy_n(powers.at, kLanes, weights_.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

double AngleRing::soft_minimum_value(const Vec3& at, double sharpness) {
  collect(at);
  weigh(scores_, scores_.size(), sharpness);
  const double sum =
      std::accumulate(weights_.begin(), weights_.begin() + static_cast<std::ptrdiff_t>(scores_.size()), 0.0);
  return least_[0] - std::log(sum) / sharpness;
}

/// Of the group of scores from `first` on, one for each gradient.
AngleRing::Soft AngleRing::soft_of(std::size_t first, std::span<const Vec3> gradients,
                                   double sharpness) const {
  double sum = 0;
  Vec3 mean = Vec3::Zero();
  Mat3 squares = Mat3::Zero();
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    const double weight = weights_[first + i];
    sum += weight;
    mean += weight * gradients[i];
    squares += weight * gradients[i] * gradients[i].transpose();
  }
  mean /= sum;
  return {least_[first / gradients.size()] - std::log(sum) / sharpness, mean,
          sharpness * (squares / sum - mean * mean.transpose())};
}

AngleRing::Soft AngleRing::soft_minimum(const Vec3& at, double sharpness) {
  collect(at);
  weigh(scores_, scores_.size(), sharpness);
  gradients_.clear();
  for (const Side& side : sides_) {
    for (const Vec3& g : angle_gradients(at, side.a, side.b)) {
      gradients_.push_back(g);
      gradients_.push_back(-goal_.obtuse_weight * g);
    }
  }
  return soft_of(0, gradients_, sharpness);
}

double AngleRing::sum_of_soft_minima_value(const Vec3& at, double sharpness) {
  measure(at);
  weigh(angles_, 3, sharpness);
  // One logarithm for many sums, each from 1 to 3.
  constexpr double kLarge = 1e250;
  double least = 0, logarithms = 0, product = 1;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    least += least_[i];
    product *= weights_[3 * i] + weights_[3 * i + 1] + weights_[3 * i + 2];
    if (product < kLarge) continue;
    logarithms += std::log(product);
    product = 1;
  }
  return least - (logarithms + std::log(product)) / sharpness;
}

AngleRing::Soft AngleRing::sum_of_soft_minima(const Vec3& at, double sharpness) {
  measure(at);
  weigh(angles_, 3, sharpness);
  Soft sum{0, Vec3::Zero(), Mat3::Zero()};
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Soft soft = soft_of(3 * i, angle_gradients(at, sides_[i].a, sides_[i].b), sharpness);
    sum.value += soft.value;
    sum.gradient += soft.gradient;
    sum.spread += soft.spread;
  }
  return sum;
}

double AngleRing::shortest_edge(const Vec3& at) const {
  double squared = INFINITY;
  for (const Side& side : sides_)
    squared = std::min({squared, (side.a - at).squaredNorm(), (side.b - at).squaredNorm()});
  return std::sqrt(squared);
}

}  // namespace isorelax
