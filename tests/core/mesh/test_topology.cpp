#include <gtest/gtest.h>

#include "mesh/topology.h"

namespace isorelax {
namespace {

const std::vector<Triangle> kTetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

TEST(Topology, TetrahedronIsClosedAndManifold) {
  const Topology topology(kTetrahedron, 4);
  for (Index v = 0; v < 4; ++v) {
    EXPECT_EQ(topology.corners_of(v).size(), 3U);
    EXPECT_EQ(topology.flags(v), 0);
  }
  for (Corner c = 0; c < 12; ++c) EXPECT_EQ(topology.opposite(topology.opposite(c)), c);
}

TEST(Topology, SquareOfTwoTrianglesHasFourBoundaryVertices) {
  const std::vector<Triangle> square = {{0, 1, 2}, {0, 2, 3}};
  const Topology topology(square, 5);
  for (Index v = 0; v < 4; ++v) EXPECT_EQ(topology.flags(v), kBoundaryVertex);
  EXPECT_EQ(topology.flags(4), kIsolatedVertex);
  EXPECT_EQ(topology.opposite(1), 5U);  // corner at vertex 1 faces the corner at vertex 3 across the diagonal
}

TEST(Topology, EdgeWithThreeTrianglesIsNonManifold) {
  const std::vector<Triangle> fins = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const Topology topology(fins, 5);
  EXPECT_TRUE(topology.flags(0) & kNonManifoldVertex);
  EXPECT_TRUE(topology.flags(1) & kNonManifoldVertex);
  EXPECT_FALSE(topology.flags(2) & kNonManifoldVertex);
  EXPECT_EQ(topology.edge_triangle_count(2), 3U);
}

TEST(Topology, TwoFansThatMeetInOneVertexAreNonManifold) {
  const std::vector<Triangle> bow_tie = {{0, 1, 2}, {0, 3, 4}};
  const Topology topology(bow_tie, 5);
  EXPECT_TRUE(topology.flags(0) & kNonManifoldVertex);
  EXPECT_FALSE(topology.flags(1) & kNonManifoldVertex);
}

TEST(Topology, TwoClosedFansThatMeetInOneVertexAreNonManifold) {
  std::vector<Triangle> twins = kTetrahedron;
  for (const Triangle& t : kTetrahedron) {
    Triangle shifted{};
    for (unsigned k = 0; k < 3; ++k) shifted[k] = t[k] == 0 ? 0 : t[k] + 3;
    twins.push_back(shifted);
  }
  const Topology topology(twins, 7);
  EXPECT_TRUE(topology.flags(0) & kNonManifoldVertex);
  for (Index v = 1; v < 7; ++v) EXPECT_EQ(topology.flags(v), 0) << v;
}

TEST(Topology, TwoTrianglesThatRunAlongAnEdgeTheSameWayAreInconsistent) {
  const std::vector<Triangle> opposed = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_FALSE(Topology(opposed, 4).flags(0) & kInconsistentVertex);
  const std::vector<Triangle> same = {{0, 1, 2}, {2, 0, 3}};
  EXPECT_TRUE(Topology(same, 4).flags(0) & kInconsistentVertex);
  EXPECT_FALSE(Topology(same, 4).flags(1) & kInconsistentVertex);
}

TEST(Topology, TriangleThatRepeatsAVertexIsFlagged) {
  const std::vector<Triangle> triangles = {{0, 0, 1}, {0, 1, 2}};
  const Topology topology(triangles, 3);
  EXPECT_TRUE(topology.flags(0) & kRepeatedVertex);
  EXPECT_TRUE(topology.flags(1) & kRepeatedVertex);
  EXPECT_FALSE(topology.flags(2) & kRepeatedVertex);
}

}  // namespace
}  // namespace isorelax
