// An OpenGL context without a window: OSMesa, else EGL without a surface, both loaded at run time.
#pragma once

#include <memory>

#include "render/gl.h"

namespace viete::platform {

/// A context, current in the thread that created it. Draw into a render::Framebuffer, as there is no default
/// one. One context per thread: never create one in the thread that owns a GLFW window (they share Mesa's
/// current-context slot).
class OffscreenContext {
public:
  enum class Kind { any, osmesa, egl };

  /// any: OSMesa first, then EGL with Mesa's CPU rasteriser (sets LIBGL_ALWAYS_SOFTWARE for the
  /// process), so that pictures are the same on every machine, then EGL with any driver. Throws base::Error
  /// with the reason of each failed attempt.
  static std::unique_ptr<OffscreenContext> create(Kind kind = Kind::any);

  virtual ~OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// For render::load_gl: load_gl([&](const char* n) { return context.get_proc_address(n); }).
  virtual render::Proc get_proc_address(const char* name) const = 0;

protected:
  OffscreenContext() = default;
};

/// Call before creating any context, including a window's. Mesa's CPU rasteriser waits forever for threads
/// that the system refused to create; if there are too few, this disables its threads (LP_NUM_THREADS=0,
/// unless set).
void spare_rasteriser_threads();

}  // namespace viete::platform
