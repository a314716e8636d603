// A virtual display with mouse and keyboard, and programs on this display.
#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <thread>

#include "support/data.h"
#include "support/folder.h"

namespace viete::test {

namespace fs = std::filesystem;

/// Waits until the condition is true. After the limit, returns false: only a hanging program takes so long.
inline bool wait_until(const std::function<bool()>& condition, double seconds = 300) {
  for (int i = 0; i < seconds * 20; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

inline bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

/// The key code of F12. On some keyboard layouts, two keys are F12, and xdotool would use the wrong key.
constexpr const char* f12_keycode = "96";

// A child process. The destructor kills the process.
class Child {
public:
  Child(const std::string& command, const fs::path& log) {
    pid_ = fork();
    if (pid_ == 0) {
      setpgid(0, 0);
      const int out = open(log.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
      dup2(out, 1);
      dup2(out, 2);
      execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
      _exit(127);
    }
  }
  ~Child() {
    if (pid_ <= 0 || finished()) return;
    kill(-pid_, SIGKILL);
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  bool finished() {
    if (!status_) {
      int status = 0;
      if (waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
    }
    return status_.has_value();
  }
  void kill_now() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }
  /// Sends SIGTERM, as the desktop does at the end of a session.
  void terminate() { kill(pid_, SIGTERM); }
  int exit_code() const { return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 128 + WTERMSIG(*status_); }

private:
  pid_t pid_ = 0;
  std::optional<int> status_;
};

struct Desktop {
  fs::path folder = fs::temp_directory_path() / ("viete-test-window-" + std::to_string(getpid()));
  std::string display;
  std::optional<Child> server;

  Desktop() {
    fs::create_directories(folder);
    const fs::path number = folder / "display";
    server.emplace("Xvfb -displayfd 3 -screen 0 1440x900x24 -nolisten tcp -fbdir '" + folder.string() +
                       "' 3>'" + number.string() + "'",
                   folder / "xvfb.log");
    REQUIRE_MESSAGE(wait_until([&] { return fs::exists(number) && fs::file_size(number) > 1; }),
                    "Xvfb did not start");
    std::ifstream(number) >> display;
    display = ":" + display;
    setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);  // each desktop has its own preferences
    fs::create_directories(folder / "state" / "viete");
    std::ofstream(folder / "state" / "viete" / "remembered.json")
        << R"({"format": "viete preferences", "version": 1, "ask_keys": false})";
  }
  ~Desktop() {
    server.reset();
    fs::remove_all(folder);
  }
  void xdotool(const std::string& arguments) {
    REQUIRE(std::system(("DISPLAY=" + display + " xdotool " + arguments + " >/dev/null 2>&1").c_str()) == 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  }
  /// Returns the bytes of the screen.
  std::string screen() const { return file_bytes(folder / "Xvfb_screen0"); }
  /// Waits until the screen differs from `before` and no longer changes. The program has then handled all
  /// events.
  void rest(const std::string& before = "") {
    std::string seen = before;
    const auto same_again = [&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(400));  // longer than the text cursor blinks
      std::string now = screen();
      const bool same = now == seen && now != before;
      seen = std::move(now);
      return same;
    };
    REQUIRE_MESSAGE(wait_until(same_again), "the screen does not come to rest");
  }
  /// Sends keys or mouse events that change the screen. Waits for the change.
  void xdotool_seen(const std::string& arguments) {
    const std::string before = screen();
    xdotool(arguments);
    rest(before);
  }
  void drag(glm::ivec2 from, glm::ivec2 to) {
    const auto at = [](glm::ivec2 p) { return std::to_string(p.x) + " " + std::to_string(p.y); };
    xdotool("mousemove " + at(from));
    xdotool("mousedown 1");
    for (int i = 1; i <= 8; ++i) xdotool("mousemove " + at(from + (to - from) * i / 8));
    xdotool("mouseup 1");
  }
  /// Returns the command line that starts the viewer in the desktop's folder.
  std::string viete(const std::string& arguments) const {
    return "env DISPLAY=" + display + " WAYLAND_DISPLAY= sh -c 'cd \"" + folder.string() + "\" && exec \"" +
           test::build_dir().string() + "/viete\" --scale 1 " + arguments + "'";
  }
  std::optional<fs::path> screenshot() {
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".png") return entry.path();
    return std::nullopt;
  }
};

/// If Xvfb or xdotool is missing, skips the test case and returns true.
inline bool no_desktop() {
  for (const char* program : {"Xvfb", "xdotool"}) {
    if (has_program(program)) continue;
    skip(std::string(program) + " is not installed");
    return true;
  }
  return false;
}

}  // namespace viete::test
