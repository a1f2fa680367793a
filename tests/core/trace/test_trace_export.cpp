#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/temporary_mesh.h"
#include "core/trace/recorded.h"
#include "io/mesh_file.h"
#include "mesh/error.h"
#include "trace/trace_export.h"

namespace isorelax::test {
namespace {

TEST(TraceExport, CsvHasALinePerIterationAndAsManyColumnsInEach) {
  const Recorded recorded = record(5);
  std::istringstream csv(trace_csv(recorded.trace));
  std::string line;
  std::vector<std::string> lines;
  while (std::getline(csv, line)) lines.push_back(line);
  ASSERT_EQ(lines.size(), 7U);
  for (const std::string& one : lines)
    EXPECT_EQ(std::ranges::count(one, ','), std::ranges::count(lines.front(), ',')) << one;
  EXPECT_EQ(lines.front().rfind("iteration,energy_before,", 0), 0U);
  EXPECT_EQ(lines[1].rfind("0,,", 0), 0U) << "no step led to the start: " << lines[1];
  EXPECT_EQ(lines[1].back(), ',') << lines[1];
  EXPECT_EQ(lines[6].rfind("5,", 0), 0U);
}

TEST(TraceExport, JsonHoldsTheNumbersToTheBit) {
  const Recorded recorded = record(5);
  const auto json = nlohmann::json::parse(trace_json(recorded.trace));
  ASSERT_EQ(json["iterations"].size(), 5U);
  EXPECT_EQ(json["iterations"][2]["energy"].get<double>(), recorded.trace.iterations[2].after.energy);
}

TEST(TraceExport, MeshesAreThoseOfTheRun) {
  const Recorded recorded = record(5);
  const TemporaryFolder folder;
  const auto files = export_meshes(recorded.trace, {0, 5, 2}, folder.path(), ".off");
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(read_mesh(files[0]).mesh.positions, recorded.positions[0]);
  EXPECT_EQ(read_mesh(files[1]).mesh.positions, recorded.positions[5]);
  EXPECT_EQ(read_mesh(files[2]).mesh.positions, recorded.positions[2]);
  EXPECT_THROW((void)export_meshes(recorded.trace, {6}, folder.path(), ".off"), Error);
}

TEST(TraceExport, VtkSeriesNamesEveryFileInItsIndex) {
  const Recorded recorded = record(3);
  const TemporaryFolder folder;
  const auto files = export_vtk_series(recorded.trace, {0, 3}, folder.path());
  ASSERT_EQ(files.size(), 3U);
  std::ostringstream index;
  index << std::ifstream(files.back()).rdbuf();
  EXPECT_NE(index.str().find("timestep=\"3\" file=\"iteration_00003.vtp\""), std::string::npos);
  std::ostringstream mesh;
  mesh << std::ifstream(files[1]).rdbuf();
  EXPECT_NE(mesh.str().find("NumberOfPoints=\"" + std::to_string(recorded.mesh.vertex_count()) + "\""),
            std::string::npos);
}

}  // namespace
}  // namespace isorelax::test
