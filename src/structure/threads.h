#pragma once
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace boxwood {

/// Runs `work` on so many threads, 0: as many as the machine has. More than it has are for tests of determinism; TBB
/// has to be told to allow them.
template <class Work>
void run_on_threads(unsigned threads, const Work& work) {
  const auto available = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  std::max<std::size_t>(threads, available));
  tbb::task_arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads)).execute(work);
}

}  // namespace boxwood
