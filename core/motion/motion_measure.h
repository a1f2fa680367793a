#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "mesh/topology.h"

namespace isorelax {

/// A moving mesh at one moment, in numbers. Angles are each triangle's smallest, in degrees.
struct MotionMeasure {
  double min_angle_deg = 0;
  double mean_angle_deg = 0;
  double angle_p01_deg = 0, angle_p05_deg = 0, angle_p50_deg = 0;  ///< percentiles: 1, 5, 50 (nearest rank)
  double below_15_deg = 0;                                         ///< share of the triangles, 0..1
  double area_max_over_min = 0;
  double area = 0;
  double volume = 0;             ///< cubed length units; means something for closed meshes
  std::size_t folded_edges = 0;  ///< that turn by more than 120 degrees
};

/// Measures in parallel, the same for any number of threads. Precondition: there is a triangle.
[[nodiscard]] MotionMeasure measure_motion(std::span<const Vec3> positions,
                                           std::span<const Triangle> triangles, const Topology& topology,
                                           unsigned threads = 0);

/// Distances, in length units.
struct Distances {
  double max = 0;
  double rms = 0;
  double mean = 0;
};

/// Takes in distances one by one; of none, all are 0.
class DistanceSum {
 public:
  void add(double distance) {
    max_ = std::max(max_, distance);
    sum_ += distance;
    squares_ += distance * distance;
    ++count_;
  }
  [[nodiscard]] Distances result() const {
    if (count_ == 0) return {};
    const auto count = static_cast<double>(count_);
    return {.max = max_, .rms = std::sqrt(squares_ / count), .mean = sum_ / count};
  }

 private:
  double max_ = 0, sum_ = 0, squares_ = 0;
  std::size_t count_ = 0;
};

/// Of the points from a sphere.
[[nodiscard]] Distances distance_from_sphere(std::span<const Vec3> positions, const Vec3& centre,
                                             double radius);

}  // namespace isorelax
