#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace boxwood {

/// An array that is written before it is read: its pages are not touched when it is made.
template <class T>
class RawArray {
 public:
  explicit RawArray(std::size_t size) : data_(std::make_unique_for_overwrite<T[]>(size)), size_(size) {}
  T* data() { return data_.get(); }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t size() const { return size_; }
  operator std::span<T>() { return {data_.get(), size_}; }
  operator std::span<const T>() const { return {data_.get(), size_}; }

 private:
  std::unique_ptr<T[]> data_;
  std::size_t size_;
};

/// Sorts `keys` by their bits [first_bit, 64); keys that agree there keep their order. Least significant digit first,
/// parallel, one result for any number of threads. `scratch` has the size of `keys`. O(n) for a fixed number of bits.
void radix_sort(std::span<std::uint64_t> keys, std::span<std::uint64_t> scratch, unsigned first_bit);

}  // namespace boxwood
