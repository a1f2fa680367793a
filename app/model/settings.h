#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "smoothing/run.h"

namespace isorelax::model {

/// Which reference triangles are asked for; the edge length or the file stands beside it in
/// SmoothingSettings.
enum class ReferenceKind : std::uint8_t { mean_area, edge_length, initial, file };

/// Which creases are kept: those of the library's own thresholds, none, or those that turn by a given angle.
enum class FeatureRule : std::uint8_t { automatic, none, angle };

/// How vertices are told where to go: by the energy, or by what others do, to compare with.
enum class Method : std::uint8_t { near_isometry, laplacian, angle_based };

/// How far the surface may go from the mesh as opened: one of automatic_limits, any way, or a share of the
/// bounding-box diagonal that stands beside it.
enum class Reach : std::uint8_t { nearest, widest, any, typed };

/// What a last stage raises after the run.
enum class Polish : std::uint8_t { none, worst, mean, both };

/// What a run does. Every field has an option of `isorelax smooth`.
struct SmoothingSettings {
  Method method = Method::near_isometry;
  Solver solver = Solver::automatic;
  double exponent = 2;  ///< p in the sum of E^p, 1..32
  double mu_a = 0;      ///< weight of the area term, 0..1; the shape term has 1 - mu_a
  ReferenceKind reference = ReferenceKind::mean_area;
  double edge_length = 1;      ///< length units; used with ReferenceKind::edge_length
  std::string reference_file;  ///< used with ReferenceKind::file
  BoundaryRule boundary = BoundaryRule::fixed;
  FeatureRule features = FeatureRule::automatic;
  double feature_deg = 30;  ///< used with FeatureRule::angle
  Reach reach = Reach::widest;
  double max_deviation = 0.003;  ///< over the bounding-box diagonal; used with Reach::typed
  unsigned iterations = 1000;
  double tolerance = 1e-6;  ///< relative; 0: only the iteration count stops the run
  Polish polish = Polish::none;
  std::vector<Index> pinned;  ///< vertices held by the user, ascending

  bool operator==(const SmoothingSettings&) const = default;
};

/// The same with the numbers and names at their defaults that stand beside another choice.
[[nodiscard]] SmoothingSettings without_unused(SmoothingSettings settings);

/// Whether the energy of a mesh is the same number under both settings.
[[nodiscard]] bool same_energy(const SmoothingSettings& a, const SmoothingSettings& b);

/// What the colours of the triangles say.
enum class Coloring : std::uint8_t { none, min_angle, max_angle, relative_area, energy };
inline constexpr std::size_t kColorings = 5;

/// Where the ends of the colour scale come from.
enum class RangeMode : std::uint8_t {
  run,      ///< all states since the file was opened: colours of two iterations can be compared
  current,  ///< the state that is shown
  typed,    ///< two numbers
};

enum class Shading : std::uint8_t { flat, smooth };

/// A closed interval of a coloured quantity.
struct ValueRange {
  double low = 0;
  double high = 1;
  bool operator==(const ValueRange&) const = default;
};

/// How the mesh is shown, apart from the camera.
struct ViewSettings {
  Coloring coloring = Coloring::min_angle;
  RangeMode range_mode = RangeMode::run;
  /// One typed range for each colouring; used with RangeMode::typed.
  std::array<ValueRange, kColorings> typed{{{0, 1}, {0, 60}, {60, 180}, {0, 2}, {2, 4}}};
  std::string color_map;  ///< a name of the renderer's; empty: the colouring's own
  bool reversed = false;
  bool wire = true;
  bool legend = true;
  bool reasons = false;  ///< dots in the colours of what limited the vertices
  Shading shading = Shading::flat;

  bool operator==(const ViewSettings&) const = default;
};

/// "auto", "jacobi", "newton", "lbfgs": as on the command line.
[[nodiscard]] std::string_view solver_option(Solver solver);
/// "near-isometry", "laplacian", "angle-based": as on the command line.
[[nodiscard]] std::string_view method_option(Method method);
/// "none", "worst", "mean", "both": as on the command line.
[[nodiscard]] std::string_view polish_option(Polish polish);
/// "Near-isometry", ...: a title for people.
[[nodiscard]] std::string_view title(Method method);
/// "Min angle", "Energy", ...: a title for people.
[[nodiscard]] std::string_view title(Coloring coloring);
/// "deg" for angles, "x mean" for areas, empty where there is none.
[[nodiscard]] std::string_view unit(Coloring coloring);
/// What mu_a asks for, in words: "shape 70 %, area 30 %".
[[nodiscard]] std::string describe_mu(double mu_a);

}  // namespace isorelax::model
