#include "surface/crossings.h"

#include <gtest/gtest.h>

#include <random>

namespace isorelax {
namespace {

using Pairs = std::vector<std::array<Index, 2>>;

Pairs find(std::span<const Vec3> x, std::span<const Triangle> triangles, unsigned threads = 1) {
  return crossing_pairs({x, triangles}, x, triangles, threads);
}

/// A triangle in the plane z = 0, and one more.
Pairs against(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::vector<Vec3> x = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, a, b, c};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {3, 4, 5}};
  return find(x, triangles);
}

TEST(Crossings, AnEdgeThroughATriangleCrosses) {
  const Pairs one = {{0, 1}};
  EXPECT_EQ(against({1, 1, -1}, {1, 1, 1}, {9, 9, 0}), one) << "the other's edge passes through this one";
  EXPECT_EQ(against({-1, 1, -1}, {-1, 1, 1}, {1, 1, 0}), one) << "each is pierced by an edge";
  EXPECT_EQ(against({-9, 1, -9}, {9, 1, -9}, {0.5, 1, 9}), one) << "this one's edges pass through the other";
}

TEST(Crossings, WhatTouchesOrPassesByDoesNot) {
  EXPECT_EQ(against({1, 1, 0}, {1, 1, 1}, {2, 1, 1}), Pairs{}) << "a corner inside";
  EXPECT_EQ(against({1, 1, 0.1}, {1, 2, 1}, {2, 1, 1}), Pairs{}) << "above";
  EXPECT_EQ(against({3, 3, -1}, {3, 3, 1}, {9, 9, 0}), Pairs{}) << "beside";
  EXPECT_EQ(against({1, 1, 0}, {3, 1, 0}, {1, 3, 0}), Pairs{}) << "in one plane";
  EXPECT_EQ(against({2, 0, -1}, {2, 0, 1}, {2, -3, 0}), Pairs{}) << "an edge on an edge";
}

TEST(Crossings, TrianglesThatShareVerticesMayCross) {
  const std::vector<Vec3> x = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {-4, 0, 1}};
  const auto pairs = [&](Triangle other) {
    const std::vector<Triangle> triangles = {{0, 1, 2}, other};
    return find(x, triangles).size();
  };
  EXPECT_EQ(pairs({0, 3, 4}), 1U) << "the edge opposite to the shared corner passes through";
  EXPECT_EQ(pairs({0, 4, 5}), 0U);
  EXPECT_EQ(pairs({1, 0, 4}), 0U) << "an edge is shared";
}

/// Triangles without order, some of which share vertices.
struct Heap {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

Heap random_heap(unsigned seed) {
  std::mt19937 generator(seed);
  Heap heap;
  const auto coordinate = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  for (int i = 0; i < 150; ++i) {
    const Vec3 centre(coordinate(), coordinate(), coordinate());
    for (int k = 0; k < 3; ++k)
      heap.positions.push_back(centre + 0.3 * Vec3(coordinate(), coordinate(), coordinate()));
  }
  for (Index i = 0; i + 4 < heap.positions.size(); i += 2) heap.triangles.push_back({i, i + 1, i + 4});
  return heap;
}

TEST(Crossings, FindsAllOfAHeapOnAnyNumberOfThreads) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Heap heap = random_heap(seed);
    Pairs expected;
    for (Index s = 0; s < heap.triangles.size(); ++s)
      for (Index t = s + 1; t < heap.triangles.size(); ++t)
        if (do_cross(heap.positions, heap.triangles[s], heap.triangles[t])) expected.push_back({s, t});
    ASSERT_GT(expected.size(), 20U);
    EXPECT_EQ(find(heap.positions, heap.triangles, 1), expected);
    EXPECT_EQ(find(heap.positions, heap.triangles, 3), expected);
  }
}

TEST(Crossings, BordersThatOverlapInAPlaneCross) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {3, 4, 5}};
  const Topology topology(triangles, 6);
  const auto crossings = [&](double shift) {
    const std::vector<Vec3> x = {{0, 0, 1},     {4, 0, 1},         {0, 4, 1},
                                 {shift, 3, 1}, {shift + 4, 3, 1}, {shift, 7, 1}};
    return crossing_borders(x, triangles, topology, {0, 0, 1}, 1);
  };
  EXPECT_EQ(crossings(5), Pairs{});
  // The long side of the first, opposite to its first corner, and the short ones of the second.
  EXPECT_EQ(crossings(0.5), (Pairs{{0, 4}, {0, 5}}));
}

TEST(Crossings, FewTrianglesNeedNoTree) {
  EXPECT_EQ(find({}, {}), Pairs{});
  const std::vector<Vec3> x = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const std::vector<Triangle> one = {{0, 1, 2}};
  EXPECT_EQ(find(x, one), Pairs{});
}

}  // namespace
}  // namespace isorelax
