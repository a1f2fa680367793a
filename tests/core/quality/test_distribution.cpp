#include <gtest/gtest.h>

#include <limits>

#include "mesh/error.h"
#include "quality/distribution.h"

namespace isorelax {
namespace {

TEST(Histogram, EveryValueIsCountedOnce) {
  const std::vector<double> values = {-1, 0, 9.99, 10, 59, 60, 61, std::numeric_limits<double>::infinity()};
  const Histogram h = make_histogram(values, {0, 60, 6});
  EXPECT_EQ(h.counts, (std::vector<std::size_t>{2, 1, 0, 0, 0, 2}));
  EXPECT_EQ(h.below, 1U);
  EXPECT_EQ(h.above, 2U);
}

TEST(Histogram, WhatIsNotANumberIsCountedNowhere) {
  const std::vector<double> values = {std::numeric_limits<double>::quiet_NaN(), 5};
  const Histogram h = make_histogram(values, {0, 10, 2});
  EXPECT_EQ(h.counts, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(h.below + h.above, 0U);
}

TEST(Histogram, RefusesAnEmptyRange) {
  EXPECT_THROW(static_cast<void>(make_histogram({}, {1, 1, 4})), UsageError);
  EXPECT_THROW(static_cast<void>(make_histogram({}, {0, 1, 0})), UsageError);
}

TEST(Percentile, IsLinearBetweenNeighbours) {
  const std::vector<double> values = {40, 10, 30, 20};
  EXPECT_EQ(percentile(values, 0), 10);
  EXPECT_EQ(percentile(values, 1), 40);
  EXPECT_EQ(percentile(values, 0.5), 25);
  EXPECT_NEAR(percentile(values, 0.1), 13, 1e-12);
  EXPECT_THROW(static_cast<void>(percentile({}, 0.5)), UsageError);
}

TEST(WorstElements, ComeWorstFirstAndEqualOnesByNumber) {
  const std::vector<double> values = {3, 1, 2, 1, 5};
  EXPECT_EQ(worst_elements(values, 3, WorstEnd::smallest), (std::vector<Index>{1, 3, 2}));
  EXPECT_EQ(worst_elements(values, 2, WorstEnd::largest), (std::vector<Index>{4, 0}));
  EXPECT_EQ(worst_elements(values, 99, WorstEnd::largest).size(), 5U);
}

}  // namespace
}  // namespace isorelax
