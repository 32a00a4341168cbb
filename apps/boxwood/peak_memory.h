#pragma once
#include <cstddef>
#include <functional>
#include <optional>

namespace boxwood::cli {

struct PeakMemory {
  std::size_t added_bytes = 0;  ///< the most that `work` had resident at once, beyond what was resident before
  std::size_t total_bytes = 0;  ///< the same, of the whole process
};

/// Runs `work` and reads from the kernel (Linux, /proc) what it took. Nothing where the kernel does not tell.
std::optional<PeakMemory> peak_memory_of(const std::function<void()>& work);

}  // namespace boxwood::cli
