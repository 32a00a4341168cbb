#pragma once
#include <cstdint>

namespace boxwood {

/// Spreads every bit of `value` over all 64. A bijection: distinct inputs stay distinct. Stafford's variant 13 of the
/// SplitMix64 finaliser (Steele, Lea, Flood 2014).
constexpr std::uint64_t mix_bits(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return value ^ (value >> 31);
}

/// Random numbers by PCG32 (O'Neill 2014), the same on every machine. One generator per thing, numbered by `stream`
/// (a pixel, a triangle, a strand), makes results independent of threads and order.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(mix_bits(seed + mix_bits(stream + 0x9e3779b97f4a7c15u))), increment_((mix_bits(stream) << 1) | 1) {
    bits();
  }

  constexpr std::uint32_t bits() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + increment_;
    const auto word = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto turn = static_cast<std::uint32_t>(old >> 59);
    return (word >> turn) | (word << ((32 - turn) & 31));
  }

  /// Uniform in [0, 1), a multiple of 2^-24.
  constexpr float uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }
  /// Uniform in [low, high]; `high` itself only by rounding.
  constexpr float uniform(float low, float high) { return low + (high - low) * uniform(); }
  /// Uniform in 0 … count-1 without bias (Lemire 2019). `count` must not be 0.
  constexpr std::uint32_t below(std::uint32_t count) {
    std::uint64_t product = std::uint64_t{bits()} * count;
    if (static_cast<std::uint32_t>(product) < count) {
      const std::uint32_t threshold = (0u - count) % count;
      while (static_cast<std::uint32_t>(product) < threshold) product = std::uint64_t{bits()} * count;
    }
    return static_cast<std::uint32_t>(product >> 32);
  }

 private:
  std::uint64_t state_, increment_;
};

}  // namespace boxwood
