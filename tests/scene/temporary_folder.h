#pragma once
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "boxwood/error.h"
#include "boxwood/scene.h"

namespace boxwood {

/// A folder of its own for one test, with the mesh cache inside.
class TemporaryFolder : public ::testing::Test {
 protected:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "boxwood-test-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    setenv("BOXWOOD_CACHE", (folder_ / "cache").c_str(), 1);
  }
  ~TemporaryFolder() override {
    unsetenv("BOXWOOD_CACHE");
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::string path(std::string_view name) const { return (folder_ / name).string(); }

  std::string write(std::string_view name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path(name);
  }

  Scene load_text(std::string_view name, std::string_view bytes) const { return load(write(name, bytes)); }

  /// What `load` says about a file that it refuses; empty when it does not.
  std::string refusal(std::string_view name, std::string_view bytes) const {
    try {
      load_text(name, bytes);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }

 private:
  std::filesystem::path folder_;
};

/// One clear sentence: says which file, and is one line.
inline ::testing::AssertionResult is_one_sentence(const std::string& text, const std::string& file) {
  if (text.find(file) == text.npos) return ::testing::AssertionFailure() << "does not name the file: " << text;
  if (text.find('\n') != text.npos) return ::testing::AssertionFailure() << "has several lines: " << text;
  return ::testing::AssertionSuccess();
}

/// Appends values as bytes, turned round for big endian.
template <class T>
void put(std::string& bytes, T value, bool big_endian = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes.push_back(raw[big_endian ? sizeof(T) - 1 - i : i]);
}

inline const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5f}, {0, 1, 0}};

}  // namespace boxwood
