// What ImGui shows beside the pictures: settings and figures, help, the steps of a picked ray.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "app.h"
#include "boxwood/error.h"
#include "boxwood/recipe.h"
#include "recipe/stage.h"
#include "render/integrator.h"

namespace boxwood::viewer {
namespace {

void text(const std::string& line) { ImGui::TextUnformatted(line.c_str()); }

void tip(std::string_view help) {
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%.*s", static_cast<int>(help.size()), help.data());
}

/// A list to choose from; true when another entry was taken.
template <class Range, class Name, class Help>
bool choose(const char* label, std::string& current, const Range& range, Name name, Help help) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, current.c_str())) return false;
  for (const auto& item : range) {
    const std::string entry(name(item));
    if (ImGui::Selectable(entry.c_str(), entry == current)) {
      changed = entry != current;
      current = entry;
    }
    tip(help(item));
  }
  ImGui::EndCombo();
  return changed;
}

/// A recipe to type, with the ones that were given and the presets to choose from.
void recipe_field(const char* label, std::string& recipe, const std::vector<std::string>& known) {
  ImGui::PushID(label);
  static std::map<std::string, std::string> typed;
  std::string& edited = typed.try_emplace(label, recipe).first->second;
  if (!ImGui::IsAnyItemActive()) edited = recipe;
  ImGui::SetNextItemWidth(-70);
  if (ImGui::InputText("##text", &edited, ImGuiInputTextFlags_EnterReturnsTrue)) recipe = edited;
  tip("a recipe; Enter builds it");
  ImGui::SameLine();
  if (ImGui::BeginCombo(label, "", ImGuiComboFlags_NoPreview)) {
    for (const std::string& entry : known) {
      if (ImGui::Selectable(entry.c_str())) recipe = entry;
    }
    for (const Preset& preset : presets()) {
      if (ImGui::Selectable(preset.name.c_str())) recipe = preset.name;
      tip(text_here(preset));
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
}

/// In the column beside the pictures where there is one, from `top` to `bottom` as shares of the window; else anywhere
/// over them, at first at `corner`.
void place_window(float column, float top, float bottom, ImVec2 corner, ImVec2 size) {
  if (column == 0) {
    ImGui::SetNextWindowPos(corner, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(size, ImGuiCond_FirstUseEver);
    return;
  }
  const float height = ImGui::GetIO().DisplaySize.y;
  ImGui::SetNextWindowPos({0, top * height});
  ImGui::SetNextWindowSize({column, (bottom - top) * height});
}

void figures(const Picture& picture) {
  text(fmt::format("{:.1f} ms a frame, {:.2f} Mrays/s per thread", picture.frame_ms, picture.mrays_per_s));
  text(fmt::format("built in {:.1f} ms, {:.1f} bytes per triangle", picture.build.build_ms,
                   picture.build.primitives
                       ? static_cast<double>(picture.build.bytes) / static_cast<double>(picture.build.primitives)
                       : 0.0));
  text(picture.divisor > 1 ? fmt::format("one pixel for {0} x {0}", picture.divisor)
                           : fmt::format("{} samples per pixel", picture.samples));
}

}  // namespace

void draw_panel(App& app) {
  place_window(app.panel_column(), 0, app.walk_ ? 0.6f : 1, {12, 12}, {400, 460});
  ImGui::Begin("Boxwood (h: help)");
  const Scene& scene = app.frames_[app.state_.frame];
  text(fmt::format("{}: {} triangles", scene.name, scene.placed_triangles()));
  text(app.painter_.activity());
  if (const std::string trouble = app.painter_.trouble(); !trouble.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 0.5f, 0.4f, 1));
    ImGui::TextWrapped("%s", trouble.c_str());
    ImGui::PopStyleColor();
  }
  if (app.pictures_[0]) figures(*app.pictures_[0]);
  ImGui::Separator();

  recipe_field("recipe", app.state_.recipes[0], app.options_.recipes);
  ImGui::Checkbox("compare with", &app.state_.compare);
  if (app.state_.compare) {
    recipe_field("second", app.state_.recipes[1], app.options_.recipes);
    if (app.pictures_[1]) figures(*app.pictures_[1]);
    ImGui::SliderFloat("gain of the difference", &app.gain_, 1, 64, "%.0f", ImGuiSliderFlags_Logarithmic);
    text(app.difference_.pixels == 0
             ? "the pictures are the same to the bit"
             : fmt::format("{} pixels differ, by {:.3g} at most", app.difference_.pixels, app.difference_.largest));
  }
  ImGui::Separator();
  choose(
      "integrator", app.state_.settings.integrator, integrators(), [](const auto& i) { return i.name; },
      [](const auto& i) { return i.summary; });
  choose(
      "lights", app.state_.settings.lights, light_settings(), [](const auto& l) { return l.name; },
      [](const auto& l) { return l.summary; });
  constexpr const char* orders[] = {"", "near", "axis", "none"};
  std::string shown = app.state_.order.empty() ? "as the recipe says" : app.state_.order;
  if (ImGui::BeginCombo("order", shown.c_str())) {
    for (const char* order : orders) {
      if (ImGui::Selectable(*order ? order : "as the recipe says", app.state_.order == order)) app.state_.order = order;
    }
    ImGui::EndCombo();
  }
  bool first_person = app.control_.scheme == CameraScheme::first_person;
  if (ImGui::Checkbox("first person", &first_person)) app.act(Action::switch_scheme);
  ImGui::Separator();

  ImGui::Checkbox("boxes of level", &app.show_boxes_);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(120);
  ImGui::SliderInt("##level", &app.level_, 0, 40);
  if (app.show_boxes_) text(fmt::format("{} boxes, blue cheap, red expensive", app.boxes_.size()));
  int transfer = static_cast<int>(app.transfer_);
  ImGui::RadioButton("texture upload", &transfer, 0);
  ImGui::SameLine();
  ImGui::RadioButton("pixel buffer", &transfer, 1);
  app.transfer_ = static_cast<Transfer>(transfer);
  text(fmt::format("transfer: texture upload {:.2f} ms, pixel buffer {:.2f} ms", app.transfer_ms_[0],
                   app.transfer_ms_[1]));
  if (app.frames_.size() > 1) {
    ImGui::Separator();
    int frame = static_cast<int>(app.state_.frame);
    ImGui::SliderInt("frame", &frame, 0, static_cast<int>(app.frames_.size()) - 1);
    app.state_.frame = static_cast<std::size_t>(frame);
    ImGui::Checkbox("play", &app.playing_);
    ImGui::SameLine();
    ImGui::SliderFloat("frames/s", &app.frames_per_second_, 1, 60, "%.0f");
  }
  if (!app.message_.empty()) {
    ImGui::Separator();
    ImGui::TextWrapped("%s", app.message_.c_str());
  }
  ImGui::End();
}

