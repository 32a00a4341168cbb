#include "app.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "boxwood/error.h"
#include "files/output_file.h"
#include "render/camera_rays.h"
#include "render/image.h"
#include "render/integrator.h"
#include "render/png.h"
#include "scene/cameras.h"

namespace boxwood::viewer {
namespace {

constexpr float drag_threshold = 4;  // pixels; less is a click

const Camera& named_camera(const Scene& scene, const std::string& name) {
  for (const Camera& camera : scene.cameras) {
    if (name.empty() || camera.name == name) return camera;
  }
  std::string names;
  for (const Camera& camera : scene.cameras) names += (names.empty() ? "" : ", ") + camera.name;
  throw UsageError(fmt::format("the scene has no camera called '{}'; it has {}", name, names));
}

template <class Range, class Name>
std::string next_name(const Range& range, const std::string& current, Name name) {
  auto found = std::ranges::find_if(range, [&](const auto& item) { return name(item) == current; });
  if (found == range.end() || ++found == range.end()) found = range.begin();
  return std::string(name(*found));
}

}  // namespace

App::App(const std::vector<Scene>& frames, const AppOptions& options)
    : frames_(frames),
      options_(options),
      window_(options.width, options.height, fmt::format("Boxwood - {}", frames[0].name)),
      control_(named_camera(frames[0], options.camera), frames[0].bounds()),
      first_camera_(control_.camera()),
      painter_(frames, options.threads, options.samples) {
  state_.recipes = {options_.recipes[0], options_.recipes[options_.recipes.size() > 1 ? 1 : 0]};
  state_.compare = options_.recipes.size() > 1;
  state_.settings.integrator = options_.integrator;
  glfwSetWindowUserPointer(window_.handle(), this);
  // A click shorter than a frame is still one.
  glfwSetInputMode(window_.handle(), GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE);
  glfwSetCharCallback(window_.handle(), on_character);
  glfwSetScrollCallback(window_.handle(), on_scroll);
}

void App::run() {
  double last = glfwGetTime();
  while (window_.open()) {
    window_.begin_frame();
    const double time = glfwGetTime();
    const auto seconds = static_cast<float>(std::min(time - last, 0.1));
    last = time;
    move_camera(seconds);
    drag();
    advance_sequence(seconds);
    lay_out_panes();
    painter_.show(state_);
    take_pictures();

    const char* captions[] = {"", "", "difference"};
    const std::size_t panes = state_.compare ? 3 : 1;
    for (std::size_t i = 0; i < panes; ++i) {
      const char* caption = i < 2 && pictures_[i] && state_.compare ? pictures_[i]->recipe.c_str() : captions[i];
      draw_pane(panes_[i], textures_[i], caption);
    }
    for (std::size_t i = 0; i < (state_.compare ? 2u : 1u); ++i) {
      if (show_boxes_) draw_boxes(*this, panes_[i]);
      if (walk_) draw_walk_boxes(*this, panes_[i]);
    }
    if (show_panel_) draw_panel(*this);
    if (walk_) draw_walk(*this);
    if (help_) draw_help(*this);
    window_.draw();
    if (window_asked_) save_window();
    window_.show();
    if (!ready_ && pictures_[0]) {
      ready_ = true;
      say("ready; press h for the keys");
    }
  }
}

void App::on_character(GLFWwindow* window, unsigned codepoint) {
  App& app = *static_cast<App*>(glfwGetWindowUserPointer(window));
  if (ImGui::GetIO().WantTextInput || codepoint > 127) return;
  if (const auto action = action_of(static_cast<char>(codepoint))) app.act(*action);
}

void App::on_scroll(GLFWwindow* window, double, double y) {
  App& app = *static_cast<App*>(glfwGetWindowUserPointer(window));
  if (!ImGui::GetIO().WantCaptureMouse) app.control_.zoom(static_cast<float>(y));
}

void App::act(Action action) {
  RenderSettings& settings = state_.settings;
  switch (action) {
    case Action::save_camera:
      return save_camera();
    case Action::load_camera:
      return load_camera();
    case Action::save_picture:
      save_asked_ = true;
      return;
    case Action::save_window:
      window_asked_ = true;
      return;
    case Action::switch_scheme:
      control_.scheme =
          control_.scheme == CameraScheme::trackball ? CameraScheme::first_person : CameraScheme::trackball;
      return;
    case Action::next_recipe:
      state_.recipes[0] = next_name(options_.recipes, state_.recipes[0], [](const auto& r) { return r; });
      return;
    case Action::next_integrator:
      settings.integrator = next_name(integrators(), settings.integrator, [](const auto& i) { return i.name; });
      return;
    case Action::next_lights:
      settings.lights = next_name(light_settings(), settings.lights, [](const auto& l) { return l.name; });
      return;
    case Action::next_order: {
      static const std::vector<std::string> orders{"", "near", "axis", "none"};
      state_.order = next_name(orders, state_.order, [](const auto& o) { return o; });
      return;
    }
    case Action::compare:
      state_.compare = !state_.compare;
      return;
    case Action::show_boxes:
      show_boxes_ = !show_boxes_;
      return;
    case Action::deeper:
      ++level_;
      return;
    case Action::shallower:
      level_ = std::max(0, level_ - 1);
      return;
    case Action::play:
      playing_ = !playing_ && frames_.size() > 1;
      return;
    case Action::next_frame:
      state_.frame = (state_.frame + 1) % frames_.size();
      return;
    case Action::reset_camera:
      control_ = CameraControl(first_camera_, frames_[0].bounds());
      return;
    case Action::panel:
      show_panel_ = !show_panel_;
      return;
    case Action::help:
      help_ = !help_;
      return;
    default:
      return;  // keys that are held down
  }
}

void App::move_camera(float seconds) {
  if (!ImGui::GetIO().WantCaptureKeyboard) {
    const auto held = [&](int key) { return glfwGetKey(window_.handle(), key) == GLFW_PRESS; };
    const MoveKeys keys{held(GLFW_KEY_W), held(GLFW_KEY_S), held(GLFW_KEY_A),
                        held(GLFW_KEY_D), held(GLFW_KEY_E), held(GLFW_KEY_Q)};
    if (keys.any()) control_.move(keys, seconds, held(GLFW_KEY_LEFT_SHIFT) ? 4.0f : 1.0f);
  }
  state_.settings.camera = control_.camera();
}

void App::drag() {
  double x = 0, y = 0;
  glfwGetCursorPos(window_.handle(), &x, &y);
  const auto px = static_cast<float>(x), py = static_cast<float>(y);
  const float right = (px - mouse_x_) / panes_[0].height, down = (py - mouse_y_) / panes_[0].height;
  mouse_x_ = px, mouse_y_ = py;
  const bool left_button = glfwGetMouseButton(window_.handle(), GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  const bool other_button = glfwGetMouseButton(window_.handle(), GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS ||
                            glfwGetMouseButton(window_.handle(), GLFW_MOUSE_BUTTON_MIDDLE) == GLFW_PRESS;
  if (ImGui::GetIO().WantCaptureMouse && !pressed_) return;
  if (left_button && !pressed_) {
    pressed_ = true, dragged_ = false;
    press_x_ = px, press_y_ = py;
    return;
  }
  if (pressed_ && std::hypot(px - press_x_, py - press_y_) > drag_threshold) dragged_ = true;
  if (pressed_ && !left_button) {
    pressed_ = false;
    if (!dragged_) pick(px, py);
  } else if (left_button && dragged_) {
    control_.turn(right, down);
  } else if (other_button) {
    control_.pan(right, down);
  }
}

void App::pick(float x, float y) {
  for (int side = 0; side < (state_.compare ? 2 : 1); ++side) {
    const Pane& pane = panes_[side];
    if (!pane.holds(x, y)) continue;
    const auto built = painter_.built(side);
    if (!built || built->tree->empty()) return say("this structure's nodes cannot be seen, so no ray walks them");
    const auto width = static_cast<std::uint32_t>(pane.width), height = static_cast<std::uint32_t>(pane.height);
    const CameraRays rays(state_.settings.camera, width, height, 1, 1);
    walk_ray_ = rays.ray(static_cast<std::uint32_t>(x - pane.x), static_cast<std::uint32_t>(y - pane.y), 0);
    const ChildOrder order = state_.order == "none"   ? ChildOrder::none
                             : state_.order == "axis" ? ChildOrder::axis
                                                      : ChildOrder::near;
    walk_ = walk_ray(*built->tree, frames_[state_.frame].meshes[0], walk_ray_, order);
    walk_tree_ = built->tree;
    walk_step_ = -1;
    say(fmt::format("ray of pixel {}, {}: {} node tests, {} triangle tests, {}", static_cast<int>(x - pane.x),
                    static_cast<int>(y - pane.y), walk_->node_tests, walk_->primitive_tests,
                    walk_->hit.valid() ? fmt::format("hits triangle {}", walk_->hit.primitive) : "hits nothing"));
  }
}

float App::panel_column() const {
  if (!state_.compare || !show_panel_) return 0;
  int width = 0, height = 0;
  glfwGetWindowSize(window_.handle(), &width, &height);
  return std::floor(std::min(400.0f, 0.3f * static_cast<float>(width)));
}

void App::lay_out_panes() {
  int width = 0, height = 0;
  glfwGetWindowSize(window_.handle(), &width, &height);
  const int count = state_.compare ? 3 : 1;
  const auto column = static_cast<int>(panel_column());
  const int each = std::max((width - column) / count, 8);
  for (int i = 0; i < count; ++i) {
    panes_[i] = {static_cast<float>(column + i * each), 0, static_cast<float>(each),
                 static_cast<float>(std::max(height, 8))};
  }
  state_.settings.width = static_cast<std::uint32_t>(panes_[0].width);
  state_.settings.height = static_cast<std::uint32_t>(panes_[0].height);
}

void App::take_pictures() {
  const bool done = painter_.activity() == "done";  // asked first, so that the pictures taken are the last
  if (const std::uint64_t version = painter_.version(); version != seen_version_) {
    seen_version_ = version;
    const auto newest = painter_.pictures();
    for (std::size_t side = 0; side < 2; ++side) {
      if (newest[side] == pictures_[side] || !newest[side]) continue;
      pictures_[side] = newest[side];
      transfer_ms_[static_cast<int>(transfer_)] = textures_[side].upload(newest[side]->image, transfer_);
    }
    if (state_.compare && pictures_[0] && pictures_[1]) {
      difference_ = difference_of(pictures_[0]->image, pictures_[1]->image, gain_);
      if (!difference_.image.pixels.empty()) textures_[2].upload(difference_.image, transfer_);
    }
  }
  const bool full = pictures_[0] && pictures_[0]->divisor == 1 && pictures_[0]->image.width == state_.settings.width;
  if (save_asked_ && full && done) {
    save_asked_ = false;
    save_pictures();
  }
}

void App::draw_pane(const Pane& pane, PictureTexture& texture, const char* caption) {
  if (texture.width() == 0) return;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const ImVec2 a(pane.x, pane.y), b(pane.x + pane.width, pane.y + pane.height);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL has numbers where ImGui has pointers
  list->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture.id())), a, b);
  if (*caption == '\0') return;
  const ImVec2 size = ImGui::CalcTextSize(caption);
  const ImVec2 corner(a.x + 8, b.y - size.y - 10);
  list->AddRectFilled({corner.x - 4, corner.y - 3}, {corner.x + size.x + 4, corner.y + size.y + 3},
                      IM_COL32(0, 0, 0, 170));
  list->AddText(corner, IM_COL32_WHITE, caption);
  list->AddLine({b.x, a.y}, b, IM_COL32(255, 255, 255, 90));
}

