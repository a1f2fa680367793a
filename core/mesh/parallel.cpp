#include "mesh/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

namespace isorelax {

void parallel_for_blocks(std::size_t count, unsigned threads,
                         const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t blocks = block_count(count);
  const auto run_block = [&](std::size_t block) {
    body(block * kBlockSize, std::min(count, (block + 1) * kBlockSize));
  };
  if (threads == 1 || blocks <= 1) {
    for (std::size_t block = 0; block < blocks; ++block) run_block(block);
    return;
  }
  // More threads than processors gain nothing, and TBB would complain on standard error.
  const int available = tbb::info::default_concurrency();
  tbb::task_arena arena(threads == 0 ? available : std::min(available, static_cast<int>(threads)));
  // TBB hands work over and back by itself; said once more in terms that a thread checker sees without
  // knowing TBB.
  std::atomic<bool> started{false};
  std::atomic<std::size_t> finished{0};
  started.store(true, std::memory_order_release);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      static_cast<void>(started.load(std::memory_order_acquire));
      run_block(block);
      finished.fetch_add(1, std::memory_order_release);
    });
  });
  static_cast<void>(finished.load(std::memory_order_acquire));
}

}  // namespace isorelax
