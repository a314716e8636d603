#include "mesh/formats/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "mesh/formats/ply_file.h"
#include "mesh/formats/surface_builder.h"
#include "mesh/formats/text_cursor.h"
#include "mesh/point_index.h"

namespace viete::mesh {

namespace {

// The colour scale of a type. Integers wider than two bytes contain bytes, as some programs declare them in
// text.
double part_of_largest(PlyType type) {
  return with_type(type, [](auto number) {
    using Number = decltype(number);
    if (!std::is_integral_v<Number>) return 1.0;
    return 1.0 / (sizeof number > 2 ? 255.0 : static_cast<double>(std::numeric_limits<Number>::max()));
  });
}

// Selected scalar values of a row, by name. Integer colours are scaled by the maximum of their type.
class PlyRow {
public:
  // The properties of the following rows.
  void begin(const PlyElement& element) {
    element_ = &element;
    places_.assign(element.properties.size(), most);
    factors_.assign(element.properties.size(), 1);
  }

  // True if all these properties exist; they are stored from `place` on.
  bool find(std::size_t place, std::initializer_list<const char*> names, bool colors = false) {
    const auto& properties = element_->properties;
    for (const char* name : names) {
      const std::size_t p = element_->find(name);
      if (p == properties.size() || properties[p].list_size) return false;
    }
    for (const char* name : names) {
      const std::size_t p = element_->find(name);
      if (colors) factors_[p] = part_of_largest(properties[p].type);
      places_[p] = place++;
    }
    return true;
  }

  bool wants(std::size_t property) const { return places_[property] != most; }
  void take(std::size_t property, double value) { values[places_[property]] = value * factors_[property]; }

  Color color(std::size_t place) const {
    Color c;
    for (std::size_t i = 0; i < 4; ++i) c[i] = static_cast<float>(std::clamp(values[place + i], 0.0, 1.0));
    return c;
  }

  static constexpr std::size_t most = 9;
  std::array<double, most> values{};

private:
  const PlyElement* element_ = nullptr;
  std::vector<std::size_t> places_;  // storage index of each property
  std::vector<double> factors_;
};

// Collects vertex normals, colours and texture coordinates: nx ny nz; red green blue alpha, also with the
// prefix diffuse_; s t, u v, also with the prefix texture_.
class PlyAttributes {
public:
  PlyRow& begin(const PlyElement& vertices) {
    row_.begin(vertices);
    row_.values[color + 3] = 1;
    has_normals_ = row_.find(normal, {"nx", "ny", "nz"});
    has_colors_ = row_.find(color, {"red", "green", "blue"}, true) ||
                  row_.find(color, {"diffuse_red", "diffuse_green", "diffuse_blue"}, true);
    if (has_colors_) row_.find(color + 3, {"alpha"}, true);
    for (const auto& [u, v] :
         {std::array{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}) {
      if (!has_texture_) has_texture_ = row_.find(texture, {u, v});
    }
    return row_;
  }

  void end_row() {
    const auto& v = row_.values;
    if (has_normals_) found_.normals.push_back({v[normal], v[normal + 1], v[normal + 2]});
    if (has_texture_) found_.texture_points.push_back({v[texture], v[texture + 1]});
    if (has_colors_) found_.colors.push_back(row_.color(color));
  }

  Attributes finish(const Surface& surface) {
    if (has_normals_) found_.corner_normal = surface.corners;
    if (has_texture_) found_.corner_texture = surface.corners;
    return std::move(found_);
  }

private:
  static constexpr std::size_t normal = 0, color = 3, texture = 7;

  PlyRow row_;
  bool has_normals_ = false, has_colors_ = false, has_texture_ = false;
  Attributes found_;
};

// Collects face colours and texture coordinates: red green blue alpha, a list texcoord (u v per corner) and
// texnumber, as written by MeshLab.
class PlyFaceAttributes {
public:
  // The following rows become polygons of this surface.
  PlyRow& begin(const PlyElement& faces, const Surface& surface) {
    surface_ = &surface;
    row_.begin(faces);
    row_.values = {0, 0, 0, 1, 0};
    has_colors_ = row_.find(color, {"red", "green", "blue"}, true);
    row_.find(color + 3, {"alpha"}, true);
    has_number_ = row_.find(number, {"texnumber"});
    const std::size_t none_such = faces.properties.size();
    texture_list_ = faces.find("texcoord");
    if (texture_list_ < none_such && !faces.properties[texture_list_].list_size) texture_list_ = none_such;
    return row_;
  }

