#include "formats/ply_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "base/worker_pool.h"

namespace viete::formats {

namespace {

base::NumberType type_named(TextCursor& text) {
  static const std::map<std::string_view, base::NumberType> types = {
      {"char", base::NumberType::int8},      {"int8", base::NumberType::int8},
      {"uchar", base::NumberType::uint8},    {"uint8", base::NumberType::uint8},
      {"short", base::NumberType::int16},    {"int16", base::NumberType::int16},
      {"ushort", base::NumberType::uint16},  {"uint16", base::NumberType::uint16},
      {"int", base::NumberType::int32},      {"int32", base::NumberType::int32},
      {"uint", base::NumberType::uint32},    {"uint32", base::NumberType::uint32},
      {"long", base::NumberType::int64},     {"int64", base::NumberType::int64},
      {"ulong", base::NumberType::uint64},   {"uint64", base::NumberType::uint64},
      {"longlong", base::NumberType::int64}, {"ulonglong", base::NumberType::uint64},
      {"float", base::NumberType::float32},  {"float32", base::NumberType::float32},
      {"double", base::NumberType::float64}, {"float64", base::NumberType::float64}};
  const std::string_view word = text.word();
  const auto found = types.find(word);
  if (found == types.end()) text.fail(in_quotes(word) + " is not a PLY type");
  return found->second;
}

PlyHeader::Format format_named(TextCursor& text) {
  const std::string_view word = text.word();
  if (word == "ascii") return PlyHeader::Format::ascii;
  if (word == "binary_little_endian") return PlyHeader::Format::little_endian;
  if (word == "binary_big_endian") return PlyHeader::Format::big_endian;
  text.fail(in_quotes(word) + " is not a PLY format", "export as ascii or binary_little_endian");
}

PlyElement element(TextCursor& text) {
  PlyElement element;
  element.name = text.word();
  const std::int64_t count = text.integer("element count");
  if (count < 0) text.fail("element count " + std::to_string(count) + " is negative");
  element.count = static_cast<std::size_t>(count);
  return element;
}

PlyProperty property(TextCursor& text) {
  PlyProperty property;
  TextCursor ahead = text;
  if (ahead.word() == "list") {
    text = ahead;
    property.list_size = type_named(text);
  }
  property.type = type_named(text);
  property.name = text.word();
  return property;
}

std::size_t least_row_bytes(const PlyElement& element, bool ascii) {
  if (ascii) return 2 * element.properties.size();  // each value has a digit and a separator
  return std::accumulate(
      element.properties.begin(), element.properties.end(), std::size_t{0},
      [](std::size_t sum, const PlyProperty& p) { return sum + size_of(p.list_size.value_or(p.type)); });
}

void check_room(const PlyHeader& header, const TextCursor& text, const Source& source) {
  const bool ascii = header.format == PlyHeader::Format::ascii;
  std::size_t left = text.bytes_left() + (ascii ? 1 : 0);  // the last line end may be missing
  for (const PlyElement& e : header.elements) {
    const std::size_t row = least_row_bytes(e, ascii);
    if (row == 0) continue;
    if (e.count > left / row)
      throw base::Error(source.name,
                        "the header announces " + std::to_string(e.count) + " elements " + in_quotes(e.name) +
                            ", the file has room for " + std::to_string(left / row),
                        "it seems to be truncated: export or copy it again");
    left -= e.count * row;
  }
}

bool is_of_splats(std::string_view property) {
  const auto names = {"f_dc_", "f_rest_", "scale_", "rot_", "opacity"};
  return std::ranges::any_of(names, [&](std::string_view name) { return property.starts_with(name); });
}

// Reads a line of the header. At the end of the header, returns false.
bool header_line(TextCursor& text, PlyHeader& header, SurfaceBuilder& builder) {
  const std::string_view word = text.word();
  if (word == "end_header") return false;
  if (word == "comment" || word == "obj_info") {
    TextCursor ahead = text;
    builder.comment(text.rest_of_line());
    const bool is_texture = word == "comment" && ahead.word() == "TextureFile";
    if (is_texture) header.texture_files.emplace_back(ahead.rest_of_line());
    (word == "comment" ? header.has_comments : header.has_obj_info) |= !is_texture;
  } else if (word == "format") {
    header.format = format_named(text);
  } else if (word == "element") {
    header.elements.push_back(element(text));
  } else if (word == "property") {
    if (header.elements.empty()) text.fail("a property stands before the first element");
    header.elements.back().properties.push_back(property(text));
  } else {
    constexpr std::size_t most = 64;  // rejects a file that only begins like PLY
    if (++header.unknown_lines > most) text.fail("a PLY header cannot hold " + in_quotes(word));
    if (header.unknown_lines == 1)
      builder.warn_at(text.place(), "ignored a header line that starts with " + in_quotes(word));
  }
  return true;
}

// Returns the largest degree, at most 3, whose harmonics are all among this number of harmonics.
int whole_degree(std::size_t harmonics) {
  return harmonics >= 15 ? 3 : harmonics >= 8 ? 2 : harmonics >= 3 ? 1 : 0;
}

}  // namespace

std::size_t PlyElement::find(const std::string& wanted, const std::string& other) const {
  std::size_t i = 0;
  while (i < properties.size() && properties[i].name != wanted &&
         (other.empty() || properties[i].name != other))
    ++i;
  return i;
}

std::size_t PlyElement::bytes_before(std::size_t property) const {
  std::size_t sum = 0;
  for (std::size_t p = 0; p < properties.size(); ++p) {
    if (properties[p].list_size) return 0;
    if (p < property) sum += size_of(properties[p].type);
  }
  return sum;
}

const PlyElement* PlyHeader::find(const std::string& name) const {
  const auto found =
      std::find_if(elements.begin(), elements.end(), [&](const PlyElement& e) { return e.name == name; });
  return found == elements.end() ? nullptr : &*found;
}

// After B. Kerbl et al., 3D Gaussian Splatting for Real-Time Radiance Field Rendering, 2023.
Capture PlyHeader::capture() const {
  const PlyElement* vertices = find("vertex");
  if (!vertices) return Capture::none;
  const auto has = [&](const char* name) { return vertices->find(name) < vertices->properties.size(); };
  if (!has("scale_0") && !has("rot_0") && !has("f_rest_0")) return Capture::none;
  const auto all = {"scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3", "opacity"};
  const bool lists =
      std::ranges::any_of(vertices->properties, [](const PlyProperty& p) { return p.list_size.has_value(); });
  const bool faces = std::ranges::any_of(elements, [](const PlyElement& e) {
    return e.count > 0 && (e.name == "face" || e.name == "tristrips");
  });
  const bool complete = std::ranges::all_of(all, has) && !lists && !faces && vertices->count > 0;
  return complete ? Capture::splats : Capture::points;
}

std::vector<std::string> PlyHeader::beyond_attributes() const {
  constexpr std::string_view of_vertices =
      " x y z nx ny nz red green blue alpha diffuse_red diffuse_green diffuse_blue s t u v texture_u "
      "texture_v texture_s texture_t ";
  constexpr std::string_view of_faces =
      " vertex_indices vertex_index red green blue alpha texcoord texnumber ";
  std::vector<std::string> found;
  const bool splats = capture() == Capture::splats;
  if (has_comments) found.emplace_back("comments");
  if (has_obj_info) found.emplace_back("obj_info");
  for (const PlyElement& element : elements) {
    if (element.count == 0) continue;
    const bool vertices = element.name == "vertex";
    if (!vertices && element.name != "face" && element.name != "tristrips") {
      found.push_back("element " + element.name);
      continue;
    }
    for (const PlyProperty& p : element.properties)
      if (!(vertices && splats && is_of_splats(p.name)) &&
          (vertices ? of_vertices : of_faces).find(" " + p.name + " ") == std::string_view::npos)
        found.push_back("property " + p.name + " of " + element.name);
  }
  return found;
}

PlyHeader read_ply_header(TextCursor& text, const Source& source, SurfaceBuilder& builder) {
  PlyHeader header;
  text.next_line();  // skips "ply"
  text.need_word("the end of the PLY header");
  while (header_line(text, header, builder)) {
    text.next_line();
    text.need_word("the end of the PLY header");
  }
  text.next_line();
  check_room(header, text, source);
  return header;
}

double PlyValues::coordinate(base::NumberType type) {
  if (is_text_) return next_word().coordinate();
  const double number = value(type);
  if (!(std::abs(number) <= mesh::largest_coordinate))
    fail("a coordinate is not a finite number up to 1e100", "repair the vertex");
  return number;
}

std::int64_t PlyValues::integer(base::NumberType type) {
  if (is_text_) return next_word().integer("whole number");
  const double number = value(type);
  if (!(std::abs(number) < 9e15) || number != std::floor(number))
    fail("a value is not a whole number", "export again");
  return static_cast<std::int64_t>(number);
}

double PlyValues::value(base::NumberType type) {
  const std::string_view word = next(type);
  return is_text_ ? number_in(word).value_or(std::nan("")) : base::number_of_bytes(word.data(), type, order_);
}

std::string_view PlyValues::next(base::NumberType type) {
  if (is_text_) return next_word().word();
  const std::size_t size = size_of(type);
  if (at_.size() < size) fail("the file ends here", "it seems to be truncated: export or copy it again");
  const std::string_view bytes = at_.substr(0, size);
  at_.remove_prefix(size);
  return bytes;
}

void PlyValues::fail(const std::string& problem, const std::string& advice) const {
  if (is_text_) text_.fail(problem, advice);
  throw base::Error(source_.place(element_, index_), problem, advice);
}

std::vector<std::string> splat_names(std::size_t bands, std::size_t in_file) {
  std::vector<std::string> names;
  const auto add = [&](const char* name, std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k) names.push_back(name + std::to_string(k));
  };
  add("f_dc_", 0, 3);
  for (std::size_t color = 0; color < 3; ++color) add("f_rest_", color * in_file, bands);
  names.emplace_back("opacity");
  add("scale_", 0, 3);
  add("rot_", 0, 4);
  return names;
}

