#include <GLFW/glfw3.h>

#include "base/error.h"
#include "platform/offscreen_context.h"

namespace viete::platform {

namespace {

class HiddenWindow final : public OffscreenContext {
public:
  HiddenWindow() {
    if (glfwInit() == GLFW_FALSE) throw base::Error("GLFW", "it cannot be initialised");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    window_ = glfwCreateWindow(16, 16, "Viete", nullptr, nullptr);
    glfwWindowHint(GLFW_VISIBLE, GLFW_TRUE);
    if (!window_) throw base::Error("the graphics driver", "OpenGL 3.3 core is not supported");
    glfwMakeContextCurrent(window_);
  }
  ~HiddenWindow() override { glfwDestroyWindow(window_); }

  render::Proc get_proc_address(const char* name) const override {
    return reinterpret_cast<render::Proc>(glfwGetProcAddress(name));
  }

private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace

std::unique_ptr<OffscreenContext> make_driver_context() {
  return std::make_unique<HiddenWindow>();
}

}  // namespace viete::platform
