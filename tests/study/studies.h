#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>

#include "store/store.h"
#include "study/run_study.h"
#include "study/study_file.h"

namespace boxwood::testing {

/// A store in a folder of its own, gone when the test is.
class TemporaryStore {
 public:
  TemporaryStore() {
    std::string name = (std::filesystem::temp_directory_path() / "boxwood-study-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~TemporaryStore() { std::filesystem::remove_all(folder_); }
  TemporaryStore(const TemporaryStore&) = delete;
  TemporaryStore& operator=(const TemporaryStore&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  Store open() const { return Store(folder_ / "store.sqlite", Store::Mode::create_or_add); }

 private:
  std::filesystem::path folder_;
};

}  // namespace boxwood::testing
