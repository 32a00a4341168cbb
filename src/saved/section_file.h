#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saved/mapped_file.h"

namespace boxwood {

/// What a section of a saved structure holds; the number stands in files.
enum class SectionKind : std::uint32_t { recipe = 1, report = 2, facts = 3, nodes = 4, leaves = 5 };

struct Section {
  SectionKind kind{};
  std::span<const std::byte> bytes;
};

/// A file of sections, each with a checksum and on a cache line border; docs/saved-structures.md has every byte.
void write_sections(const std::filesystem::path& file, std::span<const Section> sections);

/// Maps one. The header and the table of sections are always checked, and that they fill the file exactly; `verify`:
/// the sections' checksums too, which reads every byte. Throws Error naming the file and what is wrong.
class SectionFile {
 public:
  SectionFile(const std::filesystem::path& file, bool verify);

  /// The next section, which must be of that kind.
  std::span<const std::byte> next(SectionKind kind);
  bool at_end() const { return position_ == sections_.size(); }
  const std::shared_ptr<const void>& owner() const { return mapped_.owner; }
  [[noreturn]] void fail(std::string_view problem) const;

 private:
  std::string name_;
  MappedFile mapped_;
  std::vector<Section> sections_;
  std::size_t position_ = 0;
};

}  // namespace boxwood
