// A drawing target with optional multisampling. Its picture can be read, or copied to the window.
#pragma once

#include <glm/glm.hpp>

#include "render/gl.h"
#include "render/image.h"

namespace viete::render {

/// The target of all drawing, so that windows, OSMesa and EGL give equal pictures. Reallocates memory only if
/// the size or the number of samples changes. Colours are RGBA8 as displayed; depth has 24 bits.
class Framebuffer {
public:
  explicit Framebuffer(const Gl& gl);

  /// Binds the target, and clears it to opaque black and depth 1. `size` is in device pixels; each side is at
  /// least 1. `samples` is limited to GL_MAX_SAMPLES; below 2, there is no multisampling. Throws base::Error
  /// if the driver rejects the size.
  void begin(glm::ivec2 size, int samples);
  /// Averages the samples of each pixel into the resolved picture. Binds this picture for further drawing.
  void resolve();
  /// Binds this target without multisampling. Fills it with the picture of `picture`, stretched to `size`.
  void begin_with(const Framebuffer& picture, glm::ivec2 size);
  /// Copies the resolved picture to the window, and leaves the window's framebuffer bound.
  void blit_to_window(glm::ivec2 window_size);
  /// Returns the resolved picture, top row first. If `opaque`, sets alpha to 255. Otherwise keeps alpha, and
  /// colours are premultiplied by alpha.
  Image read(bool opaque = true);

  glm::ivec2 size() const { return size_; }
  int samples() const { return samples_; }  ///< 0 if there is no multisampling

private:
  void fit(glm::ivec2 size, int samples);
  void allocate(glm::ivec2 size, int samples);
  void allocate_multisampled(glm::ivec2 size);
  void require_complete(const char* what, glm::ivec2 size) const;
  void blit_to(GLuint target, glm::ivec2 size) const;

  const Gl& gl_;
  FramebufferObject resolved_, multisampled_;
  Texture color_;
  Renderbuffer depth_, sample_color_, sample_depth_;
  glm::ivec2 size_{0, 0};
  int samples_ = 0;
};

}  // namespace viete::render
