#pragma once

#include <span>

#include "trace/trace.h"

namespace isorelax {

/// The part that makes an iteration, counted from 1; null where nothing is known of it.
[[nodiscard]] const TracePart* part_of(const Trace& trace, std::size_t iteration);

/// The words that a part is made with: its own or the trace's.
[[nodiscard]] const RunWords& words_of(const Trace& trace, const TracePart& part);

/// The positions that the problem of a part is made from. Throws Error for a damaged delta.
[[nodiscard]] std::vector<Vec3> base_of(const Trace& trace, const TracePart& part);

/// What a part is made with, on one line: "from iteration 5: exponent 4, 12 vertices held".
[[nodiscard]] std::string part_text(const TracePart& part);

/// Whether what the run found out by itself is in it, and not in its words: untangling, held vertices,
/// another exponent than the usual one.
[[nodiscard]] bool says_more_than_words(const Trace& trace, const TracePart& part);

/// Whether both are the same to the bit, signs of zeros and all.
[[nodiscard]] bool same_bits(std::span<const Vec3> first, std::span<const Vec3> second);

/// Throws InputError where a file that a run has read is gone or holds something else now.
void check_resources(const RunWords& words);

}  // namespace isorelax