void draw_help(App& app) {
  ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x / 2, ImGui::GetIO().DisplaySize.y / 2),
                          ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  ImGui::Begin("Keys and mouse", &app.help_, ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::BeginTable("keys", 2)) {
    for (const KeyBinding& binding : key_bindings()) {
      ImGui::TableNextColumn();
      text(binding.key == ' ' ? "space" : std::string(1, binding.key));
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(binding.help.data(), binding.help.data() + binding.help.size());
    }
    const std::pair<const char*, const char*> mouse[] = {{"left drag", "turn"},
                                                         {"right drag", "move sideways"},
                                                         {"wheel", "zoom"},
                                                         {"click", "walk the ray of that pixel"},
                                                         {"shift", "move four times as fast"}};
    for (const auto& [what, does] : mouse) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(what);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(does);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

void draw_walk(App& app) {
  bool open = true;
  place_window(app.panel_column(), 0.6f, 1, {ImGui::GetIO().DisplaySize.x - 392, 12}, {380, 420});
  ImGui::Begin("A ray's way through the tree", &open);
  const RayWalk& walk = *app.walk_;
  text(fmt::format("{} node tests, {} met; {} leaves, {} triangle tests", walk.node_tests, walk.node_hits, walk.leaves,
                   walk.primitive_tests));
  text(walk.hit.valid() ? fmt::format("hits triangle {} at t = {:.6g}", walk.hit.primitive, walk.hit.t)
                        : std::string("hits nothing"));
  ImGui::SliderInt("step", &app.walk_step_, -1, static_cast<int>(walk.steps.size()) - 1,
                   app.walk_step_ < 0 ? "all" : "%d");
  ImGui::BeginChild("steps");
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(walk.steps.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      ImGui::PushID(i);
      if (ImGui::Selectable(describe(walk.steps[static_cast<std::size_t>(i)]).c_str(), i == app.walk_step_)) {
        app.walk_step_ = i;
      }
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
  ImGui::End();
  if (!open) app.walk_.reset();
}

}  // namespace boxwood::viewer
