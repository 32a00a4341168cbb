#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "logic/camera_control.h"
#include "logic/difference.h"
#include "logic/key_bindings.h"
#include "logic/painter.h"
#include "logic/ray_walk.h"
#include "logic/tree_level.h"
#include "picture_texture.h"
#include "window.h"

namespace boxwood::viewer {

struct AppOptions {
  std::vector<std::string> recipes{"default"};  ///< to switch between; the first two to compare
  std::string integrator = "eyelight";
  std::string camera;  ///< name; empty: the scene's first
  int width = 1280, height = 720;
  unsigned threads = 0;
  unsigned samples = 64;               ///< per pixel, at most
  std::filesystem::path folder = ".";  ///< where pictures and cameras are saved
};

/// One part of the window that shows a picture.
struct Pane {
  float x = 0, y = 0, width = 0, height = 0;
  bool holds(float px, float py) const { return px >= x && py >= y && px < x + width && py < y + height; }
};

/// The viewer: what the user does becomes a ViewState, what the painter paints becomes textures.
class App {
 public:
  /// `frames` are one scene or a sequence; not empty.
  App(const std::vector<Scene>& frames, const AppOptions& options);
  /// Until the window is closed.
  void run();

 private:
  friend void draw_panel(App& app);
  friend void draw_help(App& app);
  friend void draw_walk(App& app);
  friend void draw_boxes(App& app, const Pane& pane);
  friend void draw_walk_boxes(App& app, const Pane& pane);

  // Input.
  static void on_character(GLFWwindow* window, unsigned codepoint);
  static void on_scroll(GLFWwindow* window, double x, double y);
  void act(Action action);
  void move_camera(float seconds);
  void drag();
  void pick(float x, float y);

  // Output.
  void lay_out_panes();
  /// Width of the column that the panel has to itself, left of the pictures: while comparing, where each picture is
  /// small.
  float panel_column() const;
  void take_pictures();
  void draw_pane(const Pane& pane, PictureTexture& texture, const char* caption);
  void advance_sequence(float seconds);
  void save_camera();
  void load_camera();
  void save_pictures();
  void save_window();
  void say(const std::string& text);
  std::shared_ptr<const Painter::Built> built() const { return painter_.built(0); }
  std::filesystem::path file_named(const std::string& ending) const;

  const std::vector<Scene>& frames_;
  AppOptions options_;
  Window window_;
  CameraControl control_;
  Camera first_camera_;
  ViewState state_;
  Painter painter_;

  PictureTexture textures_[3];  // first recipe, second, difference
  Pane panes_[3];
  std::uint64_t seen_version_ = 0;
  std::array<std::shared_ptr<const Picture>, 2> pictures_;
  Difference difference_;
  Transfer transfer_ = Transfer::texture_upload;
  double transfer_ms_[2] = {0, 0};  // of the last transfer in each way

  bool help_ = false, show_panel_ = true, show_boxes_ = false, playing_ = false, save_asked_ = false,
       window_asked_ = false;
  int level_ = 3;
  float gain_ = 4, frames_per_second_ = 10, since_frame_ = 0;
  std::vector<LevelBox> boxes_;
  std::shared_ptr<const Tree> boxes_tree_;
  int boxes_level_ = -1;
  std::optional<RayWalk> walk_;
  std::shared_ptr<const Tree> walk_tree_;
  Ray walk_ray_;
  int walk_step_ = -1;
  bool pressed_ = false, dragged_ = false;
  float press_x_ = 0, press_y_ = 0, mouse_x_ = 0, mouse_y_ = 0;
  bool ready_ = false;
  std::string message_;
};

void draw_panel(App& app);
void draw_help(App& app);
void draw_walk(App& app);
void draw_boxes(App& app, const Pane& pane);
void draw_walk_boxes(App& app, const Pane& pane);

}  // namespace boxwood::viewer
