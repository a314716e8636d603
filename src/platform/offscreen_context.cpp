#include "platform/offscreen_context.h"

#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/os.h"
#include "base/worker_pool.h"

namespace viete::platform {

namespace {

using base::Error;

// A function of a library, for conversion to its type.
struct Function {
  void* address;
  template <class Pointer>
  operator Pointer() const {
    return reinterpret_cast<Pointer>(address);
  }
};

class Library : public base::os::Library {
public:
  using base::os::Library::Library;
  Function find(const char* name) const { return {base::os::Library::find(name)}; }
};

// Functions of GL/osmesa.h. They are declared here so that the build does not need this header.
struct OsmesaApi {
  // Requests RGBA, 24 bits of depth, the core profile and version 3.3.
  static constexpr int attributes[] = {0x22, GL_RGBA, 0x30, 24, 0x33, 0x34, 0x36, 3, 0x37, 3, 0};

  Library library{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  void* (*create)(const int* attributes, void* share) = library.find("OSMesaCreateContextAttribs");
  void (*destroy)(void* context) = library.find("OSMesaDestroyContext");
  GLboolean (*make_current)(void* context, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) = library.find("OSMesaMakeCurrent");
  render::Proc (*get_proc_address)(const char* name) = library.find("OSMesaGetProcAddress");
};

class OsmesaContext final : public OffscreenContext {
public:
  OsmesaContext() {
    if (context_ == nullptr) throw Error("OSMesa", "OpenGL 3.3 core is not supported");
    if (api_.make_current(context_, buffer_.data(), GL_UNSIGNED_BYTE, side, side) == GL_FALSE)
      throw Error("OSMesa", "the context cannot be made current");
  }
  ~OsmesaContext() override {
    api_.make_current(nullptr, nullptr, 0, 0, 0);
    api_.destroy(context_);
  }

  render::Proc get_proc_address(const char* name) const override { return api_.get_proc_address(name); }

private:
  static constexpr int side = 16;  // OSMesa requires a buffer, but this program does not use it

  OsmesaApi api_;
  std::array<std::uint8_t, 4 * side * side> buffer_{};
  void* context_ = api_.create(OsmesaApi::attributes, nullptr);
};

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

template <class Make>
std::unique_ptr<OffscreenContext> attempt(std::string& tried, Make make) {
  try {
    return make();
  } catch (const Error& error) {
    tried += std::string(tried.empty() ? "" : ", ") + error.what();
    return nullptr;
  }
}

}  // namespace

void spare_rasteriser_threads() {
  constexpr int other_threads = 2;  // threads of the driver, in addition to one for each processor
  const int wanted = static_cast<int>(std::thread::hardware_concurrency()) + other_threads;
  if (base::WorkerPool(wanted).threads() < wanted && base::os::variable("LP_NUM_THREADS").empty())
    base::os::set_variable("LP_NUM_THREADS", "0");
}

std::unique_ptr<OffscreenContext> OffscreenContext::create(Kind kind) {
  spare_rasteriser_threads();
  std::string tried;
  std::unique_ptr<OffscreenContext> context;
  if (kind != Kind::egl) context = attempt(tried, [] { return std::make_unique<OsmesaContext>(); });
  if (!context && kind != Kind::osmesa)
    context = attempt(tried, [] { return std::make_unique<EglContext>(); });
  if (context) return context;
  throw Error("offscreen picture", "no OpenGL context could be created (" + tried + ")",
              "install libosmesa6, or libegl1 with libgl1-mesa-dri");
}

}  // namespace viete::platform
