#include "base/file_bytes.h"
#include "formats/codecs.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "base/worker_pool.h"
#include "formats/file_vectors.h"
#include "formats/ply_file.h"
#include "mesh/point_index.h"

namespace viete::formats {

namespace {

// Returns the factor that maps colour values of this type to 0..1. Integers of more than two bytes use 1/255,
// because some text files declare bytes as wider integers.
double part_of_largest(base::NumberType type) {
  return with_type(type, [](auto number) {
    using Number = decltype(number);
    if (!std::is_integral_v<Number>) return 1.0;
    return 1.0 / (sizeof number > 2 ? 255.0 : static_cast<double>(std::numeric_limits<Number>::max()));
  });
}

// Reads vertices, faces and triangle strips. Optional properties of vertices: normals (nx ny nz), colours
// (red green blue alpha, or diffuse_red ...), texture coordinates (s t, u v, texture_u texture_v, texture_s
// texture_t). Optional properties of faces: colours; texcoord (a list with u v for each corner); texnumber.
class PlyBody {
public:
  PlyBody(const PlyHeader& header, const Source& source, SurfaceBuilder& builder, const PlyValues& values)
      : header_(header), source_(source), builder_(builder), values_(values) {
    const PlyElement* vertices = header.find("vertex");
    vertex_count_ = vertices ? vertices->count : 0;
  }

  Attributes read() {
    for (const PlyElement& element : header_.elements) {
      columns_.assign(element.properties.size(), {});
      if (element.name == "vertex" && builder_.vertex_count() == 0) {
        vertices(element);
      } else if (element.name == "face") {
        if (!read_triangles(element))
          lists(element, record_face_normals(element), [this](std::size_t n) { polygon(n); });
      } else if (element.name == "tristrips") {
        lists(element, nullptr, [this](std::size_t n) { strips(n); });
      } else {
        rows(element, [this](const PlyProperty& property, std::size_t p) { take(property, p); });
      }
    }
    if (splats_) builder_.splats(splats_);
    if (values_.longer_rows() > 0)
      builder_.warn_at(values_.place_of_longer(), "ignored extra values after the header's properties in " +
                                                      base::counted(values_.longer_rows(), "row"));
    finish();
    return std::move(found_);
  }

  // Returns the vectors that can change when the file is written again. Call this after read().
  std::vector<FileVectors> take_vectors() { return std::move(vectors_); }
  std::size_t first_row() const { return first_row_; }

private:
  // The destinations of a property: (*places)[row][axis] gets the offset of the value, *number gets
  // factor * value. Unused pointers are null.
  struct Column {
    std::vector<FileVectors::Places>* places = nullptr;
    std::size_t axis = 0;
    double* number = nullptr;
    double factor = 1;
  };
  using RowOfCorner = std::vector<std::uint32_t>;

  // Adds FileVectors for three properties. If a property is missing or source_.owner is null, returns null.
  // If rows are binary and have no lists, computes the places. Otherwise, rows() records the places.
  FileVectors* record(const PlyElement& element, FileVectors::Kind kind,
                      const std::array<const char*, 3>& names) {
    std::array<std::size_t, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = element.find(names[k]);
      if (!source_.owner || at[k] == element.properties.size() || element.properties[at[k]].list_size)
        return nullptr;
    }
    FileVectors& vectors =
        vectors_.emplace_back(FileVectors{.kind = kind, .element = element.name, .count = element.count});
    for (std::size_t k = 0; k < 3; ++k) vectors.types[k] = element.properties[at[k]].type;
    const bool is_text = header_.format == PlyHeader::Format::ascii;
    if (const std::size_t row_bytes = element.row_bytes(); row_bytes > 0 && !is_text) {
      FileVectors::Places first;
      for (std::size_t k = 0; k < 3; ++k) first[k] = values_.place() + element.bytes_before(at[k]);
      vectors.places = [first, row_bytes](std::size_t row) {
        const std::size_t by = row * row_bytes;
        return FileVectors::Places{first[0] + by, first[1] + by, first[2] + by};
      };
    } else {
      const auto list = std::make_shared<std::vector<FileVectors::Places>>(element.count);
      for (std::size_t k = 0; k < 3; ++k) columns_[at[k]] = {list.get(), k};
      vectors.places = [list](std::size_t row) { return (*list)[row]; };
    }
    return &vectors;
  }

