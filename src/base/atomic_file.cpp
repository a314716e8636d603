#include "base/atomic_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/os.h"
#include "base/process.h"

namespace viete::base {

namespace fs = std::filesystem;

namespace {

void check(const fs::path& path, const std::error_code& code) {
  if (!code) return;
  const bool full = os::is_disk_full(code), limited = code == std::errc::file_too_large;
  throw Error(path.string(), "cannot be written: " + code.message(),
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

// The part files of this process, for the signal handler; unused entries are null. Further files are left.
using NativeName = const fs::path::value_type*;
std::array<std::atomic<NativeName>, 64> own_parts{};

void replace_own_part(NativeName from, NativeName to) {
  for (auto& entry : own_parts)
    if (NativeName expected = from; entry.compare_exchange_strong(expected, to)) return;
}

void remove_own_parts() {
  for (const auto& entry : own_parts)
    if (const NativeName path = entry) os::remove_at_end(path);
}

// Returns the path of the file to write. Throws Error for a folder, a device or a write-protected file.
fs::path checked_target(const fs::path& path) {
  const fs::path target = target_of(path);
  if (os::is_device_name(target))
    throw Error(path.string(), "Windows keeps this name for a device", "choose another name");
  std::error_code code;
  const fs::file_status status = fs::status(target, code);
  if (status.type() == fs::file_type::directory)
    throw Error(path.string(), "this is a folder", "choose a file in it");
  if (fs::exists(status) && status.type() != fs::file_type::regular) {
    throw Error(path.string(), "this is not a regular file", "choose another name");
  }
  if (target.empty()) throw Error("", "no file name is given", "give a file name");
  if (os::is_write_protected(target))
    throw Error(path.string(), "this file is write-protected",
                "choose another name, or make it writable (" + std::string(os::way_to_make_writable) + ")");
  return target;
}

}  // namespace

// process_runs() cannot find processes in other containers or on other computers. Their part files stay
// nevertheless, because they are locked and remove_unless_held() keeps them.
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
  std::ranges::for_each(stale, os::remove_unless_held);
}

// A part file. The destructor removes the file, unless become_target() has renamed it.
struct FilesTogether::File {
  explicit File(const fs::path& target) : target_(target) {
    remove_stale_parts(target.parent_path(), target.filename().string());
    std::error_code code = std::make_error_code(std::errc::file_exists);
    for (int i = 0; code == std::errc::file_exists && i < 1000; ++i) {
      path_ = part_of(target, i);
      code = file_.create(path_, target);
    }
    check(target, code);
    replace_own_part(nullptr, path_.c_str());
  }

  File(const File&) = delete;
  File& operator=(const File&) = delete;

  ~File() {
    (void)file_.close();
    if (path_.empty()) return;
    std::error_code ignored;
    fs::remove(path_, ignored);
    replace_own_part(path_.c_str(), nullptr);
  }

  void write_all(std::string_view bytes) { check(target_, file_.write(bytes)); }

  void settle(Durability durability) {
    check(target_, file_.take_rights(target_));
    if (durability == Durability::power_cut) check(target_, file_.flush_to_disk());
  }

  void become_target() {
    check(target_, file_.close());
    std::error_code code;
    fs::rename(path_, target_, code);
    check(target_, code);
    replace_own_part(path_.c_str(), nullptr);
    path_.clear();
  }

  const fs::path& target() const { return target_; }
  const fs::path& part() const { return path_; }

private:
  fs::path target_, path_;
  os::NewFile file_;
};

namespace {

// Returns "a.png" for 1, "a-2.png" for 2, ...
fs::path numbered(const fs::path& path, int number) {
  if (number == 1) return path;
  return path.parent_path() /
         (path.stem().string() + "-" + std::to_string(number) + path.extension().string());
}

}  // namespace

fs::path unused_name(const fs::path& path, const std::function<bool(const fs::path&)>& fits) {
  std::error_code ignored;
  fs::path name = path;
  const auto taken = [&] {
    return fs::exists(fs::symlink_status(name, ignored)) &&
           !(fs::is_regular_file(name, ignored) && fits(name));
  };
  for (int i = 2; taken(); ++i) name = numbered(path, i);
  return name;
}

void remove_parts_at_signals() {
  os::at_end(remove_own_parts);
}

void remove_leftovers_beside(const fs::path& path) {
  remove_stale_parts(target_of(path).parent_path());
}

void check_replaceable(const fs::path& path) {
  const fs::path target = checked_target(path);
  if (const auto names = os::count_names(target); names != 1)
    throw Error(
        path.string(),
        "this file has " + std::to_string(names) + " names (hard links), which replacing it would separate",
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

fs::path FilesTogether::put_new(const fs::path& path, std::string_view bytes) {
  const std::size_t hash = std::hash<std::string_view>()(bytes);
  std::error_code ignored;
  for (int i = 1;; ++i) {
    const fs::path name = numbered(path, i);
    const auto own = new_.find(name);
    if (own != new_.end() && own->second.first != hash) continue;
    const fs::path& content = own == new_.end() ? name : own->second.second->part();
    if (has_bytes(content, bytes)) return name;
    if (fs::exists(fs::symlink_status(content, ignored))) continue;
    put(name, [&](const ByteSink& out) { out(bytes); });
    new_[name] = {hash, files_.back().get()};
    return name;
  }
}

void FilesTogether::replace() {
  for (const auto& file : files_) file->become_target();
  for (const auto& file : files_) {
    if (durability_ == Durability::power_cut) os::sync_folder(file->target().parent_path());
  }
  files_.clear();
  new_.clear();
}

}  // namespace viete::base
