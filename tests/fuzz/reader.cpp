#include <cmath>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/attributes.h"
#include "formats/codecs.h"
#include "fuzz/checks.h"
#include "mesh/summary.h"

using namespace viete::formats;
using namespace viete::mesh;
using viete::fuzz::Reader;
using viete::fuzz::require;

namespace {

void check_invariants(const Surface& s, std::size_t bytes, std::size_t placed) {
  for (const auto& p : s.positions)
    for (const double x : p) require(std::isfinite(x) && std::abs(x) <= 1e100);
  require(s.polygon_starts.empty() || s.polygon_starts.back() == s.corners.size());
  require(s.triangles.size() == s.triangle_polygon.size());
  for (const auto c : s.corners) require(c < s.positions.size());
  for (const auto& t : s.triangles)
    for (const auto v : t) require(v < s.positions.size());
  // A small file must not give a large surface. `placed` is the limit for vertices of instances in glTF.
  require(s.positions.size() <= bytes + placed && s.corners.size() <= 4 * (bytes + placed) + 64);
}

void check_attributes(const ReadResult& read) {
  if (!read.attributes) return;
  const Attributes& a = *read.attributes;
  const std::size_t corners = read.surface.corners.size();
  require(a.corner_texture.empty() || a.corner_texture.size() == corners);
  require(a.corner_normal.empty() || a.corner_normal.size() == corners);
  require(a.colors.empty() || a.colors.size() == read.surface.positions.size());
  require(a.polygon_colors.empty() || a.polygon_colors.size() == read.surface.polygon_count());
  for (const auto t : a.corner_texture) require(t == none || t < a.texture_points.size());
  for (const auto n : a.corner_normal) require(n == none || n < a.normals.size());
  for (std::size_t g = 0; g < a.groups.size(); ++g) {
    require(g == 0 ? a.groups[g].first_polygon == 0
                   : a.groups[g].first_polygon > a.groups[g - 1].first_polygon);
    require(a.groups[g].first_polygon < read.surface.polygon_count());
    require(a.groups[g].material == none || a.groups[g].material < a.materials.size());
  }
}

std::string written_again(const ReadResult& read, const std::vector<Point>& positions,
                          const Splats* splats = nullptr, std::span<const std::uint32_t> sources = {}) {
  return written_text([&](TextWriter& out) {
    read.original->write({read.surface, positions, {}, nullptr, splats, sources}, out);
  });
}

// Moves the vertices, writes the file and reads it again. The polygons must be equal.
void check_moved(const ReadResult& read, Reader* reader) {
  auto moved = read.surface.positions;
  for (std::size_t v = 0; v < moved.size(); ++v) moved[v][v % 3] += 0.37 * static_cast<double>(v % 7);
  const std::string text = written_again(read, moved);
  const ReadResult again = reader(Source{"fuzz", "", text, nullptr});
  require(again.surface.polygon_count() == read.surface.polygon_count());
  if (!read.format.starts_with("STL"))  // STL has no shared vertices
    require(again.surface.corners == read.surface.corners);
}

struct Codec {
  void (*write)(const Content&, TextWriter&);
  ReadResult (*read)(const Source&);
};

// Repeats a splat, writes the file and reads it again. Converts the capture to both formats.
void check_splats(const ReadResult& read, Reader* reader, std::string_view bytes) {
  if (!read.splats) return;
  Splats splats = *read.splats;
  const std::size_t count = splats.size(), harmonics = 3 * splats.bands();
  require(count == read.surface.positions.size() && splats.log_scales.size() == count);
  require(splats.rotations.size() == count && splats.colors.size() == count);
  require(splats.harmonics.size() == harmonics * count);
  require(written_again(read, read.surface.positions, &splats) == bytes);
  std::vector<std::uint32_t> sources(count);
  std::iota(sources.begin(), sources.end(), 0U);
  sources.push_back(0);
  std::vector<Point> positions = read.surface.positions;
  positions.push_back(positions[0]);
  splats.rotations.push_back({1, 0, 0, 0});
  splats.log_scales.push_back({-1, -2, -3});
  splats.opacities.push_back(1);
  splats.colors.push_back({0, 1, 0});
  splats.harmonics.resize(harmonics * (count + 1));
  require(reader(Source{"fuzz", "", written_again(read, positions, &splats, sources)}).splats->size() ==
          count + 1);
  for (const auto& [write, read_again] : {Codec{write_ply, read_ply}, Codec{write_spz, read_spz}}) {
    const Content content{read.surface, read.surface.positions, {}, nullptr, read.splats.get()};
    try {
      const std::string converted = written_text([&](TextWriter& out) { write(content, out); });
      require(read_again(Source{"fuzz", "", converted}).splats->size() == count);
    } catch (const viete::base::Error& error) {  // positions beyond the range of float or SPZ
      require(!error.place().empty());
    }
  }
}

// An animation must have a position for each vertex at every moment.
void check_morphs(const ReadResult& read) {
  const auto clip = read.original ? read.original->morphs() : nullptr;
  if (!clip) return;
  for (const double t : clip->seconds()) require(std::isfinite(t));
  const std::size_t vertices = read.surface.positions.size();
  require(clip->at_target(clip->targets().size() - 1).size() == vertices);
  if (!clip->seconds().empty()) require(clip->at_key(clip->seconds().size() - 1).size() == vertices);
}

ReadResult read_back(ReadResult (*read)(const Source&), const std::string& bytes) noexcept {
  return read(Source{"written", "", bytes, nullptr});
}

// Writes the surface in every format. Each file must be readable, with equal polygons.
void check_converted(const ReadResult& read) {
  if (read.original) read.original->beyond_attributes();
  Attributes a;
  if (read.attributes) a = deformed_attributes(read.surface, read.surface.positions, *read.attributes);
  const Content content{read.surface, read.surface.positions, read.comments, &a};
  for (const Codec& format : {Codec{write_obj, read_obj}, Codec{write_ply, read_ply},
                              Codec{write_off, read_off}, Codec{write_glb, read_gltf}}) {
    const bool glb = format.write == write_glb;
    std::string bytes;
    try {
      bytes = written_text([&](TextWriter& out) { format.write(content, out); });
    } catch (const viete::base::Error& error) {
      require(glb && !error.place().empty());  // GLB rejects numbers beyond the range of float
      continue;
    }
    const ReadResult result = read_back(format.read, bytes);
    if (glb) continue;  // a GLB has the triangles in another order
    require(result.surface.corners == read.surface.corners);
    require(result.surface.polygon_starts == read.surface.polygon_starts);
  }
}

}  // namespace

void viete::fuzz::check_reader(Reader* reader, std::size_t placed, std::string_view bytes) {
  const std::shared_ptr<const void> owner(std::shared_ptr<const void>(),
                                          bytes.data());  // does not delete the data
  const Source source{"fuzz", "", bytes, nullptr, owner};
  try {
    const ReadResult read = reader(source);
    check_attributes(read);
    if (!read.format.starts_with("glTF")) {  // the glTF writer may change the JSON
      require(written_again(read, read.surface.positions) == bytes);
      check_moved(read, reader);
    }
    check_invariants(read.surface, bytes.size(), placed);
    if (bytes.size() < 20000) check_splats(read, reader, bytes);
    if (bytes.size() < 20000) {
      check_morphs(read);
      summarize(read.surface);
      check_converted(read);
    }
  } catch (const viete::base::Error& error) {
    require(!error.place().empty());
  }
}
