#include "mesh/conversion.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "base/quantity.h"
#include "mesh/normals.h"
#include "mesh/spread_normals.h"

namespace viete::mesh {

namespace {

// What a surface may have, and which formats hold it.
struct Kind {
  const char* plural;
  std::size_t count;
  bool in_obj, in_ply, in_off;
};

bool held(std::string_view extension, const Kind& kind) {
  if (extension == "obj") return kind.in_obj;
  if (extension == "ply") return kind.in_ply;
  return extension == "off" && kind.in_off;
}

std::string upper(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
  return text;
}

}  // namespace

std::string short_number(float value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::uint8_t color_byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255 + 0.5F);
}

std::string name_of_material(const Attributes& attributes, std::uint32_t material) {
  std::string name = TextWriter::one_line(attributes.materials[material].name);
  return name.empty() ? "material_" + std::to_string(material) : name;
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

std::vector<std::string> left_out(std::string_view extension, const Surface& surface, const Attributes& a,
                                  const Attributes& deformed) {
  if (extension == "glb" || extension == "gltf") return {};
  const bool texture_fits = one_a_vertex(surface, a.corner_texture).has_value();
  const bool normals_fit = one_a_vertex(surface, deformed.corner_normal).has_value();
  std::set<std::uint32_t> of_base_color;
  for (const Material& m : a.materials) {
    if (m.base_color_image < a.images.size()) of_base_color.insert(m.base_color_image);
  }
  const Kind kinds[] = {
      {"texture coordinates", a.texture_points.size(), true, texture_fits, false},
      {"normals", a.normals.size(), true, normals_fit, false},
      {"colours", a.colors.size(), true, true, true},
      {"groups", a.groups.size(), true, false, false},
      {"materials", a.materials.size(), true, false, false},
      {"textures", of_base_color.size(), true, false, false},
      {"images but those of base colours", a.images.size() - of_base_color.size(), false, false, false}};
  std::vector<std::string> notes;
  for (const Kind& kind : kinds) {
    if (kind.count == 0 || held(extension, kind)) continue;
    const bool several = extension == "ply" && (&kind == &kinds[0] || &kind == &kinds[1]);
    notes.push_back(upper(extension) + (several ? " holds one a vertex of " : " has no ") + kind.plural +
                    ": " + base::with_thousands(kind.count) + " left out");
  }
  return notes;
}

std::string material_library(const Attributes& attributes) {
  std::string text;
  for (std::uint32_t i = 0; i < attributes.materials.size(); ++i) {
    const Material& m = attributes.materials[i];
    const Color& c = m.base_color;
    text += "newmtl " + name_of_material(attributes, i) + "\nKd";
    for (std::size_t k = 0; k < 3; ++k) text += " " + short_number(c[k]);
    text += "\nd " + short_number(c[3]) + "\n";
    if (m.base_color_image == none || attributes.images[m.base_color_image].path.empty()) continue;
    text += std::string("map_Kd ") + (m.repeats ? "" : "-clamp on ") +
            TextWriter::one_line(attributes.images[m.base_color_image].path.string()) + "\n";
  }
  return text;
}

}  // namespace viete::mesh
