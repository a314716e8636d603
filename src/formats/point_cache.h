// Point caches (PC2 and MDD) are files with the positions of all vertices in a sequence of frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "mesh/surface.h"

namespace viete::formats {

/// A point cache contains only positions. The model must have the same vertices in the same order. OBJ, PLY
/// and OFF keep the order; STL and glTF do not.
///
/// pc2  Pointcache 2 of 3ds Max, little-endian. The header is: "POINTCACHE2\0", int32 version (1), int32
///      points, float32 first frame, float32 frames per sample, int32 samples. Each sample is: float32 x, y,
///      z of every point. Read by 3ds Max (Point Cache modifier), Blender (Mesh Cache modifier) and Maya
///      (`cacheFile -pc2 1 -pcf FILE ...` converts the file to Maya's own cache).
/// mdd  LightWave, big-endian. The header is: int32 frames, int32 points, float32 seconds of every frame.
///      Each frame is: float32 x, y, z of every point. Read by LightWave, Blender and Houdini (MDD node).
///
/// Positions have the axes and the unit of the model's file. Blender applies positions in object space,
/// before the object's rotation and scale. Only the modifier's *Forward axis* and *Up axis* rotate positions.
/// Blender's OBJ import rotates the object, not its coordinates. Until the object's rotation is applied
/// (Ctrl-A), the modifier's defaults (Y, Z) are correct. Maya and Houdini do not rotate the model or the
/// cache.
enum class PointCacheFormat { pc2, mdd };

/// Returns the format for the extension, .pc2 or .mdd.
std::optional<PointCacheFormat> point_cache_format(const std::filesystem::path& path);

struct PointCacheHead {
  PointCacheFormat format = PointCacheFormat::pc2;
  std::size_t points = 0, frames = 0;  ///< 1 to 2147483647 each
  float start = 0, rate = 1;           ///< PC2 only: number of the first frame, frames per sample
  std::vector<float> seconds{};        ///< MDD only: time of each frame
};

/// Writes a file atomically. Only one frame is in memory at a time. frame(i) must return x, y, z of every
/// point of frame i. If sizes exceed the limits of the format, the disk is full or a number is not finite,
/// throws base::Error. Does not catch exceptions of `frame`.
void write_point_cache(const std::filesystem::path& path, const PointCacheHead& head,
                       const std::function<std::span<const float>(std::size_t)>& frame);

/// Reads single frames from the file. Thread-safe.
class PointCache {
public:
  /// Detects PC2 by the signature and MDD by the size. Throws base::Error for other or truncated files, files
  /// without points or frames, and non-finite times. Checks sizes before it allocates memory.
  explicit PointCache(const std::filesystem::path& path);
  /// Reads from memory.
  PointCache(std::string name, std::string bytes);

  const PointCacheHead& head() const { return head_; }
  /// Warnings about problems that were ignored, one line each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// `number` must be below head().frames. If a position is invalid or cannot be read, throws base::Error.
  std::vector<mesh::Point> frame(std::size_t number) const;

private:
  void read_head();
  void read_pc2_head();
  void read_mdd_head();
  /// The bytes must be within the file.
  void read(std::uint64_t offset, std::span<char> to) const;

  std::string name_;
  std::uint64_t size_ = 0;
  std::unique_ptr<std::istream> file_;
  mutable std::mutex mutex_;  ///< protects file_
  PointCacheHead head_;
  std::uint64_t first_frame_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace viete::formats
