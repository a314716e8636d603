// An OpenGL context without a window, by OSMesa or EGL; both libraries are loaded at run time.
#pragma once

#include <memory>

#include "render/gl.h"

namespace viete::platform {

/// A context, which is current in the thread that created it. It has no default framebuffer: draw into a
/// render::Framebuffer. Each thread may have only one context. The thread of a GLFW window must not create
/// another, because Mesa would replace the current context.
class OffscreenContext {
public:
  enum class Kind { any, osmesa, egl };

  /// any: tries OSMesa, then EGL with Mesa's CPU rasteriser, then EGL with any driver. CPU rasterisers give
  /// the same pictures on every machine. EGL sets LIBGL_ALWAYS_SOFTWARE for the process. Throws base::Error
  /// with the reason of each failed attempt.
  static std::unique_ptr<OffscreenContext> create(Kind kind = Kind::any);

  virtual ~OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// For render::load_gl().
  virtual render::Proc get_proc_address(const char* name) const = 0;

protected:
  OffscreenContext() = default;
};

/// Call before creating a context or a window. Mesa's CPU rasteriser hangs if the system refuses to create
/// its threads. If that would happen, this function disables them: it sets LP_NUM_THREADS=0 unless already
/// set.
void spare_rasteriser_threads();

}  // namespace viete::platform