void App::advance_sequence(float seconds) {
  if (!playing_) return;
  since_frame_ += seconds;
  if (since_frame_ < 1 / frames_per_second_) return;
  since_frame_ = 0;
  state_.frame = (state_.frame + 1) % frames_.size();
}

std::filesystem::path App::file_named(const std::string& ending) const {
  std::string name = frames_[state_.frame].name;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '-';
  }
  return options_.folder / (name + ending);
}

void App::save_camera() {
  const auto file = file_named(".view.json");
  Camera camera = control_.camera();
  camera.name = "view";
  try {
    write_cameras(file, {&camera, 1});
    say(fmt::format("camera saved as {}", file.string()));
  } catch (const Error& error) {
    say(error.what());
  }
}

void App::load_camera() {
  try {
    const std::vector<Camera> cameras = read_cameras(file_named(".view.json"));
    if (cameras.empty()) return say("the saved camera file holds no camera; save one with 'o'");
    control_.set_camera(cameras[0]);
    say(fmt::format("camera loaded from {}", file_named(".view.json").string()));
  } catch (const Error& error) {
    say(error.what());
  }
}

void App::save_pictures() {
  const char* endings[] = {".png", ".second.png", ".difference.png"};
  const Image* images[] = {&pictures_[0]->image, pictures_[1] ? &pictures_[1]->image : nullptr, &difference_.image};
  try {
    for (std::size_t i = 0; i < (state_.compare ? 3u : 1u); ++i) {
      if (images[i] && !images[i]->pixels.empty()) write_png(file_named(endings[i]), *images[i]);
    }
    say(fmt::format("picture saved as {}, {} samples per pixel", file_named(".png").string(), pictures_[0]->samples));
  } catch (const Error& error) {
    say(error.what());
  }
}

void App::save_window() {
  window_asked_ = false;
  std::uint32_t width = 0, height = 0;
  const std::vector<unsigned char> pixels = window_.contents(width, height);
  try {
    OutputFile file(file_named(".window.png"));
    const std::vector<unsigned char> png = encode_png(pixels, width, height);
    file.write(std::as_bytes(std::span(png)));
    file.commit();
    say(fmt::format("window saved as {}", file_named(".window.png").string()));
  } catch (const Error& error) {
    say(error.what());
  }
}

void App::say(const std::string& text) {
  message_ = text;
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

}  // namespace boxwood::viewer
