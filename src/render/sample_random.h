#pragma once
#include <cstdint>

#include "math/random.h"

namespace boxwood {

/// What a random number decides. Each use has numbers of its own, so adding one never changes another.
enum class RandomUse : std::uint8_t { camera, light, ao, diffuse, random_ray, axis_ray, grazing_ray, block, path };

/// Random numbers of one sample: a function of its arguments only, so nothing depends on threads or order. `depth`
/// tells bounces apart.
constexpr Random sample_random(std::uint64_t seed, RandomUse use, std::uint32_t pixel, std::uint32_t sample = 0,
                               std::uint32_t depth = 0) {
  const std::uint64_t purpose = (std::uint64_t{depth} << 8) | static_cast<std::uint64_t>(use);
  return Random(mix_bits(seed) + purpose, (std::uint64_t{pixel} << 32) | sample);
}

}  // namespace boxwood
