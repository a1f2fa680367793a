#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "app/cli/program.h"
#include "cli/motion_pictures.h"
#include "generate/generate.h"

namespace isorelax::test {
namespace {

using Json = nlohmann::json;

TEST(AdvectCommand, WritesAStartAnIndexALogAndStates) {
  const Workspace workspace;
  const std::string folder = workspace.path("run");
  const Outcome outcome =
      run_program("advect --sphere 100 --step 0.1 --until 0.4 --save-every 2 --vtk --exact -o " + folder);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const Json log = Json::parse(contents(folder + "/log.json"))["steps"];
  ASSERT_EQ(log.size(), 5U);
  for (const char* key : {"time", "min_angle_deg", "mean_min_angle_deg", "angle_p05_deg", "below_15_deg",
                          "area_max_over_min", "volume", "volume_change", "folded_edges"})
    EXPECT_TRUE(log[4].contains(key)) << key;
  EXPECT_NEAR(log[3]["time"].get<double>(), 0.3, 1e-15);
  EXPECT_GT(log[4]["exact"]["from_exact"]["max"].get<double>(), 0);
  EXPECT_FALSE(log[3].contains("exact"));
  const Json series = Json::parse(contents(folder + "/states.ply.series"))["files"];
  ASSERT_EQ(series.size(), 3U);
  EXPECT_EQ(series[2]["name"], "state_000004.ply");
  for (const char* file :
       {"/start.ply", "/state_000002.ply", "/state_000004.vtp", "/states.pvd", "/run.json"})
    EXPECT_FALSE(contents(folder + file).empty()) << file;
  // What the log says is what the state shows to others.
  const Outcome quality = run_program("quality --json " + folder + "/state_000004.ply");
  EXPECT_EQ(Json::parse(quality.out)["min_angle_deg"], log[4]["min_angle_deg"]);
}

TEST(AdvectCommand, PicturesShowAllOfTheSurface) {
  cli::MotionPictures pictures("fit", 300, 260);
  TriangleMesh first = generate(ShapeKind::sphere, {.vertices = 400}), last = first;
  for (Vec3& x : first.positions) x = 0.15 * x + Vec3(0.35, 0.35, 0.35);
  for (Vec3& x : last.positions) x = 0.3 * x + Vec3(1.2, 0.5, 0.4);
  pictures.look_at(first);
  pictures.look_at(last);
  for (const TriangleMesh& mesh : {first, last}) {
    const render::Image image = pictures.draw(mesh, "");
    std::size_t drawn = 0;
    for (int y = 0; y < 260; ++y)
      for (int x = 0; x < 220; ++x) {  // the legend stands on the right
        const auto pixel = image.at(x, y);
        const bool white = pixel[0] == 255 && pixel[1] == 255 && pixel[2] == 255;
        drawn += white ? 0 : 1;
        const bool edge = x == 0 || y == 0 || y == 259;
        EXPECT_TRUE(white || !edge) << x << " " << y;
      }
    EXPECT_GT(drawn, 1000U);
  }
}

TEST(AdvectCommand, AResumedRunLeavesTheFilesOfAStraightOne) {
  const Workspace workspace;
  const std::string straight = workspace.path("straight");
  const std::string resumed = workspace.path("resumed");
  const std::string options = "advect --sphere 80 --step 0.1 --until 0.5 --save-every 1 -o ";
  ASSERT_EQ(run_program(options + straight).status, 0);
  ASSERT_EQ(run_program(options + resumed).status, 0);
  for (const char* file : {"/state_000003.ply", "/state_000004.ply", "/state_000005.ply"})
    std::filesystem::remove(resumed + file);
  const Outcome outcome = run_program("advect --resume " + resumed + "/state_000002.ply");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const auto& entry : std::filesystem::directory_iterator(straight)) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(contents(straight + "/" + name), contents(resumed + "/" + name)) << name;
  }
}

