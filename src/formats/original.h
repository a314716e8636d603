// A file kept as read, so that it can be written again with other positions.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "formats/attributes.h"
#include "formats/morphs.h"
#include "formats/source.h"
#include "formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::formats {

/// External files referenced by relative paths: material libraries and images.
struct Companions {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;  ///< absolute; they may not exist
};

/// Immutable; one implementation per format. Thread-safe.
class Original {
public:
  /// format: its name in the table. Keeps the owner of the bytes, which must have been read without error.
  Original(std::string_view format, const Source& source)
      : name_(source.name),
        bytes_(source.owner ? source.bytes : std::string_view()),
        owner_(source.owner),
        format_(format) {}
  virtual ~Original() = default;

  std::string_view format() const { return format_; }

  /// Content that a surface and its attributes do not represent, and that other formats therefore lose:
  /// "animations", "12 lines".
  virtual std::vector<std::string> beyond_attributes() const { return {}; }

  /// External files that must accompany the file; write_file() copies them.
  virtual Companions companions() const { return {}; }

  /// All external files that it uses; they may not exist.
  virtual std::vector<std::filesystem::path> files_beside() const { return companions().files; }

  /// Writes the whole file in its order, with new values for positions that differ from `rest` (the surface
  /// read from it) and for the normals and tangents that depend on them. Returns messages for the user, one
  /// line each. Throws base::Error and base::Cancelled.
  virtual std::vector<std::string> write(const mesh::Surface& rest, std::span<const mesh::Point> positions,
                                         TextWriter& out) const = 0;

  /// Writes to a file, which is replaced atomically, together with external buffers of formats with several
  /// files, and with companions that its folder lacks. progress may be null.
  virtual std::vector<std::string> write_file(const std::filesystem::path& path, const mesh::Surface& rest,
                                              std::span<const mesh::Point> positions, Digits digits,
                                              base::Progress* progress) const;

  /// Writes morph targets as well, see check_motion(). Throws base::Error for formats without them.
  virtual std::vector<std::string> write_animated(const std::filesystem::path& path,
                                                  const mesh::Surface& rest,
                                                  std::span<const mesh::Point> positions,
                                                  const MorphMotion& motion, base::Progress* progress) const;

  /// The morph animation; null if there is none. Throws base::Error if it is invalid.
  virtual std::shared_ptr<const MorphClip> morphs() const { return nullptr; }

protected:
  Source source() const { return {name_, "", bytes_}; }

  std::string name_;
  std::string_view bytes_;  // the file's bytes; empty without an owner

private:
  std::shared_ptr<const void> owner_;
  std::string_view format_;
};

/// The result of reading a file.
struct ReadResult {
  mesh::Surface surface;
  std::string format;                 ///< "OBJ", "PLY ascii", "PLY binary little-endian", "STL binary", ...
  std::vector<std::string> warnings;  ///< harmless oddities with their place, one line each
  std::shared_ptr<const Attributes> attributes;  ///< null: only positions and polygons
  std::shared_ptr<const Original> original;      ///< null: cannot be written again as it was
  std::vector<std::string> comments;  ///< header comments without marks: at most 64, 200 bytes each
};

}  // namespace viete::formats
