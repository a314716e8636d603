// Everything that differs between operating systems. os_posix*.cpp and os_windows*.cpp implement it; no other
// file of src includes a header of a system. Texts are UTF-8. Functions are thread-safe, objects are not.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace viete::base::os {

namespace fs = std::filesystem;

// ---------------------------------------------------------------- program and environment

/// Returns the arguments of main() without the program's name. Prepares the terminal for UTF-8. Afterwards, a
/// write to a closed pipe or beyond the limit of the file size fails; it does not end the program.
std::vector<std::string> start_program(int argc, char** argv);
/// Returns the value of an environment variable; empty if there is none.
std::string variable(const char* name);
void set_variable(const char* name, const char* value);
/// The file of the running program.
fs::path program_file();
/// The name of a program's file: "viete-bench" or "viete-bench.exe".
std::string program_name(std::string_view name);
/// The user's folder; empty if unknown.
fs::path home_folder();
/// The folder in which programs keep their state for this user: $XDG_STATE_HOME or ~/.local/state (XDG Base
/// Directory Specification), or %LOCALAPPDATA%. Empty if unknown.
fs::path state_folder();
/// True if windows can be opened.
bool has_display();
/// Opens a page in the user's browser. Throws Error.
void open_page(const fs::path& page);
std::tm local_time(std::time_t time);
/// True if the file is a terminal.
bool is_terminal(std::FILE* file);
/// Turns off the translation of line ends.
void make_binary(std::FILE* file);
/// Returns the standard output for bytes of this program; closes at the end. From now on, what libraries
/// print to the standard output goes to the standard error. Call once, before the first output.
std::FILE* reserve_output();
/// Limits this process: beyond `bytes` of address space, allocations fail; after `seconds` of processor time,
/// the process ends. Its files cannot be larger than `bytes`, and a crash does not write a core file.
void limit_process(double bytes, unsigned seconds);
/// From now on, the calling thread and its new threads can only read these files, and the files in these
/// folders and below. They cannot write or open other files, use the network or start programs; files that
/// are open stay open. Needs Linux 5.13; elsewhere, does less or nothing.
void confine_process(const std::vector<fs::path>& readable);

// ---------------------------------------------------------------- machine

/// The names of the system and the processor; empty if unknown.
std::string system_name();
std::string processor_name();
/// Bytes, or nullopt if the system does not report them.
std::optional<double> total_memory();
std::optional<double> free_memory();
/// The calling thread's processor time in seconds; wall time if the system does not measure it.
double thread_seconds();
/// Waits while the value is `old`. After a change, waiting threads continue at the next wake_all(). Until
/// then, the value must not become `old` again.
void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old);
void wake_all(std::atomic<std::uint32_t>& value);
/// Returns null if the memory is not available. `alignment` must be a power of two.
void* allocate_aligned(std::size_t alignment, std::size_t bytes);
void free_aligned(void* memory);
/// Lets the system use large pages; a failure only costs speed.
void use_large_pages(void* memory, std::size_t bytes);
/// Returns freed memory to the system. Call this after work with many small arrays.
void release_freed_memory();
/// From now on, keeps the memory of freed large arrays for other arrays. By default, it returns to the
/// system, and a command that makes many large arrays spends a third of its time on clearing new memory.
void keep_freed_memory();

/// A library that stays loaded until the process ends, because drivers crash when they are unloaded. Its
/// functions are hidden from other libraries.
class Library {
public:
  /// Loads the first of these libraries that is installed. Throws Error.
  explicit Library(std::initializer_list<const char*> names);
  /// Throws Error.
  void* find(const char* function) const;

private:
  void* handle_ = nullptr;
};

// ---------------------------------------------------------------- processes

unsigned long process_id();
/// Returns the start time of a process as digits. Empty if it does not run or cannot be inspected.
std::string process_start(unsigned long id);
/// Lets the system call `before` before fork(), and `after` afterwards in both processes.
/// Returns true if the system has fork().
bool at_fork(void (*before)(), void (*after)());

struct StartFailure {
  std::string reason;
  bool missing = false;  ///< the program is not installed
  bool limit = false;    ///< the limit on processes is reached
};

