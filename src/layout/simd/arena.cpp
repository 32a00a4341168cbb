#include "layout/simd/arena.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <utility>

#include "boxwood/error.h"

namespace boxwood {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;

/// The system aligns mappings of whole huge pages, and makes only whole ones huge.
std::size_t mapped_bytes(std::size_t bytes) {
  return bytes < huge_page ? bytes : (bytes + huge_page - 1) / huge_page * huge_page;
}

}  // namespace

Arena::Arena(std::size_t bytes) : bytes_(bytes) {
  if (bytes == 0) return;
  void* memory = mmap(nullptr, mapped_bytes(bytes), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) {
    throw Error(
        fmt::format("no {} bytes of memory for the acceleration structure; free some or take a compact layout", bytes));
  }
  // A hint: without huge pages everything works, only slower.
  if (bytes >= huge_page) madvise(memory, mapped_bytes(bytes), MADV_HUGEPAGE);
  data_ = static_cast<std::byte*>(memory);
}

Arena::Arena(Arena&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

Arena& Arena::operator=(Arena&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

Arena::~Arena() {
  if (data_) munmap(data_, mapped_bytes(bytes_));
}

}  // namespace boxwood
