#pragma once
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "boxwood/error.h"
#include "fuzz/targets.h"

namespace boxwood::fuzz {

/// Ends the program, as libFuzzer expects it of what was found.
inline void require(bool holds, std::string_view what) {
  if (holds) return;
  std::fprintf(stderr, "found: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

/// A folder of this process for files that readers want by name; it goes with the process.
const std::filesystem::path& scratch();

inline std::filesystem::path write_file(const char* name, Bytes bytes) {
  const std::filesystem::path file = scratch() / name;
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return file;
}

/// Runs a reader. A refusal must be one sentence.
template <class Read>
void accept_or_refuse(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string_view what = error.what();
    require(!what.empty() && what.find('\n') == what.npos, "a refusal that is no sentence");
  }
}

inline std::string text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

}  // namespace boxwood::fuzz
