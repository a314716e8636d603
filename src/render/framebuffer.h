// A drawing target with optional multisampling, whose picture can be read or copied to the window.
#pragma once

#include <glm/glm.hpp>

#include "render/gl.h"
#include "render/image.h"

namespace viete::render {

/// All drawing goes to such a target, so that a window, OSMesa and EGL give the same picture. Memory is only
/// reallocated if size or samples change. Colours are RGBA8 as displayed; depth has 24 bits.
class Framebuffer {
public:
  explicit Framebuffer(const Gl& gl);

  /// Binds the target and clears it to opaque black and depth 1. size: in device pixels, increased to at
  /// least 1 x 1. samples: limited to GL_MAX_SAMPLES; no multisampling below 2. Throws base::Error if the
  /// driver rejects the size.
  void begin(glm::ivec2 size, int samples);
  /// Averages the samples of each pixel and binds the resulting picture for more drawing.
  void resolve();
  /// Binds the target and fills it with another resolved picture, stretched to the size.
  void begin_with(const Framebuffer& picture, glm::ivec2 size);
  /// Copies the resolved picture to the window and leaves the window's framebuffer bound.
  void blit_to_window(glm::ivec2 window_size);
  /// Returns the resolved picture, top row first. opaque: sets alpha to 255; otherwise keeps the drawn alpha,
  /// by which the colours are multiplied.
  Image read(bool opaque = true);

  glm::ivec2 size() const { return size_; }
  int samples() const { return samples_; }  ///< 0 without multisampling

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
