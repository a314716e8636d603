#include "mesh/formats/conversion.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include "base/text.h"
#include "mesh/formats/spread_normals.h"
#include "mesh/normals.h"

namespace viete::mesh {

namespace {

// Of parts that groups belong to.
bool share_vertices(const Surface& surface, const Attributes& attributes,
                    const std::vector<std::uint32_t>& part_of_group) {
  std::vector<std::uint32_t> part_of(surface.positions.size(), none);
  std::size_t g = 0;
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    while (g + 1 < attributes.groups.size() && attributes.groups[g + 1].first_polygon <= p) ++g;
    for (std::uint32_t c = surface.polygon_starts[p]; c < surface.polygon_starts[p + 1]; ++c) {
      std::uint32_t& part = part_of[surface.corners[c]];
      if (part != none && part != part_of_group[g]) return true;
      part = part_of_group[g];
    }
  }
  return false;
}

// All have a node of their own there.
bool are_objects(const Surface& surface, const Attributes& attributes) {
  std::set<std::pair<std::string, std::string>> names;
  for (const Group& g : attributes.groups) names.emplace(g.object, g.name);
  return names.size() <= std::max<std::size_t>(1, objects_of(surface, attributes).names.size());
}

}  // namespace

std::string short_number(float value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::uint8_t color_byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255 + 0.5F);
}

void name_materials(Attributes& attributes) {
  std::set<std::string> taken;
  for (std::uint32_t i = 0; i < attributes.materials.size(); ++i) {
    std::string& name = attributes.materials[i].name;
    name = TextWriter::one_line(name);
    name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
    if (name.empty()) name = "material_" + std::to_string(i);
    const std::string given = name;
    for (int n = 2; !taken.insert(name).second; ++n) name = given + "_" + std::to_string(n);
  }
}

void fill_in_materials(Attributes& attributes) {
  const auto number = static_cast<std::uint32_t>(attributes.materials.size());
  bool has_one = false, needs_another = false;
  for (Group& group : attributes.groups) {
    has_one |= group.material != none;
    if (group.material != none || !has_one) continue;
    group.material = number;
    needs_another = true;
  }
  if (needs_another) attributes.materials.emplace_back().name = "no_material";
}

void colors_to_materials(Attributes& a) {
  constexpr std::size_t most = 1024;
  if (!a.groups.empty() || !a.materials.empty()) return;
  std::map<Color, std::uint32_t> numbers;
  for (const Color& c : a.polygon_colors) {
    if (numbers.size() <= most) numbers.emplace(c, static_cast<std::uint32_t>(numbers.size()));
  }
  if (numbers.size() > most) return;
  a.materials.resize(numbers.size());
  for (const auto& [color, number] : numbers)
    a.materials[number] = {"color_" + std::to_string(number + 1), color};
  for (std::uint32_t p = 0; p < a.polygon_colors.size(); ++p) {
    const std::uint32_t number = numbers.at(a.polygon_colors[p]);
    if (a.groups.empty() || a.groups.back().material != number) a.groups.push_back({p, "", "", number});
  }
  a.polygon_colors.clear();
}

Objects objects_of(const Surface& surface, const Attributes& attributes) {
  Objects objects;
  std::map<std::string, std::uint32_t> numbers;
  for (const Group& g : attributes.groups) {
    const std::string& name = g.object.empty() ? g.name : g.object;
    const auto number = static_cast<std::uint32_t>(objects.names.size());
    const auto [at, added] = numbers.emplace(name, number);
    if (added) objects.names.push_back(name);
    objects.of_group.push_back(at->second);
  }
  if (objects.names.size() < 2 || !share_vertices(surface, attributes, objects.of_group)) return objects;
  return {{""}, std::vector<std::uint32_t>(attributes.groups.size(), 0)};
}

std::vector<std::string> triangles_notes(const Format& format, const Surface& surface) {
  if (format.holds(held::polygons) || surface.triangles.empty()) return {};
  const auto& starts = surface.polygon_starts;
  std::size_t larger = 0;
  for (std::size_t p = 0; p + 1 < starts.size(); ++p) larger += starts[p + 1] - starts[p] > 3;
  std::vector<char> is_loose(surface.positions.size(), 1);
  for (const std::uint32_t v : surface.corners) is_loose[v] = 0;
  const auto loose = static_cast<std::size_t>(std::ranges::count(is_loose, 1));
  std::vector<std::string> notes;
  if (larger > 0)
    notes.push_back(base::counted(larger, "face") + " of more than three corners became triangles");
  if (loose > 0)
    notes.push_back(base::counted(loose, "point") + " of no face " + (loose == 1 ? "is" : "are") +
                    " left out");
  return notes;
}

