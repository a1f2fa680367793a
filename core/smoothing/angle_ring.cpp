#include "smoothing/angle_ring.h"

#include <algorithm>
#include <cmath>

#include "mesh/angle.h"

namespace isorelax {
namespace {

double soft_value_of(std::span<const double> scores, double sharpness) {
  const double least = *std::min_element(scores.begin(), scores.end());
  double sum = 0;
  for (const double s : scores) sum += std::exp(-sharpness * (s - least));
  return least - std::log(sum) / sharpness;
}

AngleRing::Soft soft_of(std::span<const double> scores, std::span<const Vec3> gradients, double sharpness) {
  const double least = *std::min_element(scores.begin(), scores.end());
  double sum = 0;
  Vec3 mean = Vec3::Zero();
  Mat3 squares = Mat3::Zero();
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const double weight = std::exp(-sharpness * (scores[i] - least));
    sum += weight;
    mean += weight * gradients[i];
    squares += weight * gradients[i] * gradients[i].transpose();
  }
  mean /= sum;
  return {least - std::log(sum) / sharpness, mean, sharpness * (squares / sum - mean * mean.transpose())};
}

}  // namespace

AngleRange angle_range(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double at_a = angle_between_deg(b - a, c - a);
  const double at_b = angle_between_deg(c - b, a - b);
  const double at_c = 180 - at_a - at_b;
  return {std::min({at_a, at_b, at_c}), std::max({at_a, at_b, at_c})};
}

void AngleRing::look_at(std::span<const Vec3> positions, Index vertex) {
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
    const auto other = std::ranges::find(triangles_, beside / 3);
    if (beside != kNone && other != triangles_.end())
      neighbours_.push_back(
          {side, static_cast<std::size_t>(other - triangles_.begin()), *other, Vec3::Zero(), {}});
    ++side;
  }
}

std::span<const AngleRange> AngleRing::ranges(const Vec3& at) {
  ranges_.clear();
  for (const Side& side : sides_) {
    const auto a = angles(side, at, nullptr);
    ranges_.push_back({std::min({a[0], a[1], a[2]}), std::max({a[0], a[1], a[2]})});
  }
  return ranges_;
}

std::vector<MoveBound> AngleRing::move_bounds(const Vec3& at, std::span<const AngleRange> bounds) const {
  std::vector<MoveBound> found;
  found.reserve(6 * sides_.size());
  std::array<Vec3, 3> gradients;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const auto a = angles(sides_[i], at, &gradients);
    const AngleRange& bound = bounds[triangles_[i]];
    for (unsigned k = 0; k < 3; ++k) {
      found.push_back({gradients[k], a[k] - bound.min});
      found.push_back({-gradients[k], bound.max - a[k]});
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
    if (!(along > 0 && along * along > kLeast * area.squaredNorm())) return false;
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

std::array<double, 3> AngleRing::angles(const Side& side, const Vec3& at, std::array<Vec3, 3>* gradients) {
  const Vec3 to_a = side.a - at;
  const Vec3 to_b = side.b - at;
  const Vec3 ab = side.b - side.a;
  const Vec3 normal = to_a.cross(to_b);
  const double length = normal.norm();
  const double at_a = kDegrees * std::atan2(length, -to_a.dot(ab));
  const double at_b = kDegrees * std::atan2(length, to_b.dot(ab));
  if (gradients != nullptr) {
    const Vec3 n = normal * (kDegrees / length);
    // Turning the ray from a to the vertex about the normal opens the angle at a; at b it closes it.
    const Vec3 ga = -n.cross(to_a) / to_a.squaredNorm();
    const Vec3 gb = n.cross(to_b) / to_b.squaredNorm();
    *gradients = {-ga - gb, ga, gb};
  }
  return {180 - at_a - at_b, at_a, at_b};
}

/// All scores of the ring, and their gradients if asked for.
void AngleRing::collect(const Vec3& at, std::vector<Vec3>* gradients) {
  scores_.clear();
  if (gradients != nullptr) gradients->clear();
  std::array<Vec3, 3> g;
  for (const Side& side : sides_) {
    const auto a = angles(side, at, gradients != nullptr ? &g : nullptr);
    for (unsigned k = 0; k < 3; ++k) {
      scores_.push_back(goal_.of_small(a[k]));
      scores_.push_back(goal_.of_large(a[k]));
      if (gradients == nullptr) continue;
      gradients->push_back(g[k]);
      gradients->push_back(-goal_.obtuse_weight * g[k]);
    }
  }
}

double AngleRing::soft_minimum_value(const Vec3& at, double sharpness) {
  collect(at, nullptr);
  return soft_value_of(scores_, sharpness);
}

AngleRing::Soft AngleRing::soft_minimum(const Vec3& at, double sharpness) {
  collect(at, &gradients_);
  return soft_of(scores_, gradients_, sharpness);
}

double AngleRing::sum_of_soft_minima_value(const Vec3& at, double sharpness) const {
  double value = 0;
  for (const Side& side : sides_) value += soft_value_of(angles(side, at, nullptr), sharpness);
  return value;
}

AngleRing::Soft AngleRing::sum_of_soft_minima(const Vec3& at, double sharpness) const {
  Soft sum{0, Vec3::Zero(), Mat3::Zero()};
  std::array<Vec3, 3> gradients;
  for (const Side& side : sides_) {
    const Soft soft = soft_of(angles(side, at, &gradients), gradients, sharpness);
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
