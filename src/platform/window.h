// A GLFW window with an OpenGL context. The window receives events and shows pictures.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/os.h"
#include "platform/input_queue.h"
#include "render/framebuffer.h"
#include "render/gl.h"

struct GLFWwindow;

namespace viete::platform {

/// The functions that wait_for_events() calls.
struct WindowEvents {
  std::function<void(InputEvent)> input;
  std::function<void(std::vector<std::filesystem::path>)> dropped;  ///< files dropped on the window
  std::function<void()> exposed;                                    ///< the window was resized or uncovered
};

/// Create at most one window, in the main thread. Its context is current in this thread. After listen(), the
/// signals SIGTERM, SIGINT and SIGHUP have the effect of the close button.
class Window {
public:
  /// `size` is in logical pixels; a window larger than the screen is reduced. `scale` is device pixels per
  /// logical pixel; 0 selects the display's scale. If there is no display or no OpenGL 3.3, returns null and
  /// sets `reason`.
  static std::unique_ptr<Window> open(glm::ivec2 size, float scale, std::string& reason);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  const render::Gl& gl() const { return *gl_; }
  float scale() const { return scale_; }
  /// See open(). Enlarges a window that would be too small for the panels. Calls WindowEvents::exposed().
  void set_scale(float scale);
  /// Returns the size in logical pixels, at least 1 x 1.
  glm::ivec2 size() const;

  void listen(WindowEvents events);
  /// Connects the current ImGui context to the clipboard.
  void share_clipboard();
  /// Handles events. If there are none, waits until an event, wake() or a signal, at most this time. 0 does
  /// not wait; infinity is allowed.
  void wait_for_events(double seconds);
  /// Ends wait_for_events(). Any thread may call this while a window exists.
  static void wake();
  /// True if the close button was clicked, or a signal arrived, since the last call.
  bool asked_to_close();

  void set_title(const std::string& title);
  /// If `full`, fills the screen that contains most of the window. Otherwise restores place and size.
  void set_full_screen(bool full);
  bool full_screen() const;
  void present(render::Framebuffer& framebuffer);

private:
  Window(GLFWwindow* handle, float scale);
  glm::ivec2 device_size() const;
  float logical_per_unit() const;

  GLFWwindow* handle_;
  float scale_;
  std::unique_ptr<render::Gl> gl_;
  WindowEvents events_;
  std::atomic<bool> asked_to_end_ = false;  ///< by a signal; a second one before it is taken ends the program
  std::unique_ptr<base::os::EndRequests> end_requests_;
  std::string title_;
  struct Place {
    glm::ivec2 corner, size;
  };
  std::optional<Place> windowed_;  ///< during full screen, the place to restore
};

}  // namespace viete::platform
