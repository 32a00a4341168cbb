#include "workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "options/suggest.h"
#include "recipe/stage.h"
#include "report/number_text.h"
#include "scene/generators.h"

namespace boxwood::cli {
namespace {

namespace fs = std::filesystem;

bool is_generator(std::string_view text) {
  const std::string_view name = text.substr(0, text.find('('));
  return std::any_of(generators().begin(), generators().end(),
                     [&](const Generator& generator) { return generator.name == name; });
}

}  // namespace

Scene load_scene(const std::string& path_or_generator) {
  std::error_code ignored;
  if (!path_or_generator.starts_with("generate:") && !fs::exists(path_or_generator, ignored)) {
    if (is_generator(path_or_generator)) {
      throw UsageError(fmt::format("there is no file '{}'; to generate that scene write generate:{}", path_or_generator,
                                   path_or_generator));
    }
    throw Error(fmt::format("there is no scene file '{}'; 'boxwood scenes' lists what can be generated or installed",
                            path_or_generator));
  }
  return load(path_or_generator);
}

const Camera& find_camera(const Scene& scene, const ViewOptions& view) {
  if (view.camera.empty()) return scene.cameras.front();
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) {
    if (camera.name == view.camera) return camera;
    names.push_back(camera.name);
  }
  throw UsageError(fmt::format("{} has no camera '{}'; {}", scene.name, view.camera, suggest(view.camera, names)));
}

std::vector<Recipe> parse_recipes(const std::vector<std::string>& texts) {
  std::vector<Recipe> recipes;
  recipes.reserve(texts.size());
  for (const std::string& text : texts) recipes.push_back(Recipe::parse(text));
  return recipes;
}

bool is_peer(const Recipe& recipe) { return recipe.stages().front().stage->kind == StageKind::peer; }

void check_can_write(const fs::path& file, bool force) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    throw UsageError(fmt::format("{} is a folder; name a file in it", file.string()));
  }
  if (!force && fs::exists(file, ignored)) {
    throw UsageError(fmt::format("{} exists; add --force to replace it, or name another file", file.string()));
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw UsageError(fmt::format("{} cannot be written because there is no folder {}; make it first", file.string(),
                                 folder.string()));
  }
}

void check_can_write_image(const fs::path& file, bool force) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".png" && extension != ".exr") {
    throw UsageError(fmt::format("{} is no picture that can be written; end its name in .png or .exr", file.string()));
  }
  check_can_write(file, force);
}

std::vector<std::string> scene_notes(const Scene& scene) {
  std::vector<std::string> notes = scene.notes.messages;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count == 0) return;
    notes.push_back(fmt::format("{}: {} {} {}; left out of every build", scene.name, counted(count, "triangle"),
                                count == 1 ? "is" : "are", what));
  };
  add(scene.notes.degenerate_triangles, "degenerate (of no area)");
  add(scene.notes.non_finite_triangles, "not finite or beyond 1e12");
  return notes;
}

}  // namespace boxwood::cli
