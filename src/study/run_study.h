#pragma once
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "boxwood/scene.h"
#include "render/progress.h"
#include "store/store.h"
#include "study/study.h"

namespace boxwood {

struct StudySettings {
  std::vector<std::filesystem::path> scene_folders;  ///< where scene files are looked for, in order
  /// Told once per scene what is worth saying: which stand-in was taken, what is wrong with the file.
  std::function<void(std::string_view)> note = [](std::string_view) {};
};

/// Measures all that the study asks for and that is not in the store yet for this machine and program. Scene by scene:
/// all recipes are built, interleaved; then, view by view, their rays are counted and timed, interleaved, after one
/// untimed pass. Every measurement is in the store before the next begins. All structures of a scene are in memory at
/// once. Throws Error for a scene that is nowhere, Cancelled when `progress` asks for it; nothing stored is lost.
/// Returns the number of the environment.
std::int64_t run_study(const Study& study, Store& store, const StudySettings& settings,
                       ProgressSink* progress = nullptr);

/// The name under which a study's measurements are stored: quick runs are kept apart.
std::string stored_name(const Study& study);
inline constexpr std::string_view quick_suffix = " (quick)";

}  // namespace boxwood
