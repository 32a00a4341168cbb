// Renderings and heat maps; the script lays two of a scene over each other.
#include <fmt/format.h>

#include <algorithm>

#include "report/html/markup.h"
#include "report/html/sections.h"

namespace boxwood::html {
namespace {

std::string label(const StoredPicture& picture) {
  return escaped(picture.recipe.empty() ? picture.kind : fmt::format("{}: {}", picture.kind, picture.recipe));
}

std::string scene_html(const std::string& scene, const std::vector<StoredPicture>& pictures) {
  std::string out = fmt::format("<div class=\"pictures\"><h3>{}</h3><div class=\"gallery\">\n", escaped(scene));
  for (const StoredPicture& picture : pictures) {
    if (picture.scene != scene) continue;
    out += fmt::format(
        "<figure><img alt=\"{0}, {1}\" data-label=\"{1}\" src=\"{2}\"><figcaption>{1}</figcaption></figure>\n",
        escaped(scene), label(picture), data_uri("image/png", picture.png));
  }
  return out + "</div></div>\n";
}

}  // namespace

std::string pictures_section(const StudyResult& result, const std::string& prefix) {
  if (result.pictures.empty()) return "";
  std::string out = fmt::format(
      "<section id=\"{}-pictures\"><h2>Pictures</h2><p>What each ray costs, on one scale per scene: "
      "green inner nodes visited, red triangles tested; primitive tests alone in grey, on a scale of their own.</p>\n",
      prefix);
  std::vector<std::string> scenes;
  for (const StoredPicture& picture : result.pictures) {
    if (std::ranges::find(scenes, picture.scene) == scenes.end()) scenes.push_back(picture.scene);
  }
  for (const std::string& scene : scenes) out += scene_html(scene, result.pictures);
  return out + "</section>\n";
}

}  // namespace boxwood::html