TEST(AdvectCommand, AFieldThatFailsLeavesWhatWasWritten) {
  const Workspace workspace;
  const std::string folder = workspace.path("run");
  const Outcome outcome = run_program(
      "advect --sphere 50 --field 'expr:1/max(0,0.25-t);0;0' --step 0.1 --until 1 --save-every 1 -o " +
      folder);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("isorelax: error: at time 0.25, vertex 0: "), std::string::npos) << outcome.err;
  EXPECT_EQ(Json::parse(contents(folder + "/log.json"))["steps"].size(), 3U);
  EXPECT_EQ(run_program("quality " + folder + "/state_000002.ply").status, 0);
  EXPECT_FALSE(std::filesystem::exists(folder + "/state_000003.ply"));
}

TEST(AdvectCommand, MistakesAreToldBeforeAnythingIsWritten) {
  const Workspace workspace;
  const std::string folder = workspace.path("run");
  for (const char* options :
       {"--field swirl", "--preset best", "--sphere 3", "--sphere 100:-1", "--field 'expr:1;2'", "--step nan",
        "--preset none --volume keep", "--mu 0.5", "--field normal:1 --tolerance 1e-6",
        "--reference equilateral:0", "--reference equilateral:0.02", "--step 1e-300",
        "--step 1e-25 --tolerance 1e-6", "--until 1e300", "--camera nowhere",
        "--pictures --camera iso:zoom=x"}) {
    const Outcome outcome = run_program("advect -o " + folder + " " + options);
    EXPECT_EQ(outcome.status, 2) << options << ": " << outcome.err;
    expect_one_error_line(outcome);
    EXPECT_FALSE(std::filesystem::exists(folder)) << options;
  }
  EXPECT_EQ(run_program("advect").status, 2);
  EXPECT_EQ(run_program("advect --resume " + workspace.write("no.ply", "nothing")).status, 3);
}

TEST(AdvectCommand, DamagedFilesAreToldAndLeftAsTheyAre) {
  const Workspace workspace;
  const std::string folder = workspace.path("run");
  ASSERT_EQ(run_program("advect --sphere 50 --step 0.1 --until 0.3 --save-every 1 -o " + folder).status, 0);
  const auto refused_with = [&](const std::string& file, const std::string& damaged) {
    const std::string whole = contents(folder + "/" + file);
    ASSERT_NE(whole, damaged) << file;
    static_cast<void>(workspace.write("run/" + file, damaged));
    const Outcome outcome = run_program("advect --resume " + folder + "/state_000002.ply");
    EXPECT_EQ(outcome.status, 3) << file << ": " << outcome.err;
    expect_one_error_line(outcome);
    EXPECT_EQ(contents(folder + "/" + file), damaged);
    static_cast<void>(workspace.write("run/" + file, whole));
  };
  const Json run = Json::parse(contents(folder + "/run.json"));
  for (const Json& value : {Json(0), Json(-2), Json(1.5), Json("1")}) {
    Json damaged = run;
    damaged["save_every"] = value;
    refused_with("run.json", damaged.dump());
  }
  Json damaged = run;
  damaged["options"] = {"--sphere", "50", "--step", "1e-300"};
  refused_with("run.json", damaged.dump());
  refused_with("log.json", R"({"steps":[]})");
  std::string state = contents(folder + "/state_000002.ply");
  const std::size_t first = state.find("end_header\n") + 11;
  state[first] = static_cast<char>(state[first] ^ 1);
  refused_with("state_000002.ply", state);
  std::string between = contents(folder + "/state_000002.ply");
  between.replace(between.find(" step 2 "), 8, " step 2.5 ");
  refused_with("state_000002.ply", between);
  const Outcome sound = run_program("advect --threads 2 --resume " + folder + "/state_000002.ply");
  EXPECT_EQ(sound.status, 0) << sound.err;
  EXPECT_EQ(run_program("advect --step 0.2 --resume " + folder + "/state_000002.ply").status, 2);
}

