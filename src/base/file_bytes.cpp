#include "base/file_bytes.h"

#include <algorithm>
#include <atomic>
#include <new>

#include "base/error.h"
#include "base/os.h"
#include "base/worker_pool.h"

namespace viete::base {

namespace fs = std::filesystem;

namespace {

os::InputFile open(const fs::path& path) {
  try {
    return os::InputFile(path);
  } catch (const std::system_error& error) {
    throw Error(path.string(), "cannot be opened: " + error.code().message());
  }
}

std::unique_ptr<char[]> allocate(const fs::path& path, std::size_t size) {
  try {
    return std::make_unique_for_overwrite<char[]>(size);
  } catch (const std::bad_alloc&) {
    throw Error(path.string(), std::to_string(size) + " bytes do not fit into memory",
                "reduce the model or use a larger machine");
  }
}

}  // namespace

std::size_t regular_file_size(const fs::path& path) {
  if (path.empty()) throw Error("file name", "is empty", "choose a file");
  if (os::is_device_name(path))
    throw Error(path.string(), "Windows keeps this name for a device", "rename the file");
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found)
    throw Error(path.string(), "there is no such file", "check the path");
  if (status.type() == fs::file_type::directory)
    throw Error(path.string(), "this is a folder", "choose a file in it");
  if (code) {
    const bool circle = code == std::errc::too_many_symbolic_link_levels;
    throw Error(path.string(), "cannot be opened: " + code.message(),
                circle ? "the link refers to itself: choose the file" : "check the permissions");
  }
  if (status.type() != fs::file_type::regular)
    throw Error(path.string(), "this is not a regular file", "copy the data into a file first");
  const auto size = fs::file_size(path, code);
  if (code) throw Error(path.string(), "cannot be opened: " + code.message());
  return static_cast<std::size_t>(size);
}

FileBytes::FileBytes(const fs::path& path, Progress* progress, std::size_t most) {
  const std::size_t size = regular_file_size(path);
  if (size > most)
    throw Error(path.string(), "has more than " + std::to_string(most >> 20) + " MB",
                "check that it is the right file");
  const os::InputFile file = open(path);
  bytes_ = allocate(path, size);
  constexpr std::size_t step = 64 << 20, block = 1 << 20;
  std::atomic<bool> complete = true;
  for (; size_ < size; size_ = std::min(size, size_ + step)) {
    if (progress) progress->report(0.2 * static_cast<double>(size_) / static_cast<double>(size));
    const auto read = [&](std::size_t begin, std::size_t end) {
      if (!file.read(size_ + begin, bytes_.get() + size_ + begin, end - begin)) complete = false;
    };
    for_blocks(std::min(step, size - size_), read, block);
  }
  if (!complete) throw Error(path.string(), "cannot be read completely", "check the disk");
}

bool has_bytes(const fs::path& file, std::string_view bytes) {
  std::error_code code;
  return fs::is_regular_file(file, code) && fs::file_size(file, code) == bytes.size() && !code &&
         FileBytes(file).view() == bytes;
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

bool is_file_below(const fs::path& folder, const fs::path& file) {
  std::error_code code;
  const fs::path real = fs::weakly_canonical(file, code);
  return !code && fs::is_regular_file(real, code) && std::ranges::mismatch(folder, real).in1 == folder.end();
}

std::filesystem::path path_beside(const std::filesystem::path& folder, std::string_view name) {
  std::string slashed(name);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  return (folder / slashed).lexically_normal();
}

}  // namespace viete::base
