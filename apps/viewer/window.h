#pragma once
#include <cstdint>
#include <string>
#include <vector>

struct GLFWwindow;

namespace boxwood::viewer {

/// A window with OpenGL and Dear ImGui in it. One per program.
class Window {
 public:
  /// Throws Error with one sentence where there is no display or no OpenGL.
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  bool open() const;
  /// What was drawn last, before it is shown: three bytes a pixel, top row first.
  std::vector<unsigned char> contents(std::uint32_t& width, std::uint32_t& height) const;
  void begin_frame();
  /// Draws what ImGui collected.
  void draw();
  void show();

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace boxwood::viewer