TEST(AdvectCommand, ErrorControlWritesAboutThirtyStatesAndResumes) {
  const Workspace workspace;
  const std::string straight = workspace.path("straight");
  const std::string resumed = workspace.path("resumed");
  const std::string options =
      "advect --sphere 50 --field 'expr:-y*exp(3*t);x;0' --step 0.001 --tolerance 1e-8 -o ";
  ASSERT_EQ(run_program(options + straight).status, 0);
  const Json files = Json::parse(contents(straight + "/states.ply.series"))["files"];
  EXPECT_GT(files.size(), 15U);
  EXPECT_LE(files.size(), 31U);
  std::filesystem::copy(straight, resumed);
  const std::string middle = files[files.size() / 2]["name"];
  const Outcome outcome = run_program("advect --resume " + resumed + "/" + middle);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* file : {"/states.ply.series", "/log.json"})
    EXPECT_EQ(contents(straight + file), contents(resumed + file)) << file;
}

TEST(AdvectCommand, RigidAndShearMotionTellTheirErrors) {
  const Workspace workspace;
  const std::string mesh = workspace.path("part.off");
  ASSERT_EQ(run_program("generate torus --triangles 600 -o " + mesh).status, 0);
  for (const char* field : {"rigid:0.3,0.2,3@0.1,0,0+1,0,0.5", "shear:2"}) {
    for (const char* preset : {"none", "balanced"}) {
      const std::string folder = workspace.path(std::string(field).substr(0, 5) + preset);
      const Outcome outcome = run_program("advect " + mesh + " --step 0.05 --until 0.5 --preset " + preset +
                                          " --field " + field + " -o " + folder);
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      const Json log = Json::parse(contents(folder + "/log.json"))["steps"];
      for (const Json& entry : log) {
        ASSERT_TRUE(entry.contains("error")) << field << " " << preset;
        EXPECT_LT(entry["error"]["max"].get<double>(), preset == std::string("none") ? 1e-4 : 0.05);
      }
    }
  }
}

TEST(AdvectCommand, DoesNotWriteOverARun) {
  const Workspace workspace;
  const std::string options = "advect --sphere 50 --step 0.1 --until 0.1 -o " + workspace.path("run");
  EXPECT_EQ(run_program(options).status, 0);
  EXPECT_EQ(run_program(options).status, 2);
}

TEST(AdvectCommand, AnInterruptedRunWritesItsStateAndGoesOnFromIt) {
  const Workspace workspace;
  const std::string folder = workspace.path("run");
  // Once the first state is there, steps begin.
  const Outcome outcome =
      run_program("advect --sphere 300 --step 0.001 --until 1000 --save-every 100000 -o " + folder +
                  " & pid=$!; until [ -e " + folder +
                  "/states.ply.series ]; do sleep 0.05; done; sleep 0.8; kill -INT $pid; wait $pid");
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("go on with --resume " + folder + "/state_"), std::string::npos) << outcome.err;
  const Json series = Json::parse(contents(folder + "/states.ply.series"))["files"];
  EXPECT_EQ(series.size(), 2U);
}

TEST(AdvectCommand, AnInterruptBeforeTheFirstStateLeavesNothing) {
  const Workspace workspace;
  const std::string folder = workspace.path("run");
  // Once the program is there and catches SIGINT, a bit of the lowest hexadecimal digit.
  const Outcome outcome = run_program("advect --sphere 12000 --exact -o " + folder +
                                      " & pid=$!; until grep -q isorelax /proc/$pid/comm && grep -q "
                                      "'SigCgt:.*[2367abef]$' /proc/$pid/status; do sleep 0.01; done; "
                                      "kill -INT $pid; wait $pid");
  EXPECT_EQ(outcome.status, 1);
  expect_one_error_line(outcome);
  EXPECT_NE(outcome.err.find("cancelled before anything was written"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder));
}

}  // namespace
}  // namespace isorelax::test
