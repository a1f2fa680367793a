#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trace/trace.h"

namespace isorelax {

/// One thing that two runs were told differently.
struct TraceSetting {
  std::string name, first, second;
};

/// Where two runs part: the first iteration after which a vertex stands elsewhere, to the bit.
struct TraceParting {
  std::size_t iteration = 0;  ///< 0: they start apart
  Index vertex = 0;           ///< the first such vertex
  std::size_t vertices = 0;   ///< how many of them there are
  Vec3 first, second;         ///< where it stands in each
  double largest = 0;         ///< the largest distance between the two places of a vertex
};

struct TraceDifference {
  std::vector<TraceSetting> settings;
  /// Both have the same triangles: only then can positions be compared.
  bool same_triangles = false;
  std::optional<TraceParting> parting;
  /// Largest distance of any vertex after the last iteration that both have.
  double distance_at_end = 0;
  std::size_t common_iterations = 0;

  /// Nothing that was done differs: same triangles, positions and number of iterations.
  [[nodiscard]] bool none() const;
  bool same_length = false;
};

/// Where two runs part, as words; coordinates with all digits, in which they may differ last.
[[nodiscard]] std::string parting_text(const TraceParting& parting);

/// Compares two recorded runs. Throws Error for a damaged delta.
[[nodiscard]] TraceDifference compare_traces(const Trace& first, const Trace& second);

/// The first vertex whose positions differ in a bit, and what can be said of it; none when all agree.
/// Precondition: as many positions in both.
[[nodiscard]] std::optional<TraceParting> find_parting(std::span<const Vec3> first,
                                                       std::span<const Vec3> second, std::size_t iteration);

}  // namespace isorelax
