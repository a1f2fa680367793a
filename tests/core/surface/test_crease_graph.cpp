#include "surface/crease_graph.h"

#include <gtest/gtest.h>

#include <set>

namespace isorelax {
namespace {

/// A flat sheet of n x n squares, each cut in two, whose edges turn as a test says.
struct Sheet {
  explicit Sheet(Index squares) : n(squares + 1) {
    for (Index j = 0; j + 1 < n; ++j) {
      for (Index i = 0; i + 1 < n; ++i) {
        triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
    topology = Topology(triangles, n * n);
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) positions.emplace_back(i, j, 0);
    turns.assign(3 * triangles.size(), 0);
  }
  [[nodiscard]] Index at(Index i, Index j) const { return j * n + i; }

  /// The edges along a chain of vertices turn by this much.
  void turn(std::vector<Index> chain, double degrees) {
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      for (Corner c = 0; c < turns.size(); ++c) {
        const Triangle& t = triangles[c / 3];
        if (std::set{t[next(c % 3)], t[previous(c % 3)]} == std::set{chain[k], chain[k + 1]})
          turns[c] = degrees;
      }
  }
  [[nodiscard]] std::size_t creases() const {
    const std::vector<double> spread(n * n, 90), defect(n * n, 0);
    return find_creases(positions, triangles, topology, {}, turns, spread, defect).size();
  }

  Index n;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  Topology topology;
  std::vector<double> turns;
};

TEST(CreaseGraph, AroundASinglePimpleIsNone) {
  Sheet sheet(10);
  const std::vector<Index> around{sheet.at(4, 4), sheet.at(5, 4), sheet.at(5, 5), sheet.at(4, 4)};
  sheet.turn(around, 80);
  EXPECT_EQ(sheet.creases(), 0U);
  // Not with a tail either, which without the loop ends freely on both sides.
  sheet.turn({sheet.at(5, 5), sheet.at(6, 5), sheet.at(7, 5), sheet.at(8, 5), sheet.at(8, 6)}, 80);
  EXPECT_EQ(sheet.creases(), 0U);
}

TEST(CreaseGraph, ALoopOfFourEdgesIsOne) {
  Sheet sheet(10);
  sheet.turn({sheet.at(4, 4), sheet.at(5, 4), sheet.at(5, 5), sheet.at(4, 5), sheet.at(4, 4)}, 80);
  EXPECT_EQ(sheet.creases(), 4U);
}

TEST(CreaseGraph, WhatNoiseMakesOfSliversIsNone) {
  Sheet sheet(10);
  sheet.turn({sheet.at(4, 4), sheet.at(5, 4), sheet.at(5, 5), sheet.at(4, 5), sheet.at(4, 4)}, 80);
  for (Index i = 0; i <= 10; ++i) sheet.positions[sheet.at(i, 5)].y() = 4.1;
  EXPECT_EQ(sheet.creases(), 0U);
  // The same edges on what stands out for once: its surroundings face every which way.
  for (const Index v : {sheet.at(4, 4), sheet.at(5, 4), sheet.at(5, 5), sheet.at(4, 5)})
    sheet.positions[v].z() = 3;
  EXPECT_EQ(sheet.creases(), 4U);
}

TEST(CreaseGraph, ALongerLoopAlongSliversWasDrawn) {
  Sheet sheet(10);
  sheet.turn({sheet.at(4, 4), sheet.at(5, 4), sheet.at(6, 4), sheet.at(7, 4), sheet.at(7, 5), sheet.at(6, 5),
              sheet.at(5, 5), sheet.at(4, 5), sheet.at(4, 4)},
             80);
  for (Index i = 0; i <= 10; ++i) sheet.positions[sheet.at(i, 5)].y() = 4.1;
  EXPECT_EQ(sheet.creases(), 8U);
}

TEST(CreaseGraph, AShortLoopWhoseVerticesAllMeetOthersStays) {
  Sheet sheet(12);
  sheet.turn({sheet.at(4, 4), sheet.at(5, 4), sheet.at(5, 5), sheet.at(4, 4)}, 80);
  sheet.turn({sheet.at(4, 4), sheet.at(3, 4), sheet.at(2, 4), sheet.at(1, 4), sheet.at(0, 4)}, 80);
  sheet.turn({sheet.at(5, 4), sheet.at(5, 3), sheet.at(5, 2), sheet.at(5, 1), sheet.at(5, 0)}, 80);
  sheet.turn({sheet.at(5, 5), sheet.at(5, 6), sheet.at(5, 7), sheet.at(5, 8), sheet.at(5, 9), sheet.at(5, 10),
              sheet.at(5, 11), sheet.at(5, 12)},
             80);
  EXPECT_EQ(sheet.creases(), 3U + 4U + 4U + 7U);
}

TEST(CreaseGraph, ALineGoesOnWhereItIsGentleOnItsWay) {
  const auto count = [](double turn, double others) {
    Sheet sheet(12);
    const auto along = [&](Index first, Index last, double degrees) {
      std::vector<Index> chain;
      for (Index i = first; i <= last; ++i) chain.push_back(sheet.at(i, 5));
      sheet.turn(chain, degrees);
    };
    along(0, 5, 80);
    along(5, 8, turn);
    along(8, 12, 60);
    sheet.turn({sheet.at(6, 4), sheet.at(6, 5), sheet.at(6, 6)}, others);
    return sheet.creases();
  };
  EXPECT_EQ(count(20, 5), 12U);
  EXPECT_EQ(count(14, 5), 9U);   // too gentle
  EXPECT_EQ(count(20, 18), 9U);  // others at a vertex on the way turn as much
}

TEST(CreaseGraph, AGentleLineThatLeadsNowhereIsNone) {
  Sheet sheet(12);
  sheet.turn({sheet.at(0, 5), sheet.at(1, 5), sheet.at(2, 5), sheet.at(3, 5), sheet.at(4, 5), sheet.at(5, 5)},
             80);
  sheet.turn({sheet.at(5, 5), sheet.at(6, 5), sheet.at(7, 5), sheet.at(8, 5)}, 20);
  EXPECT_EQ(sheet.creases(), 5U);
}

TEST(CreaseGraph, ALineThatLosesItsOtherEndIsLookedAtAgain) {
  Sheet sheet(12);
  // Five sharp edges from a junction of two lines that are too short to stay.
  sheet.turn({sheet.at(2, 5), sheet.at(3, 5), sheet.at(4, 5), sheet.at(5, 5), sheet.at(6, 5), sheet.at(7, 5)},
             80);
  sheet.turn({sheet.at(7, 5), sheet.at(8, 5), sheet.at(9, 5)}, 40);
  sheet.turn({sheet.at(7, 5), sheet.at(7, 6), sheet.at(7, 7)}, 40);
  EXPECT_EQ(sheet.creases(), 0U);
}

}  // namespace
}  // namespace isorelax
