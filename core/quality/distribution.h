#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Counts of values in equal bins over [low, high]; a value at `high` falls in the last bin. Values outside
/// the range (infinite ones too) are counted apart, so that two histograms of one range can be compared bar
/// by bar. What is not a number is counted nowhere.
struct Histogram {
  double low = 0;
  double high = 0;
  std::vector<std::size_t> counts;
  std::size_t below = 0;
  std::size_t above = 0;
};

struct HistogramRange {
  double low = 0;
  double high = 180;
  std::size_t bins = 36;
};

/// Throws UsageError unless low < high and bins > 0.
[[nodiscard]] Histogram make_histogram(std::span<const double> values, const HistogramRange& range);

/// The value under which the share `p` (0..1) of the values lies, linear between neighbours (type 7: 0 gives
/// the smallest, 1 the largest, 0.5 the median). Throws UsageError when there is no value or p is outside
/// 0..1.
[[nodiscard]] double percentile(std::span<const double> values, double p);

/// Which end of the values is the bad one.
enum class WorstEnd { smallest, largest };

/// Ids of the `count` worst elements, worst first, equal ones by ascending id; all of them when count is
/// larger.
[[nodiscard]] std::vector<Index> worst_elements(std::span<const double> values, std::size_t count,
                                                WorstEnd end);

}  // namespace isorelax
