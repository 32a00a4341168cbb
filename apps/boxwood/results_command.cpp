// `boxwood results`: what a store of measurements has, filtered, exported, or held against another store.
#include <fmt/format.h>

#include <memory>

#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "report/number_text.h"
#include "report/store_report.h"
#include "report/study_report.h"
#include "report/table.h"
#include "shared_options.h"
#include "store/store.h"

namespace boxwood::cli {
namespace {

struct ResultsOptions {
  std::string store, other;
  StoreFilter filter;
  std::uint32_t environment = 0;
  bool csv = false, json = false, all = false;
};

/// What is in it, without the figures.
std::string overview(const Store& store, std::span<const StoredSeries> series) {
  std::string out;
  for (const std::int64_t number : store.environments()) {
    const Environment e = store.environment(number);
    std::size_t samples = 0;
    for (const StoredSeries& s : series) samples += s.environment == number ? s.samples.size() : 0;
    if (samples == 0) continue;
    out += fmt::format("Environment {}: {}; {}; commit {}; {}\n", number, e.cpu, e.compiler, e.commit,
                       counted(samples, "value"));
  }
  return out + "\n";
}

Json store_json(const Store& store, std::span<const StoredSeries> series) {
  Json environments = Json::array();
  for (const std::int64_t number : store.environments()) {
    Json environment = {{"number", number}};
    environment.update(to_json(store.environment(number)));
    environments.push_back(std::move(environment));
  }
  return {{"environments", std::move(environments)}, {"series", series_json(series)}};
}

int run_results(const ResultsOptions& options) {
  StoreFilter filter = options.filter;
  if (options.environment > 0) filter.environment = options.environment;
  const Store store(options.store, Store::Mode::read);
  const std::vector<StoredSeries> series = stored_series(store.measurements(filter));
  if (options.other.empty()) {
    if (options.json) {
      print_json(store_json(store, series));
    } else {
      print(options.csv ? series_csv(series) : overview(store, series) + series_text(series));
    }
    return exit_done;
  }
  const Store other(options.other, Store::Mode::read);
  const std::vector<SeriesChange> all = changes(series, stored_series(other.measurements(filter)));
  if (options.json) {
    print_json({{"changes", changes_json(all)}});
  } else {
    print(options.csv ? changes_csv(all) : changes_text(all, options.all));
  }
  return exit_done;
}

}  // namespace

void add_results(CommandSet& commands) {
  const auto options = std::make_shared<ResultsOptions>();
  Command command = commands.add("results", "List, filter and export measurements, or compare two stores of them",
                                 [options] { return run_results(*options); });
  command.argument("STORE", options->store, "A file that 'boxwood study' wrote, such as study-wide-bvh/store.sqlite");
  command.text("--study", options->filter.study, "NAME", "Only of this study");
  command.text("--scene", options->filter.scene, "NAME", "Only on this scene");
  command.text("--rays", options->filter.rays, "KIND", "Only of this kind of rays");
  command.text("--recipe", options->filter.recipe, "TEXT", "Only of recipes that contain this");
  command.text("--metric", options->filter.metric, "NAME", "Only this metric");
  command.text("--probe", options->filter.probe, "NAME", "Only of this probe");
  command.integer("--environment", options->environment, 0, 1u << 30, "Only of this machine and program; 0: all");
  command.text("--compare", options->other, "STORE", "Another store: what changed from the first to it");
  command.flag("--all", options->all, "With --compare: also what did not change");
  command.flag("--csv", options->csv, "Print CSV, one line per sample");
  add_json(command, options->json);
  command.conflict("--csv", "--json");
}

}  // namespace boxwood::cli
