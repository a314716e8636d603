#include "app/window.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

#include "app/state_folder.h"
#include "app/viewer.h"
#include "base/clock.h"
#include "scene/edit.h"
#include "scene/saving.h"

namespace viete::app {

namespace {

using platform::InputEvent;

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  std::string reason = text ? text : "no reason given";
  while (!reason.empty() && reason.back() == ' ') reason.pop_back();
  return reason;
}

std::string utf8(unsigned code) {
  const auto byte = [](unsigned value) { return static_cast<char>(value); };
  const auto tail = [&](unsigned shift) { return byte(0x80 | (code >> shift & 0x3f)); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xc0 | code >> 6), tail(0)};
  if (code < 0x10000) return {byte(0xe0 | code >> 12), tail(6), tail(0)};
  return {byte(0xf0 | code >> 18), tail(12), tail(6), tail(0)};
}

// GLFW names keys by their place on a US keyboard; shortcuts mean what is printed on the key.
int labelled(int key, int scancode) {
  if (key < GLFW_KEY_A || key > GLFW_KEY_Z) return key;
  const char* name = glfwGetKeyName(key, scancode);
  const bool letter = name && name[0] >= 'a' && name[0] <= 'z' && name[1] == 0;
  return letter ? name[0] - 'a' + GLFW_KEY_A : key;
}

struct GlfwSession {
  bool open = glfwInit() == GLFW_TRUE;
  ~GlfwSession() {
    if (open) glfwTerminate();
  }
};

// Where neither is named, nothing is asked: the Wayland library would complain on stderr where the session
// has no runtime folder, and open a window on whatever display of that folder it finds.
bool display_is_named() {
  const auto given = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
  };
  return given("DISPLAY") || given("WAYLAND_DISPLAY") || given("WAYLAND_SOCKET");
}

// The only thing that a signal handler may touch.
volatile std::sig_atomic_t end_signal = 0;

// A request, as by the window's close button. One more before the window has taken notice ends the program.
void take_end_signal(int number) {
  if (end_signal) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  end_signal = 1;
}

// What was told to be ignored (nohup) stays so.
void listen_to_end_signals() {
  for (const int number : {SIGTERM, SIGINT, SIGHUP}) {
    if (std::signal(number, take_end_signal) == SIG_IGN) std::signal(number, SIG_IGN);
  }
}

using WindowPtr = std::unique_ptr<GLFWwindow, decltype(&glfwDestroyWindow)>;

// Core 3.3 is all that is used; some drivers hand out exactly what is asked for, so ask for the newest first.
WindowPtr open_window(glm::ivec2 size) {
  constexpr int versions[][2] = {{4, 5}, {4, 3}, {3, 3}};
  for (const auto& version : versions) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, version[0]);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, version[1]);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SAMPLES, 0);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    // Whose window it is: the desktop looks for these in assets/desktop/viete.desktop.
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "Viete");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "viete");
#ifdef GLFW_WAYLAND_APP_ID
    glfwWindowHintString(GLFW_WAYLAND_APP_ID, "viete");
#endif
    if (GLFWwindow* window = glfwCreateWindow(size.x, size.y, "Viete", nullptr, nullptr)) {
      return {window, glfwDestroyWindow};
    }
  }
  return {nullptr, glfwDestroyWindow};
}

// One window with its viewer, and the units in between: events come in window units, the viewer thinks in
// logical pixels.
class Window {
public:
  Window(GLFWwindow* window, float scale, const std::filesystem::path& binding)
      : window_(window), scale_(scale) {
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    gl_ = std::make_unique<render::Gl>(render::load_gl(
        [](const char* name) { return reinterpret_cast<render::Proc>(glfwGetProcAddress(name)); }));
    ViewerOptions options;
    options.scale = scale;
    options.samples = gl_->software ? 0 : 4;
    options.still_samples = gl_->software ? 4 : 0;
    options.state = state_folder();
    options.bindings = {.folder = bindings_folder(), .named = binding};
    viewer_ = std::make_unique<Viewer>(*gl_, options);
    follow_size();
    listen();
    share_clipboard();
  }

  Viewer& viewer() { return *viewer_; }
  void run(int frames);

private:
  static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }
  void listen();
  void listen_to_mouse();
  void listen_to_keys();
  void push(InputEvent event) { viewer_->input().push(std::move(event)); }
  void share_clipboard();
  void follow_size();
  void set_title();
  void draw(float seconds);
  bool asked_to_end();
  void call_for_attention();

  // Window units are pixels on X11 and logical on Wayland: events are converted by what one unit is in device
  // pixels.
  float logical_per_unit() const {
    int units = 0, pixels = 0;
    glfwGetWindowSize(window_, &units, nullptr);
    glfwGetFramebufferSize(window_, &pixels, nullptr);
    return units > 0 ? static_cast<float>(pixels) / static_cast<float>(units) / scale_ : 1;
  }

  GLFWwindow* window_;
  float scale_;
  std::unique_ptr<render::Gl> gl_;
  std::unique_ptr<Viewer> viewer_;
  bool exposed_ = true, asks_ = false;
  std::string title_;
};

void Window::listen_to_mouse() {
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    const float k = of(w).logical_per_unit();
    of(w).push(InputEvent::move({static_cast<float>(x) * k, static_cast<float>(y) * k}));
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
    if (button <= 2) of(w).push(InputEvent::button(button, action == GLFW_PRESS));
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double y) {
    of(w).push(InputEvent::scroll(static_cast<float>(y)));
  });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int entered) {
    if (!entered) of(w).push(InputEvent::left_window());
  });
}

