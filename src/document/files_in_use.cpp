#include "document/files_in_use.h"

namespace viete::document {

namespace fs = std::filesystem;

namespace {

// Returns the file's identity or, if the file does not exist, the absolute path.
FileIdentity identity(const fs::path& file) {
  if (const auto id = base::os::file_id(file)) return *id;
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
  if (!file.empty()) files_.emplace(identity(file), what);
}

const std::string* FilesInUse::find(const fs::path& file) const {
  if (file.empty()) return nullptr;
  const auto at = files_.find(identity(file));
  return at == files_.end() ? nullptr : &at->second;
}

}  // namespace viete::document
