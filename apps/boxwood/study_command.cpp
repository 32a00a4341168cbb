// `boxwood study`: runs a study file, keeps every measurement, and says which claims hold.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>

#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "options/options.h"
#include "options/suggest.h"
#include "report/progress_bar.h"
#include "report/study_report.h"
#include "shared_options.h"
#include "study/run_study.h"
#include "study/study_file.h"
#include "study_finder.h"

namespace boxwood::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* store_name = "store.sqlite";

struct StudyOptions {
  std::string study;
  bool quick = false, resume = false, json = false;
  std::string out;
  std::vector<std::string> scenes;
};

fs::path prepare_folder(const StudyOptions& options, const Study& study) {
  fs::path folder = options.out.empty() ? fs::path("study-" + study.name) : fs::path(options.out);
  if (fs::exists(folder / store_name) && !options.resume) {
    throw UsageError(
        fmt::format("{} has measurements already; add --resume to go on with them, or name another folder "
                    "with --out",
                    (folder / store_name).string()));
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("the folder {} cannot be made: {}", folder.string(), error.message()));
  return folder;
}

/// --scenes, $BOXWOOD_SCENES, the study's own folder, here.
std::vector<fs::path> scene_folders(const StudyOptions& options, const fs::path& study_file) {
  std::vector<fs::path> folders(options.scenes.begin(), options.scenes.end());
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder)) throw UsageError(fmt::format("--scenes: there is no folder {}", folder.string()));
  }
  if (const char* folder = std::getenv("BOXWOOD_SCENES"); folder && *folder) folders.emplace_back(folder);
  folders.push_back(study_file.parent_path());
  folders.emplace_back(".");
  return folders;
}

int run_study_command(const StudyOptions& options) {
  const fs::path file = find_study(options.study);
  const Study study = read_study(file, options.quick);
  const fs::path folder = prepare_folder(options, study);
  StudySettings settings;
  settings.scene_folders = scene_folders(options, file);
  settings.note = [](std::string_view sentence) { complain(sentence); };
  Store store(folder / store_name, Store::Mode::create_or_add);
  std::int64_t environment = 0;
  try {
    ProgressBar bar(stop_requested());
    environment = run_study(study, store, settings, &bar);
  } catch (const Cancelled&) {
    complain(fmt::format("stopped; what was measured is in {}, go on with --resume", (folder / store_name).string()));
    return exit_interrupted;
  }
  const StudyResult result = evaluate(study, store, environment);
  write_study(folder, result);
  if (options.json) {
    print_json(to_json(result));
  } else {
    print(study_text(result));
    print(fmt::format("\nTables, plots and claims are in {}, every measurement in {}.\n", folder.string(),
                      (folder / store_name).string()));
  }
  return exit_done;
}

}  // namespace

void add_study(CommandSet& commands) {
  const auto options = std::make_shared<StudyOptions>();
  Command command = commands.add("study", "Run a study and say which of its claims hold",
                                 [options] { return run_study_command(*options); });
  command.argument("STUDY", options->study,
                   fmt::format("A study file, or one of: {}", option_text::join(known_studies(), ", ")));
  command.flag("--quick", options->quick, "The short version that the study describes: minutes, not hours");
  command.flag("--resume", options->resume, "Go on with what the folder has; measure only what is missing");
  command.text("--out", options->out, "DIR", "Folder for measurements and results", "study-NAME");
  command.repeated("--scenes", options->scenes, "DIR", "Where scene files are; also $BOXWOOD_SCENES");
  add_json(command, options->json);
}

}  // namespace boxwood::cli