void Window::listen_to_keys() {
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int) {
    if (action != GLFW_REPEAT && key >= 0)
      of(w).push(InputEvent::key(labelled(key, scancode), action == GLFW_PRESS));
  });
  glfwSetCharCallback(window_,
                      [](GLFWwindow* w, unsigned code) { of(w).push(InputEvent::typed(utf8(code))); });
}

void Window::listen() {
  glfwSetWindowUserPointer(window_, this);
  listen_to_mouse();
  listen_to_keys();
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    auto& requests = of(w).viewer_->workspace().requests;
    requests.open = scene::OpenRequest{scene::OpenRequest::What::dropped, {paths, paths + count}};
    of(w).exposed_ = true;
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { of(w).exposed_ = true; });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) {
    of(w).follow_size();
    of(w).exposed_ = true;
  });
}

// Old and new versions of ImGui keep the clipboard functions in different places.
void Window::share_clipboard() {
#if IMGUI_VERSION_NUM >= 19110
  ImGuiPlatformIO& io = ImGui::GetPlatformIO();
  io.Platform_GetClipboardTextFn = [](ImGuiContext*) { return glfwGetClipboardString(nullptr); };
  io.Platform_SetClipboardTextFn = [](ImGuiContext*, const char* text) {
    glfwSetClipboardString(nullptr, text);
  };
#else
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = window_;
  io.GetClipboardTextFn = [](void* w) { return glfwGetClipboardString(static_cast<GLFWwindow*>(w)); };
  io.SetClipboardTextFn = [](void* w, const char* text) {
    glfwSetClipboardString(static_cast<GLFWwindow*>(w), text);
  };
#endif
}

void Window::follow_size() {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  viewer_->resize(glm::max(glm::ivec2(1), glm::ivec2(glm::vec2(width, height) / scale_)));
}

void Window::set_title() {
  const auto& model = viewer_->workspace().document.model;
  const char* unsaved = scene::has_unsaved_edits(viewer_->workspace()) ? "*" : "";
  const std::string title = model.surface ? model.path.filename().string() + unsaved + " - Viete" : "Viete";
  if (title != title_) glfwSetWindowTitle(window_, title.c_str());
  title_ = title;
}

void Window::draw(float seconds) {
  viewer_->frame(seconds);
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  if (width > 0 && height > 0) viewer_->framebuffer().blit_to_window({width, height});
  glfwSwapBuffers(window_);
  set_title();
  call_for_attention();
}

// By the window's close button or a signal; each time once.
bool Window::asked_to_end() {
  const bool asked = glfwWindowShouldClose(window_) || end_signal;
  glfwSetWindowShouldClose(window_, GLFW_FALSE);
  end_signal = 0;
  return asked;
}

// The window may be behind others when the program is asked to end.
void Window::call_for_attention() {
  const bool asks = viewer_->workspace().question.has_value();
  if (asks && !asks_) glfwRequestWindowAttention(window_);
  asks_ = asks;
}

// Draws when something changed, and otherwise waits for events.
void Window::run(int frames) {
  double last = base::wall_seconds();
  for (int drawn = 0; frames == 0 || drawn < frames;) {
    glfwPollEvents();
    const bool needed = exposed_ || viewer_->wants_frame();
    if (!needed) glfwWaitEventsTimeout(viewer_->working() ? 0.02 : 0.1);
    if (asked_to_end()) viewer_->workspace().requests.quit = exposed_ = true;
    if (!exposed_ && !viewer_->wants_frame() && frames == 0) continue;
    exposed_ = false;
    const double now = base::wall_seconds();
    draw(static_cast<float>(std::min(now - last, 0.1)));
    last = now;
    if (viewer_->closed()) return;
    if (!viewer_->loading()) ++drawn;
  }
}

}  // namespace

void set_settings(scene::Document& document, const WindowOptions& options) {
  scene::set_method(document, options.method);
  options.weighting.apply(document, false);
}

bool run_window(const WindowOptions& options, std::string& reason) {
  if (!display_is_named()) {
    reason = "there is no display: DISPLAY and WAYLAND_DISPLAY are not set";
    return false;
  }
  const GlfwSession session;
  if (!session.open) {
    reason = last_glfw_error();
    return false;
  }
  const WindowPtr handle = open_window({1440, 900});
  if (!handle) {
    reason = last_glfw_error();
    return false;
  }
  float scale = options.scale;
  if (scale <= 0) glfwGetWindowContentScale(handle.get(), &scale, nullptr);
  glfwSetWindowSizeLimits(handle.get(), 640, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
  if (scale > 1.01f) {
    int units = 0, pixels = 0;
    glfwGetWindowSize(handle.get(), &units, nullptr);
    glfwGetFramebufferSize(handle.get(), &pixels, nullptr);
    if (units == pixels) glfwSetWindowSize(handle.get(), int(1440 * scale), int(900 * scale));
  }
  Window window(handle.get(), std::max(scale, 0.5f), options.binding);
  scene::Workspace& workspace = window.viewer().workspace();
  if (state_folder().empty())
    workspace.messages.warn("There is no home folder: unsaved work is not kept; save often.");
  set_settings(workspace.document, options);
  workspace.requests.open =
      scene::OpenRequest{scene::OpenRequest::What::model, {options.model, options.cage, options.pose}};
  listen_to_end_signals();
  window.run(options.frames);
  if (!window.viewer().closed()) window.viewer().finish_keeping();
  if (window.viewer().keeping()) {
    std::fprintf(stderr, "viete: unsaved edits are kept; the next start offers to bring them back\n");
  }
  return true;
}

}  // namespace viete::app
