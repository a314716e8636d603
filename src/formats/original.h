// Keeps a file in memory, so that the file can be written again with other positions.
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

/// External files with relative paths in the model's file: material libraries and images.
struct Companions {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;  ///< absolute paths; some files can be missing
};

/// A file that was read. Each format has a subclass. Immutable and thread-safe.
class Original {
public:
  /// `format` is Format::name. Keeps source.owner, so that the bytes stay valid. Reading must have succeeded.
  Original(std::string_view format, const Source& source)
      : name_(source.name),
        bytes_(source.owner ? source.bytes : std::string_view()),
        owner_(source.owner),
        format_(format) {}
  virtual ~Original() = default;

  std::string_view format() const { return format_; }

  /// Names the content that only this file format stores: "animations", "12 lines".
  virtual std::vector<std::string> beyond_attributes() const { return {}; }

  /// True for a capture (Gaussian splats). Its vertices have sizes, rotations and colours that depend on the
  /// direction. They should follow a deformation, but they do not.
  virtual bool is_capture() const { return false; }

  /// The external files that write_file() copies.
  virtual Companions companions() const { return {}; }

  /// All external files to which the file refers. Some files can be missing.
  virtual std::vector<std::filesystem::path> files_beside() const { return companions().files; }

  /// Writes the whole file with new values for positions that differ from `rest`, and for the normals and
  /// tangents that depend on these positions. `rest` is the surface read from the file. Returns messages for
  /// the user, one line each. Can throw base::Error and base::Cancelled.
  virtual std::vector<std::string> write(const mesh::Surface& rest, std::span<const mesh::Point> positions,
                                         TextWriter& out) const = 0;

  /// Works like write(), and replaces an existing file atomically. Also writes external buffers, and copies
  /// companions that are missing in the new folder. `progress` may be null.
  virtual std::vector<std::string> write_file(const std::filesystem::path& path, const mesh::Surface& rest,
                                              std::span<const mesh::Point> positions, Digits digits,
                                              base::Progress* progress) const;

  /// Works like write_file(), and adds morph targets. `motion` must pass check_motion(). If the format has no
  /// morph targets, throws base::Error.
  virtual std::vector<std::string> write_animated(const std::filesystem::path& path,
                                                  const mesh::Surface& rest,
                                                  std::span<const mesh::Point> positions,
                                                  const MorphMotion& motion, base::Progress* progress) const;

  /// Returns the morph animation, or null if there are no targets. For invalid data, throws base::Error.
  virtual std::shared_ptr<const MorphClip> morphs() const { return nullptr; }

protected:
  Source source() const { return {name_, "", bytes_}; }

  std::string name_;
  std::string_view bytes_;  // the file's bytes; empty if there is no owner

private:
  std::shared_ptr<const void> owner_;
  std::string_view format_;
};

/// The result of reading a file.
struct ReadResult {
  mesh::Surface surface;
  std::string format;                 ///< "OBJ", "PLY ascii", "PLY binary little-endian", "STL binary", ...
  std::vector<std::string> warnings;  ///< problems that were ignored and their places, one line each
  std::shared_ptr<const Attributes> attributes;  ///< null if the file has no attributes
  std::shared_ptr<const Original> original;      ///< null if the file cannot be rewritten
  std::vector<std::string> comments;             ///< without comment marks; at most 64, each up to 200 bytes
};

}  // namespace viete::formats
