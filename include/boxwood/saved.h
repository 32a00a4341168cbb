#pragma once
#include <filesystem>

#include "boxwood/structure.h"

namespace boxwood {

enum class Verification {
  /// Every byte against its checksum, and every node, leaf and triangle number against the arrays they refer to: what
  /// loads can be traced without leaving its memory, whoever made the file. Reads the whole file; O(bytes).
  full,
  /// Only the header and the table of sections; O(levels), whatever the size: pages are read when rays touch them. For
  /// files that you wrote yourself and trust: tracing a damaged one may give wrong answers or end the program.
  header,
};

struct LoadOptions {
  Verification verification = Verification::full;
};

/// Writes a structure to a file, which appears under its name only once it is complete. Byte for byte what the kernels
/// read, so that it can be mapped; docs/saved-structures.md has the format. The layouts `binary`, `wide` and
/// `compressed` can be saved, on one level or two; the last with its mesh, which it refers to. Throws UsageError for
/// others, Error when the file cannot be written.
void save(const Structure& structure, const std::filesystem::path& file);

/// Whether save() takes it.
bool can_save(const Structure& structure);

/// Maps a saved structure. It answers as the one that was saved, to the bit; its report() is that of the build. The
/// file must stay as it is while the structure, or a copy of it, lives (replacing it, as save() does, is fine). Throws
/// Error naming the file and what is wrong with it.
Structure load_structure(const std::filesystem::path& file, const LoadOptions& options = {});

/// Throws Error, saying what differs, when the meshes or instances of `scene` are not as many as those that `structure`
/// was built from: its hits would then name triangles that are not there. Passes any structure that cannot be saved.
void check_fits(const Structure& structure, const Scene& scene);

}  // namespace boxwood
