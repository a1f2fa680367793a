#pragma once

#include <cstddef>
#include <functional>

namespace isorelax {

/// Elements per block. Fixed, so that how work is cut up (and so every rounded sum) never depends on the
/// threads.
inline constexpr std::size_t kBlockSize = 2048;

/// Calls body(begin, end) for every block of [0, count), on up to `threads` threads (0: all the machine has).
/// Blocks may run in any order: the body writes only what belongs to its own elements.
void parallel_for_blocks(std::size_t count, unsigned threads,
                         const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Number of blocks that `parallel_for_blocks` makes: the size of an array of per-block partial sums.
constexpr std::size_t block_count(std::size_t count) {
  return (count + kBlockSize - 1) / kBlockSize;
}

}  // namespace isorelax
