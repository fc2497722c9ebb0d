#include "parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <optional>

namespace geovor {

ForEach for_each_on(int threads) {
  return [threads](int n, const std::function<void(int)>& body) {
    std::optional<tbb::global_control> limit;
    if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
      // One face a task: faces differ in cost by orders of magnitude. They are begun in their order, whichever part of
      // the range a thread has been given: the caller has put the large ones first.
      std::atomic<int> next = 0;
      tbb::parallel_for(
          tbb::blocked_range<int>(0, n, 1),
          [&](const tbb::blocked_range<int>& range) {
            for (int i = range.begin(); i != range.end(); ++i) body(next++);
          },
          tbb::simple_partitioner());
    });
  };
}

}  // namespace geovor
