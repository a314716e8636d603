#include "mesh/obj_normals.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "mesh/normals.h"

namespace viete::mesh {

namespace {

// What the corners that share a normal must have in common: their polygon where faces are flat, else their
// vertex.
std::vector<std::uint64_t> common_to_corners(const Surface& surface, const Attributes& attributes) {
  std::vector<std::uint64_t> common(surface.corners.begin(), surface.corners.end());
  constexpr std::uint64_t polygons = std::uint64_t{1} << 32;
  for (std::size_t g = 0; g < attributes.groups.size(); ++g) {
    if (attributes.groups[g].smooth) continue;
    const std::size_t end =
        g + 1 < attributes.groups.size() ? attributes.groups[g + 1].first_polygon : surface.polygon_count();
    for (std::size_t p = attributes.groups[g].first_polygon; p < end; ++p) {
      for (auto c = surface.polygon_starts[p]; c < surface.polygon_starts[p + 1]; ++c)
        common[c] = polygons + p;
    }
  }
  return common;
}

// Corners with the same normal, one normal after the other.
struct CornersOfNormals {
  std::vector<std::uint32_t> starts, corners;

  CornersOfNormals(std::span<const std::uint32_t> corner_normal, std::size_t normals)
      : starts(normals + 2, 0) {
    for (const std::uint32_t n : corner_normal) {
      if (n != none) ++starts[n + 2];
    }
    for (std::size_t n = 2; n < starts.size(); ++n) starts[n] += starts[n - 1];
    corners.resize(starts.back());
    for (std::uint32_t c = 0; c < corner_normal.size(); ++c) {
      if (corner_normal[c] != none) corners[starts[corner_normal[c] + 1]++] = c;
    }
    starts.pop_back();
  }

  std::span<std::uint32_t> of(std::size_t normal) {
    return std::span(corners).subspan(starts[normal], starts[normal + 1] - starts[normal]);
  }
};

// Each normal once for everything its corners have in common.
struct Spread {
  std::vector<Vec3> normals;
  std::vector<std::uint32_t> first;      // of each of the file's normals, one or more each; and the end
  std::vector<std::uint32_t> of_corner;  // or none

  Spread(const Surface& surface, const Attributes& attributes) : of_corner(surface.corners.size(), none) {
    const auto common = common_to_corners(surface, attributes);
    CornersOfNormals of_normals(attributes.corner_normal, attributes.normals.size());
    normals.reserve(attributes.normals.size());
    for (std::size_t n = 0; n < attributes.normals.size(); ++n) {
      first.push_back(static_cast<std::uint32_t>(normals.size()));
      normals.push_back(attributes.normals[n]);
      const auto corners = of_normals.of(n);
      if (corners.empty()) continue;
      const auto same = [&](std::uint32_t c) { return common[c] == common[corners[0]]; };
      if (!std::all_of(corners.begin(), corners.end(), same)) {
        std::stable_sort(corners.begin(), corners.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return common[a] < common[b]; });
      }
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (i > 0 && common[corners[i]] != common[corners[i - 1]]) normals.push_back(attributes.normals[n]);
        of_corner[corners[i]] = static_cast<std::uint32_t>(normals.size() - 1);
      }
    }
    first.push_back(static_cast<std::uint32_t>(normals.size()));
  }
};

std::string words_of(const Vec3& normal, const Printed& printed) {
  std::array<char, 400> room;
  std::string words;
  for (const double x : normal) words.append(printed.print(x, room)).append(1, ' ');
  return words;
}

}  // namespace

ObjNormals::ObjNormals(const Surface& rest, const Attributes& attributes,
                       std::span<const std::uint32_t> blocks, std::span<const Point> positions,
                       const Printed& printed) {
  const Spread spread(rest, attributes);
  std::vector<Vec3> moved = deformed_normals(rest, positions, spread.normals, spread.of_corner);
  keep_lengths(spread.normals, moved);
  std::vector<std::uint32_t> value_of(moved.size());
  for (std::size_t n = 0; n < attributes.normals.size(); ++n) {
    const auto begin = spread.first[n], end = spread.first[n + 1];
    first_.push_back(static_cast<std::uint32_t>(values_.size()));
    // The line keeps its words if some corners do.
    const auto kept = std::find(moved.begin() + begin, moved.begin() + end, attributes.normals[n]);
    values_.push_back(kept == moved.begin() + end ? moved[begin] : *kept);
    value_of[begin] = first_[n];
    if (end - begin == 1) continue;
    std::map<std::string, std::uint32_t> printed_before = {{words_of(values_.back(), printed), first_[n]}};
    for (auto i = begin; i < end; ++i) {
      const auto next = static_cast<std::uint32_t>(values_.size());
      const auto [at, is_new] = printed_before.emplace(words_of(moved[i], printed), next);
      if (is_new) values_.push_back(moved[i]);
      value_of[i] = at->second;
    }
  }
  first_.push_back(static_cast<std::uint32_t>(values_.size()));
  std::vector<std::uint32_t> value_of_corner = spread.of_corner;
  for (std::uint32_t& v : value_of_corner) v = v == none ? none : value_of[v];
  number(blocks, attributes, value_of_corner);
}

void ObjNormals::number(std::span<const std::uint32_t> blocks, const Attributes& attributes,
                        std::span<const std::uint32_t> value_of_corner) {
  std::vector<std::uint32_t> index_of_value(values_.size());
  std::uint32_t next = 0, begin = 0;
  for (const std::uint32_t end : blocks) {
    for (auto n = begin; n < end; ++n) {
      index_of_value[first_[n]] = next;
      index_.push_back(next++);
    }
    for (auto n = begin; n < end; ++n) {
      for (auto v = first_[n] + 1; v < first_[n + 1]; ++v) index_of_value[v] = next++;
    }
    begin = end;
  }
  if (!adds_lines()) return;
  corner_index_.resize(attributes.corner_normal.size(), none);
  for (std::size_t c = 0; c < corner_index_.size(); ++c) {
    if (value_of_corner[c] != none) corner_index_[c] = index_of_value[value_of_corner[c]];
  }
}

}  // namespace viete::mesh
