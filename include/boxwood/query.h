#pragma once
#include <cstdint>

namespace boxwood {

/// What is asked of a ray: what it hits first, or whether it hits anything.
enum class Query : std::uint8_t { closest_hit, any_hit };

}  // namespace boxwood
