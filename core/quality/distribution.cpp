#include "quality/distribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/error.h"

namespace isorelax {

Histogram make_histogram(std::span<const double> values, const HistogramRange& range) {
  if (!(range.low < range.high) || range.bins == 0) {
    throw UsageError("a histogram needs a range with low < high and at least one bin");
  }
  Histogram histogram{range.low, range.high, std::vector<std::size_t>(range.bins, 0), 0, 0};
  const double bins_per_unit = static_cast<double>(range.bins) / (range.high - range.low);
  for (const double value : values) {
    if (value < range.low) {
      ++histogram.below;
    } else if (value > range.high) {
      ++histogram.above;
    } else if (!std::isnan(value)) {
      const auto bin = static_cast<std::size_t>((value - range.low) * bins_per_unit);
      ++histogram.counts[std::min(bin, range.bins - 1)];
    }
  }
  return histogram;
}

double percentile(std::span<const double> values, double p) {
  if (values.empty() || !(p >= 0 && p <= 1)) {
    throw UsageError("a percentile needs at least one value and a share between 0 and 1");
  }
  std::vector<double> sorted(values.begin(), values.end());
  const double rank = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(std::floor(rank));
  const auto at = sorted.begin() + below;
  std::nth_element(sorted.begin(), at, sorted.end());
  const double fraction = rank - static_cast<double>(below);
  if (fraction == 0) return *at;
  const double above = *std::min_element(at + 1, sorted.end());
  return *at == above ? above : *at + fraction * (above - *at);
}

std::vector<Index> worst_elements(std::span<const double> values, std::size_t count, WorstEnd end) {
  std::vector<Index> ids(values.size());
  std::iota(ids.begin(), ids.end(), Index{0});
  count = std::min(count, ids.size());
  std::partial_sort(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count), ids.end(),
                    [&](Index a, Index b) {
                      if (values[a] == values[b]) return a < b;
                      return (values[a] < values[b]) == (end == WorstEnd::smallest);
                    });
  ids.resize(count);
  return ids;
}

}  // namespace isorelax
