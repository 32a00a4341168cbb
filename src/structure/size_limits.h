#pragma once
#include <cstdint>

namespace boxwood {

/// Triangles of a mesh, and instances of a scene, are named by 32 bits, of which the last two name nothing.
inline constexpr std::uint64_t most_named = (std::uint64_t{1} << 32) - 2;

/// Throws Error when a mesh of so many triangles, or a scene of so many instances, has more than can be named.
void check_named(std::uint64_t triangles, std::uint64_t instances);

}  // namespace boxwood
