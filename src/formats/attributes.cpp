#include "formats/attributes.h"

#include <algorithm>

#include "mesh/adjacency.h"
#include "mesh/normals.h"

namespace viete::formats {

namespace {

// For each corner, returns a number for its polygon (flat shading) or for its vertex (smooth shading).
// Corners with different numbers get separate normals.
std::vector<std::uint64_t> common_to_corners(const mesh::Surface& surface, const Attributes& attributes) {
  std::vector<std::uint64_t> common(surface.corners.begin(), surface.corners.end());
  constexpr std::uint64_t polygons = std::uint64_t{1} << 32;
  for (std::size_t g = 0; g < attributes.groups.size(); ++g) {
    if (attributes.groups[g].smooth) continue;
    const std::size_t end =
        g + 1 < attributes.groups.size() ? attributes.groups[g + 1].first_polygon : surface.polygon_count();
    for (std::size_t p = attributes.groups[g].first_polygon; p < end; ++p)
      for (auto c = surface.polygon_starts[p]; c < surface.polygon_starts[p + 1]; ++c)
        common[c] = polygons + p;
  }
  return common;
}

}  // namespace

SpreadNormals::SpreadNormals(const mesh::Surface& surface, const Attributes& attributes)
    : of_corner(surface.corners.size(), mesh::none) {
  const auto common = common_to_corners(surface, attributes);
  mesh::Adjacency of_normals = mesh::make_adjacency(attributes.normals.size(), [&](const auto& add) {
    for (std::uint32_t c = 0; c < attributes.corner_normal.size(); ++c)
      if (attributes.corner_normal[c] != mesh::none) add(attributes.corner_normal[c], c);
  });
  normals.reserve(attributes.normals.size());
  for (std::size_t n = 0; n < attributes.normals.size(); ++n) {
    first.push_back(static_cast<std::uint32_t>(normals.size()));
    normals.push_back(attributes.normals[n]);
    const auto corners = std::span(of_normals.items)
                             .subspan(of_normals.starts[n], of_normals.starts[n + 1] - of_normals.starts[n]);
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

bool is_flat(const Attributes& attributes) {
  return !attributes.groups.empty() && std::ranges::none_of(attributes.groups, &Group::smooth);
}

WrittenColor::WrittenColor(std::size_t element, std::span<const double> numbers,
                           std::span<const bool> are_whole)
    : element(static_cast<std::uint32_t>(element)), color{0, 0, 0, 1} {
  for (std::size_t i = 0; i < std::min<std::size_t>(numbers.size(), 4); ++i) {
    color[i] = static_cast<float>(std::clamp(numbers[i], 0.0, 255.0));
    whole &= are_whole[i] || i == 3;
  }
}

std::vector<Color> colors_of_elements(std::span<const WrittenColor> written, std::size_t elements,
                                      const Color& missing) {
  float divisor[2] = {1, 1};  // of decimal and of whole colours
  for (const auto& [element, color, whole] : written)
    if (std::max({color[0], color[1], color[2], whole ? color[3] : 0}) > 1) divisor[whole] = 255;
  std::vector<Color> colors(written.empty() ? 0 : elements, missing);
  for (const auto& [element, color, whole] : written) {
    for (std::size_t i = 0; i < 3; ++i) colors[element][i] = color[i] / divisor[whole];
    colors[element][3] = color[3] > 1 ? color[3] / 255 : color[3];
  }
  return colors;
}

std::uint8_t color_byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255 + 0.5F);
}

Attributes deformed_attributes(const mesh::Surface& rest, std::span<const mesh::Point> positions,
                               const Attributes& attributes) {
  Attributes now = attributes;
  if (attributes.corner_normal.empty()) return now;
  SpreadNormals spread(rest, attributes);
  now.normals = deformed_normals(rest, positions, spread.normals, spread.of_corner);
  now.corner_normal = std::move(spread.of_corner);
  return now;
}

std::optional<std::vector<std::uint32_t>> one_a_vertex(const mesh::Surface& surface,
                                                       const std::vector<std::uint32_t>& of_corner) {
  std::vector<std::uint32_t> of_vertex(surface.positions.size(), mesh::none);
  for (std::size_t c = 0; c < of_corner.size(); ++c) {
    std::uint32_t& at = of_vertex[surface.corners[c]];
    if (of_corner[c] == mesh::none) continue;
    if (at != mesh::none && of_corner[c] != at) return std::nullopt;
    at = of_corner[c];
  }
  return of_vertex;
}

}  // namespace viete::formats
