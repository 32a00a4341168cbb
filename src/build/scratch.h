#pragma once
#include <cstddef>
#include <memory>
#include <type_traits>

namespace boxwood {

/// `size` elements that are written before they are read, on the stack when they fit there.
template <class T, std::size_t stack_size>
class Scratch {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  explicit Scratch(std::size_t size)
      : heap_(size > stack_size ? std::make_unique_for_overwrite<T[]>(size) : nullptr),
        data_(heap_ ? heap_.get() : reinterpret_cast<T*>(stack_)) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  T* data() { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }

 private:
  std::unique_ptr<T[]> heap_;
  T* data_;
  alignas(T) std::byte stack_[stack_size * sizeof(T)];
};

}  // namespace boxwood
