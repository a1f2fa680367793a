// render and compare as one types them.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/cli/program.h"

namespace isorelax::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

const char* const kTetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const char* const kOtherTetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0.1 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

class PictureCommands : public testing::Test {
 protected:
  /// Draws a mesh; the picture's path.
  [[nodiscard]] std::string draw(const std::string& name, const std::string& arguments) const {
    const Outcome outcome =
        run_program("render " + arguments + " -o " + path(name) + " --size 200x150 --quiet");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return path(name);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return workspace_.path(name); }

  Workspace workspace_;
  std::string mesh_ = workspace_.write("t.off", kTetrahedron);
  std::string other_ = workspace_.write("u.off", kOtherTetrahedron);
};

TEST_F(PictureCommands, a_picture_is_made_again_like_itself_and_from_its_view) {
  const std::string first =
      draw("a.png", mesh_ + " --wire --camera iso --color max-angle --save-view " + path("v.json"));
  ASSERT_EQ(run_program("render --like " + first + " -o " + path("b.png")).status, 0);
  ASSERT_EQ(run_program("render --camera " + path("v.json") + " -o " + path("c.png")).status, 0);
  ASSERT_EQ(run_program("render " + mesh_ + " --camera " + path("v.json") + " -o " + path("d.png")).status,
            0);
  for (const char* name : {"b.png", "c.png", "d.png"})
    EXPECT_EQ(contents(path(name)), contents(first)) << name;
  ASSERT_EQ(run_program("render --like " + first + " --no-wire -o " + path("e.png")).status, 0);
  EXPECT_NE(contents(path("e.png")), contents(first));
}

TEST_F(PictureCommands, a_views_meshes_are_found_beside_it) {
  fs::create_directories(path("sub"));
  workspace_.write("sub/m.off", kTetrahedron);
  workspace_.write("sub/v.json", R"({"version": 1, "meshes": ["m.off"], "size": [80, 60], "camera": "top"})");
  EXPECT_EQ(run_program("render --camera " + path("sub/v.json") + " -o " + path("m.png")).status, 0);
}

TEST_F(PictureCommands, views_that_make_no_sense_are_refused_with_their_key) {
  const std::string bad = workspace_.write("bad.json", R"({"version": 1, "colour": "angle"})");
  const Outcome outcome = run_program("render " + mesh_ + " --camera " + bad + " -o " + path("x.png"));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("bad.json: key 'colour': is unknown"), std::string::npos) << outcome.err;
  EXPECT_EQ(run_program("render " + mesh_ + " --camera " + path("none.json") + " -o " + path("x.png")).status,
            3);
  for (const std::string& wrong :
       {std::string("--color red"), std::string("--range 2:1"), std::string("--supersampling 9"),
        std::string("--difference"), std::string("--arrows"), std::string("--legend maybe"),
        std::string("--projection flat"), std::string("--only-worse-than x"), std::string("--camera nowhere"),
        std::string("--size 8192x8192 --supersampling 2")}) {
    const Outcome refused = run_program("render " + mesh_ + " -o " + path("x.png") + " " + wrong);
    EXPECT_EQ(refused.status, 2) << wrong << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
  EXPECT_EQ(run_program("render -o " + path("x.png")).status, 2);
  EXPECT_FALSE(fs::exists(path("x.png")));
}

