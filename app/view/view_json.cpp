#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "mesh/error.h"
#include "view/view.h"

namespace isorelax::view {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kVersion = 1;

Json to_object(const render::Camera& camera) {
  return {
      {"target", {camera.target.x(), camera.target.y(), camera.target.z()}},
      {"azimuth", camera.azimuth_deg},
      {"elevation", camera.elevation_deg},
      {"up", camera.up == render::UpAxis::y ? "y" : "z"},
      {"extent", camera.extent},
      {"projection", camera.projection == render::Projection::perspective ? "perspective" : "orthographic"},
      {"field_of_view", camera.field_of_view_deg}};
}

std::string hex(render::Color color) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const unsigned channel : {color.red, color.green, color.blue}) {
    text += kDigits[channel / 16];
    text += kDigits[channel % 16];
  }
  return text;
}

Json range_json(const RangeChoice& range) {
  if (range.rule == RangeRule::run) return "run";
  if (range.rule == RangeRule::current) return "current";
  return {range.ends.low, range.ends.high};
}

/// Reads the keys of one object; every key has to have a reader.
class Keys {
 public:
  using Reader = std::function<void(const Json&)>;

  Keys(std::string source, std::string prefix) : source_(std::move(source)), prefix_(std::move(prefix)) {}

  [[noreturn]] void fail(const std::string& key, const std::string& reason) const {
    throw InputError(source_, "key '" + prefix_ + key + "'", reason);
  }

  template <class Value>
  void add(const std::string& key, Value& value) {
    readers_[key] = [&value](const Json& json) { value = json.get<Value>(); };
  }
  void add(const std::string& key, double& value) {
    readers_[key] = [this, key, &value](const Json& json) { value = number(key, json); };
  }
  void add(const std::string& key, Reader reader) { readers_[key] = std::move(reader); }

  void read(const Json& object) const {
    if (!object.is_object()) throw UsageError("is no object");
    for (const auto& [key, value] : object.items()) {
      const auto reader = readers_.find(key);
      if (reader == readers_.end()) fail(key, "is unknown");
      try {
        reader->second(value);
      } catch (const nlohmann::json::exception&) {
        fail(key, "has a value of the wrong kind: " + value.dump());
      } catch (const UsageError& error) {
        fail(key, error.what());
      }
    }
  }

  [[nodiscard]] double number(const std::string& key, const Json& json) const {
    const auto value = json.get<double>();
    if (!std::isfinite(value)) fail(key, "is no finite number");
    return value;
  }

 private:
  std::string source_, prefix_;
  std::map<std::string, Reader> readers_;
};

/// One of two words.
template <class Enum>
Keys::Reader either(Enum& value, const std::string& first, const std::string& second) {
  return [&value, first, second](const Json& json) {
    const auto word = json.get<std::string>();
    if (word != first && word != second) throw UsageError("expected " + first + " or " + second);
    value = word == first ? static_cast<Enum>(0) : static_cast<Enum>(1);
  };
}

void require(bool holds, const char* reason) {
  if (!holds) throw UsageError(reason);
}

int whole_number(const Json& json) {
  require(json.is_number_integer(), "is no whole number");
  const auto value = json.get<std::int64_t>();
  require(std::abs(value) <= std::numeric_limits<int>::max(), "is too large");
  return static_cast<int>(value);
}

render::Camera read_camera(const Json& json, const std::string& source) {
  render::Camera camera;
  Keys keys(source, "camera.");
  keys.add("target", [&](const Json& value) {
    const auto target = value.get<std::array<double, 3>>();
    camera.target = Vec3(target[0], target[1], target[2]);
    require(camera.target.allFinite(), "is no point");
  });
  keys.add("azimuth", camera.azimuth_deg);
  keys.add("elevation", camera.elevation_deg);
  keys.add("up", either(camera.up, "y", "z"));
  keys.add("extent", camera.extent);
  keys.add("projection", either(camera.projection, "perspective", "orthographic"));
  keys.add("field_of_view", camera.field_of_view_deg);
  keys.read(json);
  if (!(camera.extent > 0)) keys.fail("extent", "must be above 0");
  if (std::abs(camera.elevation_deg) > 90) keys.fail("elevation", "must lie between -90 and 90");
  if (!(camera.field_of_view_deg >= 1 && camera.field_of_view_deg <= 150))
    keys.fail("field_of_view", "must lie between 1 and 150");
  return camera;
}

EnergyTerms read_energy(const Json& json, const std::string& source) {
  EnergyTerms energy;
  Keys keys(source, "energy.");
  keys.add("shape", energy.shape);
  keys.add("area", energy.area);
  keys.add("reference", energy.reference);
  keys.read(json);
  if (energy.shape < 0) keys.fail("shape", "must not be negative");
  if (energy.area < 0) keys.fail("area", "must not be negative");
  return energy;
}

RangeChoice read_range(const Json& json) {
  if (json.is_string()) return parse_range_choice(json.get<std::string>());
  const auto ends = json.get<std::array<double, 2>>();
  require(std::isfinite(ends[0]) && std::isfinite(ends[1]) && ends[0] <= ends[1], "is no range LO, HI");
  return {RangeRule::ends, {ends[0], ends[1]}};
}

render::Background read_background(const Json& json) {
  if (json.is_string()) return render::parse_background(json.get<std::string>());
  const auto ends = json.get<std::array<std::string, 2>>();
  return {render::parse_background(ends[0]).top, render::parse_background(ends[1]).bottom};
}

