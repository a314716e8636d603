#include "platform/offscreen_context.h"

#include <array>
#include <cstdint>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/os.h"
#include "base/worker_pool.h"
#include "platform/library.h"

namespace viete::platform {

namespace {

using base::Error;

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
  if (kind != Kind::driver) context = attempt(tried, [] { return std::make_unique<OsmesaContext>(); });
  if (!context && kind != Kind::osmesa) context = attempt(tried, make_driver_context);
  if (context) return context;
  throw Error("offscreen picture", "no OpenGL context could be created (" + tried + ")",
              "install libosmesa6, or libegl1 with libgl1-mesa-dri");
}

}  // namespace viete::platform
