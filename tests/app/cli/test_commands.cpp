#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/program.h"

namespace isorelax::test {
namespace {

using Json = nlohmann::json;

/// A tetrahedron with: 4 isolated; triangle 4 degenerate (vertex twice), 5 a copy of 1 turned over.
const char* const kFlawed =
    "OFF\n5 6 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n9 9 9\n"
    "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 1 1 2\n3 1 0 3\n";

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

TEST(QualityCommand, PrintsExactlyTheKeysOfTheContract) {
  const Workspace workspace;
  const Outcome outcome = run_program("quality --json " + workspace.write("t.off", kTriangle));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  const Json object = Json::parse(outcome.out);
  std::vector<std::string> expected = {
      "vertices",     "triangles",    "min_angle_deg",    "max_angle_deg",       "mean_min_angle_deg",
      "below_20_deg", "below_30_deg", "above_120_deg",    "area_max_over_min",   "area_std_over_mean",
      "shape_mean",   "shape_max",    "radius_ratio_min", "scaled_jacobian_min", "aspect_ratio_max",
      "inverted",     "degenerate"};
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(keys_of(object), expected);
  EXPECT_NEAR(object["min_angle_deg"].get<double>(), 45, 1e-12);
  EXPECT_NEAR(object["shape_max"].get<double>(), 2.3094010767585034, 1e-12);
}

TEST(RenderCommand, RefusesSizesAndFilesItCannotDraw) {
  const Workspace workspace;
  const std::string render = "render " + workspace.write("t.off", kTriangle) + " -o ";
  for (const std::string& rest :
       {workspace.path("a.jpg"), workspace.path("a.png") + " --size 1000000x1000000"})
    expect_refused(render + rest);
}

TEST(QualityCommand, ListsTheWorstTrianglesFirst) {
  const Workspace workspace;
  const std::string mesh = workspace.path("m.off");
  ASSERT_EQ(run_program("generate random --triangles 300 -o " + mesh).status, 0);
  const Json object = Json::parse(run_program("quality --json --worst 4 " + mesh).out);
  ASSERT_EQ(object["worst"].size(), 4U);
  EXPECT_EQ(object["worst"][0]["min_angle_deg"], object["min_angle_deg"]);
  for (int i = 1; i < 4; ++i) {
    EXPECT_LE(object["worst"][i - 1]["min_angle_deg"], object["worst"][i]["min_angle_deg"]);
  }
  const Outcome text = run_program("quality --worst 4 " + mesh);
  const std::string id = std::to_string(object["worst"][0]["triangle"].get<int>());
  EXPECT_NE(text.out.find("triangle " + id + " "), std::string::npos);
}

TEST(QualityCommand, WritesNullForInfinity) {
  const Workspace workspace;
  const Json object = Json::parse(run_program("quality --json " + workspace.write("f.off", kFlawed)).out);
  EXPECT_TRUE(object["shape_max"].is_null());
  EXPECT_EQ(object["degenerate"], 1);
  EXPECT_EQ(object["min_angle_deg"], 0);
}

TEST(QualityCommand, MeasuresShapeAndSizeAgainstAReference) {
  const Workspace workspace;
  const std::string mesh = workspace.write("t.off", kTriangle);
  const std::string large = workspace.write("l.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n");
  const auto measure = [&](const std::string& reference) {
    return Json::parse(run_program("quality --json " + mesh + " --reference " + reference).out);
  };
  EXPECT_NEAR(measure("initial")["shape_mean"].get<double>(), 2, 1e-12);
  EXPECT_NEAR(measure(large)["shape_max"].get<double>(), 2, 1e-12);
  EXPECT_NEAR(measure(large)["size_max"].get<double>(), 2.5, 1e-12);
  EXPECT_NEAR(measure("equilateral")["shape_max"].get<double>(), 2.3094010767585034, 1e-12);
  EXPECT_NEAR(measure("equilateral")["size_mean"].get<double>(), 2, 1e-12);
  const std::string other = workspace.write("f.off", kFlawed);
  EXPECT_EQ(run_program("quality " + mesh + " --reference " + other).status, 3);
  EXPECT_EQ(run_program("quality " + mesh + " --reference equilateral:-1").status, 2);
}

TEST(Errors, NameTheFileAtFault) {
  const Workspace workspace;
  const std::string large = workspace.path("large.off");
  const std::string small = workspace.path("small.off");
  ASSERT_EQ(run_program("generate random --triangles 100 -o " + large).status, 0);
  ASSERT_EQ(run_program("generate random --triangles 60 -o " + small).status, 0);
  const auto complaint = [](const std::string& arguments) {
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.status, 3) << arguments;
    return outcome.err;
  };
  for (const std::string& command :
       {"smooth " + large + " -o " + workspace.path("o.off"), "quality " + large})
    EXPECT_NE(complaint(command + " --reference " + small).find("error: " + small + ": has "),
              std::string::npos);
  const std::string picture = workspace.path("o.png");
  const std::string shown =
      complaint("render " + large + " --against " + small + " --difference -o " + picture);
  EXPECT_NE(shown.find(large + ": has other vertices"), std::string::npos) << shown;
  EXPECT_NE(shown.find(small), std::string::npos) << shown;
  const std::string flat = workspace.write("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  const std::string viewed = complaint("view " + flat + " --after-iterations 3 --screenshot " + picture);
  EXPECT_NE(viewed.find("error: " + flat + ": "), std::string::npos) << viewed;
}

TEST(GenerateCommand, HelpTellsTheLeastOfEachKind) {
  const Workspace workspace;
  const std::string help = run_program("generate --help").out;
  EXPECT_NE(help.find("a torus and a cylinder have at least 24 triangles"), std::string::npos);
  for (const auto& [kind, least] : {std::pair("torus", 24), std::pair("cylinder", 24), std::pair("cube", 12),
                                    std::pair("cone", 12), std::pair("part", 188)}) {
    const std::string mesh = workspace.path(std::string(kind) + ".off");
    const std::string made = "generate " + std::string(kind) + " --triangles 1 -o " + mesh;
    const Outcome outcome = run_program(made);
    EXPECT_NE(outcome.err.find(" " + std::to_string(least) + " triangles"), std::string::npos) << outcome.err;
  }
}

TEST(InfoCommand, NamesEveryFlawWithItsIds) {
  const Workspace workspace;
  const std::string mesh = workspace.write("f.off", kFlawed);
  const Outcome outcome = run_program("info --json " + mesh);
  EXPECT_EQ(outcome.status, 0);
  const Json object = Json::parse(outcome.out);
  EXPECT_EQ(object["isolated_vertices"], Json::parse("[4]"));
  EXPECT_EQ(object["degenerate_triangles"][0]["triangle"], 4);
  EXPECT_EQ(object["duplicate_triangles"], Json::parse(R"([{"triangle": 5, "same_as": 1}])"));
  EXPECT_FALSE(object["manifold"]);
  const Outcome text = run_program("info " + mesh);
  EXPECT_NE(text.out.find("5 (same as 1)"), std::string::npos) << text.out;
}

TEST(InfoCommand, TellsGenusBoundaryAndOrientation) {
  const Workspace workspace;
  const std::string mesh = workspace.path("part.ply");
  ASSERT_EQ(run_program("generate part -o " + mesh).status, 0);
  const Json part = Json::parse(run_program("info --json " + mesh).out);
  EXPECT_EQ(part["genus"], 1);
  EXPECT_EQ(part["closed"], true);
  EXPECT_EQ(part["oriented"], true);
  const Json square = Json::parse(run_program("info --json " + workspace.write("t.off", kTriangle)).out);
  EXPECT_EQ(square["boundary_loops"][0]["edges"], 3);
  EXPECT_EQ(square["closed"], false);
}

TEST(InfoCommand, NamesTrianglesThatCross) {
  const Workspace workspace;
  const std::string mesh =
      workspace.write("c.off", "OFF\n6 2 0\n0 0 0\n4 0 0\n0 4 0\n1 1 -1\n1 1 1\n9 9 0\n3 0 1 2\n3 3 4 5\n");
  EXPECT_EQ(Json::parse(run_program("info --json " + mesh).out)["crossing_triangles"],
            Json::array({Json::array({0, 1})}));
  const std::string text = run_program("info " + mesh).out;
  EXPECT_NE(text.find("crossing triangles     1: 0-1\n"), std::string::npos) << text;
}

TEST(InfoCommand, NamesWhatLiesUpsideDownAndGivesAFlatMeshNoOutside) {
  const Workspace workspace;
  // A square about its middle, which was thrown over a side.
  const std::string square = "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const std::string faces = "\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  const std::string sound = workspace.write("s.off", square + "0.5 0.5 0" + faces);
  const std::string thrown = workspace.write("t.off", square + "1.5 0.5 0" + faces);
  EXPECT_EQ(Json::parse(run_program("info --json " + sound).out)["inverted_triangles"], Json::array());
  EXPECT_EQ(Json::parse(run_program("info --json " + thrown).out)["inverted_triangles"], Json::array({1}));
  const std::string text = run_program("info " + thrown).out;
  EXPECT_NE(text.find("inverted triangles     1: 1\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("facing"), std::string::npos) << text;
}

TEST(InfoCommand, TellsAMeshThatFacesInward) {
  const Workspace workspace;
  const std::string corners = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string outward = workspace.write("o.off", corners + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  const std::string inward = workspace.write("i.off", corners + "3 0 1 2\n3 0 3 1\n3 1 3 2\n3 0 2 3\n");
  EXPECT_EQ(Json::parse(run_program("info --json " + outward).out)["faces_inward"], false);
  EXPECT_EQ(Json::parse(run_program("info --json " + inward).out)["faces_inward"], true);
  const Outcome text = run_program("info " + inward);
  EXPECT_NE(text.out.find("inward: the triangles show their backs"), std::string::npos) << text.out;
}

TEST(GenerateCommand, WritesTheSameBytesForTheSameSeed) {
  const Workspace workspace;
  for (const char* const name : {"a.off", "b.off"}) {
    const Outcome outcome =
        run_program("generate random --seed 5 --triangles 454 -o " + workspace.path(name));
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("454 triangles"), std::string::npos);
  }
  EXPECT_EQ(contents(workspace.path("a.off")), contents(workspace.path("b.off")));
  run_program("generate random --seed 6 --triangles 454 -o " + workspace.path("c.off"));
  EXPECT_NE(contents(workspace.path("a.off")), contents(workspace.path("c.off")));
}

TEST(GenerateCommand, IsSilentWhenQuiet) {
  const Workspace workspace;
  EXPECT_EQ(run_program("generate cube --quiet -o " + workspace.path("c.off")).err, "");
}

TEST(BenchmarkCommand, PutsThePapersTableBesideOurs) {
  const Workspace workspace;
  const std::string picture = workspace.path("figure.png");
  const std::string paper = "benchmark paper --triangles 100 200 300 --quiet";
  const Outcome outcome = run_program(paper + " --json --picture " + picture);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json object = Json::parse(outcome.out);
  EXPECT_GT(std::filesystem::file_size(picture), 10000U);
  EXPECT_GT(object["choices"].size(), 4U);
  ASSERT_EQ(object["meshes"].size(), 6U);
  EXPECT_EQ(object["meshes"][5]["triangles"], 300);
  std::vector<std::string> methods;
  for (const Json& row : object["rows"]) methods.push_back(row["method"]);
  EXPECT_EQ(methods, (std::vector<std::string>{"original", "laplacian", "angle_based", "cn", "cnea",
                                               "converged", "worst_element", "polished", "worst_polished"}));
  EXPECT_EQ(object["rows"][2]["paper_min_angle_deg"], Json::parse("[32.9, 30.9, 29.5, 3.9, null, null]"));
  for (std::size_t mesh = 3; mesh < 6; ++mesh) {
    const auto smallest = [&](std::size_t row) {
      return object["rows"][row]["min_angle_deg"][mesh].get<double>();
    };
    const auto largest = [&](std::size_t row) {
      return object["rows"][row]["max_angle_deg"][mesh].get<double>();
    };
    EXPECT_GT(smallest(5), smallest(0) + 5);
    EXPECT_GT(smallest(5), smallest(1));
    EXPECT_LT(largest(6), largest(1));
    EXPECT_GE(smallest(7), smallest(5));
    EXPECT_LE(largest(7), largest(5));
    EXPECT_GE(smallest(8), smallest(6));
    EXPECT_LE(largest(8), largest(6));
  }
  const Outcome text = run_program(paper);
  EXPECT_NE(text.out.find("(36.1)"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("(-)"), std::string::npos) << text.out;
  EXPECT_EQ(run_program("benchmark paper --triangles 100").status, 2);
}

TEST(Statuses, WrongUsageIsTwo) {
  const Workspace workspace;
  const std::string mesh = workspace.write("t.off", kTriangle);
  const std::vector<std::string> wrong = {
      "info",
      "nonsense",
      "info --bogus x.off",
      "quality " + mesh + " --worst -1",
      "quality " + mesh + " --worst many",
      "generate cube",
      "generate dodecahedron -o " + workspace.path("x.off"),
      "generate cube --jitter 2 -o " + workspace.path("x.off"),
      "generate sphere --vertices 3 -o " + workspace.path("x.off"),
      "generate cube --vertices 9 --triangles 9 -o " + workspace.path("x.off"),
      "generate cube -o " + workspace.path("x.unknown")};
  for (const std::string& arguments : wrong) expect_refused(arguments);
  EXPECT_FALSE(std::filesystem::exists(workspace.path("x.off")));
}

TEST(Statuses, ADashIsNoFile) {
  const Workspace workspace;
  const std::string mesh = workspace.write("t.off", kTriangle);
  const std::string out = workspace.path("o.off");
  for (const auto& [arguments, word] : {std::pair("info -", std::string(" -: ")),
                                        {"-", " -: "},
                                        {"smooth - -o x.off", " -: "},
                                        {"generate cube -o -", "-o -: "},
                                        {"generate cube -o-", "-o-: "}}) {
    const Outcome outcome = run_program(arguments);
    expect_refused(arguments);
    EXPECT_NE(outcome.err.find(word + "names no file"), std::string::npos) << outcome.err;
  }
  for (const char* option : {" --report -", " --report=-", " --trace -", " --pin -"})
    expect_refused("smooth " + mesh + " -o " + out + option);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Statuses, InputThatCannotBeReadIsThreeAndNamed) {
  const Workspace workspace;
  const std::string bad = workspace.write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n");
  for (const std::string& command : {std::string("info "), std::string("quality ")}) {
    for (const std::string& file : {workspace.path("missing.off"), workspace.path(""), bad}) {
      const Outcome outcome = run_program(command + file);
      EXPECT_EQ(outcome.status, 3) << file;
      expect_one_error_line(outcome);
      EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    }
    EXPECT_NE(run_program(command + bad).err.find("line 4"), std::string::npos);
  }
}

TEST(Statuses, OutputThatCannotBeWrittenIsFour) {
  const Workspace workspace;
  const Outcome outcome = run_program("generate cube -o " + workspace.path("no/such/folder.off"));
  EXPECT_EQ(outcome.status, 4);
  expect_one_error_line(outcome);
  const std::string mesh = workspace.write("t.off", kTriangle);
  EXPECT_EQ(run_program("info " + mesh + " > /dev/full").status, 4);
  EXPECT_EQ(run_program("--help > /dev/full").status, 4);
}

TEST(ViewCommand, SaysThatAFileIsMissingBeforeItAsksForADisplay) {
  const Outcome outcome = run_program("view no/such/mesh.off");
  EXPECT_EQ(outcome.status, 3);
  expect_one_error_line(outcome);
}

TEST(ViewCommand, RefusesIterationsWithoutAScreenshot) {
  const Workspace workspace;
  const std::string mesh = workspace.write("t.off", kTriangle);
  expect_refused("view " + mesh + " --after-iterations 50");
}

TEST(TraceCommand, ShowsExportsComparesAndReplaysARun) {
  const Workspace workspace;
  const std::string in = workspace.path("in.off");
  const std::string trace = workspace.path("run.trace");
  ASSERT_EQ(run_program("generate random --triangles 200 -o " + in).status, 0);
  const std::string smooth = "smooth " + in + " --quiet --mu 0.25 -o " + workspace.path("o");
  ASSERT_EQ(run_program(smooth + ".off --iterations 12 --trace " + trace).status, 0);
  ASSERT_EQ(run_program(smooth + "2.off --iterations 5 --trace " + workspace.path("short.trace")).status, 0);

  const Outcome shown = run_program("trace show " + trace);
  EXPECT_EQ(shown.status, 0);
  EXPECT_NE(shown.out.find("--mu 0.25"), std::string::npos) << shown.out;
  EXPECT_EQ(Json::parse(run_program("trace show --json " + trace).out)["iterations"].size(), 12U);
  EXPECT_EQ(run_program("trace replay " + trace).status, 0);
  EXPECT_EQ(run_program("trace diff " + trace + " " + trace).status, 0);
  const Outcome differs = run_program("trace diff --json " + trace + " " + workspace.path("short.trace"));
  EXPECT_EQ(differs.status, 1);
  EXPECT_EQ(Json::parse(differs.out)["common_iterations"], 5);
  EXPECT_TRUE(Json::parse(differs.out)["parting"].is_null());
  // So does compare, with a limit and a page.
  EXPECT_EQ(run_program("compare " + trace + " " + trace).status, 0);
  const std::string page = workspace.path("page.html");
  const Outcome shorter =
      run_program("compare --json " + trace + " " + workspace.path("short.trace") + " --report " + page);
  EXPECT_EQ(shorter.status, 1);
  EXPECT_EQ(Json::parse(shorter.out)["common_iterations"], 5);
  EXPECT_NE(contents(page).find("one run has more iterations"), std::string::npos);
  EXPECT_EQ(run_program("compare " + trace + " " + in).status, 2);
  ASSERT_EQ(run_program("smooth " + in + " --quiet -o " + workspace.path("o3.off") +
                        " --mu 0.5 --iterations 12 --trace " + workspace.path("other.trace"))
                .status,
            0);
  const std::string parted = "compare " + trace + " " + workspace.path("other.trace");
  EXPECT_EQ(run_program(parted).status, 1);
  EXPECT_NE(run_program(parted).out.find("part at iteration 2"), std::string::npos);
  EXPECT_EQ(run_program(parted + " --max-displacement 1").status, 0);

  const std::string exported = "trace export " + trace + " --iterations every:5 ";
  EXPECT_EQ(run_program(exported + "--csv " + workspace.path("t.csv") + " --vtk " + workspace.path("v") +
                        " --meshes " + workspace.path("m"))
                .status,
            0);
  EXPECT_EQ(run_program("quality --json " + workspace.path("m/iteration_00012.off")).out,
            run_program("quality --json " + workspace.path("o.off")).out);
  EXPECT_TRUE(std::filesystem::exists(workspace.path("v/trace.pvd")));
  EXPECT_EQ(run_program("trace export " + trace).status, 2);
}

TEST(TraceCommand, RefusesWhatIsNoTraceAndWhatHasChangedSince) {
  const Workspace workspace;
  const std::string in = workspace.write("t.off", kTriangle);
  const Outcome foreign = run_program("trace show " + in);
  EXPECT_EQ(foreign.status, 3);
  expect_one_error_line(foreign);
  const std::string trace = workspace.path("run.trace");
  ASSERT_EQ(run_program("generate random --triangles 100 -o " + workspace.path("in.off")).status, 0);
  const std::string pins = workspace.write("pins.txt", "40\n");
  ASSERT_EQ(run_program("smooth " + workspace.path("in.off") + " -o " + workspace.path("o.off") + " --pin " +
                        pins + " --trace " + trace)
                .status,
            0);
  EXPECT_EQ(run_program("trace replay " + trace).status, 0);
  (void)workspace.write("pins.txt", "41\n");
  const Outcome changed = run_program("trace replay " + trace);
  EXPECT_EQ(changed.status, 3);
  expect_one_error_line(changed);
}

TEST(Help, OfEveryCommandHasAnExample) {
  const Outcome all = run_program("--help");
  EXPECT_EQ(all.status, 0);
  for (const std::string& name : std::vector<std::string>{"info", "quality", "smooth", "render", "generate",
                                                          "benchmark", "trace", "view"}) {
    EXPECT_NE(all.out.find(name), std::string::npos);
    const Outcome one = run_program(name + " --help");
    EXPECT_EQ(one.status, 0);
    EXPECT_EQ(one.err, "");
    EXPECT_NE(one.out.find("Usage: isorelax " + name), std::string::npos) << one.out;
    EXPECT_NE(one.out.find("  isorelax " + name + " "), std::string::npos) << one.out;
  }
}

TEST(Help, OfAPartOfTraceIsAboutThatPart) {
  for (const std::string name : {"show", "export", "diff", "replay"}) {
    const Outcome help = run_program("trace " + name + " --help");
    EXPECT_EQ(help.status, 0);
    EXPECT_NE(help.out.find("  isorelax trace " + name + " "), std::string::npos) << help.out;
    EXPECT_EQ(help.out.find("min_angle"), std::string::npos) << help.out;
    EXPECT_EQ(help.out.find("--break"), std::string::npos) << help.out;
  }
  EXPECT_NE(run_program("trace --help").out.find("min_angle"), std::string::npos);
}

TEST(Help, VersionNamesTheProgram) {
  const Outcome outcome = run_program("--version");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out.rfind("isorelax ", 0), 0U);
}

}  // namespace
}  // namespace isorelax::test