render::PictureSize read_size(const Json& json) {
  require(json.is_array() && json.size() == 2, "is no WIDTH, HEIGHT");
  const int sides[] = {whole_number(json[0]), whole_number(json[1])};
  require(sides[0] >= 1 && sides[1] >= 1 && sides[0] <= 16384 && sides[1] <= 16384,
          "has sides outside 1..16384 pixels");
  return {sides[0], sides[1]};
}

void add_colors(Keys& keys, View& view, const std::string& source) {
  keys.add("color", [&](const Json& json) { view.color = parse_color(json.get<std::string>()); });
  keys.add("difference", view.difference);
  keys.add("range", [&](const Json& json) { view.range = read_range(json); });
  keys.add("colormap", [&](const Json& json) {
    view.color_map.reset();
    if (json != "auto") view.color_map = render::parse_color_map(json.get<std::string>());
  });
  keys.add("reverse", view.reversed);
  keys.add("only_worse_than", [&](const Json& json) {
    view.only_worse_than.reset();
    if (!json.is_null()) view.only_worse_than = keys.number("only_worse_than", json);
  });
  keys.add("energy", [&](const Json& json) { view.energy = read_energy(json, source); });
}

void add_drawing(Keys& keys, View& view, const std::string& source) {
  keys.add("arrows", view.arrows);
  keys.add("arrow_scale", view.arrow_scale);
  keys.add("wire", view.wire);
  keys.add("boundary", view.boundary);
  keys.add("legend", view.legend);
  keys.add("numbers", view.numbers);
  keys.add("labels", view.labels);
  keys.add("shading", either(view.shading, "flat", "smooth"));
  keys.add("background", [&](const Json& json) { view.background = read_background(json); });
  keys.add("transparent", view.transparent);
  keys.add("size", [&](const Json& json) { view.size = read_size(json); });
  keys.add("supersampling", [&](const Json& json) {
    view.supersampling = whole_number(json);
    require(view.supersampling >= 1 && view.supersampling <= 4, "must be 1, 2, 3 or 4");
  });
  keys.add("points", [&](const Json& json) {
    view.points = keys.number("points", json);
    require(view.points >= 0 && view.points <= 64, "must lie between 0 and 64");
  });
  keys.add("selected", [&](const Json& json) {
    view.selected.reset();
    if (json.is_null()) return;
    const int triangle = whole_number(json);
    require(triangle >= 0, "is no triangle");
    view.selected = static_cast<Index>(triangle);
  });
  keys.add("camera", [&](const Json& json) {
    if (json.is_string())
      view.camera = json.get<std::string>();
    else
      view.camera = read_camera(json, source);
  });
}

}  // namespace

std::string to_json(const View& view) {
  Json json;
  json["version"] = kVersion;
  json["meshes"] = view.meshes;
  if (!view.against.empty()) json["against"] = view.against;
  json["color"] = name_of(view.color);
  json["difference"] = view.difference;
  json["range"] = range_json(view.range);
  json["colormap"] = view.color_map ? Json(render::name_of(*view.color_map)) : Json("auto");
  json["reverse"] = view.reversed;
  json["only_worse_than"] = view.only_worse_than ? Json(*view.only_worse_than) : Json();
  json["energy"] = {
      {"shape", view.energy.shape}, {"area", view.energy.area}, {"reference", view.energy.reference}};
  json["arrows"] = view.arrows;
  json["arrow_scale"] = view.arrow_scale;
  json["wire"] = view.wire;
  json["boundary"] = view.boundary;
  json["legend"] = view.legend;
  json["numbers"] = view.numbers;
  json["labels"] = view.labels;
  json["shading"] = view.shading == render::Shading::flat ? "flat" : "smooth";
  json["background"] = {hex(view.background.top), hex(view.background.bottom)};
  json["transparent"] = view.transparent;
  json["size"] = {view.size.width, view.size.height};
  json["supersampling"] = view.supersampling;
  json["points"] = view.points;
  json["selected"] = view.selected ? Json(*view.selected) : Json();
  if (const auto* camera = std::get_if<render::Camera>(&view.camera))
    json["camera"] = to_object(*camera);
  else
    json["camera"] = std::get<std::string>(view.camera);
  // One key to a line, values on theirs.
  std::string text = "{\n";
  for (const auto& [key, value] : json.items())
    text +=
        "  " + Json(key).dump() + ": " + value.dump(-1, ' ', false, Json::error_handler_t::replace) + ",\n";
  return text.substr(0, text.size() - 2) + "\n}\n";
}

View parse_view(std::string_view text, const std::string& source) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(source, "byte " + std::to_string(error.byte), "is no view: not JSON");
  }
  View view;
  if (!json.is_object()) throw InputError(source, "", "is no view: not a JSON object");
  const auto version = json.find("version");
  if (version == json.end()) throw InputError(source, "", "is no view: the key 'version' is missing");
  if (*version != kVersion)
    throw InputError(source, "key 'version'", "is " + version->dump() + ", this program reads version 1");
  Keys keys(source, "");
  keys.add("version", [](const Json&) {});
  keys.add("meshes", view.meshes);
  keys.add("against", view.against);
  add_colors(keys, view, source);
  add_drawing(keys, view, source);
  keys.read(json);
  return view;
}

}  // namespace isorelax::view
