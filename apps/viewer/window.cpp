#include "window.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl2.h>

#include "boxwood/error.h"

namespace boxwood::viewer {
namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

}  // namespace

Window::Window(int width, int height, const std::string& title) {
  if (!glfwInit()) {
    throw Error(
        fmt::format("there is no display to open a window on ({}); set DISPLAY, or use 'boxwood render', which "
                    "needs none",
                    last_glfw_error()));
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 2);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    const std::string reason = last_glfw_error();
    glfwTerminate();
    throw Error(
        fmt::format("no window with OpenGL 2.1 can be opened ({}); install an OpenGL driver such as "
                    "libgl1-mesa-dri, or use 'boxwood render', which needs none",
                    reason));
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = style.FrameRounding = 3;
  style.Colors[ImGuiCol_WindowBg].w = 0.85f;
}

Window::~Window() {
  if (ImGui::GetIO().BackendRendererUserData) {
    ImGui_ImplOpenGL2_Shutdown();
    ImGui_ImplGlfw_Shutdown();
  }
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::open() const { return !glfwWindowShouldClose(window_); }

void Window::begin_frame() {
  // Set up late, so that the callbacks of whoever uses the window are there for ImGui to pass events on to.
  if (!ImGui::GetIO().BackendRendererUserData) {
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL2_Init();
  }
  glfwWaitEventsTimeout(1.0 / 60);
  ImGui_ImplOpenGL2_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Window::draw() {
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  glViewport(0, 0, width, height);
  glClearColor(0.07f, 0.07f, 0.08f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
}

void Window::show() { glfwSwapBuffers(window_); }

std::vector<unsigned char> Window::contents(std::uint32_t& width, std::uint32_t& height) const {
  int w = 0, h = 0;
  glfwGetFramebufferSize(window_, &w, &h);
  width = static_cast<std::uint32_t>(w), height = static_cast<std::uint32_t>(h);
  const std::size_t row = std::size_t{3} * width;
  std::vector<unsigned char> upside_down(row * height), out;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, w, h, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
  for (std::size_t y = height; y-- > 0;) {
    const auto begin = upside_down.begin() + static_cast<std::ptrdiff_t>(y * row);
    out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
  }
  return out;
}

}  // namespace boxwood::viewer