/// A child process in its own process group. Its standard input is empty. Its standard output is kept in
/// memory or discarded.
class Child {
public:
  /// Searches PATH for the program words[0]. Adds `variables` ("NAME=value") to the environment. Throws
  /// StartFailure.
  Child(const std::vector<std::string>& words, const std::vector<std::string>& variables,
        bool keeps_output = false);
  /// Kills the process and its children.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  bool running();
  /// True if the process ended without an error. Call this after running() returned false.
  bool succeeded() const;
  /// Sends a request to end; see EndRequests.
  void ask_to_end();
  /// The first `most` bytes of the standard error.
  std::string errors(std::size_t most) const;
  /// The standard output; empty if it is discarded.
  std::string output() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Runs a program with the files of this process and waits for it; its output goes to the standard error.
/// Returns false if it cannot be started.
bool run_and_wait(const std::vector<std::string>& words);
/// Replaces this process by a program. Returns the reason if this fails.
std::string replace_process(const std::vector<std::string>& words);

/// Lets a request to end this process (Ctrl+C, SIGTERM, a closed terminal) call `clean_up` first. Ignored
/// signals stay ignored. `clean_up` may only call remove_at_end().
void at_end(void (*clean_up)());
void remove_at_end(const fs::path::value_type* file);

/// While an EndRequests exists, requests to end this process call `act` in a thread of their own; they do not
/// end the process. An ignored SIGHUP (nohup) stays ignored; other ignored signals count, because shells
/// ignore SIGINT in the background. If this thread cannot be created, requests end the process. One object at
/// a time.
class EndRequests {
public:
  explicit EndRequests(std::function<void()> act);
  ~EndRequests();
  EndRequests(const EndRequests&) = delete;
  EndRequests& operator=(const EndRequests&) = delete;
  /// Ends the process as without EndRequests.
  [[noreturn]] void end_process();

private:
  struct State;
  std::unique_ptr<State> state_;
};

// ---------------------------------------------------------------- files

/// Equal for two names of one file.
using FileId = std::pair<std::uint64_t, std::uint64_t>;
/// Follows symbolic links. Returns nullopt if the file does not exist.
std::optional<FileId> file_id(const fs::path& file);
/// The number of names (hard links) of a file; 1 if unknown.
std::uintmax_t count_names(const fs::path& file);
/// True if the user cannot write this existing file, or it is marked as write-protected.
bool is_write_protected(const fs::path& file);
/// How a user removes this protection, for messages.
extern const char* const way_to_make_writable;
/// True for names such as "con.obj", which Windows takes for devices in every folder.
bool is_device_name(const fs::path& file);
/// Removes a file of this user that no NewFile holds.
void remove_unless_held(const fs::path& file);
/// True if the error means a full disk or a user's full quota.
bool is_disk_full(const std::error_code& code);
/// Makes the last rename in a folder survive a power cut, if the file system supports this.
void sync_folder(const fs::path& folder);

/// A file that did not exist before, for writing. The process holds it until it is closed, also on computers
/// that share the folder.
class NewFile {
public:
  NewFile() = default;
  ~NewFile() { (void)close(); }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  bool is_open() const { return handle_ != none; }
  /// Creates the file with the permissions of the file `like`, if there is one. Fails with errc::file_exists.
  std::error_code create(const fs::path& file, const fs::path& like);
  std::error_code write(std::string_view bytes);
  /// Sets the permissions and, if the system allows this, the owner of an existing file.
  std::error_code take_rights(const fs::path& existing);
  std::error_code flush_to_disk();
  std::error_code close();

private:
  static constexpr std::intptr_t none = -1;
  std::intptr_t handle_ = none;
};

/// A file for reading at any position.
class InputFile {
public:
  /// Throws std::system_error.
  explicit InputFile(const fs::path& file);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  /// Returns false if not all bytes can be read. Thread-safe.
  bool read(std::uint64_t position, char* bytes, std::size_t count) const;

private:
  std::intptr_t handle_;
};

}  // namespace viete::base::os
