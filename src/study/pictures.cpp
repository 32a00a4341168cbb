#include "study/pictures.h"

#include <algorithm>

#include "render/heat_scale.h"
#include "render/png.h"
#include "render/render.h"
#include "study/run_study.h"

namespace boxwood {
namespace {

constexpr std::uint32_t least_height = 360;  // quick studies trace fewer rays than anybody wants to look at

RenderSettings settings_of(const Study& study, const Camera& view, const char* integrator) {
  RenderSettings settings;
  const std::uint32_t larger = (least_height + study.run.height - 1) / study.run.height;
  settings.camera = view;
  settings.width = study.run.width * larger;
  settings.height = study.run.height * larger;
  settings.integrator = integrator;
  settings.seed = study.run.seed;
  return settings;
}

/// Grey: primitive tests alone, which the nodes visited outshine in a heat map.
Image primitive_tests_of(Image counts) {
  for (Vec3& pixel : counts.pixels) pixel = {pixel.x, pixel.x, pixel.x};
  return counts;
}

float common_scale(const std::vector<Image>& counts) {
  float scale = 0;
  for (const Image& image : counts) scale = std::max(scale, usual_maximum(image));
  return scale;
}

}  // namespace

void keep_pictures(const Study& study, const StudyScene& scene, const std::vector<PicturedRecipe>& recipes,
                   Store& store) {
  if (recipes.empty()) return;
  const std::string name = stored_name(study);
  const std::vector<StoredPicture> kept = store.pictures(name);
  const auto is_kept = [&](const std::string& label) {
    return std::ranges::any_of(
        kept, [&](const StoredPicture& picture) { return picture.scene == scene.name && picture.recipe == label; });
  };
  if (std::ranges::all_of(recipes, [&](const PicturedRecipe& recipe) { return is_kept(recipe.label); })) return;

  const Camera& view = scene.views.front();
  const auto keep = [&](const std::string& label, const char* kind, const Image& image) {
    store.keep_picture({name, scene.name, view.name, label, kind, encode_png(image)});
  };
  keep("", "rendering", render(scene.scene, *recipes.front().structure, settings_of(study, view, "eyelight")).image);
  std::vector<Image> counts, tests;
  for (const PicturedRecipe& recipe : recipes) {
    counts.push_back(render(scene.scene, *recipe.structure, settings_of(study, view, "heatmap")).counts);
    tests.push_back(primitive_tests_of(counts.back()));
  }
  const float counts_scale = common_scale(counts), tests_scale = common_scale(tests);
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    keep(recipes[i].label, "heatmap", scaled(std::move(counts[i]), counts_scale));
    keep(recipes[i].label, "primitive tests", scaled(std::move(tests[i]), tests_scale));
  }
}

}  // namespace boxwood
