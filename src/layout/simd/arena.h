#pragma once
#include <cstddef>
#include <span>

#include "math/large_memory.h"

namespace boxwood {

/// A block of memory, aligned to cache lines, in huge pages where the system grants them: a traversal that jumps
/// over megabytes of 4 KiB pages spends its time in the address tables.
class Arena {
 public:
  Arena() = default;
  /// Throws Error when there is not enough memory.
  explicit Arena(std::size_t bytes, Holds holds = Holds::zeros);
  Arena(Arena&& other) noexcept;
  Arena& operator=(Arena&& other) noexcept;
  ~Arena();

  std::byte* data() { return data_; }
  const std::byte* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }

 private:
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace boxwood
