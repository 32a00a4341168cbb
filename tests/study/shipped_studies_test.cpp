// Every study that comes with the program can be read, whole and in its short version.
#include <gtest/gtest.h>

#include <filesystem>

#include "study/study_file.h"

namespace boxwood::testing {
namespace {

TEST(ShippedStudies, CanBeReadAndRunAnywhere) {
  std::size_t studies = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BOXWOOD_SOURCE_DIR "/studies")) {
    if (entry.path().extension() != ".toml") continue;
    ++studies;
    for (const bool quick : {false, true}) {
      const Study study = read_study(entry.path(), quick);
      EXPECT_FALSE(study.title.empty()) << entry.path();
      EXPECT_FALSE(study.claims.empty()) << entry.path();
      for (const SceneSpec& scene : study.scenes) {
        // On a stranger's machine nothing but the generators is sure to be there.
        EXPECT_TRUE(scene.find.back().starts_with("generate:")) << entry.path() << " " << scene.name;
      }
    }
  }
  EXPECT_GE(studies, 1u);
}

}  // namespace
}  // namespace boxwood::testing
