#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

namespace boxwood {

/// The bytes of a whole file, mapped and read only, aligned to pages. Kept by `owner`.
struct MappedFile {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;
};

/// Throws Error naming the file and the cause. O(1): pages are read when they are touched. Later changes to the file
/// may show; one that is cut short under the mapping ends the program when it is touched (SIGBUS).
MappedFile map_file(const std::filesystem::path& file);

}  // namespace boxwood
