#include "mesh/formats/write.h"

#include <algorithm>
#include <iterator>

#include "base/atomic_file.h"
#include "base/error.h"
#include "mesh/formats/conversion.h"
#include "mesh/formats/format_table.h"
#include "mesh/formats/gltf_output.h"
#include "mesh/formats/image_files.h"
#include "mesh/formats/obj.h"
#include "mesh/formats/written_positions.h"

namespace viete::mesh {

namespace {

template <class Fill>
void write_as(const std::filesystem::path& path, Digits digits, base::Progress* progress, const Fill& fill) {
  base::replace_file(path, [&](const base::ByteSink& sink) {
    TextWriter out(sink, progress, digits);
    fill(out);
    out.finish();
  });
}

void append(std::vector<std::string>& notes, std::vector<std::string> more) {
  std::ranges::move(more, std::back_inserter(notes));
}

// What the format can hold of the attributes as they are now; what it cannot is told.
Attributes converted(const Format& format, const Content& content, const Original* original,
                     std::vector<std::string>& notes) {
  if (original) notes = left_out(format, *original);
  append(notes, triangles_notes(format, content.surface));
  if (!content.attributes) return {};
  Attributes now = deformed_attributes(content.surface, content.positions, *content.attributes);
  if (format.holds(held::materials) && !format.holds(held::polygon_colors)) colors_to_materials(now);
  if (format.write == write_obj) {
    fill_in_materials(now);
    name_materials(now);
  }
  append(notes, left_out(format, content.surface, *content.attributes, now));
  if (format.images == Format::Images::within) append(notes, take_images_within(now));
  return now;
}

}  // namespace

void write(const std::filesystem::path& path, const Surface& surface,
           const std::vector<std::string>& comments) {
  write(path, surface, surface.positions, comments);
}

void write(const std::filesystem::path& path, const Surface& surface, std::span<const Point> positions,
           const std::vector<std::string>& comments, base::Progress* progress) {
  write(path, Content{surface, positions, comments}, nullptr, {}, progress);
}

std::vector<std::string> write(const std::filesystem::path& path, const Content& content,
                               const Original* original, Digits digits, base::Progress* progress) {
  check_written(path.string(), content.positions);
  FilesBeside beside(path);
  if (writes_itself(original, path)) {
    std::vector<std::string> notes = copy_companions(original->companions(), beside);
    append(notes, original->write_file(path, content.surface, content.positions, digits, progress));
    beside.keep();
    return notes;
  }
  const Format& format = surface_format(path);
  if (!format.holds(held::points) && content.surface.triangles.empty())
    throw base::Error(path.string(), std::string(format.name) + " holds triangles alone, and there are none",
                      "write " + format_extensions([](const Format& f) { return f.holds(held::points); }));
  std::vector<std::string> notes;
  Attributes now = converted(format, content, original, notes);
  std::string library;
  if (format.images == Format::Images::beside) append(notes, put_images_beside(beside, now));
  if (format.write == write_obj && !now.materials.empty()) {
    library = beside.put(path.stem().string() + ".mtl", mesh::material_library(now));
    notes.push_back("the materials are in " + (path.parent_path() / library).string());
  }
  const Content what{content.surface, content.positions, content.comments,
                     content.attributes ? &now : nullptr};
  write_as(path, digits, progress, [&](TextWriter& out) {
    library.empty() ? format.write(what, out) : write_obj_with_library(what, library, out);
  });
  beside.keep();
  return notes;
}

std::vector<std::string> write_animated(const std::filesystem::path& path, const Content& content,
                                        const Original* original, const MorphAnimation& animation,
                                        base::Progress* progress) {
  return write_animated(path, content, original, morph_motion(animation, content.positions), progress);
}

std::vector<std::string> write_animated(const std::filesystem::path& path, const Content& content,
                                        const Original* original, const MorphMotion& motion,
                                        base::Progress* progress) {
  const Format& format = surface_format(path);
  if (!format.holds_morphs)
    throw base::Error(path.string(), "this format has no morph targets",
                      "write " + format_extensions(holds_morphs));
  check_motion(motion, content.surface.positions.size());
  check_written(path.string(), content.positions);
  std::vector<std::string> notes;
  if (writes_itself(original, path)) {
    FilesBeside beside(path);
    notes = copy_companions(original->companions(), beside);
    append(notes, original->write_animated(path, content.surface, content.positions, motion, progress));
    beside.keep();
    return notes;
  }
  const Attributes now = converted(format, content, original, notes);
  const Content what{content.surface, content.positions, content.comments, &now};
  write_as(path, {}, nullptr, [&](TextWriter& out) {
    write_gltf_animated(what, motion, format.write == write_glb, out, progress);
  });
  return notes;
}

void check_keeps_vertices(const std::filesystem::path& path) {
  const Format* format = find_format(path);
  if (!format || !format->write || format->keeps_order) return;
  throw base::Error(path.string(), std::string(format->name) + " does not keep the order of the vertices",
                    "save it as " + format_extensions(keeps_order));
}

}  // namespace viete::mesh
