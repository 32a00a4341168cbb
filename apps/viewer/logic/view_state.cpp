#include "logic/view_state.h"

#include <algorithm>

#include "boxwood/recipe.h"
#include "recipe/stage.h"

namespace boxwood::viewer {
namespace {

bool same_camera(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.direction == b.direction && a.up == b.up && a.fov == b.fov && a.mirrored == b.mirrored;
}

bool same_settings(const RenderSettings& a, const RenderSettings& b) {
  return same_camera(a.camera, b.camera) && a.width == b.width && a.height == b.height &&
         a.integrator == b.integrator && a.lights == b.lights && a.depth == b.depth && a.secondary == b.secondary;
}

}  // namespace

bool operator==(const ViewState& a, const ViewState& b) {
  return a.recipes == b.recipes && a.compare == b.compare && a.order == b.order && a.frame == b.frame &&
         same_settings(a.settings, b.settings);
}

std::string with_order(const std::string& text, const std::string& order) {
  const Recipe recipe = Recipe::parse(text);
  if (order.empty()) return recipe.text();
  std::string out;
  std::string trace = "trace(order=" + order;
  for (const StageCall& call : recipe.stages()) {
    if (call.stage->kind == StageKind::peer) return recipe.text();
    if (call.stage->kind != StageKind::trace) continue;
    for (const Option& option : call.stage->options) {
      if (option.name != "order") trace += ", " + option.name + "=" + option.get(call.options);
    }
  }
  const std::string whole = recipe.text();
  const std::size_t end = whole.rfind(" > trace");
  out = end == std::string::npos ? whole : whole.substr(0, end);
  return Recipe::parse(out + " > " + trace + ")").text();
}

}  // namespace boxwood::viewer
