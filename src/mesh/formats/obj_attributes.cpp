#include "mesh/formats/obj_attributes.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.h"
#include "mesh/formats/mtl.h"

namespace viete::mesh {

namespace {

constexpr std::size_t most_groups = 100'000, most_libraries = 64, most_name_bytes = 255;
constexpr Color white{1, 1, 1, 1};

std::string short_name(std::string_view name) {
  return std::string(name.substr(0, most_name_bytes));
}

// Up to `most` numbers of this line; what is no number ends them.
template <std::size_t most>
std::size_t numbers(TextCursor& text, std::array<double, most>& values) {
  std::size_t count = 0;
  while (count < most && !text.at_line_end()) {
    const auto value = number_in(text.word());
    if (!value) break;
    values[count++] = *value;
  }
  return count;
}

}  // namespace

void ObjAttributes::behind_position(TextCursor& text, std::size_t vertex) {
  std::array<double, 4> values{};
  const std::size_t count = numbers(text, values);
  if (count < 3) return;  // a weight
  Color color = white;
  for (std::size_t i = 0; i < count; ++i) color[i] = static_cast<float>(std::clamp(values[i], 0.0, 255.0));
  found_.colors.resize(vertex, white);
  found_.colors.push_back(color);
}

void ObjAttributes::texture_point(TextCursor& text) {
  std::array<double, 2> values{};
  bad_numbers_ += numbers(text, values) == 0;
  found_.texture_points.push_back(values);
}

void ObjAttributes::normal(TextCursor& text) {
  Vec3 values{};
  if (numbers(text, values) < 3) {
    ++bad_numbers_;
    values = {};
  }
  found_.normals.push_back(values);
}

// Relative ones count from here. One that runs ahead is looked at in the end.
void ObjAttributes::put(std::vector<std::uint32_t>& indices, std::size_t corner, std::int64_t index,
                        std::size_t count) {
  if (index == 0 && indices.empty()) return;
  indices.resize(corner, none);
  const bool is_none = index == 0;
  if (index < 0) index += static_cast<std::int64_t>(count) + 1;
  const bool good = index > 0 && index < none;
  bad_indices_ += !good && !is_none;
  indices.push_back(good ? static_cast<std::uint32_t>(index - 1) : none);
}

void ObjAttributes::corner(std::size_t corner, std::string_view behind_vertex) {
  const ObjIndices indices = obj_indices(behind_vertex);
  bad_indices_ += !indices.readable;
  put(found_.corner_texture, corner, indices.texture_point, found_.texture_points.size());
  put(found_.corner_normal, corner, indices.normal, found_.normals.size());
}

void ObjAttributes::end_polygon(const Surface& surface) {
  const std::size_t corners = surface.corners.size();
  for (auto* indices : {&found_.corner_texture, &found_.corner_normal}) {
    if (indices->size() > corners) indices->resize(corners);
  }
  const bool made = std::exchange(polygons_, surface.polygon_count()) != surface.polygon_count();
  if (!changed_ || !made) return;
  state_.first_polygon = static_cast<std::uint32_t>(surface.polygon_count() - 1);
  changed_ = false;
  if (found_.groups.size() < most_groups) {
    found_.groups.push_back(state_);
  } else {
    ++groups_left_out_;
  }
}

void ObjAttributes::object(std::string_view name) {
  state_.object = short_name(name);
  changed_ = true;
}

void ObjAttributes::group(std::string_view name) {
  state_.name = short_name(name);
  changed_ = true;
}

void ObjAttributes::smoothing(std::string_view value) {
  const bool smooth = value != "off" && value != "0";
  changed_ |= smooth != state_.smooth;
  state_.smooth = smooth;
}

void ObjAttributes::use_material(std::string_view name) {
  auto at = materials_.find(name);
  if (at == materials_.end()) {
    at = materials_.emplace(name, static_cast<std::uint32_t>(found_.materials.size())).first;
    found_.materials.emplace_back().name = name;
  }
  changed_ |= state_.material != at->second;
  state_.material = at->second;
}

void ObjAttributes::library(std::string_view names) {
  if (std::find(libraries_.begin(), libraries_.end(), names) != libraries_.end()) return;
  if (!names.empty() && libraries_.size() < most_libraries) libraries_.emplace_back(names);
}

void ObjAttributes::check(std::vector<std::uint32_t>& indices, std::size_t count) {
  for (std::uint32_t& i : indices) {
    if (i == none || i < count) continue;
    i = none;
    ++bad_indices_;
  }
}

// In [0, 1], or from 0 to 255 where one is larger than 1.
void ObjAttributes::finish_colors(std::size_t vertices) {
  auto& colors = found_.colors;
  if (colors.empty()) return;
  bool bytes = false;
  for (const Color& c : colors) bytes |= *std::max_element(c.begin(), c.end()) > 1;
  for (Color& c : colors) {
    if (!bytes || c == white) continue;
    for (std::size_t i = 0; i < 4; ++i) c[i] = i == 3 && c[i] == 1 ? 1 : c[i] / 255;
  }
  colors.resize(vertices, white);
}

// A file without any is one group, and needs none.
void ObjAttributes::finish_groups() {
  const auto plain = [](const Group& g) {
    return g.object.empty() && g.name.empty() && g.material == none && g.smooth;
  };
  if (std::all_of(found_.groups.begin(), found_.groups.end(), plain)) found_.groups.clear();
}

void ObjAttributes::tell_bad(SurfaceBuilder& builder) const {
  const std::string name = source_.name + ": ";
  if (bad_indices_ > 0) {
    builder.warn(name + base::counted(bad_indices_, "reference") +
                 " to texture coordinates or normals that the file does not have: passed over");
  }
  if (bad_numbers_ > 0) {
    builder.warn(name + base::counted(bad_numbers_, "line") +
                 " of texture coordinates or normals cannot be read and count as 0");
  }
  if (groups_left_out_ > 0)
    builder.warn(name + "shows " + base::counted(most_groups, "group") + " apart, those behind as one");
}

std::shared_ptr<const Attributes> ObjAttributes::finish(SurfaceBuilder& builder) {
  check(found_.corner_texture, found_.texture_points.size());
  check(found_.corner_normal, found_.normals.size());
  const std::size_t corners = builder.surface().corners.size();
  for (auto* indices : {&found_.corner_texture, &found_.corner_normal}) {
    if (!indices->empty()) indices->resize(corners, none);
  }
  finish_colors(builder.vertex_count());
  finish_groups();
  read_materials(source_, libraries_, found_, builder);
  tell_bad(builder);
  if (found_.empty()) return nullptr;
  return std::make_shared<const Attributes>(std::move(found_));
}

}  // namespace viete::mesh
