#include "formats/point_cache.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"
#include "formats/source.h"
#include "formats/text_writer.h"

namespace viete::formats {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view pc2_magic{"POINTCACHE2\0", 12};
constexpr std::size_t pc2_head_size = 32, mdd_head_size = 8;
constexpr std::size_t most_of_cache = std::numeric_limits<std::int32_t>::max();

std::endian order_of(PointCacheFormat format) {
  return format == PointCacheFormat::pc2 ? std::endian::little : std::endian::big;
}

std::string bytes_of(const PointCacheHead& head) {
  std::string all;
  const auto put = [&](auto number) {
    const auto raw = base::bytes_of_number(number, order_of(head.format));
    all.append(raw.data(), raw.size());
  };
  const auto points = static_cast<std::uint32_t>(head.points),
             frames = static_cast<std::uint32_t>(head.frames);
  if (head.format == PointCacheFormat::pc2) {
    all = pc2_magic;
    put(std::uint32_t{1});
    put(points);
    put(head.start);
    put(head.rate);
    put(frames);
  } else {
    put(frames);
    put(points);
    for (const float s : head.seconds) put(s);
  }
  return all;
}

const PointCacheHead& writable(const fs::path& path, const PointCacheHead& head) {
  if (head.points == 0 || head.frames == 0)
    throw base::Error(path.string(), "there are no points or no frames to write",
                      "export at least one frame of a model with vertices");
  if (head.points > most_of_cache || head.frames > most_of_cache)
    throw base::Error(path.string(), "a point cache can store at most 2,147,483,647 points and frames",
                      "export fewer frames");
  if (head.format == PointCacheFormat::mdd && head.seconds.size() != head.frames)
    throw base::Error(path.string(),
                      "there are " + base::counted(head.seconds.size(), "time") + " for " +
                          base::counted(head.frames, "frame"),
                      "give one time value for each frame");
  return head;
}

std::string cache_size_text(std::int64_t points, std::int64_t frames) {
  return std::to_string(frames) + (frames == 1 ? " frame" : " frames") + " of " + std::to_string(points) +
         (points == 1 ? " point" : " points");
}

}  // namespace

std::optional<PointCacheFormat> point_cache_format(const fs::path& path) {
  const std::string extension = base::extension_of(path);
  if (extension == "pc2") return PointCacheFormat::pc2;
  if (extension == "mdd") return PointCacheFormat::mdd;
  return std::nullopt;
}

void write_point_cache(const fs::path& path, const PointCacheHead& wished,
                       const std::function<std::span<const float>(std::size_t)>& frame) {
  const PointCacheHead head = writable(path, wished);
  std::vector<std::array<char, 4>> ordered(3 * head.points);
  base::replace_file(path, [&](const base::ByteSink& sink) {
    sink(bytes_of(head));
    for (std::size_t number = 0; number < head.frames; ++number) {
      const std::span<const float> positions = frame(number);
      const std::string place = path.string() + ": frame " + std::to_string(number);
      if (positions.size() != 3 * head.points)
        throw base::Error(place,
                          "there are " + std::to_string(positions.size() / 3) + " points for " +
                              std::to_string(head.points),
                          "pass the positions of all vertices for each frame");
      for (std::size_t i = 0; i < positions.size(); i += 3)
        check_written(place, i / 3, {positions[i], positions[i + 1], positions[i + 2]}, largest_float);
      std::ranges::transform(positions, ordered.begin(),
                             [&](float x) { return base::bytes_of_number(x, order_of(head.format)); });
      sink({reinterpret_cast<const char*>(ordered.data()), positions.size_bytes()});
    }
  });
}

PointCache::PointCache(const fs::path& path) : name_(path.string()) {
  size_ = base::regular_file_size(path);
  file_ = std::make_unique<std::ifstream>(path, std::ios::binary);
  read_head();
}

PointCache::PointCache(std::string name, std::string bytes) : name_(std::move(name)) {
  size_ = bytes.size();
  file_ = std::make_unique<std::istringstream>(std::move(bytes));
  read_head();
}

void PointCache::read(std::uint64_t offset, std::span<char> to) const {
  assert(offset <= size_ && to.size() <= size_ - offset);  // read_head() checks the size of the file
  const std::lock_guard lock(mutex_);
  file_->clear();
  file_->seekg(static_cast<std::streamoff>(offset));
  if (!file_->read(to.data(), static_cast<std::streamsize>(to.size())))
    throw base::Error(name_, "the file cannot be read completely", "check the disk and the permissions");
}

