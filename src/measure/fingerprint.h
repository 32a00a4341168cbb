#pragma once
#include <cstdint>

#include "boxwood/scene.h"
#include "math/random.h"

namespace boxwood {

/// A 64-bit hash of a sequence of numbers, the same on every machine. Not for secrets.
class Fingerprint {
 public:
  void add(std::uint64_t number) { state_ = mix_bits(state_ ^ (number + 0x9e3779b97f4a7c15u)) + number; }
  std::uint64_t value() const { return mix_bits(state_); }

 private:
  std::uint64_t state_ = 0;
};

/// Of everything that rays can hit: positions, triangles, placements. O(n).
std::uint64_t fingerprint(const Scene& scene);

/// The upper 52 bits, which a double holds exactly.
inline double hash_as_number(std::uint64_t hash) { return static_cast<double>(hash >> 12); }

}  // namespace boxwood
