#include "study_finder.h"

#include <fmt/format.h>

#include <algorithm>

#include "boxwood/error.h"
#include "options/suggest.h"

namespace boxwood::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> study_folders() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  return {program / "studies", program.parent_path() / "share" / "boxwood" / "studies"};
}

}  // namespace

std::vector<std::string> known_studies() {
  std::vector<std::string> names;
  for (const fs::path& folder : study_folders()) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

fs::path find_study(const std::string& name_or_file) {
  std::error_code ignored;
  if (fs::is_regular_file(name_or_file, ignored)) return fs::absolute(name_or_file);
  for (const fs::path& folder : study_folders()) {
    fs::path file = folder / (name_or_file + ".toml");
    if (fs::is_regular_file(file, ignored)) return file;
  }
  throw UsageError(
      fmt::format("there is no study or file '{}'; {}", name_or_file, suggest(name_or_file, known_studies())));
}

}  // namespace boxwood::cli