void PointCache::read_head() {
  std::string begins(std::min<std::uint64_t>(size_, pc2_magic.size()), '\0');
  read(0, begins);
  if (begins == pc2_magic) return read_pc2_head();
  begins.resize(std::min<std::uint64_t>(size_, 512));
  read(0, begins);
  if (size_ > 0) refuse_foreign(name_, begins);
  read_mdd_head();
}

void PointCache::read_pc2_head() {
  constexpr auto format = PointCacheFormat::pc2;
  if (size_ < pc2_head_size)
    throw base::Error(name_, "the file ends within the PC2 header", "export the point cache again");
  std::vector<char> head(pc2_head_size);
  read(0, head);
  const auto points = base::number_of_bytes<std::int32_t>(&head[16]),
             samples = base::number_of_bytes<std::int32_t>(&head[28]);
  if (points <= 0 || samples <= 0)
    throw base::Error(name_, "the PC2 header declares " + cache_size_text(points, samples),
                      "export the point cache again");
  head_ = {format, static_cast<std::size_t>(points), static_cast<std::size_t>(samples),
           base::number_of_bytes<float>(&head[20]), base::number_of_bytes<float>(&head[24])};
  first_frame_ = pc2_head_size;
  const std::uint64_t whole = (size_ - first_frame_) / (12 * head_.points);
  if (whole < head_.frames)
    throw base::Error(name_,
                      "the file is truncated: it contains " + std::to_string(whole) + " of " +
                          cache_size_text(points, samples),
                      "export the point cache again");
  if (size_ > first_frame_ + head_.frames * 12 * head_.points)
    warnings_.push_back(name_ + ": ignored the bytes after the last frame");
  if (std::isfinite(head_.start) && std::isfinite(head_.rate) && head_.rate > 0) return;
  warnings_.push_back(name_ + ": the start frame or the sample rate is invalid; used 0 and 1");
  head_.start = 0;
  head_.rate = 1;
}

void PointCache::read_mdd_head() {
  constexpr auto format = PointCacheFormat::mdd;
  std::vector<char> head(mdd_head_size, 0);
  if (size_ >= mdd_head_size) read(0, head);
  const auto frames = base::number_of_bytes<std::int32_t>(&head[0], std::endian::big),
             points = base::number_of_bytes<std::int32_t>(&head[4], std::endian::big);
  if (frames <= 0 || points <= 0)
    throw base::Error(name_, "this is neither a PC2 nor an MDD point cache",
                      "check that it is the right file");
  head_ = {format, static_cast<std::size_t>(points), static_cast<std::size_t>(frames), 0, 1};
  const std::uint64_t frame_size = 4 + 12 * std::uint64_t{head_.points}, room = size_ - mdd_head_size;
  if (room / frame_size < head_.frames || room != frame_size * head_.frames)
    throw base::Error(name_,
                      "the MDD header declares " + cache_size_text(points, frames) + ", but the file has " +
                          std::to_string(size_) + " bytes",
                      "check that it is the right file, or export it again");
  std::vector<char> times(4 * head_.frames);
  read(mdd_head_size, times);
  head_.seconds.resize(head_.frames);
  for (std::size_t i = 0; i < head_.frames; ++i) {
    head_.seconds[i] = base::number_of_bytes<float>(&times[4 * i], std::endian::big);
    if (!std::isfinite(head_.seconds[i]))
      throw base::Error(name_ + ": frame " + std::to_string(i), "the time is not finite",
                        "export the point cache again");
  }
  first_frame_ = mdd_head_size + times.size();
}

std::vector<mesh::Point> PointCache::frame(std::size_t number) const {
  std::vector<char> bytes(12 * head_.points);
  read(first_frame_ + std::uint64_t{number} * bytes.size(), bytes);
  std::vector<mesh::Point> points(head_.points);
  for (std::size_t v = 0; v < points.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k)
      points[v][k] = base::number_of_bytes<float>(&bytes[12 * v + 4 * k], order_of(head_.format));
    if (!is_place(points[v]))
      throw base::Error(name_ + ": frame " + std::to_string(number),
                        "the position of point " + std::to_string(v) + " is not a finite number up to 1e100",
                        "export the point cache again");
  }
  return points;
}

}  // namespace viete::formats
