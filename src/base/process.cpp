#include "base/process.h"

#include <fcntl.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <sstream>
#include <thread>

#include "base/error.h"
#include "base/text.h"

namespace viete::base {

namespace {

// Returns the start time of a process in clock ticks: field 22 of /proc/PID/stat. (Field 2, the program's
// name, may contain spaces and parentheses.) Empty if the process does not exist or is a zombie.
std::string start_of(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto name_end = text.rfind(')');
  if (name_end == std::string::npos) return "";
  std::istringstream fields(text.substr(name_end + 1));
  std::string field;
  fields >> field;
  const bool ended = field == "Z" || field == "X";
  for (int i = 4; i <= 22; ++i) fields >> field;
  return fields && !ended ? field : "";
}

}  // namespace

std::string process_name() {
  const std::string pid = std::to_string(getpid());
  return pid + "-" + start_of(pid);
}

bool process_runs(std::string_view name) {
  const std::string pid(name.substr(0, name.find('-')));
  if (pid.empty() || pid.find_first_not_of("0123456789") != std::string::npos) return false;
  const std::string start = start_of(pid);
  return !start.empty() && name == pid + "-" + start;
}

namespace {

std::mutex entrance;          // fork() locks this mutex
std::atomic<int> inside = 0;  // the number of threads with a ForkDelay
thread_local int own = 0;     // the number of ForkDelays in this thread

void before_fork() {
  entrance.lock();
  for (int all = inside; all > (own > 0); all = inside) inside.wait(all);
}

void after_fork() {
  entrance.unlock();
}

[[maybe_unused]] const int registered = pthread_atfork(before_fork, after_fork, after_fork);

}  // namespace

ForkDelay::ForkDelay() {
  if (own++ > 0) return;
  const std::lock_guard lock(entrance);
  ++inside;
}

ForkDelay::~ForkDelay() {
  if (--own > 0) return;
  --inside;
  inside.notify_all();
}

namespace {

constexpr int look_again_ms = 20;

// Settings of a child process: its three standard files, no blocked signals, its own process group.
struct SpawnSettings {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};

  explicit SpawnSettings(int errors) {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
};

// Joins lines: "this; that".
std::string in_one_line(const std::string& lines) {
  std::string text;
  for (const char c : lines) {
    const bool ends = c == '\n' || c == '\r';
    if (!ends)
      text += c;
    else if (!text.ends_with("; "))
      text += "; ";
  }
  return text;
}

}  // namespace

ChildProgram::ChildProgram(const std::vector<std::string>& words, const std::string& advice,
                           const std::vector<std::string>& variables)
    : name_(words.front()) {
  errors_ = memfd_create("errors", MFD_CLOEXEC);
  if (errors_ < 0)
    throw Error(name_, std::string("cannot be run: ") + std::strerror(errno), "close other programs");
  std::vector<char*> arguments, environment;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  for (const std::string& variable : variables) environment.push_back(const_cast<char*>(variable.c_str()));
  for (char** variable = environ; *variable; ++variable) environment.push_back(*variable);
  environment.push_back(nullptr);
  const SpawnSettings settings(errors_);
  const int code = posix_spawnp(&process_, name_.c_str(), &settings.files, &settings.attributes,
                                arguments.data(), environment.data());
  if (code == 0) return;
  process_ = 0;
  close(errors_);
  if (code == EAGAIN)
    throw Error(name_, "cannot be run: the limit on processes is reached",
                "close other programs, or raise the limit (ulimit -u)");
  const bool missing = code == ENOENT;
  throw Error(
      name_, missing ? "this program is not installed" : std::string("cannot be run: ") + std::strerror(code),
      advice);
}

ChildProgram::~ChildProgram() {
  if (process_ > 0) {
    kill(-process_, SIGKILL);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  close(errors_);
}

bool ChildProgram::running() {
  int status = 1 << 8;  // failed, if waitpid() returns -1 because the system keeps no status of the process
  if (process_ > 0 && waitpid(process_, &status, WNOHANG) != 0) {
    process_ = 0;
    status_ = status;
  }
  return process_ > 0;
}

void ChildProgram::stop() {
  if (process_ > 0) kill(process_, SIGTERM);
}

void ChildProgram::finish() {
  while (running()) std::this_thread::sleep_for(std::chrono::milliseconds(look_again_ms));
  const int status = status_.value_or(0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail();
}

void ChildProgram::fail() {
  const std::string text = in_one_line(said());
  throw Error(name_, text.empty() ? "the program ended unexpectedly" : "it reported: " + printable(text, 600),
              "check the program's installation and the free disk space");
}

std::string ChildProgram::said() const {
  std::string text(4096, '\0');
  const ssize_t got = pread(errors_, text.data(), text.size(), 0);
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text;
}

}  // namespace viete::base
