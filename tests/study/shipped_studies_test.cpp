// Every study that comes with the program can be read, whole and in its short version.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "options/call.h"
#include "scene/generators.h"
#include "study/study_file.h"

namespace boxwood::testing {
namespace {

/// On a stranger's machine nothing but the generators is sure to be there. Throws when the options mean nothing.
bool can_be_generated(const std::string& source) {
  const std::string prefix = "generate:";
  if (!source.starts_with(prefix)) return false;
  const CallText call = parse_call_text(std::string_view(source).substr(prefix.size()));
  const auto found = std::ranges::find(generators(), call.name, &Generator::name);
  if (found == generators().end()) return false;
  std::any options = found->defaults;
  set_options(found->options, options, call);
  return true;
}

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
        SCOPED_TRACE(entry.path().string() + " " + scene.name);
        EXPECT_TRUE(can_be_generated(scene.find.back()));
      }
    }
  }
  EXPECT_GE(studies, 1u);
}

}  // namespace
}  // namespace boxwood::testing
