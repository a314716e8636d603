// The file that a surface was read from, kept as it was, so that it can be written again with other
// positions.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "mesh/formats/attributes.h"
#include "mesh/formats/morphs.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Files that another one names by the way from its folder: material libraries and images.
struct Companions {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;  ///< absolute; they need not be there
};

/// Immutable; one for each format. Thread-safe.
class Original {
public:
  /// format: the name in the table. The bytes, which were read without an error, live as long as their owner.
  Original(std::string_view format, const Source& source)
      : name_(source.name),
        bytes_(source.owner ? source.bytes : std::string_view()),
        owner_(source.owner),
        format_(format) {}
  virtual ~Original() = default;

  std::string_view format() const { return format_; }

  /// What it holds that a surface and its attributes do not, so that another format does not get it:
  /// "animations", "12 lines".
  virtual std::vector<std::string> beyond_attributes() const { return {}; }

  /// What the file leads to, so that it must lie beside it to be whole. write_file() leaves it alone.
  virtual Companions companions() const { return {}; }

  /// All other files that it was read from or leads to; they need not be there.
  virtual std::vector<std::filesystem::path> files_beside() const { return companions().files; }

  /// Everything that was read, in its order, but for positions that differ from those of `rest` (the surface
  /// that was read from it) and for normals and tangents that follow them. Returns what a person should know
  /// of the result, one line each. Throws base::Error and base::Cancelled.
  virtual std::vector<std::string> write(const Surface& rest, std::span<const Point> positions,
                                         TextWriter& out) const = 0;

  /// The same as a file, which is replaced as a whole or left as it was, with what stands beside it in a
  /// format of several files. progress may be null.
  virtual std::vector<std::string> write_file(const std::filesystem::path& path, const Surface& rest,
                                              std::span<const Point> positions, Digits digits,
                                              base::Progress* progress) const;

  /// The same with morph targets, see check_motion(). Of formats that have them: others throw base::Error.
  virtual std::vector<std::string> write_animated(const std::filesystem::path& path, const Surface& rest,
                                                  std::span<const Point> positions, const MorphMotion& motion,
                                                  base::Progress* progress) const;

  /// How its meshes morph; null where they do not. Throws base::Error where that is not sound.
  virtual std::shared_ptr<const MorphClip> morphs() const { return nullptr; }

protected:
  Source source() const { return {name_, "", bytes_}; }

  std::string name_;
  std::string_view bytes_;  // of the file; empty without an owner

private:
  std::shared_ptr<const void> owner_;
  std::string_view format_;
};

/// The result of reading a file.
struct ReadResult {
  Surface surface;
  std::string format;                 ///< "OBJ", "PLY ascii", "PLY binary little-endian", "STL binary", ...
  std::vector<std::string> warnings;  ///< one line each, harmless oddities worth a word, with their place
  std::shared_ptr<const Attributes> attributes;  ///< null: nothing but positions and polygons
  std::shared_ptr<const Original> original;      ///< null: it cannot be written again as it was
  std::vector<std::string> comments;  ///< of the file's head, without their mark: at most 64, of 200 bytes
};

}  // namespace viete::mesh
