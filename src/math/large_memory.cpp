#include "math/large_memory.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>

#include "boxwood/memory.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

// Under the address sanitizer every block comes from the heap, where it is watched.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define BOXWOOD_MAPS_LARGE_MEMORY
#endif

namespace boxwood {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;
constexpr std::align_val_t cache_line{64};

/// Memory that outlives its stage and is too small for huge pages; the heap keeps it for the next.
void* from_heap(std::size_t bytes, Holds holds) noexcept {
  void* memory = ::operator new(bytes, cache_line, std::nothrow);
  if (memory && holds == Holds::zeros) std::memset(memory, 0, bytes);
  return memory;
}
void to_heap(void* memory) noexcept { ::operator delete(memory, cache_line); }

#ifdef BOXWOOD_MAPS_LARGE_MEMORY

constexpr std::size_t whole_pages(std::size_t bytes) { return (bytes + huge_page - 1) / huge_page * huge_page; }

/// Maps a huge page too much and gives back what lies outside the aligned range. Null when there is no memory.
std::byte* map(std::size_t size) noexcept {
  void* mapped = mmap(nullptr, size + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  auto* begin = static_cast<std::byte*>(mapped);
  void* end = begin + huge_page;
  std::size_t room = size + huge_page;
  void* aligned = begin;
  std::align(huge_page, size, aligned, room);
  auto* memory = static_cast<std::byte*>(aligned);
  if (memory > begin) munmap(begin, static_cast<std::size_t>(memory - begin));
  if (memory < end) munmap(memory + size, static_cast<std::size_t>(static_cast<std::byte*>(end) - memory));
  madvise(memory, size, MADV_HUGEPAGE);  // A wish: without huge pages everything works, only slower.
  return memory;
}

/// Of memory that outlives its stage.
constexpr std::size_t mapped_bytes(std::size_t bytes) {
  constexpr std::size_t small_page = 4096;
  const std::size_t whole = whole_pages(bytes);
  return whole - bytes <= bytes / 2 ? whole : (bytes + small_page - 1) / small_page * small_page;
}

/// Of freed blocks. What a build of a million triangles works in; a page that the system has to clear, and in a virtual
/// machine perhaps to get first, costs more than all that a build does with it.
constexpr std::size_t most_kept_bytes = std::size_t{256} << 20;

struct Block {
  std::byte* memory;
  std::size_t size;
};

/// The blocks there are: few, so that lists do.
class Blocks {
 public:
  struct Memory {
    std::byte* begin;
    bool fresh;  ///< from the system, so zero
  };

  /// A freed block of at least `size` and at most `most` bytes, the smallest, or a new one.
  Memory allocate(std::size_t size, std::size_t most) {
    const std::lock_guard lock(mutex_);
    used_.reserve(used_.size() + 1);
    free_.reserve(used_.size() + free_.size() + 2);  // free() must not fail.
    auto best = free_.end();
    for (auto block = free_.begin(); block != free_.end(); ++block) {
      if (block->size < size || block->size > most) continue;
      if (best == free_.end() || block->size < best->size) best = block;
    }
    if (best == free_.end()) {
      std::byte* const memory = map(size);
      if (!memory) throw std::bad_alloc();
      used_.push_back({memory, size});
      return {memory, true};
    }
    used_.push_back(*best);
    free_.erase(best);
    free_bytes_ -= used_.back().size;
    return {used_.back().memory, false};
  }

  void free(std::byte* memory) noexcept {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(used_, memory, &Block::memory);
    const Block block = *found;
    used_.erase(found);
    if (block.size > most_kept_bytes) {
      munmap(block.memory, block.size);
      return;
    }
    free_.push_back(block);
    free_bytes_ += block.size;
    keep(most_kept_bytes);
  }

  void release_kept() noexcept {
    const std::lock_guard lock(mutex_);
    keep(0);
  }

 private:
  /// Gives the oldest freed blocks back until no more than `bytes` are left.
  void keep(std::size_t bytes) noexcept {
    while (free_bytes_ > bytes) {
      const Block oldest = free_.front();
      munmap(oldest.memory, oldest.size);
      free_bytes_ -= oldest.size;
      free_.erase(free_.begin());
    }
  }

  std::mutex mutex_;
  std::vector<Block> used_, free_;  ///< those freed first come first
  std::size_t free_bytes_ = 0;
};

/// Never destroyed: arrays with static storage may be freed after it would be.
Blocks& blocks() {
  static Blocks* const all = new Blocks;
  return *all;
}

#endif

}  // namespace

#ifdef BOXWOOD_MAPS_LARGE_MEMORY

void* allocate_large(std::size_t bytes) {
  const std::size_t size = whole_pages(bytes);
  return blocks().allocate(size, 2 * size).begin;
}
void free_large(void* memory) noexcept { blocks().free(static_cast<std::byte*>(memory)); }
void release_kept_memory() noexcept { blocks().release_kept(); }

void prefer_huge_pages(void* begin, std::size_t bytes) {
  if (bytes == 0) return;
  constexpr int collapse = 25;  // MADV_COLLAPSE, which older headers lack; older systems refuse it.
  const std::size_t into_page = reinterpret_cast<std::uintptr_t>(begin) % huge_page;
  std::byte* const first = static_cast<std::byte*>(begin) - into_page;
  const std::size_t last = (into_page + bytes - 1) / huge_page * huge_page;
  madvise(first, last + huge_page, MADV_HUGEPAGE);
  // At either end lies memory of others, at least the heap's header, which has been touched: such pages become huge
  // only by collapsing them. That fails where the heap ends within.
  madvise(first, huge_page, collapse);
  if (last != 0) madvise(first + last, huge_page, collapse);
}

#else

void prefer_huge_pages(void*, std::size_t) {}
void release_kept_memory() noexcept {}
void* allocate_large(std::size_t bytes) { return ::operator new (bytes, std::align_val_t{huge_page}); }
void free_large(void* memory) noexcept { ::operator delete (memory, std::align_val_t{huge_page}); }

#endif

#ifdef BOXWOOD_MAPS_LARGE_MEMORY

void* allocate_held(std::size_t bytes, Holds holds) noexcept {
  const std::size_t size = mapped_bytes(bytes);
  if (size < huge_page) return from_heap(size, holds);
  if (size % huge_page != 0) return map(size);
  try {
    const Blocks::Memory memory = blocks().allocate(size, size + size / 8);
    if (holds == Holds::zeros && !memory.fresh) std::memset(memory.begin, 0, bytes);
    return memory.begin;
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void free_held(void* memory, std::size_t bytes) noexcept {
  const std::size_t size = mapped_bytes(bytes);
  if (size < huge_page) return to_heap(memory);
  if (size % huge_page == 0) return free_large(memory);
  munmap(memory, size);
}

#else

void* allocate_held(std::size_t bytes, Holds holds) noexcept { return from_heap(bytes, holds); }
void free_held(void* memory, std::size_t) noexcept { to_heap(memory); }

#endif

}  // namespace boxwood
