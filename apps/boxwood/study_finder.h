#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace boxwood::cli {

/// A file, or the name of a study that comes with the program: beside it, or installed in share/boxwood/studies. Throws
/// UsageError naming those that are there.
std::filesystem::path find_study(const std::string& name_or_file);
std::vector<std::string> known_studies();

}  // namespace boxwood::cli
