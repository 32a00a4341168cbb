#pragma once
#include <span>
#include <string>
#include <string_view>

namespace boxwood::html {

/// Safe between tags and inside quoted attributes.
std::string escaped(std::string_view text);

/// "data:TYPE;base64,…"
std::string data_uri(std::string_view type, std::span<const unsigned char> bytes);

}  // namespace boxwood::html
