#pragma once

#include <memory>
#include <span>
#include <vector>

#include "model/document.h"
#include "model/settings.h"
#include "quality/distribution.h"
#include "quality/report.h"
#include "smoothing/problem.h"

namespace isorelax::model {

/// One set of positions with everything about it that does not depend on settings. Immutable once made, so
/// that the worker, the undo list and the view share it without copies.
struct Geometry {
  std::vector<Vec3> positions;
  QualityReport quality;
  Histogram min_angle;      ///< degrees, 0..60 in bins of 2
  Histogram relative_area;  ///< area over the mean area, 0..3 in bins of 0.1
  // One value per triangle, in the units of the colouring of the same name.
  std::vector<double> min_angle_values, max_angle_values, area_values;
  ValueRange min_angle_range, max_angle_range, area_range;
};

/// The energy of a geometry under given settings.
struct EnergyState {
  SmoothingSettings settings;
  /// It is that of a recorded run, which the settings only come near to.
  bool of_record = false;
  double total = 0;            ///< sum of E^exponent over the triangles that a run treats
  std::vector<double> values;  ///< E of each triangle; infinite where it has no area
  ValueRange range;
};

/// What is on screen at one iteration.
struct MeshState {
  unsigned iteration = 0;
  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<const EnergyState> energy;  ///< null while the energy cannot be measured

  [[nodiscard]] std::span<const Vec3> positions() const { return geometry->positions; }
  [[nodiscard]] const QualityReport& quality() const { return geometry->quality; }
  /// The values behind a colouring; empty for Coloring::none and for an energy that is not known.
  [[nodiscard]] std::span<const double> values(Coloring coloring) const;
  /// Extent of values(coloring); {0, 1} when there are none.
  [[nodiscard]] ValueRange range(Coloring coloring) const;
  /// Memory held, in bytes.
  [[nodiscard]] std::size_t bytes() const;
};
using MeshStatePtr = std::shared_ptr<const MeshState>;

/// Measures positions on the document's triangles. Parallel.
[[nodiscard]] std::shared_ptr<const Geometry> measure_geometry(const Document& document,
                                                               std::vector<Vec3> positions);

/// Measures the energy that `problem`, made with `settings`, gives these positions. Parallel.
[[nodiscard]] std::shared_ptr<const EnergyState> measure_energy(const SmoothingProblem& problem,
                                                                const SmoothingSettings& settings,
                                                                std::span<const Vec3> positions);

/// Smallest interval that holds the finite values; {0, 1} when there are none, and never of no length.
[[nodiscard]] ValueRange finite_range(std::span<const double> values);

}  // namespace isorelax::model
