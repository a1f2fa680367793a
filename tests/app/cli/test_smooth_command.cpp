#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/cli/program.h"

namespace isorelax::test {
namespace {

using Json = nlohmann::json;

TEST(SmoothCommand, RefusesNumbersThatAreNoNumbers) {
  const Workspace workspace;
  const std::string smooth =
      "smooth " + workspace.write("t.off", kTriangle) + " -o " + workspace.path("o.off");
  for (const char* option :
       {" --mu nan", " --tolerance nan", " --tolerance inf", " --relaxation nan", " --max-deviation nan",
        " --max-deviation -1", " --iterations -3", " --iterations 5000000000", " --max-deviation far"}) {
    const Outcome outcome = run_program(smooth + option);
    EXPECT_EQ(outcome.status, 2) << option;
    expect_one_error_line(outcome);
    EXPECT_LT(outcome.err.size(), 160U) << outcome.err;
  }
  const Outcome word = run_program(smooth + " --max-deviation nan");
  EXPECT_NE(word.err.find("inf, nearest or widest"), std::string::npos) << word.err;
  const Outcome few = run_program(smooth + " --iterations -3");
  EXPECT_NE(few.err.find("-3 is not a whole number from 0 to"), std::string::npos) << few.err;
  for (const char* limit : {"inf", "nearest", "widest"})
    EXPECT_EQ(run_program(smooth + " --max-deviation " + limit).status, 0) << limit;
}

TEST(SmoothCommand, RefusesOptionsWithoutEffect) {
  const Workspace workspace;
  const std::string smooth =
      "smooth " + workspace.write("t.off", kTriangle) + " -o " + workspace.path("o.off");
  for (const char* options :
       {" --every 2", " --view iso", " --polish-mean-loss 1", " --polish mean --polish-mean-loss 1",
        " --polish worst --polish-worst-share 0.2", " --relaxation 0.5", " --solver newton --relaxation 0.5"})
    expect_refused(smooth + options);
  const Outcome by_default = run_program(smooth + " --relaxation 0.5");
  EXPECT_NE(by_default.err.find("--solver auto"), std::string::npos) << by_default.err;
  EXPECT_EQ(run_program(smooth + " --solver jacobi --relaxation 0.5").status, 0);
  EXPECT_EQ(run_program(smooth + " --polish both --polish-mean-loss 1 --polish-worst-share 0.2").status, 0);
}

TEST(SmoothCommand, WritesNothingWhenAnUnguardedMethodTurnedTrianglesOver) {
  const Workspace workspace;
  // An arrow whose corners have their mean beyond its notch.
  const std::string arrow = workspace.write("arrow.off",
                                            "OFF\n5 4 0\n0 1.8 0\n0 1.5 0\n3 -3 0\n0 2 0\n-3 -3 0\n"
                                            "3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 1\n");
  const std::string smooth = "smooth " + arrow + " --method laplacian --iterations 5 -o ";
  const Outcome unguarded = run_program(smooth + workspace.path("folded.off") + " --guard off");
  EXPECT_EQ(unguarded.status, 1);
  expect_one_error_line(unguarded);
  EXPECT_NE(unguarded.err.find("2 triangles were turned over"), std::string::npos) << unguarded.err;
  EXPECT_FALSE(std::filesystem::exists(workspace.path("folded.off")));
  EXPECT_EQ(run_program(smooth + workspace.path("kept.off")).status, 0);
  const Outcome quality = run_program("quality --json " + workspace.path("kept.off"));
  EXPECT_EQ(nlohmann::json::parse(quality.out)["inverted"], 0);
}

TEST(SmoothCommand, WritesNothingWhenVerticesRanAway) {
  const Workspace workspace;
  const std::string square = workspace.path("square.off");
  ASSERT_EQ(run_program("generate random --triangles 200 -o " + square).status, 0);
  const std::string out = workspace.path("o.off");
  const Outcome outcome =
      run_program("smooth " + square + " -o " + out +
                  " --method laplacian --relaxation 2 --guard off --report " + workspace.path("r.json"));
  EXPECT_EQ(outcome.status, 1);
  expect_one_error_line(outcome);
  EXPECT_NE(outcome.err.find("without a guard vertex "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(" ran away"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_EQ(Json::parse(contents(workspace.path("r.json")))["stopped"], "diverged");
}

TEST(SmoothCommand, RefusesOptionsThatAMethodDoesNotHave) {
  const Workspace workspace;
  const std::string smooth =
      "smooth " + workspace.write("t.off", kTriangle) + " -o " + workspace.path("o.off");
  for (const char* options :
       {" --method newton", " --guard off", " --weighting plain", " --method laplacian --weighting plain",
        " --method angle-based --weighting length", " --method laplacian --guard maybe",
        " --method laplacian --mu 1", " --method angle-based --solver newton"})
    expect_refused(smooth + options);
}

TEST(SmoothCommand, LeavesTextFilesText) {
  const Workspace workspace;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 0.1 0\n3 0 1 2\n";
  const std::string copy = workspace.path("copy.ply");
  const std::string back = workspace.path("back.stl");
  ASSERT_EQ(run_program("smooth --iterations 0 " + workspace.write("t.ply", ply) + " -o " + copy).status, 0);
  EXPECT_EQ(contents(copy), ply);
  const std::string stl = workspace.write(
      "t.stl",
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0.1 0\nendloop\n"
      "endfacet\nendsolid\n");
  ASSERT_EQ(run_program("smooth --iterations 0 " + stl + " -o " + back).status, 0);
  EXPECT_NE(contents(back).find("vertex 0 0.1 0"), std::string::npos) << contents(back);
}

TEST(SmoothCommand, NamesTheLineOfAVertexThatCannotBePinned) {
  const Workspace workspace;
  const std::string pins = workspace.write("pins.txt", "0\n7\n");
  const Outcome outcome = run_program("smooth " + workspace.write("t.off", kTriangle) + " -o " +
                                      workspace.path("o.off") + " --pin " + pins);
  EXPECT_EQ(outcome.status, 3);
  expect_one_error_line(outcome);
  EXPECT_NE(outcome.err.find(pins + ": line 2: names vertex 7"), std::string::npos) << outcome.err;
}

TEST(SmoothCommand, PolishesWhatItIsAskedTo) {
  const Workspace workspace;
  const std::string square = workspace.path("square.off");
  ASSERT_EQ(run_program("generate random --triangles 200 -o " + square).status, 0);
  const std::string smooth = "smooth " + square + " -o " + workspace.path("o.off") + " --polish ";
  std::vector<std::string> results;
  for (const char* words : {"none", "worst", "mean", "both", "mean --polish-worst-share 0"}) {
    const Outcome outcome = run_program(smooth + words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    results.push_back(contents(workspace.path("o.off")));
    EXPECT_EQ(std::count(results.begin(), results.end(), results.back()), 1) << words;
  }
  const Outcome wrong = run_program(smooth + "neither");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("expected worst, mean, both or none"), std::string::npos) << wrong.err;
}

TEST(SmoothCommand, PinsByPredicate) {
  const Workspace workspace;
  const std::string square = workspace.path("square.off");
  ASSERT_EQ(run_program("generate random --triangles 200 -o " + square).status, 0);
  const std::string smooth =
      "smooth " + square + " --boundary free --iterations 3 -o " + workspace.path("o.off") + " --pin ";
  const Outcome all = run_program(smooth + "box:-inf,-inf,-inf:inf,inf,inf");
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_EQ(contents(workspace.path("o.off")), contents(square));
  const Outcome some = run_program(smooth + "boundary --pin box:0.6,0.4,1:0.4,0.6,-1");
  EXPECT_EQ(some.status, 0) << some.err;
  EXPECT_NE(some.err.find("--pin boundary holds "), std::string::npos) << some.err;
  EXPECT_NE(contents(workspace.path("o.off")), contents(square));
  for (const char* wrong : {"box:", "box:1,2,3", "box:1,2:3,4", "box:a,0,0:1,1,1", "box:0,0,nan:1,1,1"})
    expect_refused(smooth + wrong);
  // One word each, wherever the mesh stands.
  EXPECT_EQ(run_program("smooth --pin feature " + square + " -o " + workspace.path("o.off")).status, 0);
  EXPECT_NE(run_program("smooth --help").out.find("--pin WHICH  "), std::string::npos);
  const Outcome missing = run_program(smooth + workspace.path("none.txt"));
  EXPECT_EQ(missing.status, 3);
  expect_one_error_line(missing);
}

TEST(SmoothCommand, NamesWhatIsWrongInASizeField) {
  const Workspace workspace;
  const std::string smooth = "smooth " + workspace.write("t.off", kTriangle) + " -o " +
                             workspace.path("o.off") + " --mu 0.5 --size-field ";
  EXPECT_EQ(run_program(smooth + workspace.write("good.txt", "1 # one\n2, 3\n")).status, 0);
  EXPECT_EQ(run_program(smooth + "curvature").status, 0);
  for (const auto& [text, place] : std::vector<std::pair<std::string, std::string>>{
           {"1\n2\n", "holds 2 values"},
           {"1\n2\n3\n4\n", "line 4"},
           {"1\n-2\n3\n", "line 2: expected a positive edge length, found \"-2\""},
           {"1\n2\nnan\n", "line 3"}}) {
    const Outcome outcome = run_program(smooth + workspace.write("bad.txt", text));
    EXPECT_EQ(outcome.status, 3);
    expect_one_error_line(outcome);
    EXPECT_NE(outcome.err.find("bad.txt: " + place), std::string::npos) << outcome.err;
  }
}

TEST(SmoothCommand, MakesStoredNormalsFitAgain) {
  const Workspace workspace;
  const std::string mesh =
      workspace.write("n.off",
                      "NOFF\n5 4 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n0.8 0.7 0.3 1 0 0\n"
                      "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n");
  const std::string out = workspace.path("o.off");
  const Outcome outcome =
      run_program("smooth " + mesh + " -o " + out + " --surface tangent --max-deviation inf --features none");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("5 stored normals"), std::string::npos) << outcome.err;
  EXPECT_EQ(contents(out).find(" 1 0 0\n"), std::string::npos) << contents(out);
}

TEST(SmoothCommand, UntanglesAndSaysSo) {
  const Workspace workspace;
  const std::string tangled = workspace.path("tangled.off");
  const std::string report = workspace.path("report.json");
  ASSERT_EQ(run_program("generate random --triangles 300 --tangle 0.2 -o " + tangled).status, 0);
  const std::string smooth = "smooth " + tangled + " -o " + workspace.path("o.off") + " --report " + report;
  const Outcome outcome = run_program(smooth);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("none is left"), std::string::npos) << outcome.err;
  const nlohmann::json untangled = nlohmann::json::parse(contents(report));
  EXPECT_GT(untangled["before"]["inverted"], 0);
  EXPECT_EQ(untangled["after"]["inverted"], 0);
  EXPECT_EQ(untangled["untangled"]["inverted_before"], untangled["before"]["inverted"]);
  EXPECT_EQ(run_program(smooth + " --untangle off").status, 0);
  EXPECT_EQ(nlohmann::json::parse(contents(report))["after"]["inverted"], untangled["before"]["inverted"]);
  const Outcome wrong = run_program(smooth + " --untangle maybe");
  EXPECT_EQ(wrong.status, 2);
  expect_one_error_line(wrong);
}

TEST(SmoothCommand, FindsOutBeforeTheWorkThatItCannotWrite) {
  const Workspace workspace;
  const std::string mesh = workspace.write("t.off", kTriangle);
  const Outcome no_folder = run_program("smooth " + mesh + " -o " + workspace.path("none/o.off"));
  EXPECT_EQ(no_folder.status, 4);
  expect_one_error_line(no_folder);
  const Outcome no_report = run_program("smooth " + mesh + " -o " + workspace.path("o.off") + " --report " +
                                        workspace.path("none/r.json"));
  EXPECT_EQ(no_report.status, 4);
  expect_one_error_line(no_report);
  EXPECT_EQ(contents(workspace.path("o.off")), "");
  for (const std::string& command : {"smooth " + mesh, std::string("generate cube")}) {
    const Outcome folder = run_program(command + " -o " + workspace.path(""));
    EXPECT_EQ(folder.status, 4);
    expect_one_error_line(folder);
    EXPECT_NE(folder.err.find("is a folder"), std::string::npos) << folder.err;
  }
}

TEST(SmoothCommand, CountsOneIterationAsOne) {
  const Workspace workspace;
  const std::string square = workspace.path("square.off");
  ASSERT_EQ(run_program("generate random --triangles 100 -o " + square).status, 0);
  const Outcome one = run_program("smooth " + square + " -o " + workspace.path("o.off") + " --iterations 1");
  EXPECT_NE(one.err.find("stopped after 1 iteration: "), std::string::npos) << one.err;
}

TEST(SmoothCommand, ReplacesNothingThatItReadsOrWrites) {
  const Workspace workspace;
  const std::string in = workspace.path("in.off"), out = workspace.path("out.off");
  ASSERT_EQ(run_program("generate random --triangles 100 -o " + in).status, 0);
  const std::string mesh = contents(in);
  std::filesystem::create_symlink("in.off", workspace.path("link.off"));
  const std::string smooth = "smooth " + in + " -o " + out;
  const std::string twice = workspace.path("a.json");
  for (const std::string& wrong :
       {smooth + " --report " + in, smooth + " --trace " + workspace.path("link.off"),
        smooth + " --report " + out, smooth + " --report " + twice + " --trace " + twice,
        "smooth " + in + " -o " + workspace.path("r.off") + " --reference " + workspace.path("link.off") +
            " --trace " + workspace.path("r.off"),
        "compare " + in + " " + in + " --report " + in, "render " + in + " -o a.png --save-view " + in})
    expect_refused(wrong);
  EXPECT_EQ(contents(in), mesh);
  EXPECT_FALSE(std::filesystem::exists(out));
  // The mesh itself may be replaced.
  EXPECT_EQ(run_program("smooth " + in + " --quiet -o " + in).status, 0);
  EXPECT_NE(contents(in), mesh);
}

TEST(SmoothCommand, TellsThatARunWasDoneAgain) {
  const Workspace workspace;
  const std::string in = workspace.path("in.off"), report = workspace.path("r.json");
  ASSERT_EQ(run_program("generate part --triangles 4000 --seed 3 -o " + in).status, 0);
  const Outcome outcome = run_program("smooth " + in + " --log 'iteration == 1' --report " + report + " -o " +
                                      workspace.path("out.off"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json object = Json::parse(contents(report));
  ASSERT_EQ(object["attempts"], 2);
  EXPECT_EQ(object["exponent"], 2);
  EXPECT_GT(object["seconds"], 0);
  EXPECT_NE(outcome.err.find("done again from the start"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("done again with"), std::string::npos) << outcome.err;
  const Outcome broken =
      run_program("smooth " + in + " --break 'iteration == 1' -o " + workspace.path("broken.off"));
  EXPECT_NE(broken.err.find("ended early"), std::string::npos) << broken.err;
}

TEST(SmoothCommand, LeavesNothingBehindWhereTheResultDoesNotFit) {
  const Workspace workspace;
  ASSERT_EQ(run_program("generate random --triangles 2000 -o " + workspace.path("in.off")).status, 0);
  const std::string smooth = "smooth " + workspace.path("in.off") + " -o " + workspace.path("sub/out.off");
  std::filesystem::create_directory(workspace.path("sub"));
  const Outcome outcome = run_program("--version; ulimit -f 8; " + quoted_program() + smooth + " --quiet");
  EXPECT_EQ(outcome.status, 4);
  EXPECT_TRUE(std::filesystem::is_empty(workspace.path("sub")));
}

TEST(SmoothCommand, StopsAndTellsWherePredicatesHold) {
  const Workspace workspace;
  const std::string in = workspace.path("in.off");
  ASSERT_EQ(run_program("generate random --triangles 200 -o " + in).status, 0);
  const std::string smooth = "smooth " + in + " -o " + workspace.path("o.off");
  const Outcome stopped = run_program(smooth + " --break 'iteration == 3' --log 'iteration == 2 || stop'");
  EXPECT_EQ(stopped.status, 0);
  EXPECT_NE(stopped.err.find("iteration 2: "), std::string::npos) << stopped.err;
  EXPECT_NE(stopped.err.find("stopped because iteration == 3"), std::string::npos) << stopped.err;
  const std::string trace = workspace.path("run.trace"), report = workspace.path("r.json");
  for (const char* words : {"", " --iterations 2 --polish worst"}) {
    const Outcome recorded = run_program(smooth + " --break 'iteration == 3'" + words + " --trace " + trace +
                                         " --report " + report);
    EXPECT_EQ(recorded.status, 0) << recorded.err;
    const Json object = Json::parse(contents(report));
    const Json& ended = object.contains("polish") ? object["polish"] : object;
    EXPECT_EQ(ended["stopped"], "breakpoint") << words;
    EXPECT_EQ(ended["stopped_because"], "breakpoint: iteration == 3") << words;
    const Outcome shown = run_program("trace show " + trace);
    EXPECT_NE(shown.out.find("breakpoint: iteration == 3"), std::string::npos) << shown.out;
  }
  const Outcome ended = run_program(smooth + " --iterations 4 --tolerance 0 --log stop");
  EXPECT_NE(ended.err.find("iteration 4: "), std::string::npos) << ended.err;
  const Outcome mistaken = run_program(smooth + " --break 'min_angle < '");
  EXPECT_EQ(mistaken.status, 2);
  EXPECT_NE(mistaken.err.find("column 13"), std::string::npos) << mistaken.err;
  expect_refused(smooth + " --break 'vertex(99999).alpha < 1'");
  expect_refused(smooth + " --log 'triangle(99999).area < 1'");
}

}  // namespace
}  // namespace isorelax::test
