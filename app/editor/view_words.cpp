#include "editor/view_words.h"

#include <array>
#include <optional>

#include "editor/word_values.h"
#include "io/text_out.h"
#include "mesh/error.h"
#include "render/picture_size.h"

namespace isorelax::editor {
namespace {

using Words = std::span<const std::string>;

constexpr std::array<std::string_view, model::kColorings> kColorNames{"none", "angle", "max-angle", "area",
                                                                      "energy"};

bool to_switch(const std::string& value) {
  if (value != "on" && value != "off") throw UsageError("expected on or off, found \"" + value + "\"");
  return value == "on";
}

void set_range(const std::string& value, model::ViewSettings& view) {
  if (value == "run" || value == "current") {
    view.range_mode = value == "run" ? model::RangeMode::run : model::RangeMode::current;
    return;
  }
  const render::Range range = render::parse_range(value);
  view.range_mode = model::RangeMode::typed;
  view.typed.at(static_cast<std::size_t>(view.coloring)) = {range.low, range.high};
}

std::string range_word(const model::ViewSettings& view) {
  if (view.range_mode != model::RangeMode::typed)
    return view.range_mode == model::RangeMode::current ? "current" : "run";
  const model::ValueRange& range = view.typed.at(static_cast<std::size_t>(view.coloring));
  return digits_of(range.low) + ":" + digits_of(range.high);
}

}  // namespace

model::SetView parse_view_words(Words words, model::ViewSettings view) {
  std::optional<std::string> range;  // of the colouring, which may stand behind it
  for (const std::string& word : words.subspan(1)) {
    const std::size_t equal = std::min(word.find('='), word.size());
    const std::string key = word.substr(0, equal);
    const std::string value = word.substr(std::min(equal + 1, word.size()));
    if (key == "color")
      view.coloring = static_cast<model::Coloring>(index_of(kColorNames, value));
    else if (key == "range")
      range = value;
    else if (key == "map")
      view.color_map = value;
    else if (key == "wire")
      view.wire = to_switch(value);
    else if (key == "legend")
      view.legend = to_switch(value);
    else if (key == "reasons")
      view.reasons = to_switch(value);
    else if (key == "reversed")
      view.reversed = to_switch(value);
    else if (key == "smooth")
      view.shading = to_switch(value) ? model::Shading::smooth : model::Shading::flat;
    else
      throw UsageError("\"" + key + "\" is nothing that a view has");
  }
  if (range) set_range(*range, view);
  return {view};
}

std::string to_line(const model::SetView& command) {
  const model::ViewSettings& view = command.view;
  const auto word = [](bool on) { return on ? "on" : "off"; };
  std::string line = "view color=" + std::string(kColorNames.at(static_cast<std::size_t>(view.coloring))) +
                     " range=" + range_word(view) + " wire=" + word(view.wire) +
                     " legend=" + word(view.legend) + " reasons=" + word(view.reasons) +
                     " reversed=" + word(view.reversed) +
                     " smooth=" + word(view.shading == model::Shading::smooth);
  if (!view.color_map.empty()) line += " map=" + view.color_map;
  return line;
}

std::string to_line(const render::Camera& camera) {
  std::string line = "camera";
  for (const double x : {camera.target.x(), camera.target.y(), camera.target.z(), camera.azimuth_deg,
                         camera.elevation_deg, camera.extent})
    line += " " + digits_of(x);
  line += camera.up == render::UpAxis::y ? " y" : " z";
  return line + (camera.projection == render::Projection::perspective ? " perspective" : " orthographic");
}

render::Camera parse_camera_words(Words words) {
  require(words, 8, 8);
  render::Camera camera;
  camera.target = {to_number<double>(words[1]), to_number<double>(words[2]), to_number<double>(words[3])};
  camera.azimuth_deg = to_number<double>(words[4]);
  camera.elevation_deg = to_number<double>(words[5]);
  camera.extent = to_number<double>(words[6]);
  if (!(camera.extent > 0)) throw UsageError("camera: the extent must be positive");
  constexpr std::array<std::string_view, 2> kUp{"y", "z"};
  constexpr std::array<std::string_view, 2> kProjection{"perspective", "orthographic"};
  camera.up = index_of(kUp, words[7]) == 0 ? render::UpAxis::y : render::UpAxis::z;
  camera.projection = index_of(kProjection, words[8]) == 0 ? render::Projection::perspective
                                                           : render::Projection::orthographic;
  return camera;
}

}  // namespace isorelax::editor
