#include "logic/key_bindings.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace boxwood::viewer {

std::span<const KeyBinding> key_bindings() {
  static constexpr std::array<KeyBinding, 24> table{{
      {'w', Action::forward, "move forward"},
      {'s', Action::back, "move back"},
      {'a', Action::left, "move left"},
      {'d', Action::right, "move right"},
      {'e', Action::up, "move up"},
      {'q', Action::down, "move down"},
      {'o', Action::save_camera, "save the camera"},
      {'i', Action::load_camera, "load the saved camera"},
      {'p', Action::save_picture, "save the picture"},
      {'k', Action::save_window, "save the window as it looks"},
      {'t', Action::switch_scheme, "trackball or first person"},
      {'r', Action::next_recipe, "next recipe"},
      {'g', Action::next_integrator, "next integrator"},
      {'l', Action::next_lights, "next lights (whitted)"},
      {'v', Action::next_order, "next traversal order"},
      {'c', Action::compare, "two recipes side by side"},
      {'b', Action::show_boxes, "boxes of a tree level"},
      {'m', Action::deeper, "one level deeper"},
      {'n', Action::shallower, "one level up"},
      {' ', Action::play, "play or stop the sequence"},
      {'f', Action::next_frame, "next frame of the sequence"},
      {'x', Action::reset_camera, "back to the first view"},
      {'u', Action::panel, "hide or show the panel"},
      {'h', Action::help, "this help"},
  }};
  return table;
}

std::optional<Action> action_of(char key) {
  const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(key)));
  const auto found = std::ranges::find(key_bindings(), lower, &KeyBinding::key);
  if (found == key_bindings().end()) return std::nullopt;
  return found->action;
}

}  // namespace boxwood::viewer
