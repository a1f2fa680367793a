#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "render/camera.h"
#include "render/color.h"
#include "render/colormap.h"
#include "render/scene.h"

namespace isorelax::view {

/// What the colours say. `classes`: plain faces, with creases, borders, ridge vertices and corners marked.
enum class ColorBy : std::uint8_t { none, min_angle, max_angle, area, energy, classes };

/// "none", "angle", "max-angle", "area", "energy", "class": as on the command line and in files.
[[nodiscard]] std::string_view name_of(ColorBy color);
/// The inverse. Throws UsageError listing the names.
[[nodiscard]] ColorBy parse_color(std::string_view text);

/// Where the ends of the colour map come from.
enum class RangeRule : std::uint8_t {
  run,  ///< the quantity's own, over all meshes and frames of the picture: 0..60 degrees, 1/m..m mean areas,
        ///< ...
  current,  ///< least and greatest value of what is shown
  ends,     ///< two numbers
};
struct RangeChoice {
  RangeRule rule = RangeRule::run;
  render::Range ends;  ///< used with RangeRule::ends

  friend bool operator==(const RangeChoice&, const RangeChoice&) = default;
};
/// "run", "current" or "LO:HI". Throws UsageError.
[[nodiscard]] RangeChoice parse_range_choice(std::string_view text);

/// Which energy of a triangle ColorBy::energy shows: shape * K + area * S.
struct EnergyTerms {
  double shape = 1;
  double area = 1;
  /// "equilateral" (of mean area), "equilateral:EDGE", or a mesh file of the same triangles.
  std::string reference = "equilateral";

  friend bool operator==(const EnergyTerms&, const EnergyTerms&) = default;
};

/// A picture as a value: equal views of equal meshes are equal pictures, in a window, on the command line and
/// in a test. What a file leaves out keeps the default that stands here.
struct View {
  std::vector<std::string> meshes;  ///< files, left to right
  std::string against;              ///< file of the mesh that differences and arrows start from; empty: none

  ColorBy color = ColorBy::min_angle;
  bool difference = false;  ///< colours say now minus then, on a diverging map with 0 in its middle
  RangeChoice range;
  std::optional<render::ColorMap> color_map;  ///< empty: the quantity's own
  bool reversed = false;                      ///< the map runs the other way than the quantity's own
  /// Only triangles worse than this are drawn: angles below, largest angles and energies above, areas further
  /// from the mean than this factor; of differences those that got worse by more.
  std::optional<double> only_worse_than;
  EnergyTerms energy;

  bool arrows = false;  ///< from where vertices were in `against` to where they are
  double arrow_scale = 1;
  bool wire = false;
  bool boundary = false;  ///< mark the edges with one triangle
  bool legend = true;
  bool numbers = false;             ///< figures of the quality report
  std::vector<std::string> labels;  ///< one for each mesh; empty: file names where there are several
  render::Shading shading = render::Shading::flat;
  render::Background background = render::kDarkBackground;
  bool transparent = false;  ///< nothing behind the mesh; text is dark on a light plate
  render::PictureSize size;
  int supersampling = 1;          ///< 1..4: drawn so many times larger, then averaged
  double points = 0;              ///< pixels per point of lines and text; 0: by the picture's size
  std::optional<Index> selected;  ///< a triangle to be highlighted
  /// Text as parse_camera takes it, to be fitted to the meshes; or the camera itself.
  std::variant<std::string, render::Camera> camera = "fit";

  friend bool operator==(const View&, const View&) = default;
};

/// The key of a view's text inside a PNG file.
inline constexpr const char* kViewKeyword = "isorelax:view";

/// A view as text: JSON, one key to a line, numbers with all their digits.
[[nodiscard]] std::string to_json(const View& view);
/// The inverse. `source` names where the text is from in messages. Throws InputError: not JSON, another
/// version, an unknown key (by name), a value that makes no sense (by its key).
[[nodiscard]] View parse_view(std::string_view text, const std::string& source);

}  // namespace isorelax::view