  // Returns an empty list, to be filled with the face row of each corner. Without face normals, returns null.
  std::shared_ptr<RowOfCorner> record_face_normals(const PlyElement& element) {
    FileVectors* const vectors = record(element, FileVectors::Kind::normals, {"nx", "ny", "nz"});
    if (!vectors) return nullptr;
    const auto rows = std::make_shared<RowOfCorner>();
    vectors->rows = FileVectors::Rows::faces;
    vectors->row_of_corner = [rows](std::size_t c) { return c < rows->size() ? (*rows)[c] : mesh::none; };
    return rows;
  }

  // Selects these properties: the values of each row will be stored in to[0], to[1], ... If a property is
  // missing, returns false. If `colors`, values will be multiplied by part_of_largest().
  bool find(const PlyElement& element, std::initializer_list<std::string> names, double* to,
            bool colors = false) {
    std::vector<std::size_t> found;
    for (const std::string& name : names) {
      found.push_back(element.find(name));
      if (found.back() == element.properties.size() || element.properties[found.back()].list_size)
        return false;
    }
    for (const std::size_t p : found) {
      columns_[p].number = to++;
      if (colors) columns_[p].factor = part_of_largest(element.properties[p].type);
    }
    return true;
  }

  bool find_colors(const PlyElement& element, const std::string& prefix = "") {
    color_ = {0, 0, 0, 1};
    if (!find(element, {prefix + "red", prefix + "green", prefix + "blue"}, color_.data(), true))
      return false;
    find(element, {"alpha"}, &color_[3], true);
    return true;
  }

  Color color() const {
    Color c;
    for (std::size_t i = 0; i < 4; ++i) c[i] = static_cast<float>(std::clamp(color_[i], 0.0, 1.0));
    return c;
  }

