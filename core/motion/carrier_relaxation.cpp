#include "motion/carrier_relaxation.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/parallel.h"
#include "surface/normal_covariance.h"

namespace isorelax {
namespace {

double total_area(std::span<const Vec3> x, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += 0.5 * area_vector(x[t[0]], x[t[1]], x[t[2]]).norm();
  return sum;
}

constexpr double kFirstDamping = 0.1;

std::array<Vec3, 3> corners_of(std::span<const Vec3> x, const Triangle& t) {
  return {x[t[0]], x[t[1]], x[t[2]]};
}

}  // namespace

CarrierRelaxation::CarrierRelaxation(std::span<const Triangle> triangles, const Topology& topology,
                                     std::span<const std::array<Vec3, 3>> reference,
                                     const CarrierRelaxationOptions& options, unsigned threads)
    : triangles_(triangles.begin(), triangles.end()),
      topology_(&topology),
      options_(options),
      threads_(threads),
      system_(triangles, topology.vertex_count()),
      middles_(triangles, topology, threads) {
  for (const std::array<Vec3, 3>& corners : reference) {
    unscaled_.push_back(reference_inverse(corners));
    reference_area_ += 0.5 * area_vector(corners[0], corners[1], corners[2]).norm();
  }
  inverses_ = unscaled_;
  allowed_.assign(middles_.edges().size(), 0);
  models_.resize(triangles_.size());
  energies_.resize(triangles_.size());
  share_.resize(topology.vertex_count());
  tangents_.resize(topology.vertex_count());
  material_moves_.resize(topology.vertex_count());
  to_material_.resize(topology.vertex_count());
  spacing_.resize(topology.vertex_count());
  trial_energies_.resize(triangles_.size());
}

void CarrierRelaxation::allow_heights(const FlowMap& map, std::span<const MaterialPoint> points,
                                      std::span<const Vec3> positions) {
  middles_.measure(map, points, positions);
  for (std::size_t e = 0; e < allowed_.size(); ++e) allowed_[e] = middles_.heights()[e].norm();
  start_area_ = total_area(positions, triangles_);
}

RelaxationReport CarrierRelaxation::relax(const FlowMap& map, std::span<const std::uint8_t> held,
                                          std::span<MaterialPoint> points, std::span<Vec3> positions) {
  RelaxationReport report;
  held_.assign(held.begin(), held.end());
  scale_references(positions);
  damping_ = kFirstDamping;
  for (unsigned i = 0; i < options_.iterations; ++i)
    if (!step(map, points, positions, report)) break;
  return report;
}

void CarrierRelaxation::scale_references(std::span<const Vec3> positions) {
  const double area = total_area(positions, triangles_);
  const double scale = std::sqrt(reference_area_ / area);
  growth_ = start_area_ > 0 ? std::sqrt(area / start_area_) : 1;
  // Of an equilateral triangle of the mean area.
  const double squared_edge = 4 / std::sqrt(3.0) * area / static_cast<double>(triangles_.size());
  height_scale_ = options_.height_weight / squared_edge;
  for (std::size_t t = 0; t < unscaled_.size(); ++t) inverses_[t] = scale * unscaled_[t];
}

double CarrierRelaxation::energy_of(Index t, std::span<const Vec3> positions) const {
  return element_energy(corners_of(positions, triangles_[t]), inverses_[t], options_.weights);
}

void CarrierRelaxation::find_frames(const FlowMap& map, std::span<const MaterialPoint> points) {
  parallel_for_blocks(points.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto jacobian = map.map(points[v]).jacobian;
      auto& frame = tangents_[v];
      frame.col(0) = jacobian.col(0).normalized();
      frame.col(1) = (jacobian.col(1) - frame.col(0).dot(jacobian.col(1)) * frame.col(0)).normalized();
      const Eigen::Matrix2d to_space = frame.transpose() * jacobian;
      to_material_[v] = to_space.inverse();
      if (!to_material_[v].allFinite() || !frame.allFinite()) {
        to_material_[v].setZero();
        frame.setZero();
      }
      const auto& material = map.surface().frame(points[v].triangle);
      material_moves_[v] = material[0] * to_material_[v].row(0) + material[1] * to_material_[v].row(1);
    }
  });
}

