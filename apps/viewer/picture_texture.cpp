#include "picture_texture.h"

#define GLFW_INCLUDE_NONE
#include <GL/gl.h>
#include <GL/glext.h>
#include <GLFW/glfw3.h>

#include <cstring>
#include <vector>

#include "boxwood/error.h"
#include "measure/clock.h"

namespace boxwood::viewer {
namespace {

/// The buffer functions of OpenGL 1.5, which must be asked for.
struct BufferFunctions {
  PFNGLGENBUFFERSPROC generate;
  PFNGLDELETEBUFFERSPROC remove;
  PFNGLBINDBUFFERPROC bind;
  PFNGLBUFFERDATAPROC data;
  PFNGLMAPBUFFERPROC map;
  PFNGLUNMAPBUFFERPROC unmap;
};

template <class Function>
void load(Function& function, const char* name) {
  function = reinterpret_cast<Function>(glfwGetProcAddress(name));
  if (!function) throw Error(std::string("this OpenGL lacks ") + name + "; install a driver of version 2.1 or later");
}

const BufferFunctions& buffers() {
  static const BufferFunctions functions = [] {
    BufferFunctions f;
    load(f.generate, "glGenBuffers");
    load(f.remove, "glDeleteBuffers");
    load(f.bind, "glBindBuffer");
    load(f.data, "glBufferData");
    load(f.map, "glMapBuffer");
    load(f.unmap, "glUnmapBuffer");
    return f;
  }();
  return functions;
}

void set_pixels(std::uint32_t width, std::uint32_t height, const void* pixels, bool same_size) {
  const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
  if (same_size) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, w, h, GL_RGB, GL_UNSIGNED_BYTE, pixels);
  } else {
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, w, h, 0, GL_RGB, GL_UNSIGNED_BYTE, pixels);
  }
}

void set_pixels_from_buffer(unsigned buffer, const std::vector<unsigned char>& bytes, std::uint32_t width,
                            std::uint32_t height, bool same_size) {
  const BufferFunctions& gl = buffers();
  gl.bind(GL_PIXEL_UNPACK_BUFFER, buffer);
  // New memory each time, so that the driver need not wait until the last picture is drawn.
  gl.data(GL_PIXEL_UNPACK_BUFFER, static_cast<GLsizeiptr>(bytes.size()), nullptr, GL_STREAM_DRAW);
  if (void* memory = gl.map(GL_PIXEL_UNPACK_BUFFER, GL_WRITE_ONLY)) {
    std::memcpy(memory, bytes.data(), bytes.size());
    gl.unmap(GL_PIXEL_UNPACK_BUFFER);
    set_pixels(width, height, nullptr, same_size);
  }
  gl.bind(GL_PIXEL_UNPACK_BUFFER, 0);
}

}  // namespace

PictureTexture::PictureTexture() {
  glGenTextures(1, &texture_);
  buffers().generate(1, &buffer_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

PictureTexture::~PictureTexture() {
  glDeleteTextures(1, &texture_);
  buffers().remove(1, &buffer_);
}

double PictureTexture::upload(const Image& image, Transfer transfer) {
  const std::vector<unsigned char> bytes = srgb_bytes(image);
  const bool same_size = image.width == width_ && image.height == height_;
  width_ = image.width, height_ = image.height;
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glFinish();
  const double begin = now(Clock::wall);
  if (transfer == Transfer::texture_upload) {
    set_pixels(width_, height_, bytes.data(), same_size);
  } else {
    set_pixels_from_buffer(buffer_, bytes, width_, height_, same_size);
  }
  glFinish();
  return (now(Clock::wall) - begin) * 1000;
}

}  // namespace boxwood::viewer
