#include "model/mesh_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "energy/triangle_energy.h"
#include "mesh/parallel.h"
#include "quality/triangle_metrics.h"

namespace isorelax::model {
namespace {

constexpr HistogramRange kAngleBins{0, 60, 30};
constexpr HistogramRange kAreaBins{0, 3, 30};

}  // namespace

std::span<const double> MeshState::values(Coloring coloring) const {
  switch (coloring) {
    case Coloring::none:
      break;
    case Coloring::min_angle:
      return geometry->min_angle_values;
    case Coloring::max_angle:
      return geometry->max_angle_values;
    case Coloring::relative_area:
      return geometry->area_values;
    case Coloring::energy:
      if (energy) return energy->values;
      break;
  }
  return {};
}

ValueRange MeshState::range(Coloring coloring) const {
  switch (coloring) {
    case Coloring::none:
      break;
    case Coloring::min_angle:
      return geometry->min_angle_range;
    case Coloring::max_angle:
      return geometry->max_angle_range;
    case Coloring::relative_area:
      return geometry->area_range;
    case Coloring::energy:
      if (energy) return energy->range;
      break;
  }
  return {};
}

std::size_t MeshState::bytes() const {
  std::size_t total =
      sizeof(Vec3) * geometry->positions.size() + sizeof(double) * 3 * geometry->min_angle_values.size();
  if (energy) total += sizeof(double) * energy->values.size();
  return total;
}

std::shared_ptr<const Geometry> measure_geometry(const Document& document, std::vector<Vec3> positions) {
  const auto& triangles = document.mesh().triangles;
  auto geometry = std::make_shared<Geometry>();
  geometry->positions = std::move(positions);
  const std::vector<Vec3> resized = resized_if_extreme(geometry->positions);
  const std::span<const Vec3> x = resized.empty() ? geometry->positions : resized;
  geometry->min_angle_values.resize(triangles.size());
  geometry->max_angle_values.resize(triangles.size());
  geometry->area_values.resize(triangles.size());
  std::vector<double> areas(block_count(triangles.size()));
  parallel_for_blocks(triangles.size(), 0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) {
      const auto m = measure_triangle(x, triangles[t]);
      geometry->min_angle_values[t] = m.min_angle_deg;
      geometry->max_angle_values[t] = m.max_angle_deg;
      geometry->area_values[t] = m.area;
      sum += m.area;
    }
    areas[begin / kBlockSize] = sum;
  });
  double area = 0;
  for (const double a : areas) area += a;
  const double scale = area > 0 ? static_cast<double>(triangles.size()) / area : 0;
  for (double& a : geometry->area_values) a *= scale;
  geometry->min_angle_range = finite_range(geometry->min_angle_values);
  geometry->max_angle_range = finite_range(geometry->max_angle_values);
  geometry->area_range = finite_range(geometry->area_values);
  geometry->quality = measure_quality(x, triangles, document.topology);
  geometry->min_angle = make_histogram(geometry->min_angle_values, kAngleBins);
  geometry->relative_area = make_histogram(geometry->area_values, kAreaBins);
  return geometry;
}

std::shared_ptr<const EnergyState> measure_energy(const SmoothingProblem& problem,
                                                  const SmoothingSettings& settings,
                                                  std::span<const Vec3> positions) {
  auto energy = std::make_shared<EnergyState>();
  energy->settings = settings;
  const auto& triangles = problem.triangles;
  energy->values.resize(triangles.size());
  std::vector<double> sums(block_count(triangles.size()));
  parallel_for_blocks(triangles.size(), 0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) {
      const std::array<Vec3, 3> x{positions[triangles[t][0]], positions[triangles[t][1]],
                                  positions[triangles[t][2]]};
      double value = std::numeric_limits<double>::infinity();
      if (area_vector(x[0], x[1], x[2]).norm() > 0)
        value = evaluate_energy(x, problem.reference[static_cast<Index>(t)], problem.weights).energy;
      energy->values[t] = value;
      if (problem.treated[t] != 0) sum += std::pow(value, problem.exponent);
    }
    sums[begin / kBlockSize] = sum;
  });
  for (const double s : sums) energy->total += s;
  energy->range = finite_range(energy->values);
  return energy;
}

ValueRange finite_range(std::span<const double> values) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  if (low > high) return {};
  if (low == high) return {low - 0.5, high + 0.5};
  return {low, high};
}

}  // namespace isorelax::model