std::set<std::uint32_t> used_images(const Attributes& attributes) {
  std::set<std::uint32_t> used;
  for (const Material& m : attributes.materials) {
    if (m.base_color_image < attributes.images.size()) used.insert(m.base_color_image);
  }
  return used;
}

Attributes deformed_attributes(const Surface& rest, std::span<const Point> positions,
                               const Attributes& attributes) {
  Attributes now = attributes;
  if (attributes.corner_normal.empty()) return now;
  SpreadNormals spread(rest, attributes);
  now.normals = deformed_normals(rest, positions, spread.normals, spread.of_corner);
  now.corner_normal = std::move(spread.of_corner);
  return now;
}

std::optional<std::vector<std::uint32_t>> one_a_vertex(const Surface& surface,
                                                       const std::vector<std::uint32_t>& of_corner) {
  std::vector<std::uint32_t> of_vertex(surface.positions.size(), none);
  for (std::size_t c = 0; c < of_corner.size(); ++c) {
    std::uint32_t& at = of_vertex[surface.corners[c]];
    if (at != none && of_corner[c] != at) return std::nullopt;
    at = of_corner[c];
  }
  return of_vertex;
}

std::vector<std::string> left_out(const Format& format, const Surface& surface, const Attributes& a,
                                  const Attributes& deformed) {
  struct Kind {
    const char* has_no;
    std::size_t count;
    bool held;
  };
  const bool normals_fit =
      format.holds(held::corner_normals) || one_a_vertex(surface, deformed.corner_normal);
  const std::size_t textures = used_images(a).size();
  const Kind kinds[] = {
      {" has no texture coordinates: ", a.texture_points.size(), format.holds(held::texture_points)},
      {format.holds(held::normals) ? " holds one a vertex of normals: " : " has no normals: ",
       a.normals.size(), format.holds(held::normals) && normals_fit},
      {" has no colours: ", a.colors.size(), format.holds(held::colors)},
      {" has no colours of faces: ", deformed.polygon_colors.size(), format.holds(held::polygon_colors)},
      {" has no groups: ", a.groups.size(),
       format.holds(held::groups) || (format.holds(held::objects) && are_objects(surface, a))},
      {" has no materials: ", a.materials.size(), format.holds(held::materials)},
      {" has no textures: ", textures, format.holds(held::textures)},
      {" has no images but those of base colours: ", a.images.size() - textures, false}};
  std::vector<std::string> notes;
  for (const Kind& kind : kinds) {
    if (kind.count == 0 || kind.held) continue;
    notes.push_back(std::string(format.name) + kind.has_no + base::with_thousands(kind.count) + " left out");
  }
  return notes;
}

std::vector<std::string> left_out(const Format& format, const Original& original) {
  constexpr std::size_t most = 12;
  const std::vector<std::string> beyond = original.beyond_attributes();
  if (beyond.empty()) return {};
  std::string list;
  for (std::size_t i = 0; i < std::min(beyond.size(), most); ++i) list += (i == 0 ? "" : ", ") + beyond[i];
  return {std::string(format.name) + " does not get what else was in the file: " +
          TextWriter::one_line(list) + (beyond.size() > most ? " ..." : "")};
}

std::string material_library(const Attributes& attributes) {
  std::string text;
  for (const Material& m : attributes.materials) {
    const Color& c = m.base_color;
    text += "newmtl " + m.name + "\nKd";
    for (std::size_t k = 0; k < 3; ++k) text += " " + short_number(c[k]);
    text += "\nd " + short_number(c[3]) + "\n";
    if (m.base_color_image == none || attributes.images[m.base_color_image].path.empty()) continue;
    text += std::string("map_Kd ") + (m.repeats ? "" : "-clamp on ") +
            TextWriter::one_line(attributes.images[m.base_color_image].path.string()) + "\n";
  }
  return text;
}

}  // namespace viete::mesh
