// An OpenGL context without a visible window, from OSMesa or the graphics driver. Their libraries are loaded
// at run time.
#pragma once

#include <memory>

#include "render/gl.h"

namespace viete::platform {

/// A context that is current in the thread that created it. It has no default framebuffer: draw into a
/// render::Framebuffer. A thread may have only one context. The thread of a GLFW window must not create a
/// context, because Mesa would replace the window's context.
class OffscreenContext {
public:
  enum class Kind { any, osmesa, driver };

  /// Kind::any first tries OSMesa, then Kind::driver: EGL with Mesa's CPU rasteriser, then EGL with any
  /// driver or, on Windows, an invisible window. CPU rasterisers give equal pictures on all machines. EGL
  /// sets LIBGL_ALWAYS_SOFTWARE for the process. If all attempts fail, throws base::Error with the reasons.
  static std::unique_ptr<OffscreenContext> create(Kind kind = Kind::any);

  virtual ~OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// Returns a GL function by name, for render::load_gl().
  virtual render::Proc get_proc_address(const char* name) const = 0;

protected:
  OffscreenContext() = default;
};

/// Kind::driver: egl_context.cpp or, on Windows, hidden_window.cpp. Throws base::Error with the reason.
std::unique_ptr<OffscreenContext> make_driver_context();

/// Call this before creating a context or a window. Mesa's CPU rasteriser hangs if the system refuses to
/// create its threads. If the system cannot create enough threads for Mesa, sets LP_NUM_THREADS=0: Mesa then
/// creates no threads. Keeps the value if LP_NUM_THREADS is already set.
void spare_rasteriser_threads();

}  // namespace viete::platform
