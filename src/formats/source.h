// A file to read: its bytes, its name, the progress, and the kind of its content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "base/progress.h"

namespace viete::formats {

/// The input of every reader. The bytes must stay valid until the reader returns.
struct Source {
  std::string name;        ///< path as the user wrote it, for messages
  std::string extension;   ///< lower case, without the dot; may be empty
  std::string_view bytes;  ///< arbitrary, untrusted content
  base::Progress* progress = nullptr;
  /// Keeps the bytes valid, to write the file again. If null, bytes are valid only during reading.
  std::shared_ptr<const void> owner = nullptr;
  std::filesystem::path folder = {};  ///< folder of external files; an empty path: no external files
  bool played = false;  ///< true if the caller plays morph targets: readers do not apply targets

  /// `done` is the reader's progress, 0 to 1. (FileBytes reports the first fifth.) Throws base::Cancelled.
  void report(double done) const {
    if (progress) progress->report(0.2 + 0.8 * done);
  }

  /// Returns the place of an error in a binary file: `name: element 12`, counted from 0.
  std::string place(std::string_view element, std::size_t index) const;
};

/// The first bytes of a file, as many as format detection needs.
class Beginning {
public:
  /// If the file cannot be read, the object is empty.
  explicit Beginning(const std::filesystem::path& file);

  std::string_view bytes() const { return bytes_; }
  std::uint64_t file_size() const { return file_size_; }
  bool is_whole_file() const { return bytes_.size() == file_size_; }
  /// Returns all lines, except a last line that is truncated.
  Source whole_lines() const;

private:
  std::string bytes_;
  std::uint64_t file_size_ = 0;
};

/// If the file is empty or of a known kind that cannot be read (a compressed file, a web page, a Blender
/// file, ...), throws base::Error with advice. `bytes` is the beginning of the file.
void refuse_foreign(const std::string& name, std::string_view bytes);

/// Returns true if the first 4096 bytes contain control characters that do not occur in text.
bool looks_binary(std::string_view bytes);

/// Names the content for messages: "a picture (PNG)", "a web page", "JSON", "text", "binary data".
std::string_view name_of_content(std::string_view beginning);

/// Returns the string at keys[0], keys[1], ... in nested JSON, or "". The JSON can be truncated.
std::string text_in_json(std::string_view beginning, std::initializer_list<std::string_view> keys);

}  // namespace viete::formats
