#include <gtest/gtest.h>

#include <cmath>

#include "energy/reference.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

const std::vector<Vec3> kPoints = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 3, 0}, {1, 0, 0}};
const std::vector<Triangle> kTwo = {{0, 1, 2}, {0, 2, 3}};

TEST(ReferenceMesh, MeanAreaIsTheMeanOfTheTriangles) {
  const ReferenceMesh r = ReferenceMesh::equilateral_mean_area(kPoints, kTwo);
  EXPECT_TRUE(r.is_equilateral());
  EXPECT_DOUBLE_EQ(r.d1(0), (2.0 + 6.0) / 2);
  EXPECT_DOUBLE_EQ(r[1].cot[2], kEquilateralCot);
}

TEST(ReferenceMesh, EdgeLengthGivesTheAreaOfThatEquilateralTriangle) {
  EXPECT_DOUBLE_EQ(ReferenceMesh::equilateral_edge(2, 7).d1(6), 2 * std::sqrt(3.0));
  EXPECT_THROW(ReferenceMesh::equilateral_edge(0, 7), UsageError);
  EXPECT_THROW(ReferenceMesh::equilateral_edge(NAN, 7), UsageError);
}

TEST(ReferenceMesh, OfAMeshKeepsAnglesAndAreas) {
  const ReferenceMesh r = ReferenceMesh::of_mesh(kPoints, kTwo);
  EXPECT_FALSE(r.is_equilateral());
  EXPECT_DOUBLE_EQ(r.d1(0), 2);
  EXPECT_DOUBLE_EQ(r[0].cot[0], 2);    // angle at (0,0) of (0,0), (2,0), (2,1)
  EXPECT_NEAR(r[0].cot[1], 0, 1e-15);  // right angle
  EXPECT_DOUBLE_EQ(r[0].cot[2], 0.5);
}

TEST(ReferenceMesh, ATriangleAtRoundingErrorIsReplacedToo) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-18, 0}, {0, 1, 0}};
  const ReferenceMesh r = ReferenceMesh::of_mesh(points, std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}});
  ASSERT_EQ(r.replaced().size(), 1U);
  EXPECT_EQ(r.replaced()[0], 0U);
}

TEST(ReferenceMesh, DegenerateTriangleIsReplacedAndNamed) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 4, 1}};
  const ReferenceMesh r = ReferenceMesh::of_mesh(kPoints, triangles);
  ASSERT_EQ(r.replaced().size(), 1U);
  EXPECT_EQ(r.replaced()[0], 1U);
  EXPECT_DOUBLE_EQ(r[1].cot[0], kEquilateralCot);
  EXPECT_THROW(ReferenceMesh::of_mesh(kPoints, std::vector<Triangle>{{0, 4, 1}}), MeshError);
}

}  // namespace
}  // namespace isorelax
