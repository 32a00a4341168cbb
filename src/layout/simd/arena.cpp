#include "layout/simd/arena.h"

#include <fmt/format.h>

#include <utility>

#include "boxwood/error.h"

namespace boxwood {

Arena::Arena(std::size_t bytes, Holds holds) : bytes_(bytes) {
  if (bytes == 0) return;
  data_ = static_cast<std::byte*>(allocate_held(bytes, holds));
  if (data_) return;
  throw Error(
      fmt::format("no {} bytes of memory for the acceleration structure; free some or take a compact layout", bytes));
}

Arena::Arena(Arena&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

Arena& Arena::operator=(Arena&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

Arena::~Arena() {
  if (data_) free_held(data_, bytes_);
}

}  // namespace boxwood
