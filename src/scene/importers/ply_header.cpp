// The header of a PLY file: Turk 1994, "The PLY Polygon File Format".
#include "scene/importers/ply_header.h"

#include <fmt/format.h>

#include <charconv>

#include "scene/importers/text_file.h"

namespace boxwood {
namespace {

PlyType parse_type(TextCursor& cursor) {
  constexpr std::string_view names[8][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                            {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                            {"float", "float32"}, {"double", "float64"}};
  const std::string_view word = cursor.word();
  for (std::size_t i = 0; i < 8; ++i) {
    if (word == names[i][0] || word == names[i][1]) return static_cast<PlyType>(i);
  }
  cursor.fail(fmt::format("'{}' is no PLY type; valid are char, uchar, short, ushort, int, uint, float and double",
                          word.substr(0, 40)));
}

PlyFormat parse_format(TextCursor& cursor) {
  const std::string_view word = cursor.word();
  if (word == "ascii") return PlyFormat::ascii;
  if (word == "binary_little_endian") return PlyFormat::binary_little_endian;
  if (word == "binary_big_endian") return PlyFormat::binary_big_endian;
  cursor.fail(fmt::format("'{}' is no PLY format; valid are ascii, binary_little_endian and binary_big_endian",
                          word.substr(0, 40)));
}

PlyElement parse_element(TextCursor& cursor) {
  PlyElement element;
  element.name = cursor.word();
  const std::string_view count = cursor.word();
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (element.name.empty() || count.empty() || error != std::errc{} || end != count.data() + count.size()) {
    cursor.fail("expected 'element NAME COUNT'");
  }
  return element;
}

PlyProperty parse_property(TextCursor& cursor) {
  PlyProperty property;
  TextCursor ahead = cursor;
  property.is_list = ahead.word() == "list";
  if (property.is_list) {
    cursor = ahead;
    property.count_type = parse_type(cursor);
    if (property.count_type >= PlyType::float32) cursor.fail("the length of a list must have a whole-number type");
  }
  property.type = parse_type(cursor);
  property.name = cursor.word();
  if (property.name.empty()) cursor.fail("expected 'property TYPE NAME'");
  return property;
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[8] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(std::string_view text, const std::string& file) {
  TextCursor cursor(text, file);
  if (cursor.word() != "ply") cursor.fail("does not begin with 'ply', so it is no PLY file; check what it is");
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    cursor.next_line();
    if (cursor.at_end()) cursor.fail("the header has no 'end_header'; the file is incomplete, get it again");
    const std::string_view keyword = cursor.word();
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") {
      continue;
    } else if (keyword == "format") {
      header.format = parse_format(cursor);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(parse_element(cursor));
    } else if (keyword == "property") {
      if (header.elements.empty()) cursor.fail("a property must follow the element that it belongs to");
      header.elements.back().properties.push_back(parse_property(cursor));
    } else if (keyword == "end_header") {
      break;
    } else {
      cursor.fail(fmt::format("'{}' is no PLY header keyword", keyword.substr(0, 40)));
    }
  }
  if (!has_format) cursor.fail("the header does not name its format; add 'format ascii 1.0' or what it is");
  cursor.next_line();
  header.bytes = cursor.position();
  header.lines = cursor.line() - 1;
  return header;
}

}  // namespace boxwood
