#include "mesh/formats/ply_file.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string_view>

#include "base/error.h"

namespace viete::mesh {

namespace {

PlyType type_named(TextCursor& text) {
  static const std::map<std::string_view, PlyType> types = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"long", PlyType::int64},     {"int64", PlyType::int64},     {"ulong", PlyType::uint64},
      {"uint64", PlyType::uint64},  {"longlong", PlyType::int64},  {"ulonglong", PlyType::uint64},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  const std::string_view word = text.word();
  const auto found = types.find(word);
  if (found == types.end()) text.fail(in_quotes(word) + " is not a PLY type", "export the model again");
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
  if (count < 0)
    text.fail("element count " + std::to_string(count) + " is negative", "export the model again");
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
  if (ascii) return 2 * element.properties.size();  // at least a digit and a separator each
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
    if (e.count > left / row) {
      throw base::Error(source.name,
                        "the header announces " + std::to_string(e.count) + " elements " + in_quotes(e.name) +
                            ", the file has room for " + std::to_string(left / row),
                        "it seems to be truncated: export or copy it again");
    }
    left -= e.count * row;
  }
}

// False at the end of the header.
bool header_line(TextCursor& text, PlyHeader& header, SurfaceBuilder& builder) {
  const std::string_view word = text.word();
  if (word == "end_header") return false;
  if (word == "comment" || word == "obj_info") {
    TextCursor ahead = text;
    builder.comment(text.rest_of_line());
    if (word == "comment" && ahead.word() == "TextureFile")
      header.texture_files.emplace_back(ahead.rest_of_line());
  } else if (word == "format") {
    header.format = format_named(text);
  } else if (word == "element") {
    header.elements.push_back(element(text));
  } else if (word == "property") {
    if (header.elements.empty())
      text.fail("a property stands before the first element", "export the model again");
    header.elements.back().properties.push_back(property(text));
  } else {
    constexpr std::size_t most = 64;  // limits warnings about an endless header
    if (++header.unknown_lines > most)
      text.fail("a PLY header cannot hold " + in_quotes(word), "export the model again");
    if (header.unknown_lines == 1)
      builder.warn(text.place() + ": ignored a header line that starts with " + in_quotes(word));
  }
  return true;
}

}  // namespace

std::size_t PlyElement::find(const std::string& wanted, const std::string& other) const {
  std::size_t i = 0;
  while (i < properties.size() && properties[i].name != wanted &&
         (other.empty() || properties[i].name != other))
    ++i;
  return i;
}

const PlyElement* PlyHeader::find(const std::string& name) const {
  const auto found =
      std::find_if(elements.begin(), elements.end(), [&](const PlyElement& e) { return e.name == name; });
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(TextCursor& text, const Source& source, SurfaceBuilder& builder) {
  PlyHeader header;
  text.next_line();  // "ply"
  text.need_word("the end of the PLY header");
  while (header_line(text, header, builder)) {
    text.next_line();
    text.need_word("the end of the PLY header");
  }
  text.next_line();
  check_room(header, text, source);
  return header;
}

}  // namespace viete::mesh
