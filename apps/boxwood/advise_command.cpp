// `boxwood advise`: which structure for this scene and these rays, within these limits?
#include <fmt/format.h>

#include <charconv>
#include <memory>

#include "advise/advise.h"
#include "boxwood/ray_set.h"
#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "options/options.h"
#include "options/suggest.h"
#include "report/advice_report.h"
#include "report/progress_bar.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

constexpr std::uint32_t view_size = 160;  // pixels of each of the four views, squared

struct AdviseOptions {
  CommonOptions common{.threads = 1};
  std::string scene;
  std::string rays = "primary,shadow,ao,diffuse";
  std::string save_rays;
  double memory_limit = 0, build_limit = 0, time = 60;
  bool exhaustive = false, force = false;
};

/// A number with a unit: `units` names each and what it stands for.
double parse_amount(const std::string& text, const std::vector<std::pair<std::string_view, double>>& units,
                    const char* takes) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  for (const auto& [name, factor] : units) {
    if (error == std::errc{} && unit == name && value > 0 && value < 1e15) return value * factor;
  }
  throw UsageError(fmt::format("takes {}, not '{}'", takes, text));
}

double parse_bytes(const std::string& text) {
  return parse_amount(text, {{"", 1}, {"B", 1}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}},
                      "an amount such as 500MB or 2GB");
}

double parse_seconds(const std::string& text) {
  return parse_amount(text, {{"", 1}, {"s", 1}, {"ms", 1e-3}, {"min", 60}, {"h", 3600}},
                      "a time such as 200ms, 30s or 5min");
}

std::vector<std::string> kinds_of(const std::string& text) {
  std::vector<std::string> kinds;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string kind = text.substr(begin, end - begin);
    if (std::ranges::find(ray_kinds(), kind) == ray_kinds().end()) {
      const std::vector<std::string> known(ray_kinds().begin(), ray_kinds().end());
      throw UsageError(
          fmt::format("--rays: there is no file and no kind of rays called '{}'; {}", kind, suggest(kind, known)));
    }
    kinds.push_back(kind);
    begin = end + 1;
  }
  return kinds;
}

bool is_ray_file(const std::string& text) {
  std::error_code ignored;
  return std::filesystem::exists(text, ignored);
}

int run_advise(const AdviseOptions& options) {
  const bool from_file = is_ray_file(options.rays);
  const std::vector<std::string> kinds = from_file ? std::vector<std::string>() : kinds_of(options.rays);
  if (!options.save_rays.empty()) check_can_write(options.save_rays, options.force);
  const Scene scene = load_scene(options.scene);
  if (scene.empty()) throw Error(fmt::format("{} has no triangles; there is nothing to advise on", scene.name));
  for (const std::string& note : scene_notes(scene)) complain(note);
  check_interrupt();
  AdviseSettings settings;
  settings.seconds = options.time;
  settings.limits = {options.build_limit * 1000, options.memory_limit};
  settings.threads = options.common.threads;
  settings.exhaustive = options.exhaustive;
  std::vector<Camera> cameras;
  const std::vector<RaySet> rays = from_file ? load_ray_sets(options.rays) : run_in_arena(options.common.threads, [&] {
    return rays_to_advise_for(scene, kinds, view_size, options.common.threads, cameras);
  });
  if (!options.save_rays.empty()) save_ray_sets(options.save_rays, rays);
  if (cameras.empty()) cameras = {scene.cameras.front()};
  for (const Camera& camera : cameras) settings.views.push_back({camera, view_size, view_size});
  Advice advice;
  {
    ProgressBar bar(stop_requested());
    advice = advise(scene, rays, settings, &bar);
  }
  if (options.common.json) {
    print_json(to_json(advice));
  } else {
    print(advice_text(advice, options.scene));
  }
  return advice.interrupted ? exit_interrupted : exit_done;
}

}  // namespace

void add_advise(CommandSet& commands) {
  const auto options = std::make_shared<AdviseOptions>();
  Command command = commands.add("advise", "Find the structure for a scene, its rays, a memory and a build time",
                                 [options] { return run_advise(*options); });
  add_scene(command, options->scene);
  const std::vector<std::string> kinds(ray_kinds().begin(), ray_kinds().end());
  command.text("--rays", options->rays, "FILE|KINDS",
               "A file of recorded rays (compare --save-rays), or comma-separated kinds, which start from cameras in "
               "the scene's free space: " +
                   option_text::join(kinds, ", "));
  command.parsed(
      "--memory-limit", [options](const std::string& text) { options->memory_limit = parse_bytes(text); }, "BYTES",
      "Most memory of the structure, such as 500MB", "none");
  command.parsed(
      "--build-limit", [options](const std::string& text) { options->build_limit = parse_seconds(text); }, "TIME",
      "Longest build, such as 200ms", "none");
  command.parsed(
      "--time", [options](const std::string& text) { options->time = parse_seconds(text); }, "TIME",
      "About how long to search, such as 5min", "60s");
  command.flag("--exhaustive", options->exhaustive,
               "Measure every candidate on the whole scene, however long that takes; what the search is judged by");
  command.text("--save-rays", options->save_rays, "FILE", "Write the rays that were traced to a file", "none");
  command.flag("--force", options->force, "Replace files that exist");
  add_common(command, options->common);
}

}  // namespace boxwood::cli
