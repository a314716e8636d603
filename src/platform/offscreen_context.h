// An OpenGL context without a window: OSMesa, else EGL without a surface, both opened at run time.
#pragma once

#include <memory>
#include <string>

#include "render/gl.h"

namespace viete::platform {

/// One context, current in the thread that made it. Draw into a render::Framebuffer: there is no window
/// behind it. One context per thread: never make one in the thread that owns a GLFW window (they share Mesa's
/// current-context slot).
class OffscreenContext {
public:
  enum class Kind { any, osmesa, egl };

  /// any: OSMesa first, then EGL. software: ask EGL for Mesa's CPU rasteriser (LIBGL_ALWAYS_SOFTWARE=1, set
  /// only while the context is made), so that pictures are the same on every machine; otherwise EGL takes a
  /// GPU when there is one. Throws base::Error that says what was tried and why each attempt failed.
  static std::unique_ptr<OffscreenContext> create(Kind kind = Kind::any, bool software = true);

  virtual ~OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// "OSMesa" or "EGL surfaceless" or "EGL device", for messages.
  virtual std::string name() const = 0;
  virtual void make_current() = 0;
  /// For render::load_gl: load_gl([&](const char* n) { return context.get_proc_address(n); }).
  virtual render::Proc get_proc_address(const char* name) const = 0;

protected:
  OffscreenContext() = default;
};

/// Before a context is made, also of a window: Mesa's CPU rasteriser waits forever for threads that the
/// system refused to make. If there are too few, it is told to draw without any (LP_NUM_THREADS=0, unless
/// set).
void spare_rasteriser_threads();

}  // namespace viete::platform
