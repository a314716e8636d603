#include "platform/window.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "platform/offscreen_context.h"

namespace viete::platform {

namespace {

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  std::string reason = text ? text : "no reason given";
  while (!reason.empty() && reason.back() == ' ') reason.pop_back();
  return reason;
}

// GLFW's codes assume a US keyboard. If the user's keyboard has a letter on this key, returns its code.
int labelled(int key, int scancode) {
  if (key < GLFW_KEY_A || key > GLFW_KEY_Z) return key;
  const char* name = glfwGetKeyName(key, scancode);
  const bool letter = name && name[0] >= 'a' && name[0] <= 'z' && name[1] == 0;
  return letter ? name[0] - 'a' + GLFW_KEY_A : key;
}

GLFWwindow* open_window(glm::ivec2 size) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SAMPLES, 0);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // stay full screen while another screen is used
  // The desktop compares these names with assets/desktop/viete.desktop, to find the icon of the window.
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "Viete");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "viete");
#ifdef GLFW_WAYLAND_APP_ID
  glfwWindowHintString(GLFW_WAYLAND_APP_ID, "viete");
#endif
  return glfwCreateWindow(size.x, size.y, "Viete", nullptr, nullptr);
}

// Returns `wanted`, or the display's scale if `wanted` is 0.
float used_scale(GLFWwindow* window, float wanted) {
  float scale = 1;
  glfwGetWindowContentScale(window, &scale, nullptr);
  return std::max(wanted > 0 ? wanted : scale, 0.5f);
}

// Returns the largest window size that fits on the screen. If this size is unknown, returns `otherwise`.
glm::ivec2 room_for(GLFWwindow* window, glm::ivec2 otherwise) {
  GLFWmonitor* screen = glfwGetPrimaryMonitor();
  if (!screen) return otherwise;
  glm::ivec2 place, size{0, 0}, low{0, 0}, high{0, 0};
  glfwGetMonitorWorkarea(screen, &place.x, &place.y, &size.x, &size.y);
  glfwGetWindowFrameSize(window, &low.x, &low.y, &high.x, &high.y);
  const glm::ivec2 room = size - low - high;
  return room.x > 0 && room.y > 0 ? room : otherwise;
}

// The smallest window in which the panels have room, in logical pixels.
constexpr glm::ivec2 least_size{640, 400};

// Sets the window's size and minimum size, both limited to the screen.
void fit(GLFWwindow* window, glm::ivec2 size, float scale) {
  glm::ivec2 units;
  int pixels = 0;
  glfwGetWindowSize(window, &units.x, &units.y);
  glfwGetFramebufferSize(window, &pixels, nullptr);
  const float factor = units.x == pixels ? scale : 1;  // window units per logical pixel
  const auto in_units = [&](glm::ivec2 logical) { return glm::ivec2(glm::vec2(logical) * factor); };
  const glm::ivec2 wanted = in_units(size), room = room_for(window, wanted), fitting = glm::min(wanted, room);
  const glm::ivec2 least = glm::min(in_units(least_size), room);
  glfwSetWindowSizeLimits(window, least.x, least.y, GLFW_DONT_CARE, GLFW_DONT_CARE);
  if (fitting != units) glfwSetWindowSize(window, fitting.x, fitting.y);
}

struct Area {
  glm::ivec2 low, high;
};

Area area_of(GLFWmonitor* screen) {
  glm::ivec2 corner{0, 0};
  glfwGetMonitorPos(screen, &corner.x, &corner.y);
  const GLFWvidmode* mode = glfwGetVideoMode(screen);
  return {corner, corner + (mode ? glm::ivec2(mode->width, mode->height) : glm::ivec2(0))};
}

// Returns the screen that shows most of the window. If positions are unknown, returns the primary screen.
GLFWmonitor* screen_of(const Area& window) {
  int count = 0;
  GLFWmonitor** const screens = glfwGetMonitors(&count);
  GLFWmonitor* best = glfwGetPrimaryMonitor();
  int most = 0;
  for (int i = 0; i < count; ++i) {
    const Area screen = area_of(screens[i]);
    const glm::ivec2 shared =
        glm::max(glm::ivec2(0), glm::min(window.high, screen.high) - glm::max(window.low, screen.low));
    if (shared.x * shared.y > most) {
      best = screens[i];
      most = shared.x * shared.y;
    }
  }
  return best;
}

Window& of(GLFWwindow* window) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

}  // namespace

std::unique_ptr<Window> Window::open(glm::ivec2 size, float scale, std::string& reason) {
  // Without a named display, the Wayland library could print an error, or open a window on any display that
  // it finds in the runtime folder.
  if (!base::os::has_display()) {
    reason = "there is no display: DISPLAY and WAYLAND_DISPLAY are not set";
    return nullptr;
  }
  spare_rasteriser_threads();
  GLFWwindow* handle = glfwInit() ? open_window(size) : nullptr;
  if (!handle) {
    reason = last_glfw_error();
    glfwTerminate();
    return nullptr;
  }
  scale = used_scale(handle, scale);
  fit(handle, size, scale);
  return std::unique_ptr<Window>(new Window(handle, scale));
}

Window::Window(GLFWwindow* handle, float scale) : handle_(handle), scale_(scale) {
  glfwSetWindowUserPointer(handle, this);
  glfwMakeContextCurrent(handle);
  glfwSwapInterval(1);
  gl_ = std::make_unique<render::Gl>(render::load_gl(
      [](const char* name) { return reinterpret_cast<render::Proc>(glfwGetProcAddress(name)); }));
}

