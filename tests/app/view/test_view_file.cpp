// A view as a value, as text, and inside a picture.

#include <gtest/gtest.h>

#include <fstream>

#include "app/temporary_mesh.h"
#include "mesh/error.h"
#include "render/png_chunks.h"
#include "view/picture.h"

namespace isorelax::view {
namespace {

View full_view() {
  View view;
  view.meshes = {"a \"quoted\".off", "dir/b.ply"};
  view.against = "c.off";
  view.color = ColorBy::energy;
  view.difference = true;
  view.range = {RangeRule::ends, {-0.1, 1.0 / 3}};
  view.color_map = render::ColorMap::magma;
  view.reversed = true;
  view.only_worse_than = 2.5;
  view.energy = {0.3, 0.7, "equilateral:0.125"};
  view.arrows = true;
  view.arrow_scale = 12.5;
  view.wire = true;
  view.boundary = true;
  view.legend = false;
  view.numbers = true;
  view.labels = {"vorher", "nachher äöü"};
  view.shading = render::Shading::smooth;
  view.background = {{1, 2, 3}, {250, 251, 252}};
  view.transparent = true;
  view.size = {333, 444};
  view.supersampling = 3;
  view.points = 1.1;
  view.selected = 17;
  render::Camera camera;
  camera.target = {0.1, -1e-17, 3e8};
  camera.azimuth_deg = 12.345678901234567;
  camera.elevation_deg = -89;
  camera.up = render::UpAxis::z;
  camera.extent = 1e-9;
  camera.projection = render::Projection::orthographic;
  camera.field_of_view_deg = 45;
  view.camera = camera;
  return view;
}

std::string reason_to_refuse(const std::string& text) {
  try {
    (void)parse_view(text, "v.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ViewFile, every_field_comes_back_bit_for_bit) {
  EXPECT_EQ(parse_view(to_json(full_view()), "text"), full_view());
  EXPECT_EQ(parse_view(to_json(View()), "text"), View());
  EXPECT_EQ(to_json(parse_view(to_json(full_view()), "text")), to_json(full_view()));
}

TEST(ViewFile, no_field_of_a_full_view_has_its_default) {
  // Else the test above could not notice a field that is not written.
  const std::string full = to_json(full_view());
  const std::string empty = to_json(View());
  std::size_t same = 0;
  for (std::size_t at = 0; at < full.size(); at = full.find('\n', at) + 1) {
    const std::string line = full.substr(at, full.find('\n', at) + 1 - at);
    same += line.size() > 3 && empty.find(line) != std::string::npos;
  }
  EXPECT_EQ(same, 1U) << "the version alone";
}

TEST(ViewFile, what_is_left_out_keeps_its_default) {
  View expected;
  expected.camera = "top:zoom=2";
  expected.wire = true;
  EXPECT_EQ(parse_view(R"({"version": 1, "camera": "top:zoom=2", "wire": true})", "text"), expected);
}

TEST(ViewFile, unknown_keys_are_refused_with_their_name) {
  EXPECT_EQ(reason_to_refuse(R"({"version": 1, "wires": true})"), "v.json: key 'wires': is unknown");
  EXPECT_EQ(reason_to_refuse(R"({"version": 1, "camera": {"azimut": 3}})"),
            "v.json: key 'camera.azimut': is unknown");
}

TEST(ViewFile, nonsense_is_refused_with_its_place) {
  EXPECT_NE(reason_to_refuse("{\"version\": 1,").find("v.json: byte "), std::string::npos);
  EXPECT_NE(reason_to_refuse("[]").find("not a JSON object"), std::string::npos);
  EXPECT_NE(reason_to_refuse("{}").find("'version' is missing"), std::string::npos);
  EXPECT_NE(reason_to_refuse(R"({"version": 2})").find("reads version 1"), std::string::npos);
  for (const std::string part :
       {R"("wire": 1)", R"("color": "red")", R"("range": [2, 1])", R"("range": [1])", R"("size": [0, 5])",
        R"("size": [5])", R"("supersampling": 9)", R"("points": -1)", R"("selected": -1.5)", R"("camera": 7)",
        R"("background": "plaid")", R"("shading": "round")", R"("only_worse_than": "x")"}) {
    const std::string key = part.substr(1, part.find('"', 1) - 1);
    EXPECT_NE(reason_to_refuse("{\"version\": 1, " + part + "}").find("key '" + key + "'"), std::string::npos)
        << part;
  }
  for (const std::string part : {R"("extent": 0)", R"("elevation": 91)", R"("field_of_view": 0)",
                                 R"("target": [1, 2])", R"("up": "x")", R"("projection": "fish")"}) {
    const std::string key = part.substr(1, part.find('"', 1) - 1);
    EXPECT_NE(
        reason_to_refuse("{\"version\": 1, \"camera\": {" + part + "}}").find("key 'camera." + key + "'"),
        std::string::npos)
        << part;
  }
}

TEST(ViewFile, a_picture_carries_its_view_and_other_files_say_that_they_carry_none) {
  const test::TemporaryFolder folder;
  render::Image image(3, 2);
  write_picture(folder / "a.png", {image, full_view()});
  EXPECT_EQ(read_view(folder / "a.png"), full_view());
  EXPECT_EQ(render::read_png(folder / "a.png"), image);
  render::write_png(folder / "plain.png", image);
  EXPECT_THROW((void)read_view(folder / "plain.png"), InputError);
  std::ofstream(folder / "no.png") << "no picture";
  EXPECT_THROW((void)read_view(folder / "no.png"), InputError);
  EXPECT_THROW((void)read_view(folder / "missing.json"), InputError);
}

TEST(PngChunks, come_apart_and_together_and_damage_is_noticed) {
  const std::vector<std::uint8_t> bytes = render::encode_png(render::Image(5, 4), {{"key", "värde"}});
  EXPECT_EQ(render::join_png(render::split_png(bytes)), bytes);
  EXPECT_EQ(render::texts_of_png(bytes).at("key"), "värde");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::uint8_t> damaged = bytes;
    damaged[i] ^= 0x40;
    EXPECT_NE(render::join_png(render::split_png(damaged)), bytes) << i;
    EXPECT_LT(render::split_png(std::span(bytes).first(i)).size(), render::split_png(bytes).size()) << i;
  }
}

TEST(AnimatedPng, has_all_frames_and_shows_the_first_to_who_knows_no_animation) {
  const test::TemporaryFolder folder;
  render::Animation animation{{render::Image(4, 3), render::Image(4, 3), render::Image(4, 3)}, 40, 900};
  animation.frames[0].at(1, 1)[0] = 77;
  const auto bytes = render::encode_animated_png(animation, {{"key", "text"}});
  std::ofstream(folder / "a.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  EXPECT_EQ(render::read_png(folder / "a.png"), animation.frames[0]);
  EXPECT_EQ(render::read_png_texts(folder / "a.png").at("key"), "text");
  std::string types;
  for (const render::PngChunk& chunk : render::split_png(bytes))
    if (chunk.type == "acTL" || chunk.type == "fcTL" || chunk.type == "fdAT" || chunk.type == "IDAT")
      types += chunk.type + " ";
  EXPECT_EQ(types, "acTL fcTL IDAT fcTL fdAT fcTL fdAT ");
}

}  // namespace
}  // namespace isorelax::view
