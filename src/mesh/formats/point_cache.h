// Point caches: the positions of a model's vertices, frame after frame, in one file. PC2 and MDD.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// A cache holds nothing but positions: who plays it has the model itself, of as many vertices in the same
/// order, so that OBJ, PLY and OFF go with one, while STL and glTF, which do not keep the order, do not.
///
/// pc2  Pointcache 2, of 3ds Max, little endian: "POINTCACHE2\0", int32 version 1, int32 points, float32
/// number
///      of the first sample's frame, float32 frames from one sample to the next, int32 samples; then float32
///      x, y, z of every point, sample after sample. Read by 3ds Max (Point Cache modifier), Blender (Mesh
///      Cache modifier) and Maya (`cacheFile -pc2 1 -pcf FILE ...` makes a cache of its own of it).
/// mdd  of LightWave, big endian: int32 frames, int32 points, float32 seconds of every frame; then float32 x,
///      y, z, frame after frame. Read by LightWave, Blender (Mesh Cache modifier) and Houdini (MDD node).
///
/// Positions are in the model's own axes and unit, as its file has them, and the cache does not say which.
/// Blender's modifier takes them for coordinates of its object, before the object's own rotation and scale,
/// turned by the modifier's *Forward axis* and *Up axis* alone. Its OBJ import leaves coordinates as they are
/// and turns the object, so that the modifier's defaults (Y, Z) are right as long as that rotation is not
/// applied (Ctrl-A). In Maya and Houdini both come in as they are.
enum class PointCacheFormat { pc2, mdd };

/// By extension, .pc2 or .mdd.
std::optional<PointCacheFormat> point_cache_format(const std::filesystem::path& path);

struct PointCacheHead {
  PointCacheFormat format = PointCacheFormat::pc2;
  std::size_t points = 0, frames = 0;  ///< 1 to 2147483647 each
  float start = 0, rate = 1;           ///< of PC2: number of the first frame, and frames from one to the next
  std::vector<float> seconds{};        ///< of MDD: when each frame is shown
};

/// Writes frames one after another, so that no more than one needs to be in memory. `frame` gives x, y, z of
/// every point. The file is there as a whole or not at all. Throws base::Error for what the format cannot
/// hold, a full disk and a number that is none; and what `frame` throws.
void write_point_cache(const std::filesystem::path& path, const PointCacheHead& head,
                       const std::function<std::span<const float>(std::size_t)>& frame);

/// Frames are read when they are asked for. Thread-safe.
class PointCache {
public:
  /// PC2 is known by its beginning, MDD by its sizes. Throws base::Error: another file, one that is shorter
  /// than its head says, no points or frames, times that are no numbers. Every size is checked before memory
  /// is taken for it.
  explicit PointCache(const std::filesystem::path& path);
  /// The same of bytes in memory, which must outlive it.
  PointCache(std::string name, std::string_view bytes);

  const PointCacheHead& head() const { return head_; }
  /// What is odd and does no harm, one line each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Number below head().frames. Throws base::Error where a position is no place, or the file cannot be read
  /// any more.
  std::vector<Point> frame(std::size_t number) const;

private:
  using Read = std::function<void(std::uint64_t offset, std::span<char> to)>;

  void read_head(std::uint64_t size);
  void read_pc2_head(std::uint64_t size);
  void read_mdd_head(std::uint64_t size);

  std::string name_;
  Read read_;  ///< offset and bytes lie within the file
  PointCacheHead head_;
  std::uint64_t first_frame_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace viete::mesh
