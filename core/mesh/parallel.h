#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

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

/// Memory that is costly to make, for blocks that run at the same time: each block borrows a piece and gives
/// it back, so that there are as many pieces as threads. What a piece held before must make no difference.
template <typename T>
class Scratch {
 public:
  explicit Scratch(std::function<std::unique_ptr<T>()> make) : make_(std::move(make)) {}

  void with_one(const std::function<void(T&)>& work) {
    std::unique_ptr<T> piece = borrow();
    work(piece ? *piece : *(piece = make_()));
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(piece));
  }

 private:
  std::unique_ptr<T> borrow() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return nullptr;
    std::unique_ptr<T> piece = std::move(idle_.back());
    idle_.pop_back();
    return piece;
  }

  std::function<std::unique_ptr<T>()> make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace isorelax
