#include "mesh/formats/write.h"

#include <algorithm>
#include <iterator>

#include "base/atomic_file.h"
#include "base/error.h"
#include "mesh/formats/conversion.h"
#include "mesh/formats/gltf_output.h"
#include "mesh/formats/image_files.h"
#include "mesh/formats/obj.h"
#include "mesh/formats/off.h"
#include "mesh/formats/ply.h"
#include "mesh/formats/source.h"
#include "mesh/formats/stl.h"
#include "mesh/formats/written_positions.h"

namespace viete::mesh {

namespace {

using Format = void (*)(const Content&, TextWriter&);

Format format_for(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == "obj") return write_obj;
  if (extension == "ply") return write_ply;
  if (extension == "off") return write_off;
  if (extension == "stl") return write_stl;
  if (extension == "glb") return write_glb;
  if (extension == "gltf") return write_gltf;
  const std::string found = extension.empty() ? "no extension" : "unknown extension ." + extension;
  throw base::Error(path.string(), found, "use .obj, .ply, .off, .stl, .glb or .gltf");
}

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
                               const Original* original, Digits digits, base::Progress* progress,
                               std::vector<std::filesystem::path>* leads_to) {
  check_written(path.string(), content.positions);
  FilesBeside beside(path);
  const auto keep = [&] {
    beside.keep();
    if (leads_to) *leads_to = beside.all();
  };
  if (original && original->writes(extension_of(path))) {
    std::vector<std::string> notes = copy_companions(original->companions(), beside);
    append(notes, original->write_file(path, content.surface, content.positions, digits, progress, &beside));
    keep();
    return notes;
  }
  const Format format = format_for(path);
  if (format == write_stl && content.surface.triangles.empty())
    throw base::Error(path.string(), "STL holds triangles alone, and there are none",
                      "write .obj, .ply, .off or .glb");
  std::vector<std::string> notes;
  if (original) notes = left_out(extension_of(path), *original);
  append(notes, triangles_notes(extension_of(path), content.surface));
  if (!content.attributes) {
    write_as(path, digits, progress, [&](TextWriter& out) { format(content, out); });
    return notes;
  }
  Attributes now = deformed_attributes(content.surface, content.positions, *content.attributes);
  if (format == write_obj) {
    colors_to_materials(now);
    fill_in_materials(now);
    name_materials(now);
  }
  append(notes, left_out(extension_of(path), content.surface, *content.attributes, now));
  if (format == write_glb || format == write_gltf) append(notes, take_images_within(now));
  std::string library;
  if (format == write_obj || format == write_ply) append(notes, put_images_beside(beside, now));
  if (format == write_obj && !now.materials.empty()) {
    library = beside.put(path.stem().string() + ".mtl", mesh::material_library(now));
    notes.push_back("the materials are in " + (path.parent_path() / library).string());
  }
  const Content converted{content.surface, content.positions, content.comments, &now};
  write_as(path, digits, progress, [&](TextWriter& out) {
    library.empty() ? format(converted, out) : write_obj_with_library(converted, library, out);
  });
  keep();
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
  const Format format = format_for(path);
  if (format != write_glb && format != write_gltf)
    throw base::Error(path.string(), "this format has no morph targets", "write .glb or .gltf");
  check_motion(motion, content.surface.positions.size());
  check_written(path.string(), content.positions);
  const std::string extension = extension_of(path);
  if (original && original->writes(extension)) {
    FilesBeside beside(path);
    std::vector<std::string> notes = copy_companions(original->companions(), beside);
    append(notes, original->write_animated(path, content.surface, content.positions, motion, progress));
    beside.keep();
    return notes;
  }
  std::vector<std::string> notes;
  if (original) notes = left_out(extension, *original);
  append(notes, triangles_notes(extension, content.surface));
  Attributes now;
  if (content.attributes) {
    now = deformed_attributes(content.surface, content.positions, *content.attributes);
    append(notes, left_out(extension, content.surface, *content.attributes, now));
    append(notes, take_images_within(now));
  }
  const Content converted{content.surface, content.positions, content.comments, &now};
  write_as(path, {}, nullptr, [&](TextWriter& out) {
    write_gltf_animated(converted, motion, format == write_glb, out, progress);
  });
  return notes;
}

void check_format(const std::filesystem::path& path) {
  format_for(path);
}

void check_keeps_vertices(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  const bool stl = extension == "stl";
  if (!stl && extension != "glb" && extension != "gltf") return;
  throw base::Error(path.string(),
                    std::string(stl ? "STL" : "glTF") + " does not keep the order of the vertices",
                    "save it as .obj, .ply or .off");
}

}  // namespace viete::mesh