  template <class Read>
  void rows(const PlyElement& element, Read read) {
    if (element.properties.empty()) return;
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.start_row(element.name, i);
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (const Column& c = columns_[p]; c.places) (*c.places)[i][c.axis] = values_.place();
        read(element.properties[p], p);
      }
      values_.end_row();
      if (i % 8192 == 0) source_.report(values_.done());
    }
  }

  void vertices(const PlyElement& element) {
    const std::array<std::size_t, 3> axes = {element.find("x"), element.find("y"), element.find("z")};
    for (const std::size_t axis : axes)
      if (axis == element.properties.size() || element.properties[axis].list_size)
        throw base::Error(source_.name, "element vertex lacks x, y or z", "export the model again");
    const bool capture = header_.capture() == Capture::splats;
    if (capture) {
      start_splats(element);
    } else {
      record(element, FileVectors::Kind::positions, {"x", "y", "z"});
      record(element, FileVectors::Kind::normals, {"nx", "ny", "nz"});
      record(element, FileVectors::Kind::tangents, {"tx", "ty", "tz"});
    }
    builder_.surface().positions.reserve(element.count);
    const bool normals = !capture && find(element, {"nx", "ny", "nz"}, normal_.data());
    const bool colors = find_colors(element) || find_colors(element, "diffuse_");
    bool texture = false;
    for (const auto& [u, v] :
         {std::array{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}})
      texture = texture || find(element, {u, v}, texture_.data());
    if (!normals && !texture && !colors && read_positions(element, axes)) return;
    mesh::Point point{};
    rows(element, [&](const PlyProperty& property, std::size_t p) {
      const auto axis = static_cast<std::size_t>(std::find(axes.begin(), axes.end(), p) - axes.begin());
      if (axis < 3) {
        point[axis] = values_.coordinate(property.type);
      } else if (!splat_columns_.empty() && splat_columns_[p].first) {
        splat_columns_[p][builder_.vertex_count()] = static_cast<float>(values_.value(property.type));
      } else {
        take(property, p);
      }
      if (p + 1 != element.properties.size()) return;
      builder_.position(point);
      if (normals) found_.normals.push_back(normal_);
      if (texture) found_.texture_points.push_back(texture_);
      if (colors) found_.colors.push_back(color());
    });
  }

  // Allocates the splats. Reads them from a binary file; rows() reads them from text.
  void start_splats(const PlyElement& element) {
    values_.start_row(element.name, 0);
    first_row_ = values_.place();
    const PlySplats found(element);
    for (const std::string& note : found.notes) builder_.warn(note);
    splats_ = std::make_shared<mesh::Splats>(found.allocate(source_.name, element.count));
    if (header_.format != PlyHeader::Format::ascii)
      return read_splats(found, element, values_.bytes(), header_.order(), *splats_);
    splat_columns_.resize(element.properties.size() + 1);
    const auto columns = splat_columns(*splats_);
    for (std::size_t c = 0; c < columns.size(); ++c) splat_columns_[found.properties[c]] = columns[c];
  }

  // Reads binary rows of equal length on all processors. If rows differ in length or a value is invalid,
  // reads nothing and returns false.
  bool read_positions(const PlyElement& element, const std::array<std::size_t, 3>& axes) {
    const std::string_view bytes = values_.bytes();
    const std::size_t row = element.row_bytes();
    auto& positions = builder_.surface().positions;
    if (row == 0 || bytes.size() / row < element.count || element.count >= mesh::none) return false;
    positions.resize(element.count);
    std::atomic<bool> valid = true;
    base::for_blocks(element.count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = 0; k < 3; ++k) {
        const char* from = bytes.data() + begin * row + element.bytes_before(axes[k]);
        with_type(element.properties[axes[k]].type, [&](auto number) {
          for (std::size_t i = begin; i < end; ++i, from += row) {
            positions[i][k] =
                static_cast<double>(base::number_of_bytes<decltype(number)>(from, header_.order()));
            if (!(std::abs(positions[i][k]) <= mesh::largest_coordinate)) valid = false;
          }
        });
      }
    });
    if (!valid) {
      positions.clear();
      return false;
    }
    values_.skip_bytes(element.count * row);
    return true;
  }

  // Reads binary triangles on all processors. If a face is anything else, reads nothing and returns false.
  bool read_triangles(const PlyElement& element) {
    mesh::Surface& s = builder_.surface();
    const std::string_view bytes = values_.bytes();
    if (element.properties.size() != 1 || element.find("vertex_indices", "vertex_index") != 0 ||
        !element.properties[0].list_size || element.count >= mesh::none / 3 || !s.corners.empty())
      return false;
    const PlyProperty& list = element.properties[0];
    const std::size_t first = size_of(*list.list_size), size = size_of(list.type), row = first + 3 * size;
    if (bytes.size() / row < element.count) return false;
    s.corners.resize(3 * element.count);
    s.polygon_starts.resize(element.count + 1);
    std::atomic<bool> valid = true;
    base::for_blocks(element.count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const char* from = bytes.data() + i * row;
        bool fits = base::number_of_bytes(from, *list.list_size, header_.order()) == 3;
        for (std::size_t k = 0; k < 3; ++k) {
          const double v = base::number_of_bytes(from + first + k * size, list.type, header_.order());
          fits = fits && v >= 0 && v < static_cast<double>(vertex_count_) && v == std::floor(v);
          s.corners[3 * i + k] = fits ? static_cast<std::uint32_t>(v) : 0;
        }
        s.polygon_starts[i + 1] = static_cast<std::uint32_t>(3 * (i + 1));
        if (!fits) valid = false;
      }
    });
    if (!valid) {
      s.corners.clear();
      s.polygon_starts.resize(1);
      return false;
    }
    values_.skip_bytes(element.count * row);
    polygons_ = element.count;
    corners_ = s.corners.size();
    return true;
  }

  template <class ReadList>
  void lists(const PlyElement& element, const std::shared_ptr<RowOfCorner>& row_of_corner,
             ReadList read_list) {
    const std::size_t wanted = element.find("vertex_indices", "vertex_index");
    if (element.count > 0 && (wanted == element.properties.size() || !element.properties[wanted].list_size))
      throw base::Error(source_.name, "element " + element.name + " has no list vertex_indices",
                        "export the model again");
    const std::size_t texcoord = element.find("texcoord");
    const bool colors = find_colors(element), numbered = find(element, {"texnumber"}, &image_);
    std::uint32_t number = 0;
    rows(element, [&](const PlyProperty& property, std::size_t p) {
      if (p == wanted) {
        const std::size_t length = list_length(property);
        index_type_ = property.type;
        read_list(length);
      } else if (p == texcoord && property.list_size) {
        for (std::size_t i = list_length(property); i-- > 0;) row_texture_.push_back(value(property));
      } else {
        take(property, p);
      }
      if (p + 1 != element.properties.size()) return;
      const std::size_t first = corners_, end = builder_.surface().corners.size();
      end_face(colors, numbered);
      if (!row_of_corner) return;
      row_of_corner->resize(first, mesh::none);
      row_of_corner->resize(end, number++);
    });
  }

  // Assigns the values of a row to the polygons that were added since the previous row.
  void end_face(bool colors, bool numbered) {
    const std::size_t polygons = builder_.surface().polygon_count();
    const std::size_t corners = builder_.surface().corners.size();
    if (polygons > polygons_) {
      if (colors) found_.polygon_colors.resize(polygons_, Material{}.base_color);
      if (colors) found_.polygon_colors.resize(polygons, color());
      if (row_texture_.size() == 2 * (corners - corners_)) add_face_texture();
      if (numbered) use_image();
    }
    polygons_ = polygons;
    corners_ = corners;
    row_texture_.clear();
  }

  void add_face_texture() {
    corner_texture_.resize(corners_, mesh::none);
    for (std::size_t i = 0; i < row_texture_.size(); i += 2) {
      const mesh::Point p{row_texture_[i] + 0.0, row_texture_[i + 1] + 0.0, 0};  // -0 becomes 0
      corner_texture_.push_back(texture_index_.find_or_add(p, texture_points_));
      if (corner_texture_.back() == texture_points_.size()) texture_points_.push_back(p);
    }
  }

  // Starts a group if the texnumber changes. The texnumber is the index of the material.
  void use_image() {
    const bool is_number = image_ >= 0 && image_ < 65536;
    const std::uint32_t material = is_number ? static_cast<std::uint32_t>(image_) : mesh::none;
    if (!groups_.empty() && groups_.back().material == material) return;
    if (groups_.empty() && polygons_ > 0) groups_.emplace_back();
    groups_.push_back({static_cast<std::uint32_t>(polygons_), "", "", material});
  }

  void finish() {
    const mesh::Surface& surface = builder_.surface();
    if (!found_.normals.empty()) found_.corner_normal = surface.corners;
    if (!found_.texture_points.empty()) found_.corner_texture = surface.corners;
    if (!found_.polygon_colors.empty())
      found_.polygon_colors.resize(surface.polygon_count(), Material{}.base_color);
    if (!texture_points_.empty()) {
      found_.texture_points.clear();
      for (const mesh::Point& p : texture_points_) found_.texture_points.push_back({p[0], p[1]});
      corner_texture_.resize(surface.corners.size(), mesh::none);
      found_.corner_texture = std::move(corner_texture_);
    }
    for (const std::string& image : header_.texture_files) {
      if (source_.folder.empty()) break;
      const auto path = base::path_beside(source_.folder, image);
      Material material{path.stem().string(), {1, 1, 1, 1}};
      material.base_color_image = static_cast<std::uint32_t>(found_.images.size());
      found_.images.push_back({path, nullptr, path.filename().string()});
      found_.materials.push_back(std::move(material));
    }
    if (found_.materials.empty() || surface.polygon_count() == 0) return;
    if (groups_.empty()) groups_.push_back({0, "", "", 0});
    for (Group& g : groups_)
      if (g.material >= found_.materials.size()) g.material = mesh::none;
    found_.groups = std::move(groups_);
  }

  // Returns the next value, or 0 if the next value is not a finite number.
  double value(const PlyProperty& property) {
    const double value = values_.value(property.type);
    return std::isfinite(value) ? value : 0;
  }

  std::size_t list_length(const PlyProperty& property) {
    const std::int64_t length = values_.integer(*property.list_size);
    if (length < 0 || static_cast<std::size_t>(length) > values_.most_values(property.type))
      values_.fail("a list announces " + std::to_string(length) + " values, the file has room for " +
                       std::to_string(values_.most_values(property.type)),
                   "the file is damaged or cut short: export or copy it again");
    return static_cast<std::size_t>(length);
  }

  void take(const PlyProperty& property, std::size_t p) {
    if (const Column& c = columns_[p]; c.number) {
      *c.number = c.factor * value(property);
      return;
    }
    const std::size_t count = property.list_size ? list_length(property) : 1;
    for (std::size_t i = 0; i < count; ++i) values_.skip(property.type);
  }

  std::uint32_t checked(std::int64_t index) {
    if (index < 0 || static_cast<std::size_t>(index) >= vertex_count_)
      values_.fail("face refers to vertex " + std::to_string(index) + " (from 0), the file has " +
                   std::to_string(vertex_count_));
    return static_cast<std::uint32_t>(index);
  }

  void polygon(std::size_t corners) {
    for (std::size_t i = 0; i < corners; ++i) builder_.corner(checked(values_.integer(index_type_)));
    builder_.end_polygon();
  }

  // Adds triangle strips separated by -1. Reverses every second triangle of a strip. Skips triangles with
  // repeated corners, which only join strips.
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
  PlyValues values_;
  std::vector<FileVectors> vectors_;
  std::shared_ptr<mesh::Splats> splats_;
  std::vector<SplatColumn<float>> splat_columns_;  // for each property of a text file
  std::size_t first_row_ = 0;                      // offset of the first vertex of a capture
  std::vector<Column> columns_;                    // one per property of the current element
  std::size_t vertex_count_ = 0;
  base::NumberType index_type_ = base::NumberType::int32;
  // The next five members belong to the current row.
  mesh::Vec3 normal_{0, 0, 0};
  std::array<double, 4> color_{};
  Vec2 texture_{};
  double image_ = 0;
  std::vector<double> row_texture_;
  std::size_t polygons_ = 0, corners_ = 0;  // counts before the current row
  Attributes found_;
  std::vector<mesh::Point> texture_points_;  // (u, v, 0) for corners of faces
  mesh::PointIndex texture_index_;
  std::vector<std::uint32_t> corner_texture_;
  std::vector<Group> groups_;
};

}  // namespace