  bool wants_list(std::size_t property) const { return property == texture_list_; }
  void take_texture(double value) { row_texture_.push_back(value); }

  // Assigns the collected values to the polygons added since the last row.
  void end_row() {
    const std::size_t polygons = surface_->polygon_count();
    if (has_colors_ && polygons > polygons_) {
      colors_.resize(polygons_, Material{}.base_color);
      colors_.resize(polygons, row_.color(color));
    }
    end_texture();
    end_material();
    polygons_ = polygons;
    corners_ = surface_->corners.size();
    row_texture_.clear();
  }

  // Adds the collected values to the vertex attributes. Images, by index, are in this folder.
  void finish(const Surface& surface, const std::vector<std::string>& images,
              const std::filesystem::path& folder, Attributes& attributes) {
    if (!colors_.empty()) {
      colors_.resize(surface.polygon_count(), Material{}.base_color);
      attributes.polygon_colors = std::move(colors_);
    }
    if (!texture_points_.empty()) {
      attributes.texture_points.clear();
      for (const Point& p : texture_points_) attributes.texture_points.push_back({p[0], p[1]});
      corner_texture_.resize(surface.corners.size(), none);
      attributes.corner_texture = std::move(corner_texture_);
    }
    for (const std::string& image : images) {
      if (folder.empty()) break;
      const auto path = path_beside(folder, image);
      Material material{path.stem().string(), {1, 1, 1, 1}};
      material.base_color_image = static_cast<std::uint32_t>(attributes.images.size());
      attributes.images.push_back({path, nullptr, path.filename().string()});
      attributes.materials.push_back(std::move(material));
    }
    if (!attributes.materials.empty()) finish_groups(surface, attributes);
  }

private:
  static constexpr std::size_t color = 0, number = 4;

  // Ignores lists whose length does not match the polygon's.
  void end_texture() {
    const std::size_t corners = surface_->corners.size() - corners_;
    if (corners == 0 || row_texture_.size() != 2 * corners) return;
    corner_texture_.resize(corners_, none);
    for (std::size_t i = 0; i < row_texture_.size(); i += 2) {
      const Point p{row_texture_[i] + 0.0, row_texture_[i + 1] + 0.0, 0};  // -0 becomes 0
      corner_texture_.push_back(texture_index_.find_or_add(p, texture_points_));
      if (corner_texture_.back() == texture_points_.size()) texture_points_.push_back(p);
    }
  }

  void end_material() {
    if (!has_number_ || surface_->polygon_count() == polygons_) return;
    const double n = row_.values[number];
    const std::uint32_t material = n >= 0 && n < 65536 ? static_cast<std::uint32_t>(n) : none;
    if (!groups_.empty() && groups_.back().material == material) return;
    if (groups_.empty() && polygons_ > 0) groups_.emplace_back();
    groups_.push_back({static_cast<std::uint32_t>(polygons_), "", "", material});
  }

  void finish_groups(const Surface& surface, Attributes& attributes) {
    if (surface.polygon_count() == 0) return;
    if (groups_.empty()) groups_.push_back({0, "", "", 0});
    for (Group& g : groups_) {
      if (g.material >= attributes.materials.size()) g.material = none;
    }
    attributes.groups = std::move(groups_);
  }

