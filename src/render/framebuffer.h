// A render target: multisampled on request, resolved to a texture, read back or copied to the window.
#pragma once

#include <glm/glm.hpp>

#include "render/gl.h"
#include "render/image.h"

namespace viete::render {

/// Target of all drawing, in a window, OSMesa or EGL, which makes their pictures equal. Reallocated only when
/// size or samples change. Colour is RGBA8 as displayed (no sRGB conversion by GL), depth 24 bits.
/// The driver's limit on the longest side of a target, in device pixels.
int longest_side(const Gl& gl);

class Framebuffer {
public:
  explicit Framebuffer(const Gl& gl);

  /// Binds the target and clears it to opaque black, depth 1. samples is clamped to GL_MAX_SAMPLES; below 2
  /// means no multisampling. size is in device pixels, at least 1 x 1. Throws base::Error if the driver
  /// rejects the size.
  void begin(glm::ivec2 size, int samples);
  /// Resolves multisampling (if any) and binds the result for further drawing.
  void resolve();
  /// Starts with another resolved picture stretched to the size instead of clearing; then open for drawing.
  void begin_with(const Framebuffer& picture, glm::ivec2 size);
  /// Copies the resolved picture to the default framebuffer of the current context and leaves that bound.
  void blit_to_window(glm::ivec2 window_size);
  /// The resolved picture, top row first, alpha 255. If not `opaque`, keeps the drawn alpha; colours are
  /// premultiplied.
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
