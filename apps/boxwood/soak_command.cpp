// `boxwood soak`: random recipes on random scenes against brute force, for as long as one likes.
#include <fmt/format.h>

#include <memory>

#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/progress_bar.h"
#include "shared_options.h"
#include "soak/soak.h"

namespace boxwood::cli {
namespace {

struct SoakOptions {
  std::uint32_t seed = 1, first = 0, cases = 0, rays = 200;
  double seconds = 30;
  bool json = false;
};

std::string soak_text(const SoakResult& result, const SoakOptions& options) {
  std::string out;
  for (const SoakFailure& failure : result.failures) {
    out += fmt::format("{} on {}: {}\n  again: boxwood soak --seed {} --first {} --cases 1 --rays {}\n", failure.recipe,
                       failure.scene, failure.what, options.seed, failure.number, options.rays);
  }
  for (const auto& [sentence, times] : result.refusals) out += fmt::format("{} refused: {}\n", times, sentence);
  return out + fmt::format("{}, {}, {}\n", counted(result.cases, "case"), counted(result.rays, "ray"),
                           counted(result.failures.size(), "disagreement"));
}

Json soak_json(const SoakResult& result) {
  Json failures = Json::array();
  for (const SoakFailure& failure : result.failures) {
    failures.push_back(
        {{"case", failure.number}, {"scene", failure.scene}, {"recipe", failure.recipe}, {"what", failure.what}});
  }
  return {{"cases", result.cases}, {"rays", result.rays}, {"refusals", result.refusals}, {"failures", failures}};
}

int run_soak(const SoakOptions& options) {
  SoakSettings settings;
  settings.seed = options.seed;
  settings.first = options.first;
  settings.cases = options.cases;
  settings.seconds = options.seconds;
  settings.rays = options.rays;
  SoakResult result;
  {
    ProgressBar bar(stop_requested());
    result = soak(settings, &bar);
  }
  if (options.json) {
    print_json(soak_json(result));
  } else {
    print(soak_text(result, options));
  }
  return result.failures.empty() ? exit_done : exit_failed;
}

}  // namespace

void add_soak(CommandSet& commands) {
  const auto options = std::make_shared<SoakOptions>();
  Command command = commands.add("soak", "Check random recipes on random scenes and rays against brute force",
                                 [options] { return run_soak(*options); });
  command.integer("--seed", options->seed, 0, 0xffffffff, "What cases are made from");
  command.integer("--first", options->first, 0, 0xffffffff, "Number of the first case");
  command.integer("--cases", options->cases, 0, 0xffffffff, "Most cases; 0: as many as there is time for");
  command.real("--seconds", options->seconds, 0.1, 1e7, "When to stop");
  command.integer("--rays", options->rays, 1, 1'000'000, "Rays per case");
  add_json(command, options->json);
}

}  // namespace boxwood::cli
