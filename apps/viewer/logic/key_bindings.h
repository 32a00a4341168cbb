#pragma once
#include <optional>
#include <span>
#include <string_view>

namespace boxwood::viewer {

enum class Action {
  forward,
  back,
  left,
  right,
  up,
  down,
  save_camera,
  load_camera,
  save_picture,
  save_window,
  switch_scheme,
  next_recipe,
  next_integrator,
  next_lights,
  next_order,
  compare,
  show_boxes,
  deeper,
  shallower,
  play,
  next_frame,
  reset_camera,
  panel,
  help,
};

/// One key: what is printed on it, in lower case, and what it does. The help overlay is made from this table.
struct KeyBinding {
  char key;
  Action action;
  std::string_view help;
};

std::span<const KeyBinding> key_bindings();
/// The action of a key, in either case.
std::optional<Action> action_of(char key);

}  // namespace boxwood::viewer
