#include "scene/document/files_in_use.h"

#include <sys/stat.h>

#include <optional>

namespace viete::scene {

namespace fs = std::filesystem;

namespace {

std::optional<std::pair<dev_t, ino_t>> identity(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

fs::path plain_name(const fs::path& file) {
  std::error_code code;
  const fs::path absolute = fs::absolute(file, code);
  const fs::path plain = fs::weakly_canonical(absolute, code);
  return code ? absolute.lexically_normal() : plain;
}

}  // namespace

FilesInUse::FilesInUse(std::initializer_list<fs::path> files) {
  for (const fs::path& file : files) add(file, "an input");
}

void FilesInUse::add(const fs::path& file, std::string_view what) {
  if (file.empty()) return;
  if (const auto same = identity(file)) {
    by_file_.emplace(*same, what);
  } else {
    by_name_.emplace(plain_name(file), what);
  }
}

const std::string* FilesInUse::find(const fs::path& file) const {
  if (file.empty()) return nullptr;
  if (const auto same = identity(file)) {
    const auto at = by_file_.find(*same);
    return at == by_file_.end() ? nullptr : &at->second;
  }
  if (by_name_.empty()) return nullptr;
  const auto at = by_name_.find(plain_name(file));
  return at == by_name_.end() ? nullptr : &at->second;
}

}  // namespace viete::scene
