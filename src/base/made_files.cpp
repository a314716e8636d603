#include "base/made_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>

#include "base/checksum.h"
#include "base/error.h"

namespace viete::base {

namespace fs = std::filesystem;

namespace {

struct FileContent {
  std::uint64_t bytes = 0, checksum = 0;
};

// Nothing where it is no regular file that can be read.
std::optional<FileContent> content_of_file(const fs::path& path) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  FileContent content;
  Checksum sum;
  constexpr std::size_t portion = 1 << 20;
  const auto buffer = std::make_unique<char[]>(portion);
  while (in) {
    in.read(buffer.get(), portion);
    const auto got = static_cast<std::size_t>(in.gcount());
    sum.add(buffer.get(), got);
    content.bytes += got;
  }
  if (!in.eof()) return std::nullopt;
  content.checksum = sum.value();
  return content;
}

[[noreturn]] void fail_record(const fs::path& record, const char* what) {
  throw Error(record.string(), std::string(what) + ": " + std::strerror(errno),
              "choose a folder that can be read and written, with free space");
}

struct OpenRecord {
  int handle;
  ~OpenRecord() { close(handle); }
};

std::string begun_line(const MadeFiles::Planned& file) {
  char text[96];
  std::snprintf(text, sizeof text, "begun %" PRId64 " %016" PRIx64 "\n", file.number, file.key);
  return text;
}

std::string made_line(const MadeFiles::Planned& file, const FileContent& content) {
  char text[160];
  std::snprintf(text, sizeof text, "made %" PRId64 " %016" PRIx64 " %" PRIu64 " %016" PRIx64 "\n",
                file.number, file.key, content.bytes, content.checksum);
  return text;
}

// Before the line of the file that leads there.
std::string beside_line(std::int64_t number, const std::string& name) {
  return "beside " + std::to_string(number) + ' ' + name + '\n';
}

// The name in such a line; empty for another line.
std::string name_beside(const std::string& line, std::int64_t& number) {
  int end = 0;
  if (std::sscanf(line.c_str(), "beside %" SCNd64 " %n", &number, &end) != 1 || end == 0) return "";
  const std::string name = line.substr(static_cast<std::size_t>(end));
  return line + '\n' == beside_line(number, name) ? name : "";
}

}  // namespace

MadeFiles::MadeFiles(NumberedName name) : name_(std::move(name)), record_(name_.pattern() + ".made") {
  read();
}

// What is only printed may be scanned: a line counts if printing what was read gives it again.
void MadeFiles::read() {
  std::ifstream in(record_);
  if (!in) {
    std::error_code code;
    if (fs::exists(fs::symlink_status(record_, code))) fail_record(record_, "cannot be read");
    return;
  }
  std::map<std::int64_t, std::vector<std::string>> beside;
  for (std::string line; std::getline(in, line);) {
    Planned file{};
    FileContent content;
    const bool begun =
        std::sscanf(line.c_str(), "begun %" SCNd64 " %" SCNx64, &file.number, &file.key) == 2 &&
        line + "\n" == begun_line(file);
    const bool made = std::sscanf(line.c_str(), "made %" SCNd64 " %" SCNx64 " %" SCNu64 " %" SCNx64,
                                  &file.number, &file.key, &content.bytes, &content.checksum) == 4 &&
                      line + "\n" == made_line(file, content);
    if (begun) entries_[file.number].begun = true;
    if (made)
      entries_[file.number] = {
          file.key, content.bytes, content.checksum, std::exchange(beside[file.number], {}), false, true};
    if (const std::string name = name_beside(line, file.number); !name.empty())
      beside[file.number].push_back(name);
  }
  if (in.bad()) fail_record(record_, "cannot be read");
}

MadeFiles::State MadeFiles::state(const Planned& file) const {
  const fs::path path = name_.file(file.number);
  std::error_code code;
  if (!fs::exists(fs::symlink_status(path, code))) return State::missing;
  const auto known = entries_.find(file.number);
  if (known == entries_.end()) return State::foreign;
  const Entry& entry = known->second;
  if (entry.made) {
    const auto size = fs::file_size(path, code);
    const auto content = !code && size == entry.bytes ? content_of_file(path) : std::nullopt;
    const bool same = content && content->bytes == entry.bytes && content->checksum == entry.content;
    if (same) return entry.key == file.key && has_all_beside(entry) ? State::whole : State::ours;
  }
  return entry.begun ? State::ours : State::foreign;
}

bool MadeFiles::has_all_beside(const Entry& entry) const {
  std::error_code ignored;
  return std::ranges::all_of(entry.beside, [&](const std::string& name) {
    return fs::is_regular_file(record_.parent_path() / name, ignored);
  });
}

void MadeFiles::begin(std::span<const Planned> files) {
  std::string lines;
  for (const Planned& file : files) {
    lines += begun_line(file);
    entries_[file.number].begun = true;
  }
  if (!lines.empty()) append(lines, true);
}

void MadeFiles::add(const Planned& file, std::span<const fs::path> beside) {
  const auto content = content_of_file(name_.file(file.number));
  if (!content) fail_record(name_.file(file.number), "cannot be read again");
  Entry entry{file.key, content->bytes, content->checksum, {}, false, true};
  std::string lines;
  for (const fs::path& path : beside) {
    const std::string name = path.lexically_proximate(record_.parent_path()).string();
    if (name.find('\n') != name.npos) continue;  // has no line
    entry.beside.push_back(name);
    lines += beside_line(file.number, name);
  }
  entries_[file.number] = std::move(entry);
  append(lines + made_line(file, *content), false);
}

// In one piece, behind what others have added; a line that a killed process has left unfinished is ended.
void MadeFiles::append(const std::string& lines, bool sync) const {
  const int handle = open(record_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NONBLOCK | O_CLOEXEC, 0666);
  if (handle < 0) fail_record(record_, "cannot be written");
  const OpenRecord file{handle};
  flock(handle, LOCK_EX);  // where the file system can: elsewhere small pieces are whole by themselves
  const off_t size = lseek(handle, 0, SEEK_END);
  char last = '\n';
  if (size > 0 && pread(handle, &last, 1, size - 1) != 1) fail_record(record_, "cannot be read");
  const std::string all = (last == '\n' ? "" : "\n") + lines;
  std::string_view left = all;
  while (!left.empty()) {
    const ssize_t written = write(handle, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_record(record_, "cannot be written");
    left.remove_prefix(static_cast<std::size_t>(written));
  }
  if (sync && fsync(handle) != 0) fail_record(record_, "cannot be written");
}

}  // namespace viete::base