void CarrierRelaxation::assemble(std::span<const Vec3> positions) {
  parallel_for_blocks(triangles_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle& v = triangles_[t];
      models_[t] =
          element_model(corners_of(positions, v), {tangents_[v[0]], tangents_[v[1]], tangents_[v[2]]},
                        inverses_[t], options_.weights);
      energies_[t] = models_[t].energy;
    }
  });
  system_.clear();
  for (Index t = 0; t < models_.size(); ++t)
    if (models_[t].hessian.allFinite()) system_.add(t, models_[t].hessian, models_[t].gradient);
}

void CarrierRelaxation::add_heights(const FlowMap& map) {
  using Mat32 = Eigen::Matrix<double, 3, 2>;
  for (std::size_t e = 0; e < middles_.edges().size(); ++e) {
    const Vec3& height = middles_.heights()[e];
    const double length = height.norm();
    const double excess = length - growth_ * allowed_[e];
    if (!(excess > 0)) continue;
    const MiddledEdge& edge = middles_.edges()[e];
    const auto& frame = map.surface().frame(middles_.middle(e).triangle);
    Mat32 material;
    material << frame[0], frame[1];
    const Mat3 onward = 0.5 * middles_.mapped(e).jacobian * material.transpose();
    Eigen::Matrix<double, 3, 6> slope = Eigen::Matrix<double, 3, 6>::Zero();
    const unsigned k = edge.corner % 3;
    slope.middleCols<2>(2 * next(k)) = onward * material_moves_[edge.a] - 0.5 * tangents_[edge.a];
    slope.middleCols<2>(2 * previous(k)) = onward * material_moves_[edge.b] - 0.5 * tangents_[edge.b];
    const Vec3 axis = height / length;
    const double across = excess / length;
    const Mat3 curvature = across * Mat3::Identity() + (1 - across) * axis * axis.transpose();
    system_.add(edge.corner / 3, 2 * height_scale_ * slope.transpose() * curvature * slope,
                2 * height_scale_ * excess * slope.transpose() * axis);
  }
}

double CarrierRelaxation::height_energy() const {
  double sum = 0;
  for (std::size_t e = 0; e < allowed_.size(); ++e) {
    const double excess = middles_.heights()[e].norm() - growth_ * allowed_[e];
    if (excess > 0) sum += excess * excess;
  }
  return height_scale_ * sum;
}

void CarrierRelaxation::add_damping(std::span<const Vec3> positions) {
  constexpr double kMostDamping = 1e6;
  parallel_for_blocks(positions.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = static_cast<Index>(i);
      double sum = 0;
      std::size_t count = 0;
      for (const Corner c : topology_->corners_of(v)) {
        const Triangle& t = triangles_[c / 3];
        for (const unsigned k : {next(c % 3), previous(c % 3)})
          sum += (positions[t[k]] - positions[v]).norm(), ++count;
      }
      spacing_[v] = count > 0 ? sum / static_cast<double>(count) : 1;
      const double weight = 1 / (spacing_[v] * spacing_[v]);
      Eigen::Matrix2d damping = Eigen::Matrix2d::Zero();
      const CovarianceEigen eigen = decompose(normal_covariance(positions, triangles_, *topology_, v));
      for (int k = 1; k < 3; ++k) {
        const double ratio = eigen.values[0] > 0 ? std::max(0.0, eigen.values[k]) / eigen.values[0] : 0;
        const double share = ratio / options_.ridge_ratio;
        const Eigen::Vector2d axis = tangents_[v].transpose() * eigen.vectors.col(k);
        damping +=
            options_.ridge_damping * weight * std::min(kMostDamping, share * share) * axis * axis.transpose();
      }
      system_.add_diagonal(v, damping);
      system_.set_shift(v, weight);
    }
  });
  for (Index v = 0; v < held_.size(); ++v)
    if (held_[v] != 0) system_.hold(v);
}

void CarrierRelaxation::try_moves(const FlowMap& map, std::span<const MaterialPoint> points) {
  trial_points_.resize(points.size());
  trial_.resize(points.size());
  parallel_for_blocks(points.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = static_cast<Index>(i);
      trial_points_[v] =
          held_[v] != 0 ? points[v]
                        : map.surface().walk(points[v], share_[v] * (to_material_[v] * system_.solution(v)));
      trial_[v] = map.position(trial_points_[v]);
    }
  });
}