TEST_F(PictureCommands, comparing_tells_same_from_different_and_refuses_other_sizes) {
  const std::string a = draw("a.png", mesh_);
  const std::string b = draw("b.png", other_ + " --like " + a);
  EXPECT_EQ(run_program("compare " + a + " " + a).status, 0);
  EXPECT_EQ(run_program("compare " + a + " " + b).status, 1);
  EXPECT_EQ(
      run_program("compare " + a + " " + b +
                  " --max-share 1 --min-ssim -1 --min-tile-ssim -1 --max-flip 1 --threshold max-flip-p99=1")
          .status,
      0);
  ASSERT_EQ(run_program("render " + mesh_ + " --size 201x150 -o " + path("c.png")).status, 0);
  const Outcome refused = run_program("compare " + a + " " + path("c.png"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("200x150 and 201x150"), std::string::npos) << refused.err;
  EXPECT_EQ(run_program("compare " + a + " " + path("missing.png")).status, 3);
  EXPECT_EQ(run_program("compare " + a + " " + mesh_).status, 2);
  EXPECT_EQ(run_program("compare " + a + " " + b + " --threshold nonsense=1").status, 2);
}

TEST_F(PictureCommands,
       one_degree_one_vertex_another_map_and_a_missing_legend_fail_under_the_default_limits) {
  ASSERT_EQ(run_program("generate torus -o " + path("torus.off")).status, 0);
  const std::string good =
      draw("good.png", path("torus.off") + " --camera 30,20 --save-view " + path("v.json"));
  const std::string view = " --camera " + path("v.json");
  Json turned = Json::parse(contents(path("v.json")));
  turned["camera"]["azimuth"] = turned["camera"]["azimuth"].get<double>() + 1;
  workspace_.write("turned.json", turned.dump());
  const std::vector<std::string> wrong = {
      draw("map.png", view + " --colormap cividis"), draw("legend.png", view + " --legend off"),
      draw("turned.png", "--camera " + path("turned.json")), draw("reverse.png", view + " --reverse")};
  for (const std::string& one : wrong) EXPECT_EQ(run_program("compare " + good + " " + one).status, 1) << one;
  EXPECT_EQ(run_program("compare " + good + " " + draw("again.png", view)).status, 0);
}

TEST_F(PictureCommands, results_come_as_json_junit_and_a_page) {
  const std::string a = draw("a.png", mesh_);
  const std::string b = draw("b.png", other_ + " --like " + a);
  const Outcome outcome = run_program("compare " + a + " " + b + " --json --quiet --report " +
                                      path("r.html") + " --junit " + path("r.xml"));
  EXPECT_EQ(outcome.status, 1);
  const Json object = Json::parse(outcome.out);
  for (const char* key : {"pixels", "equal_pixels", "largest_difference", "share_beyond_tolerance",
                          "mean_ssim", "worst_tile_ssim", "flip_mean", "flip_p99"})
    EXPECT_TRUE(object[key].is_number()) << key;
  EXPECT_EQ(object["passes"], false);
  EXPECT_EQ(object["limits"].size(), 6U);
  EXPECT_NE(contents(path("r.html")).find("View of B"), std::string::npos);
  EXPECT_NE(contents(path("r.xml")).find("failures=\"1\""), std::string::npos);
}

TEST_F(PictureCommands, folders_are_compared_by_name) {
  for (const char* folder : {"x", "y"}) {
    fs::create_directories(path(folder));
    fs::copy(draw("a.png", mesh_), path(std::string(folder) + "/a.png"));
  }
  EXPECT_EQ(run_program("compare " + path("x") + " " + path("y")).status, 0);
  fs::copy(path("x/a.png"), path("y/extra.png"));
  const Outcome outcome = run_program("compare " + path("x") + " " + path("y") + " --json");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(Json::parse(outcome.out)["comparisons"][1]["name"], "extra.png");
  EXPECT_EQ(run_program("compare " + path("x") + " " + mesh_).status, 2);
}

TEST_F(PictureCommands, meshes_are_compared_with_numbers_and_a_page) {
  EXPECT_EQ(run_program("compare " + mesh_ + " " + mesh_).status, 0);
  const Outcome outcome =
      run_program("compare " + mesh_ + " " + other_ + " --json --size 120x90 --report " + path("m.html"));
  EXPECT_EQ(outcome.status, 1);
  const Json object = Json::parse(outcome.out);
  EXPECT_EQ(object["moved"], 1);
  EXPECT_EQ(object["fixed"], 3);
  EXPECT_EQ(object["displacement_max_vertex"], 2);
  EXPECT_NEAR(object["displacement_max"].get<double>(), 0.1 / std::sqrt(3.0), 1e-9);
  EXPECT_TRUE(object["min_angle_deg"]["b"].is_number());
  EXPECT_NE(contents(path("m.html")).find("Change from A to B"), std::string::npos);
  EXPECT_EQ(
      run_program("compare " + mesh_ + " " + other_ + " --max-displacement 0.1 --max-deviation 0.1").status,
      0);
  EXPECT_EQ(run_program("compare " + mesh_ + " " + path("none.off")).status, 3);
}

TEST_F(PictureCommands, a_run_becomes_numbered_pictures_on_one_camera_and_one_range) {
  ASSERT_EQ(run_program("generate random --triangles 200 -o " + path("m.off")).status, 0);
  workspace_.write("v.json", R"({"version": 1, "size": [120, 90], "color": "area", "range": "current"})");
  const std::string smooth = "smooth " + path("m.off") + " -o " + path("o.off") +
                             " --solver jacobi --iterations 7 --tolerance 0 --every 3 --view " +
                             path("v.json");
  ASSERT_EQ(run_program(smooth + " --frames " + path("frames")).status, 0);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path("frames"))) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"frame_0000.png", "frame_0001.png", "frame_0002.png",
                                             "frame_0003.png"}))
      << "0, 3, 6 and 7";
  // The last frame is the picture of the result under the view that it carries.
  ASSERT_EQ(run_program("render " + path("o.off") + " --like " + path("frames/frame_0003.png") + " -o " +
                        path("r.png"))
                .status,
            0);
  EXPECT_EQ(
      run_program("compare --max-difference 0 " + path("r.png") + " " + path("frames/frame_0003.png")).status,
      0);
  ASSERT_EQ(run_program(smooth + " --frames " + path("run.png")).status, 0);
  const std::string animation = contents(path("run.png"));
  EXPECT_NE(animation.find("acTL"), std::string::npos);
  EXPECT_EQ(run_program("compare --max-difference 0 " + path("run.png") + " " + path("frames/frame_0000.png"))
                .status,
            0);
  EXPECT_EQ(run_program(smooth + " --frames " + path("m.off") + "/x").status, 4);
}

