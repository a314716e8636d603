// A GLFW window with an OpenGL context: receives events, presents pictures.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/input_queue.h"
#include "render/framebuffer.h"
#include "render/gl.h"

struct GLFWwindow;

namespace viete::platform {

/// Callbacks, called while the window polls or waits for events.
struct WindowEvents {
  std::function<void(InputEvent)> input;
  std::function<void(std::vector<std::filesystem::path>)> dropped;  ///< files dropped on the window
  std::function<void()> exposed;                                    ///< the window was resized or uncovered
};

/// At most one, in the main thread, where its context is current. While it exists, SIGTERM, SIGINT and SIGHUP
/// ask it to close.
class Window {
public:
  /// `size` is in logical pixels of `scale` device pixels each (0: the display's scale), and is limited to
  /// the screen. Null without a display or OpenGL 3.3; `reason` then explains why.
  static std::unique_ptr<Window> open(glm::ivec2 size, float scale, std::string& reason);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  const render::Gl& gl() const { return *gl_; }
  float scale() const { return scale_; }
  /// In logical pixels, at least 1 x 1.
  glm::ivec2 size() const;

  void listen(WindowEvents events);
  /// For the current ImGui context.
  void share_clipboard();
  void poll_events();
  void wait_for_events(double seconds);
  /// True once per click on the close button or signal.
  bool asked_to_close();

  void set_title(const std::string& title);
  /// Fills the screen that shows most of the window, or restores its place and size. No effect if already so.
  void set_full_screen(bool full);
  bool full_screen() const;
  /// For a window that may be behind others.
  void call_for_attention();
  void present(render::Framebuffer& framebuffer);

private:
  Window(GLFWwindow* handle, float scale);
  void listen_to_mouse();
  void listen_to_keys();
  glm::ivec2 device_size() const;
  float logical_per_unit() const;

  GLFWwindow* handle_;
  float scale_;
  std::unique_ptr<render::Gl> gl_;
  WindowEvents events_;
  std::string title_;
  struct Place {
    glm::ivec2 corner, size;
  };
  std::optional<Place> windowed_;  ///< place to restore after full screen
};

}  // namespace viete::platform
