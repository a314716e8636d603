#include "formats/conversion.h"

#include <algorithm>

#include "base/text.h"
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
    for (std::size_t p = attributes.groups[g].first_polygon; p < end; ++p) {
      for (auto c = surface.polygon_starts[p]; c < surface.polygon_starts[p + 1]; ++c)
        common[c] = polygons + p;
    }
  }
  return common;
}

std::vector<std::string> names_of_left_out(const Format& format, const mesh::Surface& surface,
                                           const Attributes& a, const Attributes& deformed) {
  const bool is_named =
      std::ranges::any_of(a.groups, [](const Group& g) { return !g.object.empty() || !g.name.empty(); });
  const bool normals = format.holds(held::normals);
  const bool normals_fit =
      format.holds(held::corner_normals) || (normals && one_a_vertex(surface, deformed.corner_normal));
  struct Kind {
    const char* name;
    bool in_file, fits;
  };
  const Kind kinds[] = {
      {"texture coordinates", !a.texture_points.empty(), format.holds(held::texture_points)},
      {normals ? "several normals of a vertex" : "normals", !a.normals.empty(), normals_fit},
      {"colours", !a.colors.empty(), format.holds(held::colors)},
      {"colours of faces", !a.polygon_colors.empty(),
       format.holds(held::polygon_colors) && (a.colors.empty() || format.holds(held::both_colors))},
      {"groups", is_named, false},
      {"materials", !a.materials.empty(), false},
      {"textures", !a.images.empty(), false}};
  std::vector<std::string> names;
  for (const Kind& kind : kinds)
    if (kind.in_file && !kind.fits) names.emplace_back(kind.name);
  return names;
}

void tell_triangles(const mesh::Surface& surface, std::vector<std::string>& notes) {
  const auto& starts = surface.polygon_starts;
  std::size_t larger = 0;
  for (std::size_t p = 0; p + 1 < starts.size(); ++p) larger += starts[p + 1] - starts[p] > 3;
  std::vector<char> is_loose(surface.positions.size(), 1);
  for (const std::uint32_t v : surface.corners) is_loose[v] = 0;
  const auto loose = static_cast<std::size_t>(std::ranges::count(is_loose, 1));
  if (larger > 0)
    notes.push_back(base::counted(larger, "face") + " of more than three corners became triangles");
  if (loose > 0)
    notes.push_back(base::counted(loose, "point") + " without a face " + (loose == 1 ? "was" : "were") +
                    " left out");
}

}  // namespace

SpreadNormals::SpreadNormals(const mesh::Surface& surface, const Attributes& attributes)
    : of_corner(surface.corners.size(), mesh::none) {
  const auto common = common_to_corners(surface, attributes);
  mesh::Adjacency of_normals = mesh::make_adjacency(attributes.normals.size(), [&](const auto& add) {
    for (std::uint32_t c = 0; c < attributes.corner_normal.size(); ++c) {
      if (attributes.corner_normal[c] != mesh::none) add(attributes.corner_normal[c], c);
    }
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

std::vector<std::string> left_out(const Format& format, const Content& content, const Attributes& deformed,
                                  const Original* original) {
  constexpr std::size_t most = 12;
  std::vector<std::string> names, notes;
  if (content.attributes) names = names_of_left_out(format, content.surface, *content.attributes, deformed);
  if (original) std::ranges::move(original->beyond_attributes(), std::back_inserter(names));
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) list += (i == 0 ? "" : ", ") + names[i];
  if (!names.empty())
    notes.push_back("left out of the " + std::string(format.name) + " file: " + TextWriter::one_line(list) +
                    (names.size() > most ? " ..." : ""));
  if (!format.holds(held::polygons) && !content.surface.triangles.empty())
    tell_triangles(content.surface, notes);
  return notes;
}

}  // namespace viete::formats
