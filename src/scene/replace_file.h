#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>

namespace boxwood {

/// Writes a file beside `file` and renames it over it once it is complete; an existing file is never half replaced.
/// Throws Error naming the file.
void replace_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace boxwood
