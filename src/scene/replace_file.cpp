#include "scene/replace_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <fstream>

#include "boxwood/error.h"

namespace boxwood {

void replace_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  static std::atomic<unsigned> serial{0};
  std::filesystem::path temporary = file;
  temporary += fmt::format(".partial-{}-{}", getpid(), serial++);
  std::ofstream out(temporary, std::ios::binary);
  if (out) write(out);
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(temporary, file, error);
  if (out && !error) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw Error(fmt::format("{}: cannot be written; choose another place or free some space", file.string()));
}

}  // namespace boxwood
