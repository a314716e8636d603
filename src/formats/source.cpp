#include "formats/source.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>

#include "base/error.h"
#include "base/worker_pool.h"

namespace viete::formats {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::unique_ptr<char[]> allocate(const fs::path& path, std::size_t size) {
  try {
    return std::make_unique_for_overwrite<char[]>(size);
  } catch (const std::bad_alloc&) {
    throw base::Error(path.string(), std::to_string(size) + " bytes do not fit into memory",
                      "reduce the model or use a larger machine");
  }
}

}  // namespace

std::size_t regular_file_size(const fs::path& path) {
  if (path.empty()) throw base::Error("file name", "is empty", "choose a file");
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found)
    throw base::Error(path.string(), "there is no such file", "check the path");
  if (status.type() == fs::file_type::directory)
    throw base::Error(path.string(), "this is a folder", "choose a file in it");
  if (code) {
    const bool circle = code == std::errc::too_many_symbolic_link_levels;
    throw base::Error(path.string(), "cannot be opened: " + code.message(),
                      circle ? "the link refers to itself: choose the file" : "check the permissions");
  }
  if (status.type() != fs::file_type::regular)
    throw base::Error(path.string(), "this is not a regular file", "copy the data into a file first");
  const auto size = fs::file_size(path, code);
  if (code) throw base::Error(path.string(), "cannot be opened: " + code.message());
  return static_cast<std::size_t>(size);
}

std::string Source::place(std::string_view element, std::size_t index) const {
  return name + ": " + std::string(element) + " " + std::to_string(index);
}

FileBytes::FileBytes(const fs::path& path, base::Progress* progress, std::size_t most) {
  const std::size_t size = regular_file_size(path);
  if (size > most)
    throw base::Error(path.string(), "has more than " + std::to_string(most >> 20) + " MB",
                      "check that it is the right file");
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw base::Error(path.string(), std::string("cannot be opened: ") + std::strerror(errno));
  bytes_ = allocate(path, size);
  constexpr std::size_t step = 64 << 20, block = 1 << 20;
  std::atomic<bool> complete = true;
  for (; size_ < size; size_ = std::min(size, size_ + step)) {
    if (progress) progress->report(0.2 * static_cast<double>(size_) / static_cast<double>(size));
    const auto read = [&](std::size_t begin, std::size_t end) {
      const auto got = pread(fileno(file.get()), bytes_.get() + size_ + begin, end - begin,
                             static_cast<off_t>(size_ + begin));
      if (got != static_cast<ssize_t>(end - begin)) complete = false;
    };
    base::for_blocks(std::min(step, size - size_), read, block);
  }
  if (!complete) throw base::Error(path.string(), "cannot be read completely", "check the disk");
}

Beginning::Beginning(const fs::path& file) {
  constexpr std::size_t enough = 1 << 20;
  std::error_code code;
  const auto size = fs::file_size(file, code);
  if (!code) file_size_ = size;
  bytes_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(file_size_, enough)));
  std::ifstream in(file, std::ios::binary);
  in.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  bytes_.resize(static_cast<std::size_t>(in.gcount()));
}

Source Beginning::whole_lines() const {
  const std::size_t last = is_whole_file() ? bytes_.size() : bytes_.find_last_of("\r\n");
  return {"", "", bytes().substr(0, last)};
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  return lower;
}

std::string extension_of(const fs::path& path) {
  const std::string extension = path.extension().string();
  return lower_case(extension.empty() ? extension : extension.substr(1));
}

fs::path folder_of(const fs::path& file) {
  return fs::weakly_canonical(fs::absolute(file).parent_path());
}

std::filesystem::path path_beside(const std::filesystem::path& folder, std::string_view name) {
  std::string slashed(name);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  return (folder / slashed).lexically_normal();
}

}  // namespace viete::formats
