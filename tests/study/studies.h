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

/// Two scenes, two methods, three arities; tests make up the measurements.
inline const std::string made_up_study = R"toml(
run = { repetitions = 8, size = [8, 8] }
[[scene]]
name = "small"
find = ["small.ply"]
[[scene]]
name = "large"
find = ["large.ply"]
[[recipes]]
label = "{method} {k}"
recipe = "{method}(k={k}) > wide({k})"
values = { method = ["median", "binned"], k = [2, 4, 8] }
)toml";

/// A measurement of `probe` that such a test makes up.
inline Subject subject_of(const Study& study, const SceneSpec& scene, const RecipeSpec& recipe, const char* probe,
                          std::uint32_t repetition) {
  Subject subject;
  subject.study = study.name;
  subject.scene = scene.name;
  subject.scene_source = scene.find.front();
  subject.recipe = recipe.text;
  subject.probe = probe;
  subject.repetition = repetition;
  return subject;
}

}  // namespace boxwood::testing
