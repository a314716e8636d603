// Keeps a file in memory, so that the file can be written again with other positions or with morph targets.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "formats/attributes.h"
#include "formats/source.h"
#include "formats/text_writer.h"
#include "mesh/splats.h"
#include "mesh/surface.h"

namespace viete::formats {

/// Morph targets and their weights over time. The positions at a key are the rest positions plus the weighted
/// offsets of all targets. Between keys, weights are interpolated linearly.
struct MorphMotion {
  std::string name;
  std::vector<double> seconds;       ///< times of the keys in ascending order
  std::vector<std::string> targets;  ///< a name for each target; a name may be empty
  std::vector<float> weights;        ///< targets.size() weights for each key
  std::vector<char> moves;           ///< for each vertex, true if a target moves the vertex
  /// Returns the positions at full weight of the target. Called once for each target, in order.
  std::function<std::vector<mesh::Point>(std::size_t target)> positions;
  bool normals = true;  ///< true to animate normals and tangents too
};

/// If there are no keys, times do not increase, or sizes do not match, throws base::Error.
void check_motion(const MorphMotion& motion, std::size_t vertices);

/// The weights between two keys: constant, linear, or anything else.
enum class MorphCurve { held, linear, other };

/// The morph animation of a glTF file. Computes positions only on request. Immutable and thread-safe.
class MorphClip {
public:
  virtual ~MorphClip() = default;

  const std::string& name() const { return name_; }                     ///< animation name; may be empty
  const std::vector<double>& seconds() const { return seconds_; }       ///< ascending; may be empty
  const std::vector<MorphCurve>& curves() const { return curves_; }     ///< after each key but the last
  const std::vector<std::string>& targets() const { return targets_; }  ///< a non-empty name for each target
  const std::vector<std::string>& notes() const { return notes_; }      ///< messages about ignored content

  /// Returns the positions of the surface. If the file contains invalid data, throws base::Error.
  virtual std::vector<mesh::Point> at(double second) const = 0;
  std::vector<mesh::Point> at_key(std::size_t key) const { return at(seconds_[key]); }
  /// Returns the positions with one target at full weight and all others at 0. Throws like at().
  virtual std::vector<mesh::Point> at_target(std::size_t target) const = 0;

protected:
  std::string name_;
  std::vector<double> seconds_;
  std::vector<MorphCurve> curves_;
  std::vector<std::string> targets_, notes_;
};

/// External files with relative paths in the model's file: material libraries and images.
struct Companions {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;  ///< absolute paths; some files can be missing
};

/// Tells whether a file stores Gaussian splats.
enum class Capture {
  none,    ///< the file is not a capture
  points,  ///< a capture whose splats are not read: can be viewed as points, but not deformed
  splats   ///< ReadResult::splats
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

  Capture capture() const { return capture_; }

  /// All external files to which the file refers. Some files can be missing.
  virtual std::vector<std::filesystem::path> files_beside() const { return companions_.files; }

  /// Writes the whole file with new values for positions that differ from content.surface, and for the
  /// normals and tangents that depend on these positions; for a capture, also for splats that differ from the
  /// file. content.surface is the surface read from the file; attributes and comments are ignored. Returns
  /// messages for the user, one line each. Can throw base::Error and base::Cancelled. The default throws
  /// base::Error: for formats that override write_file() or cannot be written.
  virtual std::vector<std::string> write(const Content& content, TextWriter& out) const;

  /// Works like write(), and replaces an existing file atomically. Also writes external buffers, and copies
  /// companions that are missing in the new folder. `progress` may be null. If `motion` is not null, adds
  /// morph targets: then the format must hold them, and `motion` must pass check_motion().
  virtual std::vector<std::string> write_file(const std::filesystem::path& path, const Content& content,
                                              Digits digits, base::Progress* progress,
                                              const MorphMotion* motion = nullptr) const;

  /// Returns the morph animation, or null if there are no targets. For invalid data, throws base::Error.
  virtual std::shared_ptr<const MorphClip> morphs() const { return nullptr; }

protected:
  Source source() const { return {name_, "", bytes_}; }

  std::string name_;
  std::string_view bytes_;  // the file's bytes; empty if there is no owner
  Companions companions_;   // the external files that write_file() copies
  Capture capture_ = Capture::none;

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
  std::shared_ptr<const mesh::Splats> splats;    ///< null if the file is not a capture
  std::shared_ptr<const Original> original;      ///< null if the file cannot be rewritten
  std::vector<std::string> comments;             ///< without comment marks; at most 64, each up to 200 bytes
};

}  // namespace viete::formats
