// `boxwood animate`: when vertices move, is it better to refit, to rebuild parts, or to rebuild all?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "boxwood/error.h"
#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "motion_comparison.h"
#include "options/suggest.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/progress_bar.h"
#include "report/table.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct AnimateOptions {
  CommonOptions common;
  ViewOptions view;
  std::vector<std::string> scenes;
  std::string recipe = "default";
  std::string motion;
  std::uint32_t frames = 24;
  double strength = 1;
  double rays_per_frame = 1e6;
  double build_price = MotionPolicy{}.build_price;
  std::uint32_t repeats = 3;
  std::vector<std::string> kinds;  ///< empty: primary, diffuse
};

void check_motion(const AnimateOptions& options) {
  const std::vector<std::string>& names = MotionFrames::motion_names();
  if (!options.motion.empty() && std::ranges::find(names, options.motion) == names.end()) {
    throw UsageError(fmt::format("--motion knows no '{}'; {}", options.motion, suggest(options.motion, names)));
  }
  const std::vector<std::string> kinds(ray_kinds().begin(), ray_kinds().end());
  for (const std::string& kind : options.kinds) {
    if (std::ranges::find(kinds, kind) != kinds.end()) continue;
    throw UsageError(fmt::format("--rays knows no kind '{}'; {}", kind, suggest(kind, kinds)));
  }
}

std::string break_even_text(double rays) {
  if (std::isinf(rays)) return "never";
  return rays == 0 ? "always" : significant(rays * 1e-6) + " M";
}

std::string motion_text(const MotionFrames& frames, const MotionComparison& comparison, const AnimateOptions& options) {
  const Scene& scene = frames.rest();
  std::string out = fmt::format("{}: {}, {}\n{}\n\n", scene.name, counted(scene.placed_triangles(), "triangle"),
                                counted(frames.count(), "frame"), Recipe::parse(options.recipe).text());
  Table table({{"way", Align::left},
               {"update ms"},
               {"Mrays/s"},
               {"SAH ratio"},
               {"at the end"},
               {"rebuilt"},
               {"frame ms"},
               {"beats refit from"}});
  for (const MotionRow& row : comparison.rows) {
    table.add({row.way, with_interval(row.update_ms), with_interval(row.mrays_per_s), significant(row.mean_sah_ratio),
               significant(row.last_sah_ratio), fmt::format("{:.0f} %", 100 * row.rebuilt_share),
               significant(row.frame_ms), row.way == "refit" ? "" : break_even_text(row.pays_from_rays)});
  }
  out += table.text();
  out += fmt::format(
      "\nSAH ratio: cost over that of a new build of the recipe, mean over frames. Frame: the update and {} rays.\n"
      "Beats refit from: so many rays per frame make up for the longer update.\n",
      significant(options.rays_per_frame, 1));
  if (!comparison.reason.empty()) out += fmt::format("\nNot everything could be refitted: {}.\n", comparison.reason);
  for (const MotionRow& row : comparison.rows) {
    if (row.mismatches > 0) out += fmt::format("\n{} ANSWERS DIFFER IN {} RAYS.\n", row.way, grouped(row.mismatches));
  }
  return out;
}

Json motion_json(const MotionFrames& frames, const MotionComparison& comparison, const AnimateOptions& options) {
  Json rows = Json::array();
  for (const MotionRow& row : comparison.rows) {
    rows.push_back({{"way", row.way},
                    {"recipe", row.recipe},
                    {"update_ms", to_json(row.update_ms)},
                    {"mrays_per_s", to_json(row.mrays_per_s)},
                    {"mean_sah_ratio", row.mean_sah_ratio},
                    {"last_sah_ratio", row.last_sah_ratio},
                    {"rebuilt_share", row.rebuilt_share},
                    {"frame_ms", row.frame_ms},
                    {"pays_from_rays_per_frame", row.pays_from_rays},
                    {"mismatches", row.mismatches},
                    {"frames",
                     {{"update_ms", row.frame_update_ms},
                      {"mrays_per_s", row.frame_mrays_per_s},
                      {"sah_cost", row.frame_sah_cost}}}});
  }
  return {{"scene", frames.rest().name},
          {"triangles", frames.rest().placed_triangles()},
          {"frames", frames.count()},
          {"rays_traced_per_frame", comparison.rays},
          {"rays_per_frame", options.rays_per_frame},
          {"threads", options.common.threads},
          {"reason", comparison.reason},
          {"rows", std::move(rows)}};
}

MotionSettings motion_settings(const AnimateOptions& options, const Scene& rest) {
  MotionSettings settings;
  settings.recipe = options.recipe;
  settings.rays_per_frame = options.rays_per_frame;
  settings.build_price = options.build_price;
  settings.threads = options.common.threads;
  settings.repeats = options.repeats;
  settings.kinds = options.kinds;
  if (settings.kinds.empty()) settings.kinds = {"primary", "diffuse"};
  settings.rays.camera = find_camera(rest, options.view);
  settings.rays.width = options.view.width;
  settings.rays.height = options.view.height;
  return settings;
}

int run_animate(const AnimateOptions& options) {
  check_motion(options);
  Recipe::parse(options.recipe);
  const MotionFrames frames(options.scenes, options.motion, options.frames, options.strength);
  for (const std::string& note : scene_notes(frames.rest())) complain(note);
  check_interrupt();
  const MotionSettings settings = motion_settings(options, frames.rest());
  MotionComparison comparison;
  {
    ProgressBar bar(stop_requested());
    comparison = compare_motion(frames, settings, &bar);
  }
  if (options.common.json) {
    print_json(motion_json(frames, comparison, options));
  } else {
    print(motion_text(frames, comparison, options));
  }
  const bool alike = std::ranges::all_of(comparison.rows, [](const MotionRow& row) { return row.mismatches == 0; });
  return alike ? exit_done : exit_failed;
}

}  // namespace

void add_animate(CommandSet& commands) {
  const auto options = std::make_shared<AnimateOptions>();
  options->common.threads = 1;
  options->view.width = options->view.height = 256;
  Command command = commands.add("animate", "Follow a scene that moves: refit, rebuild parts, or rebuild all",
                                 [options] { return run_animate(*options); });
  command.arguments("SCENE", options->scenes, "A scene to be deformed, or one file for each frame");
  add_recipe(command, options->recipe);
  command.text("--motion", options->motion, "NAME", "twist, wave or explode, of one scene", "twist");
  command.integer("--frames", options->frames, 1, 100000, "Frames that the motion takes");
  command.real("--strength", options->strength, 0, 1000, "How far it goes: turns, or sizes of a mesh");
  command.real("--rays-per-frame", options->rays_per_frame, 0, 1e15, "What the policy expects to be traced");
  command.real("--build-price", options->build_price, 1e-6, 1e9,
               "What the policy takes a build to cost per triangle, in node visits and triangle tests");
  command.list("--rays", options->kinds, "KINDS", "Kinds of rays that are traced to measure", "primary,diffuse");
  command.integer("--repeat", options->repeats, 1, 1000, "Timed passes over the rays of each frame");
  add_view(command, options->view);
  add_common(command, options->common);
}

}  // namespace boxwood::cli