  const Surface* surface_ = nullptr;
  PlyRow row_;
  std::size_t texture_list_ = 0;
  std::vector<double> row_texture_;
  bool has_colors_ = false, has_number_ = false;
  std::size_t polygons_ = 0, corners_ = 0;  // up to the previous row
  std::vector<Color> colors_;
  std::vector<Point> texture_points_;  // (u, v, 0)
  PointIndex texture_index_;
  std::vector<std::uint32_t> corner_texture_;
  std::vector<Group> groups_;  // one per texnumber, which becomes the material
};

template <class Values>
class PlyBody {
public:
  PlyBody(const PlyHeader& header, const Source& source, SurfaceBuilder& builder, Values values)
      : header_(header), source_(source), builder_(builder), values_(values) {
    const PlyElement* vertices = header.find("vertex");
    vertex_count_ = vertices ? vertices->count : 0;
  }

  Attributes read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex" && builder_.vertex_count() == 0) {
        vertices(element);
      } else if (element.name == "face") {
        lists(element, element.find("vertex_indices", "vertex_index"), [this](std::size_t n) { polygon(n); });
      } else if (element.name == "tristrips") {
        lists(element, element.find("vertex_indices", "vertex_index"), [this](std::size_t n) { strips(n); });
      } else {
        rows(element, [this](const PlyProperty& property, std::size_t) { skip(property); });
      }
    }
    if (values_.longer_rows() > 0)
      builder_.warn(values_.place_of_longer() + ": ignored extra values after the header's properties in " +
                    base::counted(values_.longer_rows(), "row"));
    Attributes found = attributes_.finish(builder_.surface());
    face_attributes_.finish(builder_.surface(), header_.texture_files, source_.folder, found);
    return found;
  }

private:
  template <class Read>
  void rows(const PlyElement& element, Read read) {
    if (element.properties.empty()) return;
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.start_row(element.name, i);
      for (std::size_t p = 0; p < element.properties.size(); ++p) read(element.properties[p], p);
      values_.end_row();
      if (i % 8192 == 0) source_.report(values_.done());
    }
  }

  void vertices(const PlyElement& element) {
    const std::array<std::size_t, 3> axes = {element.find("x"), element.find("y"), element.find("z")};
    for (const std::size_t axis : axes) {
      if (axis == element.properties.size() || element.properties[axis].list_size) {
        throw base::Error(source_.name, "element vertex lacks x, y or z", "export the model again");
      }
    }
    builder_.surface().positions.reserve(element.count);
    PlyRow& wanted = attributes_.begin(element);
    Point point{};
    rows(element, [&](const PlyProperty& property, std::size_t p) {
      const auto axis = static_cast<std::size_t>(std::find(axes.begin(), axes.end(), p) - axes.begin());
      if (axis < 3) {
        point[axis] = values_.coordinate(property.type);
      } else if (property.list_size || !wanted.wants(p)) {
        skip(property);
      } else {
        wanted.take(p, value(property));
      }
      if (p + 1 != element.properties.size()) return;
      builder_.position(point);
      attributes_.end_row();
    });
  }

  template <class Take>
  void lists(const PlyElement& element, std::size_t wanted, Take take) {
    if (element.count > 0 && (wanted == element.properties.size() || !element.properties[wanted].list_size)) {
      throw base::Error(source_.name, "element " + element.name + " has no list vertex_indices",
                        "export the model again");
    }
    PlyRow& row = face_attributes_.begin(element, builder_.surface());
    rows(element, [&](const PlyProperty& property, std::size_t p) {
      if (p == wanted) {
        const std::size_t length = list_length(property);
        index_type_ = property.type;
        take(length);
      } else if (face_attributes_.wants_list(p)) {
        for (std::size_t i = list_length(property); i-- > 0;) face_attributes_.take_texture(value(property));
      } else if (row.wants(p)) {
        row.take(p, value(property));
      } else {
        skip(property);
      }
      if (p + 1 == element.properties.size()) face_attributes_.end_row();
    });
  }

  // 0 for non-numbers.
  double value(const PlyProperty& property) {
    const double value = values_.value_of(property.type, values_.skip(property.type));
    return std::isfinite(value) ? value : 0;
  }

  std::size_t list_length(const PlyProperty& property) {
    const std::int64_t length = values_.integer(*property.list_size);
    if (length < 0 || static_cast<std::size_t>(length) > values_.most_values(property.type)) {
      values_.fail("a list announces " + std::to_string(length) + " values, the file has room for " +
                       std::to_string(values_.most_values(property.type)),
                   "the file is damaged or cut short: export or copy it again");
    }
    return static_cast<std::size_t>(length);
  }

  void skip(const PlyProperty& property) {
    const std::size_t count = property.list_size ? list_length(property) : 1;
    for (std::size_t i = 0; i < count; ++i) values_.skip(property.type);
  }

  std::uint32_t checked(std::int64_t index) {
    if (index < 0 || static_cast<std::size_t>(index) >= vertex_count_) {
      values_.fail("face refers to vertex " + std::to_string(index) + " (from 0), the file has " +
                       std::to_string(vertex_count_),
                   "export the model again");
    }
    return static_cast<std::uint32_t>(index);
  }

  void polygon(std::size_t corners) {
    for (std::size_t i = 0; i < corners; ++i) builder_.corner(checked(values_.integer(index_type_)));
    builder_.end_polygon();
  }

  // Triangle strips separated by -1; every second triangle is reversed. Triangles with repeated corners only
  // join strips.
  void strips(std::size_t length) {
    std::uint32_t a = 0, b = 0;
    std::size_t run = 0;
    for (std::size_t i = 0; i < length; ++i) {
      const std::int64_t index = values_.integer(index_type_);
      if (index == -1) {
        run = 0;
        continue;
      }
      const std::uint32_t c = checked(index);
      if (run >= 2 && a != b && b != c && a != c) triangle(run % 2 == 0 ? a : b, run % 2 == 0 ? b : a, c);
      a = b;
      b = c;
      ++run;
    }
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t v : {a, b, c}) builder_.corner(v);
    builder_.end_polygon();
  }

  const PlyHeader& header_;
  const Source& source_;
  SurfaceBuilder& builder_;
  PlyAttributes attributes_;
  PlyFaceAttributes face_attributes_;
  Values values_;
  std::size_t vertex_count_ = 0;
  PlyType index_type_ = PlyType::int32;
};

}  // namespace

