// base/os.h for Linux and other POSIX systems.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/os.h"
#include "base/text.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace viete::base::os {

// ---------------------------------------------------------------- program and environment

std::vector<std::string> start_program(int argc, char** argv) {
  for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);
  return {argv + std::min(argc, 1), argv + argc};
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

void set_variable(const char* name, const char* value) {
  setenv(name, value, 1);
}

fs::path program_file() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored);
}

std::string program_name(std::string_view name) {
  return std::string(name);
}

namespace {

fs::path absolute_path_in(const char* name) {
  const fs::path path = variable(name);
  return path.is_absolute() ? path : fs::path();
}

}  // namespace

fs::path home_folder() {
  return absolute_path_in("HOME");
}

fs::path state_folder() {
  if (fs::path folder = absolute_path_in("XDG_STATE_HOME"); !folder.empty()) return folder;
  const fs::path home = home_folder();
  return home.empty() ? home : home / ".local/state";
}

bool has_display() {
  return !variable("DISPLAY").empty() || !variable("WAYLAND_DISPLAY").empty() ||
         !variable("WAYLAND_SOCKET").empty();
}

// The first process only tests whether xdg-open is installed.
void open_page(const fs::path& page) {
  const auto run = [&](const std::vector<std::string>& words) {
    Child child(words, {});
    while (child.running()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::string said = child.errors(600);
    said.erase(said.find_last_not_of("\r\n") + 1);
    if (!child.succeeded()) throw StartFailure{std::move(said)};
  };
  try {
    run({"xdg-open", "--version"});
    run({"setsid", "--fork", "xdg-open", page.string()});
  } catch (const StartFailure& failure) {
    const std::string said = failure.reason.empty() ? "the program ended unexpectedly" : failure.reason;
    throw Error("xdg-open", failure.missing ? "this program is not installed" : printable(said),
                "open " + page.string() + " in a browser");
  }
}

std::tm local_time(std::time_t time) {
  std::tm parts{};
  localtime_r(&time, &parts);
  return parts;
}

bool is_terminal(std::FILE* file) {
  return isatty(fileno(file)) == 1;
}

void make_binary(std::FILE*) {}

std::FILE* reserve_output() {
  std::FILE* const file = fdopen(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3), "wb");
  dup2(STDERR_FILENO, STDOUT_FILENO);
  return file;
}

// The address sanitizer reserves more address space than any limit.
void limit_process(double bytes, unsigned seconds) {
  const auto limit = [](auto resource, double most) {
    rlimit limits{};
    getrlimit(resource, &limits);
    limits.rlim_cur = std::min(static_cast<rlim_t>(most), limits.rlim_max);
    setrlimit(resource, &limits);
  };
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds);
  limit(RLIMIT_FSIZE, bytes);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  limit(RLIMIT_AS, bytes);
#endif
}

// ---------------------------------------------------------------- machine

std::string system_name() {
  utsname names{};
  if (uname(&names) != 0) return "";
  return std::string(names.sysname) + " " + names.release + ", " + names.machine;
}

std::string processor_name() {
  std::ifstream lines("/proc/cpuinfo");
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
  return "";
}

std::optional<double> total_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGE_SIZE);
  if (pages <= 0 || size <= 0) return std::nullopt;
  return static_cast<double>(pages) * static_cast<double>(size);
}

std::optional<double> free_memory() {
  std::ifstream in("/proc/meminfo");
  std::string key, unit;
  double kilobytes = 0;
  while (in >> key >> kilobytes) {
    if (key == "MemAvailable:") return kilobytes * 1024;
    std::getline(in, unit);
  }
  return std::nullopt;
}

void* allocate_aligned(std::size_t alignment, std::size_t bytes) {
  void* memory = nullptr;
  return posix_memalign(&memory, alignment, bytes) == 0 ? memory : nullptr;
}

void free_aligned(void* memory) {
  std::free(memory);
}

void use_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
  madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}

void release_freed_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_MAX, 0);         // no array is a mapping of its own, which would end with the array
  mallopt(M_TRIM_THRESHOLD, -1);  // the heap does not shrink
#endif
}

Library::Library(std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (handle_ == nullptr) handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) throw Error(*names.begin(), "the library is not installed");
}

void* Library::find(const char* function) const {
  void* const address = dlsym(handle_, function);
  if (address == nullptr) throw Error(function, "the function is missing in the library");
  return address;
}

// ---------------------------------------------------------------- processes

unsigned long process_id() {
  return static_cast<unsigned long>(getpid());
}

