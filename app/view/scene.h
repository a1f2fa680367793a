#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "quality/report.h"
#include "render/scene.h"
#include "view/view.h"

namespace isorelax::view {

/// What ColorBy::classes marks, and how.
inline constexpr render::Color kCreaseColor{255, 122, 61};
inline constexpr render::Color kBorderColor{86, 156, 255};
inline constexpr render::Color kRidgeVertexColor{255, 205, 84};
inline constexpr render::Color kCornerColor{214, 40, 57};

/// One mesh of a view with what was measured about it. Everything in spans belongs to the caller.
struct Subject {
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
  /// What the colours say, one number per triangle: of measure(), or of change() for a difference.
  std::span<const double> values;
  std::span<const std::uint8_t> boundary_marks;  ///< see mark_boundary_edges; only read with View::boundary
  bool faces_inward = false;                     ///< see isorelax::faces_inward
  std::optional<Vec3> plane_normal;              ///< see isorelax::plane_normal
  std::span<const Vec3> against;                 ///< vertices of the mesh that arrows start from
  const QualityReport* report = nullptr;         ///< only read with View::numbers
  std::string label;                             ///< empty: none
  /// See render::SceneMesh. Unknown ones are always right.
  render::Revision positions_revision = render::kUnknownRevision;
  render::Revision triangles_revision = render::kUnknownRevision;
  render::Revision values_revision = render::kUnknownRevision;
};

/// A scene and what its spans point into.
struct Depiction {
  render::Scene scene;
  std::vector<Triangle> triangles;
  std::vector<double> values;
  std::vector<std::uint8_t> marks;
};

/// How the view turns numbers into colours, for all values that its picture shows. A range that is not typed
/// follows from the values.
[[nodiscard]] render::Coloring coloring_of(const View& view, std::span<const double> values);
/// The legend of a view that has colours; `values` tell which greys there are, `inverted` how many triangles
/// lie upside down.
[[nodiscard]] render::Legend legend_of(const View& view, const render::Coloring& coloring,
                                       std::span<const double> values, std::size_t inverted = 0);

/// The scene of one mesh, without a legend. The one place where a view becomes a scene: of the window, of
/// pictures and of tests.
[[nodiscard]] Depiction depict(const View& view, const render::Coloring& coloring, const Subject& subject);

/// "Triangles <tab> 1 234", ...: the figures that View::numbers shows.
[[nodiscard]] std::vector<std::string> report_lines(const QualityReport& report);

}  // namespace isorelax::view
