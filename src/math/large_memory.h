#pragma once
#include <cstddef>
#include <iterator>
#include <limits>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace boxwood {

/// From this size on memory is taken from the system in huge pages: the first touch of a 4 KiB page costs as much as
/// writing it ten times over, and a build touches a hundred bytes per triangle and more.
inline constexpr std::size_t large_bytes = std::size_t{1} << 18;

/// Memory of at least large_bytes, aligned to 2 MiB, in huge pages where the system grants them. What it holds is
/// arbitrary. Some blocks that were freed are kept for the next (boxwood/memory.h), so that neither the stages of one
/// build nor builds that follow each other ask the system again; such a block may be up to twice as large as asked for:
/// for what is held no longer than a stage. Throws std::bad_alloc. Thread safe.
void* allocate_large(std::size_t bytes);
void free_large(void* memory) noexcept;

enum class Holds { zeros, anything };

/// Memory for what outlives its stage, aligned to cache lines, in huge pages where the system grants them; its last
/// bytes too, where rounding up adds no more than half. Comes from the same blocks, where one fits to an eighth. Null
/// when there is none. Thread safe.
void* allocate_held(std::size_t bytes, Holds holds) noexcept;
void free_held(void* memory, std::size_t bytes) noexcept;

/// Stands for the value of an element that is written later.
struct Unwritten {};

/// Standard allocator that takes large arrays from allocate_large().
template <class T>
struct LargeAllocator {
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    if (bytes >= large_bytes) return static_cast<T*>(allocate_large(bytes));
    return static_cast<T*>(::operator new (bytes, std::align_val_t{alignof(T)}));
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    const std::size_t bytes = count * sizeof(T);
    if (bytes >= large_bytes) return free_large(memory);
    ::operator delete (memory, std::align_val_t{alignof(T)});
  }
  template <class U>
  void construct(U*, Unwritten) noexcept {
    static_assert(std::is_trivially_copyable_v<U> && std::is_trivially_destructible_v<U>);
  }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

/// What a stage keeps per primitive or per node while it runs.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

/// Iterates over elements that are written later.
class UnwrittenIterator {
 public:
  using iterator_category = std::forward_iterator_tag;
  using value_type = Unwritten;
  using difference_type = std::ptrdiff_t;
  using pointer = const Unwritten*;
  using reference = const Unwritten&;

  explicit UnwrittenIterator(std::size_t at = 0) : at_(at) {}
  reference operator*() const {
    static constexpr Unwritten value;
    return value;
  }
  UnwrittenIterator& operator++() {
    ++at_;
    return *this;
  }
  UnwrittenIterator operator++(int) { return UnwrittenIterator(at_++); }
  friend bool operator==(const UnwrittenIterator&, const UnwrittenIterator&) = default;

 private:
  std::size_t at_;
};

/// `count` elements whose memory is not touched, to be written before they are read, by many threads at best: a vector
/// made in the usual way writes them in this one.
template <class T>
LargeVector<T> unwritten(std::size_t count) {
  return LargeVector<T>(UnwrittenIterator(), UnwrittenIterator(count));
}

/// Asks the system for huge pages in [begin, begin + bytes), freshly allocated. No effect on what the memory holds.
void prefer_huge_pages(void* begin, std::size_t bytes);

/// Makes room for `count` elements in an empty vector that outlives its stage, in huge pages if it is large.
template <class T>
void reserve_large(std::vector<T>& vector, std::size_t count) {
  if (count * sizeof(T) < large_bytes) return vector.reserve(count);
  // The heap maps large blocks on their own, with a header before them; only whole huge pages can be huge.
  constexpr std::size_t huge_page = std::size_t{1} << 21, header = 4096;
  const std::size_t bytes = (count * sizeof(T) + header + huge_page - 1) / huge_page * huge_page - header;
  vector.reserve(bytes / sizeof(T));
  prefer_huge_pages(vector.data(), bytes);
}

/// An array that is written before it is read: its pages are not touched when it is made.
template <class T>
class RawArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  explicit RawArray(std::size_t size = 0) : data_(size ? LargeAllocator<T>().allocate(size) : nullptr), size_(size) {}
  RawArray(RawArray&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  RawArray& operator=(RawArray&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~RawArray() {
    if (data_) LargeAllocator<T>().deallocate(data_, size_);
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t size() const { return size_; }
  operator std::span<T>() { return {data_, size_}; }
  operator std::span<const T>() const { return {data_, size_}; }

 private:
  T* data_;
  std::size_t size_;
};

}  // namespace boxwood