// Reads field 22 of /proc/PID/stat, in clock ticks. (Field 2, the program's name, may contain spaces and
// parentheses.) A zombie does not run.
std::string process_start(unsigned long id) {
  std::ifstream file("/proc/" + std::to_string(id) + "/stat");
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

bool at_fork(void (*before)(), void (*after)()) {
  return pthread_atfork(before, after, after) == 0;
}

namespace {

// Settings of a child process: its three standard files, no blocked signals, its own process group.
struct SpawnSettings {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};

  SpawnSettings(int output, int errors) {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (output >= 0)
      posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
    else
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

// The words as execv() expects them.
std::vector<char*> pointers(const std::vector<std::string>& words) {
  std::vector<char*> all;
  for (const std::string& word : words) all.push_back(const_cast<char*>(word.c_str()));
  all.push_back(nullptr);
  return all;
}

// An unnamed file for the output or the errors of a child.
int unnamed_file() {
#if defined(__linux__)
  return memfd_create("output", MFD_CLOEXEC);
#else
  std::string name = (fs::temp_directory_path() / "viete-XXXXXX").string();
  const int file = mkstemp(name.data());
  if (file >= 0) {
    unlink(name.c_str());
    fcntl(file, F_SETFD, FD_CLOEXEC);
  }
  return file;
#endif
}

}  // namespace

struct Child::State {
  pid_t process = 0;
  int errors = unnamed_file(), output = -1;
  std::optional<int> status;  // set after the process has ended
  ~State() {
    for (const int file : {errors, output})
      if (file >= 0) close(file);
  }
};

Child::Child(const std::vector<std::string>& words, const std::vector<std::string>& variables,
             bool keeps_output)
    : state_(std::make_unique<State>()) {
  if (keeps_output) state_->output = unnamed_file();
  if (state_->errors < 0 || (keeps_output && state_->output < 0)) throw StartFailure{std::strerror(errno)};
  std::vector<char*> environment = pointers(variables);
  environment.pop_back();
  for (char** variable = environ; *variable; ++variable) environment.push_back(*variable);
  environment.push_back(nullptr);
  const SpawnSettings settings(state_->output, state_->errors);
  const int code = posix_spawnp(&state_->process, words.front().c_str(), &settings.files,
                                &settings.attributes, pointers(words).data(), environment.data());
  if (code != 0) throw StartFailure{std::strerror(code), code == ENOENT, code == EAGAIN};
}

Child::~Child() {
  const pid_t process = state_->process;
  if (process <= 0) return;
  kill(-process, SIGKILL);
  while (waitpid(process, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool Child::running() {
  int status = 1 << 8;  // failed, if waitpid() returns -1 because the system keeps no status of the process
  if (state_->process > 0 && waitpid(state_->process, &status, WNOHANG) != 0) {
    state_->process = 0;
    state_->status = status;
  }
  return state_->process > 0;
}

bool Child::succeeded() const {
  const int status = state_->status.value_or(0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void Child::ask_to_end() {
  if (state_->process > 0) kill(state_->process, SIGTERM);
}

namespace {

// Returns the first `most` bytes of a file. (One call of pread() reads at most 2 GB.)
std::string beginning_of(int file, std::size_t most) {
  std::string text(most, '\0');
  std::size_t size = 0;
  for (ssize_t got = 1; got > 0 && size<most; size += got> 0 ? static_cast<std::size_t>(got) : 0)
    got = pread(file, text.data() + size, most - size, static_cast<off_t>(size));
  text.resize(size);
  return text;
}

}  // namespace

std::string Child::errors(std::size_t most) const {
  return beginning_of(state_->errors, most);
}

std::string Child::output() const {
  struct stat status {};
  if (state_->output < 0 || fstat(state_->output, &status) != 0) return "";
  return beginning_of(state_->output, static_cast<std::size_t>(status.st_size));
}

bool run_and_wait(const std::vector<std::string>& words) {
  posix_spawn_file_actions_t to_errors;
  posix_spawn_file_actions_init(&to_errors);
  posix_spawn_file_actions_adddup2(&to_errors, STDERR_FILENO, STDOUT_FILENO);
  pid_t child = 0;
  const bool started =
      posix_spawnp(&child, words.front().c_str(), &to_errors, nullptr, pointers(words).data(), environ) == 0;
  posix_spawn_file_actions_destroy(&to_errors);
  if (started) waitpid(child, nullptr, 0);
  return started;
}

std::string replace_process(const std::vector<std::string>& words) {
  execv(words.front().c_str(), pointers(words).data());
  return std::strerror(errno);
}

namespace {

constexpr auto end_signals = {SIGINT, SIGTERM, SIGHUP};

using Actions = std::array<struct sigaction, end_signals.size()>;

// Sets the handler of the signals that end the process, except those in `kept` that are ignored. Returns the
// actions before.
Actions set_end_handler(void (*handler)(int), int flags, std::initializer_list<int> kept) {
  Actions before{};
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  for (std::size_t i = 0; i < end_signals.size(); ++i) {
    sigaction(end_signals.begin()[i], nullptr, &before[i]);
    const bool keeps = std::ranges::find(kept, end_signals.begin()[i]) != kept.end();
    if (!keeps || before[i].sa_handler != SIG_IGN) sigaction(end_signals.begin()[i], &action, nullptr);
  }
  return before;
}

void (*clean_up_at_end)() = nullptr;

void end_by_signal(int number) {
  clean_up_at_end();
  std::raise(number);  // with SA_RESETHAND, this ends the process when the handler returns
}

int end_pipe[2] = {-1, -1};  // the handler writes a byte; the thread of EndRequests reads it

void report_signal(int) {
  const int error = errno;
  (void)!write(end_pipe[1], "s", 1);
  errno = error;
}

}  // namespace

void at_end(void (*clean_up)()) {
  clean_up_at_end = clean_up;
  set_end_handler(end_by_signal, static_cast<int>(SA_RESETHAND), end_signals);
}

void remove_at_end(const fs::path::value_type* file) {
  unlink(file);
}

struct EndRequests::State {
  Actions before{};
  std::jthread thread;

  void restore() {
    for (std::size_t i = 0; i < end_signals.size(); ++i)
      sigaction(end_signals.begin()[i], &before[i], nullptr);
  }
};

EndRequests::EndRequests(std::function<void()> act) : state_(std::make_unique<State>()) {
  if (pipe(end_pipe) != 0) return;
  for (const int end : end_pipe) fcntl(end, F_SETFD, FD_CLOEXEC);
  try {
    state_->thread = std::jthread([act = std::move(act)] {
      for (char byte = 's'; byte == 's' && read(end_pipe[0], &byte, 1) == 1;)
        if (byte == 's') act();
    });
    state_->before = set_end_handler(report_signal, SA_RESTART, {SIGHUP});  // nohup ignores it
  } catch (const std::system_error&) {                                      // no thread can be created
  }
}

EndRequests::~EndRequests() {
  if (state_->thread.joinable()) {
    state_->restore();
    (void)!write(end_pipe[1], "e", 1);
    state_->thread.join();
  }
  for (int& end : end_pipe) close(std::exchange(end, -1));
}

void EndRequests::end_process() {
  state_->restore();
  std::raise(SIGINT);  // ends the process, unless the signal is ignored
  if (clean_up_at_end) clean_up_at_end();
  std::_Exit(128 + SIGINT);
}

// ---------------------------------------------------------------- files

std::optional<FileId> file_id(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return FileId(status.st_dev, status.st_ino);
}

std::uintmax_t count_names(const fs::path& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0 ? status.st_nlink : 1;
}

const char* const way_to_make_writable = "chmod u+w";

// Root can write any file, but respects the missing permission of the owner.
bool is_write_protected(const fs::path& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0 &&
         ((status.st_mode & S_IWUSR) == 0 || access(file.c_str(), W_OK) != 0);
}

bool is_device_name(const fs::path&) {
  return false;
}

void remove_unless_held(const fs::path& file) {
  const int handle = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0) return;
  struct stat status {};
  const bool ours = fstat(handle, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid();
  if (ours && flock(handle, LOCK_EX | LOCK_NB) == 0) unlink(file.c_str());
  close(handle);
}

bool is_disk_full(const std::error_code& code) {
  return code.value() == ENOSPC || code.value() == EDQUOT;
}

void sync_folder(const fs::path& folder) {
  const int handle = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return;
  fsync(handle);
  close(handle);
}

namespace {

// The permission bits that a new file gets from the existing file. The setuid and setgid bits are excluded.
constexpr mode_t kept_mode = 0777;

std::error_code code_of(bool succeeded) {
  return succeeded ? std::error_code() : std::error_code(errno, std::generic_category());
}

int descriptor(std::intptr_t handle) {
  return static_cast<int>(handle);
}

}  // namespace

std::error_code NewFile::create(const fs::path& file, const fs::path& like) {
  struct stat status {};
  const mode_t mode = stat(like.c_str(), &status) == 0 ? status.st_mode & kept_mode : 0666;
  handle_ = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  const std::error_code code = code_of(is_open());
  if (is_open()) flock(descriptor(handle_), LOCK_EX | LOCK_NB);
  return code;
}

std::error_code NewFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor(handle_), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return code_of(false);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

// Sets the owner and the group. If this is not allowed, sets only the group.
std::error_code NewFile::take_rights(const fs::path& existing) {
  struct stat status {};
  if (stat(existing.c_str(), &status) != 0) return {};
  const int file = descriptor(handle_);
  if (fchown(file, status.st_uid, status.st_gid) != 0)
    (void)!fchown(file, static_cast<uid_t>(-1), status.st_gid);
  return code_of(fchmod(file, status.st_mode & kept_mode) == 0);
}

std::error_code NewFile::flush_to_disk() {
  return code_of(fsync(descriptor(handle_)) == 0);
}

std::error_code NewFile::close() {
  if (!is_open()) return {};
  return code_of(::close(descriptor(std::exchange(handle_, none))) == 0);
}

InputFile::InputFile(const fs::path& file) : handle_(open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (handle_ < 0) throw std::system_error(code_of(false));
}

InputFile::~InputFile() {
  close(descriptor(handle_));
}

bool InputFile::read(std::uint64_t position, char* bytes, std::size_t count) const {
  const ssize_t got = pread(descriptor(handle_), bytes, count, static_cast<off_t>(position));
  return got == static_cast<ssize_t>(count);
}

}  // namespace viete::base::os
