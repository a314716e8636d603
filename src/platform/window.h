// A window with an OpenGL context, by GLFW: events in, a picture out.
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

/// Called while the window waits for events.
struct WindowEvents {
  std::function<void(InputEvent)> input;
  std::function<void(std::vector<std::filesystem::path>)> dropped;  ///< files, on the window
  std::function<void()> exposed;                                    ///< of another size, or uncovered
};

/// One at a time, in the main thread, whose current context is its own. While it is open, SIGTERM, SIGINT and
/// SIGHUP ask it to close.
class Window {
public:
  /// `size` in logical pixels, of `scale` device pixels each; 0 asks the display. No larger than the screen.
  /// Null, saying why in `reason`, if there is no display or no OpenGL 3.3.
  static std::unique_ptr<Window> open(glm::ivec2 size, float scale, std::string& reason);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  const render::Gl& gl() const { return *gl_; }
  float scale() const { return scale_; }
  /// In logical pixels, at least 1 x 1.
  glm::ivec2 size() const;

  void listen(WindowEvents events);
  /// With the ImGui context that is current.
  void share_clipboard();
  void poll_events();
  void wait_for_events(double seconds);
  /// By its close button or a signal; each time once.
  bool asked_to_close();

  void set_title(const std::string& title);
  /// Over the whole screen that shows most of it, or back to its place and size there. Nothing where it is
  /// so.
  void set_full_screen(bool full);
  bool full_screen() const;
  /// The window may be behind others.
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
  std::optional<Place> windowed_;  ///< where it goes back to, while it fills the screen
};

}  // namespace viete::platform
