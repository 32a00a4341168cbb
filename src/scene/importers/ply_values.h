#pragma once
#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "boxwood/error.h"
#include "scene/importers/ply_header.h"
#include "scene/importers/text_file.h"

namespace boxwood {

// Two sources of PLY values with one interface, so that one loop reads both. Each knows where it is, for notes and
// errors.

/// Values as words.
class PlyWords {
 public:
  PlyWords(std::string_view text, const PlyHeader& header, const std::string& file)
      : cursor_(text, file), bytes_(text.size()) {
    while (cursor_.position() < header.bytes) cursor_.next_line();
  }

  double read(PlyType) {
    const std::string_view word = cursor_.word_across_lines();
    double value = 0;
    if (word.empty()) ended_ = true;
    if (!word.empty() && !parse_number(word, value)) {
      cursor_.fail(fmt::format("expected a number, found '{}'; mend or remove the line", word.substr(0, 40)));
    }
    return value;
  }
  /// No value takes less than a digit and a separator.
  bool can_hold(std::uint64_t values, PlyType) const { return values <= (bytes_ - cursor_.position() + 1) / 2; }
  bool ended() const { return ended_; }
  std::string place() const { return cursor_.place(); }

 private:
  TextCursor cursor_;
  std::size_t bytes_;
  bool ended_ = false;
};

/// Values as bytes in the order of `order`.
template <std::endian order>
class PlyBytes {
 public:
  PlyBytes(std::string_view bytes, const PlyHeader& header, const std::string& file)
      : bytes_(bytes), file_(file), position_(header.bytes) {}

  double read(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return static_cast<double>(take<float>());
      case PlyType::float64:
        return take<double>();
    }
    return 0;
  }
  bool can_hold(std::uint64_t values, PlyType type) const {
    return values <= (bytes_.size() - position_) / size_of(type);
  }
  bool ended() const { return ended_; }
  std::string place() const { return fmt::format("{}: byte {}", file_, position_); }

 private:
  template <class T>
  T take() {
    if (bytes_.size() - position_ < sizeof(T)) {
      ended_ = true;
      position_ = bytes_.size();
      return T{};
    }
    char raw[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      raw[i] = bytes_[position_ + (order == std::endian::native ? i : sizeof(T) - 1 - i)];
    }
    position_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  std::string_view bytes_;
  std::string file_;
  std::size_t position_;
  bool ended_ = false;
};

}  // namespace boxwood
