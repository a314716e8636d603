#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "base/error.h"

namespace viete::base {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, int code) {
  const bool full = code == ENOSPC || code == EDQUOT;
  throw Error(path.string(), std::string("cannot be written: ") + std::strerror(code),
              full ? "free some space" : "choose a folder that exists and can be written");
}

// The file that a link leads to; a link that leads nowhere is replaced.
fs::path target_of(const fs::path& path) {
  std::error_code code;
  const fs::path real = fs::canonical(path, code);
  return code ? path : real;
}

// Removes the new file unless it was renamed.
class NewFile {
public:
  explicit NewFile(const fs::path& target) : target_(target) {
    for (int i = 0; handle_ < 0 && i < 1000; ++i) {
      path_ = target.string() + "." + std::to_string(getpid()) + "-" + std::to_string(i) + ".part";
      handle_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (handle_ < 0 && errno != EEXIST) break;
    }
    if (handle_ < 0) fail(target, errno);
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  ~NewFile() {
    if (handle_ >= 0) close(handle_);
    if (!path_.empty()) unlink(path_.c_str());
  }

  void write_all(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(handle_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(target_, errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void become_target(Outlives outlives) {
    struct stat existing {};
    if (stat(target_.c_str(), &existing) == 0 && fchmod(handle_, existing.st_mode & 07777) != 0)
      fail(target_, errno);
    if (outlives == Outlives::power_cut && fsync(handle_) != 0) fail(target_, errno);
    const int closed = close(handle_);
    handle_ = -1;
    if (closed != 0) fail(target_, errno);
    if (rename(path_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    path_.clear();
  }

private:
  fs::path target_;
  std::string path_;
  int handle_ = -1;
};

// So that the new name outlives a power cut; some file systems cannot, which is no error.
void sync_folder(const fs::path& folder) {
  const int handle = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return;
  fsync(handle);
  close(handle);
}

// Where the bytes go; throws where no file can be.
fs::path checked_target(const fs::path& path) {
  const fs::path target = target_of(path);
  std::error_code code;
  const fs::file_status status = fs::status(target, code);
  if (status.type() == fs::file_type::directory)
    throw Error(path.string(), "this is a folder", "name a file in it");
  if (fs::exists(status) && status.type() != fs::file_type::regular) {
    throw Error(path.string(), "this is not a regular file", "choose another name");
  }
  if (target.empty()) throw Error("", "no file is named", "name a file");
  return target;
}

}  // namespace

void check_replaceable(const fs::path& path) {
  NewFile probe(checked_target(path));  // removed again: it never becomes the target
}

void replace_file(const fs::path& path, std::string_view bytes, Outlives outlives) {
  replace_file(path, std::span(&bytes, 1), outlives);
}

void replace_file(const fs::path& path, std::span<const std::string_view> parts, Outlives outlives) {
  const fs::path target = checked_target(path);
  NewFile file(target);
  for (const auto bytes : parts) file.write_all(bytes);
  file.become_target(outlives);
  if (outlives == Outlives::power_cut) sync_folder(target.parent_path());
}

}  // namespace viete::base
