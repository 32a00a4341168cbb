#include "comparison_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "console.h"
#include "expected_view.h"
#include "render/heat_scale.h"
#include "render/render.h"
#include "report/progress_bar.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

namespace fs = std::filesystem;

/// Letters and digits stay, each run of anything else becomes one dash.
std::string file_name_part(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      out += c;
    } else if (!out.empty() && out.back() != '-') {
      out += '-';
    }
  }
  while (out.ends_with('-')) out.pop_back();
  return out.substr(0, 100);
}

fs::path rendering_file(const fs::path& folder, const Scene& scene) {
  return folder / fmt::format("{}.png", file_name_part(scene.name));
}

fs::path heat_map_file(const fs::path& folder, const Scene& scene, const Recipe& recipe, std::size_t number) {
  return folder /
         fmt::format("{}-heat-{:02}-{}.png", file_name_part(scene.name), number + 1, file_name_part(recipe.text()));
}

RenderSettings settings_of(const Scene& scene, const ViewOptions& view, const char* integrator) {
  RenderSettings settings;
  settings.camera = find_camera(scene, view);
  settings.width = view.width;
  settings.height = view.height;
  settings.integrator = integrator;
  return settings;
}

}  // namespace

void check_images(const fs::path& folder, const Scene& scene, const std::vector<Recipe>& recipes, bool force) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("the folder {} cannot be made: {}", folder.string(), error.message()));
  check_can_write(rendering_file(folder, scene), force);
  for (std::size_t i = 0; i < recipes.size(); ++i) check_can_write(heat_map_file(folder, scene, recipes[i], i), force);
}

ComparisonImages write_images(const fs::path& folder, const Scene& scene, const std::vector<Recipe>& recipes,
                              const ViewOptions& view, unsigned threads) {
  ComparisonImages images;
  images.rendering = rendering_file(folder, scene).string();
  std::vector<Image> counts;
  const std::optional<ExpectedUse> use = expected_view(scene, recipes, view, threads);
  ProgressBar bar(stop_requested());
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    if (is_peer(recipes[i]) && i > 0) continue;
    if (!bar.report(static_cast<double>(i) / static_cast<double>(recipes.size()), "drawing")) throw Cancelled();
    const Structure structure = build(scene, recipes[i], {.threads = threads, .use = pointer_to(use)});
    run_in_arena(threads, [&] {
      if (i == 0) write_png(images.rendering, render(scene, structure, settings_of(scene, view, "eyelight")).image);
      if (is_peer(recipes[i])) return;
      counts.push_back(render(scene, structure, settings_of(scene, view, "heatmap")).counts);
      images.heat_maps.push_back({recipes[i].text(), heat_map_file(folder, scene, recipes[i], i).string()});
      images.scale = std::max(images.scale, usual_maximum(counts.back()));
    });
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    write_png(images.heat_maps[i].file, scaled(std::move(counts[i]), images.scale));
  }
  return images;
}

}  // namespace boxwood::cli
