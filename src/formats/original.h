// Keeps a file in memory, so that it can be written again with other positions.
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

/// The file that was read. Each format has its own subclass. Immutable and thread-safe.
class Original {
public:
  /// format: Format::name. Keeps source.owner, so that the bytes stay valid. Reading must have succeeded.
  Original(std::string_view format, const Source& source)
      : name_(source.name),
        bytes_(source.owner ? source.bytes : std::string_view()),
        owner_(source.owner),
        format_(format) {}
  virtual ~Original() = default;

  std::string_view format() const { return format_; }

  /// Content that is in neither the surface nor its attributes, so that other formats lose it: "animations",
  /// "12 lines".
  virtual std::vector<std::string> beyond_attributes() const { return {}; }

  /// External files that write_file() copies.
  virtual Companions companions() const { return {}; }

  /// All external files to which the file refers; they may not exist.
  virtual std::vector<std::filesystem::path> files_beside() const { return companions().files; }

  /// Writes the whole file with new values for positions that differ from `rest`, and for the normals and
  /// tangents that depend on them. rest: the surface read from the file. Returns messages for the user, one
  /// line each. Throws base::Error and base::Cancelled.
  virtual std::vector<std::string> write(const mesh::Surface& rest, std::span<const mesh::Point> positions,
                                         TextWriter& out) const = 0;

  /// Writes a file and replaces an existing file atomically. Also writes external buffers, and copies
  /// companions that are missing in the folder. progress may be null.
  virtual std::vector<std::string> write_file(const std::filesystem::path& path, const mesh::Surface& rest,
                                              std::span<const mesh::Point> positions, Digits digits,
                                              base::Progress* progress) const;

  /// Writes morph targets too, see check_motion(). Throws base::Error if the format has no morph targets.
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
  std::vector<std::string> warnings;  ///< ignored problems with their place, one line each
  std::shared_ptr<const Attributes> attributes;  ///< null if the file has no attributes
  std::shared_ptr<const Original> original;      ///< null if the file cannot be rewritten
  std::vector<std::string> comments;  ///< header comments without marks, at most 64 with 200 bytes each
};

}  // namespace viete::formats
