#include "formats/format_table.h"

#include <algorithm>
#include <new>
#include <ranges>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"
#include "formats/codecs.h"
#include "formats/point_cache.h"
#include "formats/read.h"

namespace viete::formats {

namespace {

constexpr Format gltf_as(std::string_view extension, void (*write)(const Content&, TextWriter&)) {
  using namespace held;
  return {.extension = extension,
          .name = "glTF",
          .read = read_gltf,
          .recognised = looks_like_gltf,
          .is_certain = is_certainly_gltf,
          .write = write,
          .may_be_binary = true,
          .holds_morphs = true,
          .embeds_images = true,
          .up = 'y',
          .in_metres = true,
          .all_held = points | texture_points | colors | polygon_colors | normals | corner_normals | objects |
                      textures | materials};
}

// Returns a list without duplicates: "a, b or c".
std::string listing(bool (*is)(const Format&), std::string_view before, std::string_view Format::*word,
                    std::string_view last) {
  std::vector<std::string> words;
  for (const Format& f : all_formats()) {
    const std::string text = std::string(before) + std::string(f.*word);
    if (is(f) && std::ranges::find(words, text) == words.end()) words.push_back(text);
  }
  return base::listed(words, last);
}

ReadResult by_extension(const Source& source) {
  refuse_foreign(source.name, source.bytes);
  const Format* named = format_by_extension(source.extension);
  if (named && named->may_be_binary) return named->read(source);
  const bool binary = looks_binary(source.bytes);
  if (!binary && looks_like_obj(source)) return read_obj(source);
  if (!binary && named && named->read) return named->read(source);
  throw base::Error(source.name, "the file is not " + format_names(holds_surface),
                    "export the model in one of these formats");
}

}  // namespace

std::span<const Format> all_formats() {
  using namespace held;
  static constexpr Format formats[] = {
      {.extension = "obj",
       .name = "OBJ",
       .read = read_obj,
       .is_certain = is_certainly_obj,
       .write = write_obj,
       .write_library = write_mtl,
       .library_extension = "mtl",
       .keeps_order = true,
       .all_held = polygons | points | texture_points | colors | normals | corner_normals | objects | groups |
                   textures | materials},
      {.extension = "ply",
       .name = "PLY",
       .read = read_ply,
       .recognised = looks_like_ply,
       .is_certain = is_certainly_ply,
       .write = write_ply,
       .keeps_order = true,
       .all_held = polygons | points | texture_points | colors | polygon_colors | both_colors | normals |
                   splats | textures},
      {.extension = "off",
       .name = "OFF",
       .read = read_off,
       .recognised = looks_like_off,
       .is_certain = is_certainly_off,
       .write = write_off,
       .keeps_order = true,
       .all_held = polygons | points | colors | polygon_colors | both_colors},
      {.extension = "stl",
       .name = "STL",
       .read = read_stl,
       .recognised = looks_like_stl,
       .is_certain = is_certainly_stl,
       .write = write_stl,
       .may_be_binary = true,
       .up = 'z'},
      gltf_as("glb", write_glb),
      gltf_as("gltf", write_gltf),
      {.extension = "spz",
       .name = "SPZ",
       .read = read_spz,
       .recognised = looks_like_spz,
       .is_certain = is_certainly_spz,
       .write = write_spz,
       .may_be_binary = true,
       .all_held = splats},
      {.extension = "pc2", .name = "PC2", .is_sequence = true},
      {.extension = "mdd", .name = "MDD", .is_sequence = true},
  };
  return formats;
}

const Format* format_by_extension(std::string_view extension) {
  const auto found = std::ranges::find(all_formats(), extension, &Format::extension);
  return found == all_formats().end() ? nullptr : &*found;
}

const Format* find_format(const std::filesystem::path& file) {
  return format_by_extension(std::string_view(base::extension_of(file)));
}

const Format& surface_format(const std::filesystem::path& file) {
  const Format* found = find_format(file);
  if (found && found->write) return *found;
  const std::string extension = base::extension_of(file);
  throw base::Error(file.string(),
                    extension.empty() ? "the file name has no extension" : "unknown extension ." + extension,
                    "use " + format_extensions(holds_surface));
}

bool writes_itself(const Original* original, const std::filesystem::path& file) {
  const Format* to = original ? find_format(file) : nullptr;
  return to && to->name == original->format();
}

const Format* format_of_content(const std::filesystem::path& file, const Beginning& beginning) {
  for (const Format& f : all_formats())
    if (f.is_certain && f.is_certain(beginning)) return &f;
  try {
    const bool is_pc2 = PointCache(file).head().format == PointCacheFormat::pc2;
    return format_by_extension(is_pc2 ? "pc2" : "mdd");
  } catch (const base::Error&) {
    return nullptr;
  }
}

const Format* format_of_description(std::string_view description) {
  for (const Format& f : all_formats())
    if (holds_surface(f) && description.starts_with(f.name)) return &f;
  return nullptr;
}

std::string format_names(bool (*is)(const Format&), std::string_view last) {
  return listing(is, "", &Format::name, last);
}

std::string format_extensions(bool (*is)(const Format&), std::string_view last) {
  return listing(is, ".", &Format::extension, last);
}

bool is_a(bool (*is)(const Format&), const std::filesystem::path& file) {
  const Format* found = find_format(file);
  return found && is(*found);
}

bool describes(bool (*is)(const Format&), std::string_view description) {
  const Format* found = format_of_description(description);
  return found && is(*found);
}

ReadResult read(const Source& source) {
  try {
    // The order is reversed, so that STL comes before OFF and PLY: a binary STL may start with any text.
    for (const Format& format : std::views::reverse(all_formats()))
      if (format.recognised && format.recognised(source)) return format.read(source);
    return by_extension(source);
  } catch (const std::bad_alloc&) {
    throw base::Error(source.name, "the model does not fit into memory",
                      "simplify the model or use a computer with more memory");
  }
}

ReadResult read(const std::filesystem::path& path, base::Progress* progress, bool played) {
  const auto bytes = std::make_shared<const base::FileBytes>(path, progress);
  const auto folder = std::filesystem::absolute(path).parent_path();
  return read(
      Source{path.string(), base::extension_of(path), bytes->view(), progress, bytes, folder, played});
}

}  // namespace viete::formats
