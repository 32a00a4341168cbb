#pragma once
#include <span>
#include <string>
#include <string_view>

namespace boxwood {

/// "did you mean 'X'? Valid are: A, B, C" — the nearest of `names` by edit distance, then all of them.
std::string suggest(std::string_view wrong, std::span<const std::string> names);

}  // namespace boxwood
