#include "mesh/formats/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "mesh/formats/ply_attributes.h"
#include "mesh/formats/ply_face_attributes.h"
#include "mesh/formats/ply_header.h"
#include "mesh/formats/ply_original.h"
#include "mesh/formats/ply_values.h"
#include "mesh/formats/surface_builder.h"
#include "mesh/formats/text_cursor.h"

namespace viete::mesh {

namespace {

template <class Values>
class PlyBody {
public:
  PlyBody(const PlyHeader& header, const Source& source, SurfaceBuilder& builder, PlyAttributes& attributes,
          PlyFaceAttributes& face_attributes, Values values)
      : header_(header),
        source_(source),
        builder_(builder),
        attributes_(attributes),
        face_attributes_(face_attributes),
        values_(values) {
    const PlyElement* vertices = header.find("vertex");
    vertex_count_ = vertices ? vertices->count : 0;
  }

  void read() {
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
      builder_.warn(values_.place_of_longer() +
                    ": passed over what stands behind the header's properties in " +
                    base::counted(values_.longer_rows(), "row"));
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
    PlyAttributes& attributes = attributes_.begin(element);
    Point point{};
    rows(element, [&](const PlyProperty& property, std::size_t p) {
      const auto axis = static_cast<std::size_t>(std::find(axes.begin(), axes.end(), p) - axes.begin());
      if (axis < 3) {
        point[axis] = values_.coordinate(property.type);
      } else if (property.list_size || !attributes.wants(p)) {
        skip(property);
      } else {
        attributes.take(p, value(property));
      }
      if (p + 1 != element.properties.size()) return;
      builder_.position(point);
      attributes.end_row();
    });
  }

  template <class Take>
  void lists(const PlyElement& element, std::size_t wanted, Take take) {
    if (element.count > 0 && (wanted == element.properties.size() || !element.properties[wanted].list_size)) {
      throw base::Error(source_.name, "element " + element.name + " has no list vertex_indices",
                        "export the model again");
    }
    face_attributes_.begin(element, builder_.surface());
    rows(element, [&](const PlyProperty& property, std::size_t p) {
      if (p == wanted) {
        const std::size_t length = list_length(property);
        index_type_ = property.type;
        take(length);
      } else if (face_attributes_.wants_list(p)) {
        for (std::size_t i = list_length(property); i-- > 0;) face_attributes_.take_texture(value(property));
      } else if (face_attributes_.wants(p)) {
        face_attributes_.take(p, value(property));
      } else {
        skip(property);
      }
      if (p + 1 == element.properties.size()) face_attributes_.end_row();
    });
  }

  // 0 for what is no number.
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

  // Strips of triangles, ended by -1; every second triangle runs the other way round. Repeated corners only
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
  PlyAttributes& attributes_;
  PlyFaceAttributes& face_attributes_;
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
  PlyAttributes attributes;
  PlyFaceAttributes face_attributes;
  std::string format = "PLY ascii";
  if (header.format == PlyHeader::Format::ascii) {
    PlyBody(header, source, builder, attributes, face_attributes, PlyTextValues(text)).read();
  } else {
    const bool little = header.format == PlyHeader::Format::little_endian;
    const auto order = little ? std::endian::little : std::endian::big;
    PlyBody(header, source, builder, attributes, face_attributes, PlyBinaryValues(source, body, order))
        .read();
    format = little ? "PLY binary little-endian" : "PLY binary big-endian";
  }
  ReadResult result = builder.finish(std::move(format));
  Attributes found = attributes.finish(result.surface);
  face_attributes.finish(result.surface, header.texture_files, source.folder, found);
  if (!found.empty()) result.attributes = std::make_shared<const Attributes>(std::move(found));
  if (source.owner) {
    Companions companions{source.folder, {}};
    if (result.attributes) {
      for (const ImageFile& image : result.attributes->images) companions.files.push_back(image.path);
    }
    result.original = std::make_shared<const PlyOriginal>(source.name, source.bytes, source.owner,
                                                          std::move(header), body, std::move(companions));
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
