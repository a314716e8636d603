#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/process.h"

namespace viete::base {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, int code) {
  const bool full = code == ENOSPC || code == EDQUOT, limited = code == EFBIG;
  throw Error(path.string(), std::string("cannot be written: ") + std::strerror(code),
              full      ? "free some disk space"
              : limited ? "raise the limit of the file size (ulimit -f), or choose another disk"
                        : "choose a folder that exists and can be written");
}

// Follows all symbolic links. If a link is broken or the file is missing, returns `path`.
fs::path target_of(const fs::path& path) {
  std::error_code code;
  const fs::path real = fs::canonical(path, code);
  return code ? path : real;
}

constexpr std::string_view part_extension = ".part";

// Returns the beginning of the names of part files. A long name is cut, because names have at most 255 bytes.
std::string part_begin(const std::string& name) {
  constexpr std::size_t most = 191;
  return name.substr(0, most) + ".";
}

fs::path part_of(const fs::path& target, int number) {
  return target.parent_path() / (part_begin(target.filename().string()) + base::process_name() + "-" +
                                 std::to_string(number) + std::string(part_extension));
}

// Returns PROCESS from `NAME.PROCESS-NUMBER.part`. For any other file name, returns an empty text.
std::string_view process_of_part(std::string_view name) {
  if (!name.ends_with(part_extension)) return "";
  name.remove_suffix(part_extension.size());
  const auto number = name.rfind('-'), target_end = name.rfind('.');
  if (number == name.npos || target_end == name.npos || number < target_end) return "";
  const auto digits = [](std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
  };
  const std::string_view process = name.substr(target_end + 1, number - target_end - 1);
  const auto middle = process.find('-');
  const bool ours = middle != process.npos && digits(process.substr(0, middle)) &&
                    digits(process.substr(middle + 1)) && digits(name.substr(number + 1));
  return ours ? process : "";
}

// Removes a part file of this user, unless a running program has locked it.
void remove_if_left(const fs::path& part) {
  const int handle = open(part.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0) return;
  struct stat status {};
  const bool ours = fstat(handle, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid();
  if (ours && flock(handle, LOCK_EX | LOCK_NB) == 0) unlink(part.c_str());
  close(handle);
}

// The part files of this process, for the signal handler; unused entries are null. Further files are left.
std::array<std::atomic<const char*>, 64> own_parts{};

void replace_own_part(const char* from, const char* to) {
  for (auto& entry : own_parts)
    if (const char* expected = from; entry.compare_exchange_strong(expected, to)) return;
}

void end_by_signal(int number) {
  for (const auto& entry : own_parts)
    if (const char* path = entry) unlink(path);
  std::raise(number);  // with SA_RESETHAND, this ends the process when the handler returns
}

// The permission bits that a new file gets from the existing file. The setuid and setgid bits are excluded.
constexpr mode_t kept_mode = 0777;

// Makes a rename survive a power cut. Ignores errors, because some file systems do not support this.
void sync_folder(const fs::path& folder) {
  const int handle = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return;
  fsync(handle);
  close(handle);
}

void check_rights(const fs::path& path, const fs::path& target) {
  struct stat existing {};
  if (stat(target.c_str(), &existing) != 0) return;
  if ((existing.st_mode & S_IWUSR) == 0 || access(target.c_str(), W_OK) != 0)
    throw Error(path.string(), "this file is write-protected",
                "choose another name, or make it writable (chmod u+w)");
}

// Returns the path of the file to write. Throws Error for a folder, a device or a write-protected file.
fs::path checked_target(const fs::path& path) {
  const fs::path target = target_of(path);
  std::error_code code;
  const fs::file_status status = fs::status(target, code);
  if (status.type() == fs::file_type::directory)
    throw Error(path.string(), "this is a folder", "choose a file in it");
  if (fs::exists(status) && status.type() != fs::file_type::regular) {
    throw Error(path.string(), "this is not a regular file", "choose another name");
  }
  if (target.empty()) throw Error("", "no file name is given", "give a file name");
  check_rights(path, target);
  return target;
}

}  // namespace

// process_runs() cannot find processes in other containers or on other computers. Their part files stay
// nevertheless, because they are locked and remove_if_left() keeps locked files.
void remove_stale_parts(const fs::path& folder, const std::string& target) {
  std::vector<fs::path> stale;
  std::error_code code;  // set if the folder cannot be read; the folder then counts as empty
  for (fs::directory_iterator at(folder.empty() ? "." : folder, code), end; !code && at != end;
       at.increment(code)) {
    const std::string name = at->path().filename().string();
    const std::string_view process = process_of_part(name);
    const bool wanted = target.empty() || name.starts_with(part_begin(target) + std::string(process));
    if (!process.empty() && wanted && !process_runs(process)) stale.push_back(at->path());
  }
  std::ranges::for_each(stale, remove_if_left);
}