TEST_F(PictureCommands, the_last_frame_counts_the_iterations_of_a_polish_too) {
  ASSERT_EQ(run_program("generate random --triangles 200 -o " + path("m.off")).status, 0);
  ASSERT_EQ(run_program("smooth " + path("m.off") + " -o " + path("o.off") +
                        " --iterations 3 --tolerance 0 --polish worst --every 1000 --report " +
                        path("r.json") + " --frames " + path("frames"))
                .status,
            0);
  const Json report = Json::parse(contents(path("r.json")));
  const unsigned polished = report["polish"]["iterations"];
  ASSERT_GT(polished, 0U);
  // The view that it carries names it.
  const std::string label = "iteration " + std::to_string(3 + polished);
  EXPECT_NE(contents(path("frames/frame_0001.png")).find(label + "\""), std::string::npos) << label;
}

TEST(Script, DoesASessionAgainAndTellsWhatDoesNotHold) {
  const Workspace folder;
  ASSERT_EQ(run_program("generate random --triangles 200 --seed 3 -o '" + folder.path("a.off") + "'").status,
            0);
  const std::string good =
      folder.write("good.script", "open a.off\nrun 3\nseek 2\nscreenshot a.png\nexpect moved > 0\n");
  const Outcome done = run_program("script '" + good + "' --size 800x600");
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("a.png")));
  const std::string wrong = folder.write("wrong.script", "open a.off\nstep\nexpect iteration == 7\n");
  const Outcome failed = run_program("script '" + wrong + "'");
  EXPECT_EQ(failed.status, 1);
  EXPECT_NE(failed.err.find("line 3"), std::string::npos) << failed.err;
  const Outcome refused = run_program("script '" + folder.write("bad.script", "jump\n") + "'");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("line 1"), std::string::npos) << refused.err;
}

TEST_F(PictureCommands, messages_name_the_file_and_the_reason) {
  const auto message = [](const std::string& arguments) { return run_program(arguments).err; };
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  const std::string to = " -o " + path("x.png");
  says(message("render " + mesh_ + " --camera " + path("none.json") + to),
       "none.json: cannot be read: No such file or directory");
  says(message("render " + mesh_ + " --like " + path("none.png") + to),
       "none.png: cannot be read: No such file or directory");
  says(message("script " + path("none.script")), "none.script: cannot be read: No such file or directory");
  says(message("render " + mesh_ + " --background '#12'" + to), "or transparent");
  const std::string flat = workspace_.write("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  says(message("render " + flat + " --color energy" + to), "flat.off: the mesh has no area");
  says(message("quality " + flat + " --reference initial"), "flat.off: the mesh has no area");
  const std::string photo = workspace_.write("photo.jpg", "\xff\xd8");
  says(message("compare " + draw("whole.png", mesh_) + " " + photo), "photo.jpg: is no PNG picture");
  const std::string whole = contents(path("whole.png"));
  const std::string half = workspace_.write("half.png", whole.substr(0, whole.size() / 2));
  says(message("compare " + half + " " + path("whole.png")), "half.png: byte ");
}

}  // namespace
}  // namespace isorelax::test
