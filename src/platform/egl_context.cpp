#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

#include "base/error.h"
#include "platform/library.h"
#include "platform/offscreen_context.h"

namespace viete::platform {

namespace {

using base::Error;

struct EglApi {
  Library library{"libEGL.so.1", "libEGL.so"};
  decltype(&eglGetProcAddress) get_proc_address = library.find("eglGetProcAddress");
  decltype(&eglInitialize) initialize = library.find("eglInitialize");
  decltype(&eglBindAPI) bind_api = library.find("eglBindAPI");
  decltype(&eglChooseConfig) choose_config = library.find("eglChooseConfig");
  decltype(&eglCreateContext) create_context = library.find("eglCreateContext");
  decltype(&eglDestroyContext) destroy_context = library.find("eglDestroyContext");
  decltype(&eglMakeCurrent) make_current = library.find("eglMakeCurrent");
};

// A context without a surface. Never terminates the display, because all contexts of the process share it.
class EglContext final : public OffscreenContext {
public:
  EglContext() {
    open_display();
    create_context();
    if (api_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
      throw Error("EGL", "the context cannot be made current without a surface");
  }
  ~EglContext() override {
    api_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    api_.destroy_context(display_, context_);
  }

  render::Proc get_proc_address(const char* name) const override { return api_.get_proc_address(name); }

private:
  void open_display() {
    const auto display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(api_.get_proc_address("eglGetPlatformDisplayEXT"));
    const auto query =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(api_.get_proc_address("eglQueryDevicesEXT"));
    const auto open = [&](EGLenum platform, void* native) {
      display_ = display ? display(platform, native, nullptr) : EGL_NO_DISPLAY;
      return display_ != EGL_NO_DISPLAY && api_.initialize(display_, nullptr, nullptr) == EGL_TRUE;
    };
    std::array<EGLDeviceEXT, 64> devices{};
    EGLint count = 0;
    for (const char* software : {"1", "0"}) {
      base::os::set_variable("LIBGL_ALWAYS_SOFTWARE", software);  // Mesa reads this variable during open()
      if (open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY)) return;
      if (query) query(static_cast<EGLint>(devices.size()), devices.data(), &count);
      for (EGLint i = 0; i < count; ++i)
        if (open(EGL_PLATFORM_DEVICE_EXT, devices[i])) return;
    }
    throw Error("EGL", "drawing without a window is not supported");
  }

  void create_context() {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION_KHR,
                                 3,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                                 EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    api_.bind_api(EGL_OPENGL_API);
    api_.choose_config(display_, wanted, &config, 1, &count);
    if (count == 0) throw Error("EGL", "desktop OpenGL is not supported");
    context_ = api_.create_context(display_, config, EGL_NO_CONTEXT, attributes);
    if (context_ == EGL_NO_CONTEXT) throw Error("EGL", "OpenGL 3.3 core is not supported");
  }

  EglApi api_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<OffscreenContext> make_driver_context() {
  return std::make_unique<EglContext>();
}

}  // namespace viete::platform