ReadResult read_ply(const Source& source) {
  if (!looks_like_ply(source))
    throw base::Error(source.name, "does not start with the word ply", "check the extension");
  SurfaceBuilder builder(source);
  TextCursor text(source, {});
  const PlyHeader header = read_ply_header(text, source, builder);
  if (const PlyElement* const v = header.find("vertex");
      v && v->find("packed_position") < v->properties.size())
    throw base::Error(source.name, "this is a capture (Gaussian splats) in a compressed PLY file",
                      "export it as PLY without compression, or as SPZ version 3");
  PlyBody body(header, source, builder, {source, header, text});
  Attributes found = body.read();
  if (header.capture() == Capture::points) builder.warn(capture_note);
  constexpr const char* formats[] = {"PLY ascii", "PLY binary little-endian", "PLY binary big-endian"};
  Companions companions{source.folder, {}};
  for (const ImageFile& image : found.images) companions.files.push_back(image.path);
  ReadResult result = builder.finish(formats[static_cast<std::size_t>(header.format)], std::move(found));
  if (result.splats) {
    result.original = original_of_capture(source, header, body.first_row(), result.splats);
  } else {
    result.original = original_of(source, {.format = "PLY",
                                           .text = header.format == PlyHeader::Format::ascii,
                                           .order = header.order(),
                                           .vectors = body.take_vectors(),
                                           .beyond_attributes = header.beyond_attributes(),
                                           .companions = std::move(companions),
                                           .capture = header.capture()});
  }
  return result;
}

bool looks_like_ply(const Source& source) {
  std::string_view bytes = source.bytes;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // the UTF-8 byte order mark
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

}  // namespace viete::formats