Window::~Window() {
  end_requests_.reset();
  glfwDestroyWindow(handle_);
  glfwTerminate();
}

glm::ivec2 Window::device_size() const {
  glm::ivec2 size;
  glfwGetFramebufferSize(handle_, &size.x, &size.y);
  return size;
}

glm::ivec2 Window::size() const {
  return glm::max(glm::ivec2(1), glm::ivec2(glm::vec2(device_size()) / scale_));
}

void Window::set_scale(float scale) {
  scale_ = used_scale(handle_, scale);
  if (!full_screen()) fit(handle_, glm::max(size(), least_size), scale_);
  events_.exposed();
}

// Returns logical pixels per window unit. A unit is a device pixel on X11, and a logical pixel on Wayland.
float Window::logical_per_unit() const {
  int units = 0;
  glfwGetWindowSize(handle_, &units, nullptr);
  return units > 0 ? static_cast<float>(device_size().x) / static_cast<float>(units) / scale_ : 1;
}

void Window::listen(WindowEvents events) {
  events_ = std::move(events);
  glfwSetCursorPosCallback(handle_, [](GLFWwindow* w, double x, double y) {
    const float k = of(w).logical_per_unit();
    of(w).events_.input(InputEvent::move({static_cast<float>(x) * k, static_cast<float>(y) * k}));
  });
  glfwSetMouseButtonCallback(handle_, [](GLFWwindow* w, int button, int action, int) {
    if (button <= 2) of(w).events_.input(InputEvent::button(button, action == GLFW_PRESS));
  });
  glfwSetScrollCallback(handle_, [](GLFWwindow* w, double, double y) {
    of(w).events_.input(InputEvent::scroll(static_cast<float>(y)));
  });
  glfwSetCursorEnterCallback(handle_, [](GLFWwindow* w, int entered) {
    if (!entered) of(w).events_.input(InputEvent::left_window());
  });
  glfwSetKeyCallback(handle_, [](GLFWwindow* w, int key, int scancode, int action, int) {
    if (action != GLFW_REPEAT && key >= 0)
      of(w).events_.input(InputEvent::key(labelled(key, scancode), action == GLFW_PRESS));
  });
  glfwSetCharCallback(handle_, [](GLFWwindow* w, unsigned code) {
    char utf8[5] = "";
    ImTextCharToUtf8(utf8, code);
    of(w).events_.input(InputEvent::typed(utf8));
  });
  glfwSetDropCallback(handle_, [](GLFWwindow* w, int count, const char** paths) {
    of(w).events_.dropped({paths, paths + count});
  });
  glfwSetWindowRefreshCallback(handle_, [](GLFWwindow* w) { of(w).events_.exposed(); });
  glfwSetFramebufferSizeCallback(handle_, [](GLFWwindow* w, int, int) { of(w).events_.exposed(); });
  end_requests_ = std::make_unique<base::os::EndRequests>([this] {
    if (asked_to_end_.exchange(true)) end_requests_->end_process();
    wake();
  });
}

void Window::share_clipboard() {
#if IMGUI_VERSION_NUM >= 19110
  ImGuiPlatformIO& io = ImGui::GetPlatformIO();
  io.Platform_GetClipboardTextFn = [](ImGuiContext*) { return glfwGetClipboardString(nullptr); };
  io.Platform_SetClipboardTextFn = [](ImGuiContext*, const char* text) {
    glfwSetClipboardString(nullptr, text);
  };
#else
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = handle_;
  io.GetClipboardTextFn = [](void* w) { return glfwGetClipboardString(static_cast<GLFWwindow*>(w)); };
  io.SetClipboardTextFn = [](void* w, const char* text) {
    glfwSetClipboardString(static_cast<GLFWwindow*>(w), text);
  };
#endif
}

void Window::wait_for_events(double seconds) {
  if (seconds <= 0) return glfwPollEvents();
  std::isinf(seconds) ? glfwWaitEvents() : glfwWaitEventsTimeout(seconds);
}

void Window::wake() {
  glfwPostEmptyEvent();
}

bool Window::asked_to_close() {
  const bool asked = asked_to_end_.exchange(false) || glfwWindowShouldClose(handle_);
  glfwSetWindowShouldClose(handle_, GLFW_FALSE);
  return asked;
}

void Window::set_title(const std::string& title) {
  if (title != title_) glfwSetWindowTitle(handle_, title.c_str());
  title_ = title;
}

bool Window::full_screen() const {
  return windowed_.has_value();
}

void Window::set_full_screen(bool full) {
  if (full == full_screen()) return;
  if (!full) {
    const Place place = *std::exchange(windowed_, std::nullopt);
    return glfwSetWindowMonitor(handle_, nullptr, place.corner.x, place.corner.y, place.size.x, place.size.y,
                                GLFW_DONT_CARE);
  }
  Place place{};
  glfwGetWindowPos(handle_, &place.corner.x, &place.corner.y);
  glfwGetWindowSize(handle_, &place.size.x, &place.size.y);
  GLFWmonitor* const screen = screen_of({place.corner, place.corner + place.size});
  const GLFWvidmode* const mode = screen ? glfwGetVideoMode(screen) : nullptr;
  if (!mode) return;
  windowed_ = place;
  glfwSetWindowMonitor(handle_, screen, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::present(render::Framebuffer& framebuffer) {
  const glm::ivec2 size = device_size();
  if (size.x > 0 && size.y > 0) framebuffer.blit_to_window(size);
  glfwSwapBuffers(handle_);
}

}  // namespace viete::platform