// A part file. The destructor removes the file, unless become_target() has renamed it.
struct FilesTogether::File {
  explicit File(const fs::path& target) : target_(target) {
    remove_stale_parts(target.parent_path(), target.filename().string());
    struct stat existing {};
    const mode_t mode = stat(target.c_str(), &existing) == 0 ? existing.st_mode & kept_mode : 0666;
    for (int i = 0; handle_ < 0 && i < 1000; ++i) {
      path_ = part_of(target, i);
      handle_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
      if (handle_ >= 0) replace_own_part(nullptr, path_.c_str());
      if (handle_ < 0 && errno != EEXIST) break;
    }
    if (handle_ < 0) fail(target, errno);
    flock(handle_, LOCK_EX | LOCK_NB);  // shows other programs that this file is in use
  }

  File(const File&) = delete;
  File& operator=(const File&) = delete;

  ~File() {
    if (handle_ >= 0) close(handle_);
    if (path_.empty()) return;
    unlink(path_.c_str());
    replace_own_part(path_.c_str(), nullptr);
  }

  void write_all(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(handle_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(target_, errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void settle(Durability durability) {
    struct stat existing {};
    if (stat(target_.c_str(), &existing) == 0) {
      keep_owner(existing);
      if (fchmod(handle_, existing.st_mode & kept_mode) != 0) fail(target_, errno);
    }
    if (durability == Durability::power_cut && fsync(handle_) != 0) fail(target_, errno);
  }

  void become_target() {
    const int closed = close(handle_);
    handle_ = -1;
    if (closed != 0) fail(target_, errno);
    if (rename(path_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    replace_own_part(path_.c_str(), nullptr);
    path_.clear();
  }

  fs::path folder() const { return target_.parent_path(); }

private:
  // Sets the owner and the group of the new file. If this is not allowed, sets only the group.
  bool keep_owner(const struct stat& existing) {
    return fchown(handle_, existing.st_uid, existing.st_gid) == 0 ||
           fchown(handle_, static_cast<uid_t>(-1), existing.st_gid) == 0;
  }

  fs::path target_;
  std::string path_;
  int handle_ = -1;
};

fs::path unused_name(const fs::path& path, const std::function<bool(const fs::path&)>& fits) {
  std::error_code ignored;
  fs::path name = path;
  const auto taken = [&] {
    return fs::exists(fs::symlink_status(name, ignored)) &&
           !(fs::is_regular_file(name, ignored) && fits(name));
  };
  for (int i = 2; taken(); ++i)
    name = path.parent_path() / (path.stem().string() + "-" + std::to_string(i) + path.extension().string());
  return name;
}

void remove_parts_at_signals() {
  struct sigaction action {};
  struct sigaction before {};
  action.sa_handler = end_by_signal;
  action.sa_flags = SA_RESETHAND;
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)  // nohup ignores SIGHUP
      sigaction(number, &action, nullptr);
}

void remove_leftovers_beside(const fs::path& path) {
  remove_stale_parts(target_of(path).parent_path());
}

void check_replaceable(const fs::path& path) {
  const fs::path target = checked_target(path);
  struct stat existing {};
  if (stat(target.c_str(), &existing) == 0 && existing.st_nlink != 1)
    throw Error(path.string(),
                "this file has " + std::to_string(existing.st_nlink) +
                    " names (hard links), which replacing it would separate",
                "choose another name, or remove this one first");
  FilesTogether::File probe(target);  // makes a part file; the destructor removes it
}

void replace_file(const fs::path& path, std::string_view bytes, Durability durability) {
  replace_file(
      path, [bytes](const ByteSink& out) { out(bytes); }, durability);
}

void replace_file(const fs::path& path, const std::function<void(const ByteSink&)>& produce,
                  Durability durability) {
  FilesTogether files(durability);
  files.put(path, produce);
  files.replace();
}

FilesTogether::FilesTogether(Durability durability) : durability_(durability) {}

FilesTogether::~FilesTogether() = default;

void FilesTogether::put(const fs::path& path, const std::function<void(const ByteSink&)>& produce) {
  auto file = std::make_unique<File>(checked_target(path));
  produce([&file](std::string_view bytes) { file->write_all(bytes); });
  file->settle(durability_);
  files_.push_back(std::move(file));
}

void FilesTogether::replace() {
  for (const auto& file : files_) file->become_target();
  for (const auto& file : files_) {
    if (durability_ == Durability::power_cut) sync_folder(file->folder());
  }
  files_.clear();
}

}  // namespace viete::base
