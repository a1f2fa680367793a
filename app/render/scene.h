#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/topology.h"
#include "mesh/triangle_mesh.h"
#include "render/camera.h"
#include "render/color.h"
#include "render/colormap.h"
#include "render/legend.h"

namespace isorelax::render {

/// Tells the renderer whether content changed since it last saw it: equal revisions mean equal content.
/// kUnknownRevision is never equal: the content is taken afresh at each draw.
using Revision = std::uint64_t;
inline constexpr Revision kUnknownRevision = 0;

/// A revision that no content in this process has had yet. Any thread.
Revision next_revision();

enum class Shading { flat, smooth };

/// Triangle edges over the faces. They fade where triangles are only a few pixels wide.
struct Wire {
  bool shown = false;
  Color color{16, 18, 22};
  double opacity = 0.7;
  double width = 1.1;  ///< in points
};

/// Marked edges (boundaries, features).
struct EdgeStyle {
  bool shown = true;
  Color color{255, 255, 255};
  double width = 2.2;  ///< in points
};

/// Bits per triangle for `SceneMesh::edge_marks`: bit k marks the edge opposite corner k.
inline constexpr std::uint8_t kMarkedEdge[3] = {1, 2, 4};
/// A second kind of mark, drawn over the first in `SceneMesh::crease_color`.
inline constexpr std::uint8_t kCreaseEdge[3] = {8, 16, 32};

/// One mesh as it is to be drawn. Everything in spans belongs to the caller and must live through the draw.
struct SceneMesh {
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
  /// One number per triangle, NaN for none; empty: all in `plain_color`.
  std::span<const double> face_values;
  /// Marked edges, one byte per triangle (kMarkedEdge); empty: none.
  std::span<const std::uint8_t> edge_marks;

  Revision positions_revision = kUnknownRevision;
  Revision triangles_revision = kUnknownRevision;  ///< of triangles and edge_marks
  Revision values_revision = kUnknownRevision;     ///< of face_values

  Coloring coloring;
  Color plain_color{176, 184, 196};
  Shading shading = Shading::flat;
  bool faces_shown =
      true;  ///< else edges alone are seen, with nothing between them; faces still hide what is behind
  bool backs_marked = true;   ///< the backs of faces are wine-red, as kBackColor
  bool faces_inward = false;  ///< the sides whose corners run clockwise are the fronts
  /// Of a mesh in a plane, which has no inside: its normal, with the sign of most triangles. Their fronts are
  /// on whichever side is seen.
  std::optional<Vec3> plane_normal;
  Wire wire;
  EdgeStyle marked_edges;
  Color crease_color{255, 122, 61};
  /// Triangles drawn in `highlight_color`, for a selection.
  std::vector<Index> highlighted_faces;
  Color highlight_color{255, 122, 61};
};

/// A round dot on a point of space, drawn over what hides it only slightly.
struct Marker {
  Vec3 position = Vec3::Zero();
  Color color{255, 122, 61};
  double diameter = 9;  ///< in points
};

/// A straight arrow in space, of one width in pixels. Shorter than its own head it is drawn as a head alone.
struct Arrow {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
};
struct Arrows {
  std::vector<Arrow> items;
  Color color{214, 40, 57};
  double width = 1.4;  ///< of the shaft, in points
};

/// All that a picture shows but the camera. Plain data, made anew for each draw at no cost.
struct Scene {
  std::vector<SceneMesh> meshes;
  std::vector<Marker> markers;
  Arrows arrows;
  Background background = kDarkBackground;
  /// Nothing behind the mesh; text is dark on a light plate.
  bool transparent = false;
  std::optional<Legend> legend;
  std::vector<Swatch> key;         ///< what the colours of markers mean, at the lower left over the caption
  std::string caption;             ///< one line at the lower left, UTF-8; empty: none
  double legend_top = 0;           ///< points at the top that the legend leaves to a host
  double caption_lift = 0;         ///< points that it stands higher, over what a host lays there
  std::vector<std::string> notes;  ///< lines at the upper left, UTF-8; a tab begins the second column
  /// Pixels per point, the unit of line widths and text; 0: the picture's shorter side / 720.
  double pixels_per_point = 0;
};

/// Box around all meshes of the scene.
Bounds bounds_of(const Scene& scene);

/// Marks for `SceneMesh::edge_marks`: the edges with one triangle.
std::vector<std::uint8_t> mark_boundary_edges(const Topology& topology);

}  // namespace isorelax::render
