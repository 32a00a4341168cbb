#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace boxwood {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type{};  ///< of the value, or of a list's entries
  bool is_list = false;
  PlyType count_type{};  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format{};
  std::vector<PlyElement> elements;
  std::size_t bytes = 0, lines = 0;  ///< what the header takes of the file
};

/// Throws Error naming file, line and what was expected.
PlyHeader read_ply_header(std::string_view text, const std::string& file);

}  // namespace boxwood