double CarrierRelaxation::trial_energy(const FlowMap& map, std::span<const Vec3> positions) {
  constexpr double kLeastCosine = 0;
  parallel_for_blocks(triangles_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto t = static_cast<Index>(i);
      const Triangle& v = triangles_[t];
      trial_energies_[t] = energy_of(t, trial_);
      const Vec3 old_area = area_vector(positions[v[0]], positions[v[1]], positions[v[2]]);
      const Vec3 new_area = area_vector(trial_[v[0]], trial_[v[1]], trial_[v[2]]);
      const bool turned = !(old_area.dot(new_area) > kLeastCosine * old_area.norm() * new_area.norm());
      if (turned || lies_upside_down(map, t)) trial_energies_[t] = INFINITY;
    }
  });
  const double sum = std::accumulate(trial_energies_.begin(), trial_energies_.end(), 0.0);
  if (!(height_scale_ > 0) || !std::isfinite(sum)) return sum;
  middles_.measure(map, trial_points_, trial_);
  return sum + height_energy();
}

void CarrierRelaxation::hold_back() {
  constexpr double kLeastShare = 0.1;
  constexpr double kRise = 0.25;  // from a vertex to its neighbours
  constexpr int kRings = 4;
  for (Index t = 0; t < triangles_.size(); ++t)
    if (std::isinf(trial_energies_[t]))
      for (const Index v : triangles_[t]) share_[v] = share_[v] > kLeastShare ? 0.4 * share_[v] : 0;
  for (int ring = 0; ring < kRings; ++ring) {
    for (const Triangle& t : triangles_) {
      const double most = std::min({share_[t[0]], share_[t[1]], share_[t[2]]}) + kRise;
      for (const Index v : t) share_[v] = std::min(share_[v], most);
    }
  }
}

double CarrierRelaxation::longest_move() const {
  double longest = 0;
  for (Index v = 0; v < spacing_.size(); ++v)
    if (held_[v] == 0) longest = std::max(longest, system_.solution(v).norm() / spacing_[v]);
  return longest;
}

bool CarrierRelaxation::lies_upside_down(const FlowMap& map, Index t) const {
  const Triangle& v = triangles_[t];
  const MaterialSurface& surface = map.surface();
  const Vec3 area = area_vector(surface.point(trial_points_[v[0]]), surface.point(trial_points_[v[1]]),
                                surface.point(trial_points_[v[2]]));
  for (const Index corner : v) {
    // On a crease a point's triangle may be that of another side; what is held turns nothing.
    if (held_[corner] != 0) continue;
    const auto& frame = surface.frame(trial_points_[corner].triangle);
    if (!(area.dot(frame[0].cross(frame[1])) > 0.1 * area.norm())) return true;
  }
  return false;
}

bool CarrierRelaxation::step(const FlowMap& map, std::span<MaterialPoint> points, std::span<Vec3> positions,
                             RelaxationReport& report) {
  constexpr int kMostAttempts = 6;
  constexpr int kMostPasses = 8;
  find_frames(map, points);
  assemble(positions);
  double before = std::accumulate(energies_.begin(), energies_.end(), 0.0);
  if (height_scale_ > 0) {
    middles_.measure(map, points, positions);
    add_heights(map);
    before += height_energy();
  }
  add_damping(positions);
  if (report.steps == 0) report.energy_before = report.energy_after = before;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    if (!system_.solve(damping_)) return false;
    const double longest = longest_move();
    if (longest > 1.5 * options_.largest_move && attempt + 1 < kMostAttempts) {
      damping_ *= std::clamp(longest / options_.largest_move, 1.5, 8.0);
      continue;
    }
    const double first = std::min(1.0, options_.largest_move / longest);
    std::ranges::fill(share_, first);
    for (int pass = 0; pass < kMostPasses; ++pass) {
      try_moves(map, points);
      const double after = trial_energy(map, positions);
      if (after < before) {
        std::ranges::copy(trial_points_, points.begin());
        std::ranges::copy(trial_, positions.begin());
        report.energy_after = after;
        ++report.steps;
        if (attempt == 0) damping_ = std::max(options_.shift, 0.4 * damping_);
        return true;
      }
      if (std::isfinite(after)) break;
      hold_back();
    }
    damping_ = std::min(4 * damping_, 1e4);
  }
  return false;
}

}  // namespace isorelax