PlySplats::PlySplats(const PlyElement& vertices) {
  const auto has = [&](const std::string& name) { return vertices.find(name) < vertices.properties.size(); };
  std::size_t harmonics = 0;
  while (has("f_rest_" + std::to_string(harmonics))) ++harmonics;
  const std::size_t in_file = harmonics % 3 == 0 ? harmonics / 3 : 0;
  degree = whole_degree(in_file);
  const auto bands = static_cast<std::size_t>(degree * (degree + 2));
  for (const std::string& name : splat_names(bands, in_file)) properties.push_back(vertices.find(name));
  if (3 * bands != harmonics)
    notes.push_back("the capture has " + std::to_string(harmonics) +
                    " properties f_rest_* instead of 0, 9, 24 or 45: harmonics above degree " +
                    std::to_string(degree) + " are kept, but neither drawn nor turned");
  if (!has("f_dc_0") || !has("f_dc_1") || !has("f_dc_2"))
    notes.emplace_back("the capture has no colours (f_dc_0 to f_dc_2): its splats are grey");
}

mesh::Splats PlySplats::allocate(const std::string& file, std::size_t count) const {
  mesh::Splats splats;
  splats.degree = degree;
  base::require_memory({static_cast<double>(sizeof(float) * properties.size() * count),
                        base::counted(count, "splat") + " take",
                        "use a computer with more memory, or remove splats in another program", file});
  splats.resize(count);
  return splats;
}

void read_splats(const PlySplats& found, const PlyElement& vertices, std::string_view rows, std::endian order,
                 mesh::Splats& splats) {
  const auto columns = splat_columns(splats);
  const std::size_t row_bytes = vertices.row_bytes();
  base::for_blocks(
      splats.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
          if (found.properties[c] == vertices.properties.size()) continue;
          const char* const first = rows.data() + vertices.bytes_before(found.properties[c]);
          with_type(vertices.properties[found.properties[c]].type, [&](auto number) {
            for (std::size_t v = begin; v < end; ++v)
              columns[c][v] =
                  static_cast<float>(base::number_of_bytes<decltype(number)>(first + v * row_bytes, order));
          });
        }
      },
      1 << 12);
}

}  // namespace viete::formats