ReadResult read_ply(const Source& source) {
  if (!looks_like_ply(source))
    throw base::Error(source.name, "does not start with the word ply", "check the extension");
  SurfaceBuilder builder(source);
  TextCursor text(source, {});
  PlyHeader header = read_ply_header(text, source, builder);
  const std::size_t body = text.offset();
  Attributes found;
  std::string format = "PLY ascii";
  if (header.format == PlyHeader::Format::ascii) {
    found = PlyBody(header, source, builder, PlyTextValues(text)).read();
  } else {
    const bool little = header.format == PlyHeader::Format::little_endian;
    const auto order = little ? std::endian::little : std::endian::big;
    found = PlyBody(header, source, builder, PlyBinaryValues(source, body, order)).read();
    format = little ? "PLY binary little-endian" : "PLY binary big-endian";
  }
  ReadResult result = builder.finish(std::move(format));
  if (!found.empty()) result.attributes = std::make_shared<const Attributes>(std::move(found));
  if (source.owner) {
    Companions companions{source.folder, {}};
    if (result.attributes) {
      for (const ImageFile& image : result.attributes->images) companions.files.push_back(image.path);
    }
    result.original = ply_original(source, std::move(header), body, std::move(companions));
  }
  return result;
}

bool looks_like_ply(const Source& source) {
  std::string_view bytes = source.bytes;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // as TextCursor does
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
}

bool is_certainly_ply(const Beginning& file) {
  const Source source{"", "", file.bytes()};
  if (!looks_like_ply(source)) return false;
  TextCursor text(source, {});
  bool has_format = false;
  for (; text.next_filled_line(); text.next_line()) {
    const std::string_view word = text.word();
    has_format |= word == "format";
    if (word == "end_header") return has_format;
  }
  return false;
}

}  // namespace viete::mesh
