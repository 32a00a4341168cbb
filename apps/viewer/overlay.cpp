// What is drawn over a picture: boxes of a tree level, and the nodes that a picked ray met.
#include <imgui.h>

#include <algorithm>

#include "app.h"
#include "logic/projection.h"

namespace boxwood::viewer {
namespace {

constexpr std::size_t most_boxes = 1000;
// Dear ImGui counts the vertices of a list in 16 bits. What is beyond is not drawn: boxes come the largest first.
constexpr int most_vertices = 60000;

/// From blue over green and yellow to red.
ImU32 heat_color(float heat, float opacity) {
  const auto ramp = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
  const float red = ramp(2 * heat - 0.5f), green = ramp(heat < 0.6f ? 2.5f * heat : 2.5f * (1 - heat));
  const float blue = ramp(1 - 2.5f * heat);
  return ImGui::ColorConvertFloat4ToU32({red, green, blue, opacity});
}

void draw_box(ImDrawList& list, const Projection& projection, const Pane& pane, const Box& box, ImU32 color,
              float thickness) {
  for (const auto& [a, b] : box_edges) {
    const auto line = projection.line(box_corner(box, a), box_corner(box, b));
    if (!line || list.VtxBuffer.Size > most_vertices) continue;
    list.AddLine({pane.x + line->a.x, pane.y + line->a.y}, {pane.x + line->b.x, pane.y + line->b.y}, color, thickness);
  }
}

/// Draws into a pane and nowhere beside it.
template <class Draw>
void in_pane(const Pane& pane, const Draw& draw) {
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->PushClipRect({pane.x, pane.y}, {pane.x + pane.width, pane.y + pane.height});
  draw(*list);
  list->PopClipRect();
}

}  // namespace

void draw_boxes(App& app, const Pane& pane) {
  const auto built = app.built();
  if (!built) return;
  if (built->tree != app.boxes_tree_ || app.level_ != app.boxes_level_) {
    app.boxes_ = boxes_of_level(*built->tree, static_cast<std::uint32_t>(app.level_), most_boxes);
    app.boxes_tree_ = built->tree;
    app.boxes_level_ = app.level_;
  }
  const Projection projection(app.state_.settings.camera, pane.width, pane.height);
  in_pane(pane, [&](ImDrawList& list) {
    for (const LevelBox& box : app.boxes_) {
      draw_box(list, projection, pane, box.box, heat_color(box.heat, 0.75f), box.leaf ? 1.0f : 1.5f);
    }
  });
}

void draw_walk_boxes(App& app, const Pane& pane) {
  const Projection projection(app.state_.settings.camera, pane.width, pane.height);
  in_pane(pane, [&](ImDrawList& list) {
    const auto& steps = app.walk_->steps;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const WalkStep& step = steps[i];
      const bool chosen = static_cast<int>(i) == app.walk_step_;
      if (app.walk_step_ >= 0 ? !chosen : step.kind != WalkStep::Kind::entered) continue;
      const ImU32 color = chosen ? IM_COL32(255, 255, 255, 255)
                                 : heat_color(1.0f / (1.0f + 0.15f * static_cast<float>(step.depth)), 0.6f);
      draw_box(list, projection, pane, app.walk_tree_->nodes[step.node].bounds, color, chosen ? 2.5f : 1.0f);
    }
    const float t = app.walk_->hit.valid() ? app.walk_->hit.t : 0;
    if (const auto place = projection.point(app.walk_ray_.origin + app.walk_ray_.direction * t); t > 0 && place) {
      list.AddCircle({pane.x + place->x, pane.y + place->y}, 6, IM_COL32(255, 255, 255, 255), 0, 2);
    }
  });
}

}  // namespace boxwood::viewer
