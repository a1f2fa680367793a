#include <gtest/gtest.h>

#include <cmath>

#include "compare/mesh_case.h"
#include "mesh/error.h"

namespace isorelax::compare {
namespace {

/// The square [0, side]^2 at a height, in cells x cells squares of two triangles.
TriangleMesh plate(Index cells, double side = 1, double height = 0) {
  TriangleMesh mesh;
  for (Index y = 0; y <= cells; ++y)
    for (Index x = 0; x <= cells; ++x)
      mesh.positions.emplace_back(side * x / cells, side * y / cells, height);
  for (Index y = 0; y < cells; ++y)
    for (Index x = 0; x < cells; ++x) {
      const Index v = y * (cells + 1) + x;
      mesh.triangles.push_back({v, v + 1, v + cells + 2});
      mesh.triangles.push_back({v, v + cells + 2, v + cells + 1});
    }
  return mesh;
}

double figure(const Case& one, const std::string& key) {
  for (const Figure& f : one.figures)
    if (f.key == key) return f.value;
  ADD_FAILURE() << "no figure " << key;
  return std::nan("");
}

TEST(MeshCase, equal_meshes_pass) {
  const TriangleMesh mesh = plate(4);
  const Case one = compare_meshes({"a.off", &mesh}, {"b.off", &mesh}, {});
  EXPECT_TRUE(one.passes());
  EXPECT_EQ(figure(one, "moved"), 0);
  EXPECT_EQ(figure(one, "fixed"), 25);
  EXPECT_EQ(figure(one, "displacement_max"), 0);
}

TEST(MeshCase, a_vertex_that_moved_is_found_and_measured) {
  const TriangleMesh a = plate(4);
  TriangleMesh b = a;
  b.positions[12] += Vec3(0, 0, 0.1);
  b.positions[7] += Vec3(0.05, 0, 0);
  const Case one = compare_meshes({"a.off", &a}, {"b.off", &b}, {});
  EXPECT_FALSE(one.passes());
  const double diagonal = std::sqrt(2.0);
  EXPECT_NEAR(figure(one, "displacement_max"), 0.1 / diagonal, 1e-12);
  EXPECT_NEAR(figure(one, "displacement_rms"), std::sqrt((0.01 + 0.0025) / 25) / diagonal, 1e-12);
  EXPECT_EQ(figure(one, "displacement_max_vertex"), 12);
  EXPECT_EQ(figure(one, "moved"), 2);
  EXPECT_EQ(figure(one, "fixed"), 23);
  EXPECT_NEAR(figure(one, "deviation_b_to_a"), 0.1 / diagonal, 1e-12);
  EXPECT_GT(figure(one, "deviation_a_to_b"), 0.02);
  EXPECT_NE(one.notes.at(0).find("Vertex 12 moved farthest: from (0.5, 0.5, 0) to (0.5, 0.5, 0.1)"),
            std::string::npos)
      << one.notes.at(0);
  EXPECT_TRUE(compare_meshes({"a.off", &a}, {"b.off", &b}, {0.2, 0.2}).passes());
  EXPECT_FALSE(compare_meshes({"a.off", &a}, {"b.off", &b}, {0.2, 0.01}).passes());
}

TEST(MeshCase, quality_of_both_stands_beside_each_other) {
  const TriangleMesh a = plate(2);
  TriangleMesh b = a;
  b.positions[4] += Vec3(0.2, 0, 0);
  const Case one = compare_meshes({"a.off", &a}, {"b.off", &b}, {});
  for (const Figure& f : one.figures)
    if (f.key == "min_angle_deg") {
      EXPECT_NEAR(f.value, 45, 1e-9);
      ASSERT_TRUE(f.other);
      EXPECT_LT(*f.other, 40);
    }
}

TEST(MeshCase, other_triangles_are_compared_as_surfaces) {
  const TriangleMesh a = plate(3);
  const TriangleMesh b = plate(5);
  EXPECT_TRUE(compare_meshes({"a", &a}, {"b", &b}, {}).passes()) << "one plate, cut in two ways";
  const TriangleMesh larger = plate(5, 1.5);
  const Case one = compare_meshes({"a", &a}, {"b", &larger}, {});
  EXPECT_FALSE(one.passes());
  EXPECT_NEAR(figure(one, "hausdorff_a_to_b"), 0, 1e-12);
  EXPECT_NEAR(figure(one, "hausdorff_b_to_a"), 0.5 * std::sqrt(2.0) / std::sqrt(2.0), 1e-12);
}

TEST(MeshCase, the_page_has_pictures_of_both_and_of_what_is_between_them) {
  const TriangleMesh a = plate(4);
  TriangleMesh b = a;
  b.positions[12] += Vec3(0.1, 0, 0);
  MeshPictures how;
  how.view.size = {160, 120};
  Case moved = compare_meshes({"a.off", &a}, {"b.off", &b}, {});
  add_pictures({"a.off", &a}, {"b.off", &b}, how, moved);
  ASSERT_EQ(moved.pictures.size(), 3U);
  EXPECT_NE(moved.pictures[0].png, moved.pictures[1].png);
  EXPECT_NE(moved.view_a.find("a.off"), std::string::npos);
  // One camera: the views differ in their mesh alone.
  view::View view_a = view::parse_view(moved.view_a, "a");
  view_a.meshes = {"b.off"};
  EXPECT_EQ(view_a, view::parse_view(moved.view_b, "b"));
  const TriangleMesh other = plate(3);
  Case surfaces = compare_meshes({"a.off", &a}, {"c.off", &other}, {});
  add_pictures({"a.off", &a}, {"c.off", &other}, how, surfaces);
  EXPECT_EQ(surfaces.pictures.size(), 3U);
}

TEST(MeshCase, a_mesh_without_triangles_is_refused_by_name) {
  const TriangleMesh mesh = plate(2);
  const TriangleMesh nothing;
  try {
    (void)compare_meshes({"a.off", &mesh}, {"nothing.off", &nothing}, {});
    FAIL();
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find("nothing.off"), std::string::npos);
  }
}

}  // namespace
}  // namespace isorelax::compare
