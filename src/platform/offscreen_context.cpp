#include "platform/offscreen_context.h"

#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/worker_pool.h"

namespace viete::platform {

namespace {

using base::Error;

/// A library that stays loaded until the process ends, because drivers do not survive unloading. RTLD_LOCAL
/// separates its GL functions from those of other GL libraries.
class Library {
public:
  explicit Library(std::initializer_list<const char*> names) {
    for (const char* name : names) {
      if (handle_ == nullptr) handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    }
    if (handle_ == nullptr) throw Error(*names.begin(), "is not installed");
  }

  template <class Function>
  void find(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(dlsym(handle_, name));
    if (function == nullptr) throw Error(name, "is missing in the library");
  }

private:
  void* handle_ = nullptr;
};

constexpr std::array<std::pair<int, int>, 3> versions{{{4, 5}, {4, 3}, {3, 3}}};

// Copied from GL/osmesa.h, so that the header need not be installed.
struct OsmesaApi {
  static constexpr int format = 0x22, depth_bits = 0x30, profile = 0x33, core_profile = 0x34, major = 0x36,
                       minor = 0x37;

  OsmesaApi() : library({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
    library.find(create, "OSMesaCreateContextAttribs");
    library.find(destroy, "OSMesaDestroyContext");
    library.find(make_current, "OSMesaMakeCurrent");
    library.find(get_proc_address, "OSMesaGetProcAddress");
  }

  Library library;
  void* (*create)(const int* attributes, void* share) = nullptr;
  void (*destroy)(void* context) = nullptr;
  GLboolean (*make_current)(void* context, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) = nullptr;
  render::Proc (*get_proc_address)(const char* name) = nullptr;
};

class OsmesaContext final : public OffscreenContext {
public:
  OsmesaContext() : context_(create()) { OsmesaContext::make_current(); }
  ~OsmesaContext() override {
    api_.make_current(nullptr, nullptr, 0, 0, 0);
    api_.destroy(context_);
  }

  std::string name() const override { return "OSMesa"; }
  render::Proc get_proc_address(const char* name) const override { return api_.get_proc_address(name); }
  void make_current() override {
    if (api_.make_current(context_, buffer_.data(), GL_UNSIGNED_BYTE, side, side) == GL_FALSE) {
      throw Error("OSMesa", "the context cannot be made current");
    }
  }

private:
  static constexpr int side = 16;  // OSMesa needs a buffer, but drawing uses a framebuffer object

  void* create() const {
    for (const auto& [major, minor] : versions) {
      const int attributes[] = {OsmesaApi::format,
                                GL_RGBA,
                                OsmesaApi::depth_bits,
                                24,
                                OsmesaApi::profile,
                                OsmesaApi::core_profile,
                                OsmesaApi::major,
                                major,
                                OsmesaApi::minor,
                                minor,
                                0};
      if (void* context = api_.create(attributes, nullptr)) return context;
    }
    throw Error("OSMesa", "offers no OpenGL 3.3 core context");
  }

  OsmesaApi api_;
  std::array<std::uint8_t, 4 * side * side> buffer_{};
  void* context_;
};

struct EglApi {
  EglApi() : library({"libEGL.so.1", "libEGL.so"}) {
    library.find(get_proc_address, "eglGetProcAddress");
    library.find(initialize, "eglInitialize");
    library.find(bind_api, "eglBindAPI");
    library.find(choose_config, "eglChooseConfig");
    library.find(create_context, "eglCreateContext");
    library.find(destroy_context, "eglDestroyContext");
    library.find(make_current, "eglMakeCurrent");
    platform_display = extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    query_devices = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    if (platform_display == nullptr) throw Error("EGL", "cannot open displays by platform");
  }

  template <class Function>
  Function extension(const char* name) const {
    return reinterpret_cast<Function>(get_proc_address(name));
  }

  Library library;
  decltype(&eglGetProcAddress) get_proc_address = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglChooseConfig) choose_config = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display = nullptr;
  PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
};

/// Sets an environment variable for the current scope (Mesa reads it while initialising a display).
class EnvironmentScope {
public:
  EnvironmentScope(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value, 1);
  }
  EnvironmentScope(const EnvironmentScope&) = delete;
  EnvironmentScope& operator=(const EnvironmentScope&) = delete;
  ~EnvironmentScope() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }

private:
  const char* name_;
  std::optional<std::string> old_;
};

// Never terminates the display, which all contexts of the process share.
class EglContext final : public OffscreenContext {
public:
  explicit EglContext(bool software) {
    std::optional<EnvironmentScope> scope;
    if (software) scope.emplace("LIBGL_ALWAYS_SOFTWARE", "1");
    open_display();
    create_context();
    EglContext::make_current();
  }
  ~EglContext() override { close(); }

  std::string name() const override { return name_; }
  render::Proc get_proc_address(const char* name) const override { return api_.get_proc_address(name); }
  void make_current() override {
    if (api_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      throw Error(name_, "the context cannot be made current without a surface");
    }
  }

private:
  void open_display() {
    if (open(api_.platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
             "EGL surfaceless"))
      return;
    std::vector<EGLDeviceEXT> devices(64);
    EGLint count = 0;
    if (api_.query_devices != nullptr)
      api_.query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
      if (open(api_.platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr), "EGL device")) return;
    }
    throw Error("EGL", "neither a surfaceless display nor any of " + std::to_string(count) +
                           "  devices can be initialised");
  }

  bool open(EGLDisplay display, const char* name) {
    if (display == EGL_NO_DISPLAY || api_.initialize(display, nullptr, nullptr) == EGL_FALSE) return false;
    display_ = display;
    name_ = name;
    return true;
  }

  void create_context() {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    api_.bind_api(EGL_OPENGL_API);
    api_.choose_config(display_, wanted, &config, 1, &count);
    if (count == 0) throw Error(name_, "offers no configuration for desktop OpenGL");
    for (const auto& [major, minor] : versions) {
      const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                                   major,
                                   EGL_CONTEXT_MINOR_VERSION_KHR,
                                   minor,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                                   EGL_NONE};
      context_ = api_.create_context(display_, config, EGL_NO_CONTEXT, attributes);
      if (context_ != EGL_NO_CONTEXT) return;
    }
    throw Error(name_, "offers no OpenGL 3.3 core context");
  }

  void close() {
    api_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    api_.destroy_context(display_, context_);
  }

  EglApi api_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  std::string name_ = "EGL";
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
  const int wanted =
      static_cast<int>(std::thread::hardware_concurrency()) + 2;  // the driver creates additional threads
  if (base::WorkerPool(wanted).threads() < wanted) setenv("LP_NUM_THREADS", "0", 0);
}

std::unique_ptr<OffscreenContext> OffscreenContext::create(Kind kind, bool software) {
  spare_rasteriser_threads();
  std::string tried;
  std::unique_ptr<OffscreenContext> context;
  if (kind != Kind::egl) context = attempt(tried, [] { return std::make_unique<OsmesaContext>(); });
  if (!context && kind != Kind::osmesa) {
    context = attempt(tried, [&] { return std::make_unique<EglContext>(software); });
  }
  if (context) return context;
  throw Error("offscreen picture", "no OpenGL context can be made (tried: " + tried + ")",
              "install libosmesa6, or libegl1 with libgl1-mesa-dri");
}

}  // namespace viete::platform
