#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <set>

#include "io/polygon_soup.h"

namespace isorelax {
namespace {

using Cut = std::array<std::uint32_t, 3>;

std::vector<Cut> cut(const std::vector<Vec3>& corners) {
  std::vector<Cut> triangles;
  triangulate_polygon(corners, triangles);
  return triangles;
}

Vec3 area_of(const std::vector<Vec3>& corners, const std::vector<Cut>& triangles) {
  Vec3 sum = Vec3::Zero();
  for (const Cut& t : triangles) {
    sum += area_vector(corners[t[0]], corners[t[1]], corners[t[2]]);
  }
  return sum;
}

/// Sum of the triangles' areas without sign: larger than the polygon's when triangles overlap or turn over.
double covered(const std::vector<Vec3>& corners, const std::vector<Cut>& triangles) {
  double sum = 0.0;
  for (const Cut& t : triangles) {
    sum += area_vector(corners[t[0]], corners[t[1]], corners[t[2]]).norm();
  }
  return sum;
}

/// Every side of the polygon is the side of one triangle, in its direction; every other side is shared by
/// two.
void expect_watertight(std::size_t corners, const std::vector<Cut>& triangles) {
  ASSERT_EQ(triangles.size(), corners - 2);
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const Cut& t : triangles) {
    for (unsigned k = 0; k < 3; ++k) {
      EXPECT_TRUE(sides.emplace(t[k], t[next(k)]).second) << "a side is used twice in one direction";
    }
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const auto after = static_cast<std::uint32_t>((i + 1) % corners);
    EXPECT_EQ(sides.erase({i, after}), 1U);
  }
  for (const auto& [a, b] : sides) {
    EXPECT_TRUE(sides.contains({b, a}));
  }
}

/// A comb with `teeth` long narrow teeth: nearly every ear but the right ones holds another corner.
std::vector<Vec3> comb(int teeth) {
  std::vector<Vec3> corners;
  for (int i = 0; i < teeth; ++i) {
    corners.emplace_back(2.0 * i, 10.0, 0.0);
    corners.emplace_back(2.0 * i + 1.0, 0.5, 0.0);
  }
  corners.emplace_back(2.0 * teeth, 10.0, 0.0);
  corners.emplace_back(2.0 * teeth, 0.0, 0.0);
  corners.emplace_back(0.0, 0.0, 0.0);
  std::reverse(corners.begin(), corners.end());
  return corners;
}

TEST(Polygon, AConvexQuadrilateralIsCutAlongItsShorterDiagonal) {
  EXPECT_EQ(cut({{0, 0, 0}, {3, 0, 0}, {4, 1, 0}, {1, 1, 0}}), (std::vector<Cut>{{0, 1, 3}, {1, 2, 3}}));
  EXPECT_EQ(cut({{0, 0, 0}, {3, 0, 0}, {2, 1, 0}, {-1, 1, 0}}), (std::vector<Cut>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, AConcaveQuadrilateralIsCutAtItsReflexCornerEvenWhereThatDiagonalIsLonger) {
  // Corner 2 is reflex: only the diagonal 0-2 lies inside.
  const std::vector<Vec3> corners{{0, 0, 0}, {1, -0.2, 0}, {0.5, 0, 0}, {1, 0.2, 0}};
  EXPECT_EQ(cut(corners), (std::vector<Cut>{{0, 1, 2}, {0, 2, 3}}));
  const std::vector<Vec3> turned{corners[1], corners[2], corners[3], corners[0]};
  EXPECT_EQ(cut(turned), (std::vector<Cut>{{0, 1, 3}, {1, 2, 3}}));
}

TEST(Polygon, ConcavePolygonsInAnyPlaneAreCoveredOnceAndWithoutOverlap) {
  std::vector<Vec3> star;
  for (int i = 0; i < 22; ++i) {
    const double radius = i % 2 == 0 ? 1.0 : 0.2;
    const double angle = 2.0 * 3.14159265358979 * i / 22.0;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -3).normalized()).toRotationMatrix();
  for (const std::vector<Vec3>& flat : {star, comb(40)}) {
    std::vector<Vec3> corners;
    corners.reserve(flat.size());
    for (const Vec3& corner : flat) {
      corners.push_back(turn * corner + Vec3(100, -50, 7));
    }
    const std::vector<Cut> triangles = cut(corners);
    expect_watertight(corners.size(), triangles);
    EXPECT_NEAR(covered(corners, triangles), area_of(corners, triangles).norm(), 1e-9);
  }
}

TEST(Polygon, CornersOnAStraightSideAreKept) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}};
  const std::vector<Cut> triangles = cut(corners);
  expect_watertight(corners.size(), triangles);
  EXPECT_NEAR(covered(corners, triangles), 18.0, 1e-12);
}

TEST(Polygon, TinyAndHugePolygonsAreCutAlike) {
  const std::vector<Vec3> unit{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
  const std::vector<Cut> expected = cut(unit);
  for (const double scale : {1e-300, 1e-160, 1e160, 4e307}) {
    std::vector<Vec3> corners;
    corners.reserve(unit.size());
    for (const Vec3& corner : unit) {
      corners.push_back(scale * corner);
    }
    EXPECT_EQ(cut(corners), expected) << scale;
  }
}

TEST(Polygon, DegenerateAndSelfCrossingPolygonsGiveTrianglesAndSaySo) {
  std::vector<Cut> triangles;
  const std::vector<Vec3> point(7, Vec3(1, 1, 1));
  EXPECT_FALSE(triangulate_polygon(point, triangles));
  expect_watertight(7, triangles);
  triangles.clear();
  std::vector<Vec3> pentagram;
  pentagram.reserve(5);
  for (int i = 0; i < 5; ++i) {
    pentagram.emplace_back(std::cos(2.5132741 * i), std::sin(2.5132741 * i), 0.0);
  }
  triangulate_polygon(pentagram, triangles);
  EXPECT_EQ(triangles.size(), 3U);
}

TEST(Polygon, AHundredThousandCornersDoNotTakeQuadraticTime) {
  const std::vector<Vec3> corners = comb(50000);
  std::vector<Vec3> turned;
  turned.reserve(corners.size());
  for (const Vec3& corner : corners) {
    turned.emplace_back(0.0, corner.x(), -corner.y());
  }
  const auto start = std::chrono::steady_clock::now();
  const std::size_t triangles = cut(corners).size() + cut(turned).size();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(triangles, 2 * (corners.size() - 2));
  // Sanitizers slow it down; quadratic work would take minutes.
  EXPECT_LT(seconds.count(), 20.0);
  RecordProperty("milliseconds", static_cast<int>(1000 * seconds.count()));
}

TEST(Triangulate, CountsPolygonsAndSkipsFacesWithoutAnArea) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  PolygonSoup faces;
  const std::vector<std::vector<Index>> all{{0, 1, 2, 3}, {0, 1}, {2}, {}, {0, 1, 2}, {1, 1, 2}};
  for (const std::vector<Index>& face : all) {
    faces.vertices.insert(faces.vertices.end(), face.begin(), face.end());
    faces.end_face();
  }
  const Triangulation result = triangulate(positions, faces);
  EXPECT_EQ(result.polygons, 1U);
  EXPECT_EQ(result.polygon_triangles, 2U);
  EXPECT_EQ(result.skipped_faces, 3U);
  EXPECT_EQ(result.triangles.size(), 4U);
  EXPECT_EQ(result.face, (std::vector<std::uint32_t>{0, 0, 4, 5}));
  EXPECT_EQ(result.triangles.back(), (Triangle{1, 1, 2}));
}

}  // namespace
}  // namespace isorelax
