#include "formats/write.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"
#include "formats/codecs.h"
#include "formats/format_table.h"
#include "formats/materials.h"

namespace viete::formats {

namespace {

namespace fs = std::filesystem;

template <class Fill>
void put_text(base::FilesTogether& files, const fs::path& path, Digits digits, base::Progress* progress,
              const Fill& fill) {
  files.put(path, [&](const base::ByteSink& sink) {
    TextWriter out(sink, progress, digits);
    fill(out);
    out.finish();
  });
}

// Returns true if the attributes have materials. If `but_textures`, ignores materials that are only an image.
bool has_materials(const Attributes& a, bool but_textures) {
  return !std::ranges::all_of(a.materials, [&](const Material& m) {
    const std::uint32_t i = m.base_color_image;
    if (!but_textures || i == mesh::none) return false;
    return m == Material{.name = fs::path(a.images[i].name).stem().string(),
                         .base_color = {1, 1, 1, 1},
                         .base_color_image = i};
  });
}

std::vector<std::string> names_of_left_out(const Format& format, const mesh::Surface& surface,
                                           const Attributes& a, const Attributes& deformed) {
  const auto are_named = [&](std::string Group::*name) {
    return std::ranges::any_of(a.groups, [&](const Group& g) { return !(g.*name).empty(); });
  };
  const bool normals = format.holds(held::normals);
  const bool normals_fit =
      format.holds(held::corner_normals) || (normals && one_a_vertex(surface, deformed.corner_normal));
  struct Kind {
    const char* name;
    bool in_file, fits;
  };
  const Kind kinds[] = {
      {"texture coordinates", !a.texture_points.empty(), format.holds(held::texture_points)},
      {normals ? "several normals of a vertex" : "normals", !a.normals.empty(), normals_fit},
      {"colours", !a.colors.empty(), format.holds(held::colors)},
      {"colours of faces", !a.polygon_colors.empty(),
       deformed.polygon_colors.empty() ||
           (format.holds(held::polygon_colors) && (a.colors.empty() || format.holds(held::both_colors)))},
      {"objects", are_named(&Group::object), format.holds(held::objects)},
      {"groups", are_named(&Group::name), format.holds(held::groups)},
      {"materials", has_materials(a, format.holds(held::textures)), format.holds(held::materials)}};
  std::vector<std::string> names;
  for (const Kind& kind : kinds)
    if (kind.in_file && !kind.fits) names.emplace_back(kind.name);
  for (const MaterialImage& property : material_images) {
    const bool is_held =
        format.holds(property.image == &Material::base_color_image ? held::textures : held::materials);
    const auto has_image = [&](const Material& m) { return m.*property.image != mesh::none; };
    if (!is_held && std::ranges::any_of(a.materials, has_image)) names.emplace_back(property.name);
  }
  return names;
}

void tell_triangles(const mesh::Surface& surface, std::vector<std::string>& notes) {
  const auto& starts = surface.polygon_starts;
  std::size_t larger = 0;
  for (std::size_t p = 0; p + 1 < starts.size(); ++p) larger += starts[p + 1] - starts[p] > 3;
  std::vector<char> is_loose(surface.positions.size(), 1);
  for (const std::uint32_t v : surface.corners) is_loose[v] = 0;
  const auto loose = static_cast<std::size_t>(std::ranges::count(is_loose, 1));
  if (larger > 0)
    notes.push_back(base::counted(larger, "face") + " of more than three corners became triangles");
  if (loose > 0)
    notes.push_back(base::counted(loose, "point") + " without a face " + (loose == 1 ? "was" : "were") +
                    " left out");
}

// Returns messages about content that this format cannot store, one line each: "2 faces of more than three
// corners became triangles". `deformed` is the result of deformed_attributes(). `original` may be null.
std::vector<std::string> left_out(const Format& format, const Content& content, const Attributes& deformed,
                                  const Original* original) {
  constexpr std::size_t most = 12;
  std::vector<std::string> names, notes;
  if (content.attributes) names = names_of_left_out(format, content.surface, *content.attributes, deformed);
  const bool capture = content.splats || (original && original->capture() != Capture::none);
  if (capture && !(content.splats && format.holds(held::splats))) names.emplace_back(splat_content);
  if (original) std::ranges::move(original->beyond_attributes(), std::back_inserter(names));
  if (!names.empty())
    notes.push_back("left out of the " + std::string(format.name) +
                    " file: " + TextWriter::one_line(base::joined(names, ", ", most)));
  if (!format.holds(held::polygons) && !content.surface.triangles.empty())
    tell_triangles(content.surface, notes);
  return notes;
}

// Returns the attributes after deformation. Converts between colours of faces and materials if the format
// holds only one of them. `notes` gets messages about this, and about content that the format cannot store.
Attributes converted(const Format& format, const Content& content, const Original* original,
                     std::vector<std::string>& notes) {
  Attributes now;
  if (content.attributes && content.sources.empty())
    now = deformed_attributes(content.surface, content.positions, *content.attributes);
  const std::size_t polygons = content.surface.polygon_count();
  const bool colors = format.holds(held::polygon_colors), materials = format.holds(held::materials);
  const bool to_materials = !colors && materials && make_materials_of_colors(polygons, now);
  if (to_materials) notes.emplace_back("the colours of faces became materials");
  if (colors && !materials && make_colors_of_materials(polygons, now))
    notes.emplace_back("the colours of materials became colours of faces");
  std::ranges::move(left_out(format, content, now, original), std::back_inserter(notes));
  return now;
}

// The name of a library without extension. All frames of an animation use one library: frame_0001 becomes
// frame.
std::string library_stem(const fs::path& model) {
  std::string stem = model.stem().string();
  const auto end = stem.find_last_not_of("0123456789");
  if (end != 0 && end != std::string::npos && stem.size() - end > 3 && (stem[end] == '_' || stem[end] == '-'))
    stem.resize(end);
  return stem;
}

// Puts external images and the material library of a new file into its folder, without replacing any file.
// Sets the name of the library.
void put_materials(const fs::path& path, const Format& format, Attributes& a, base::FilesTogether& files,
                   std::string& library, std::vector<std::string>& notes) {
  if (!format.holds(held::textures) || a.materials.empty()) return;
  std::ranges::move(format.embeds_images ? embed_images(a)
                                         : put_images_beside(path, format.holds(held::materials), a, files),
                    std::back_inserter(notes));
  if (!format.write_library) return;
  complete_materials(a);
  const std::string text = written_text([&](TextWriter& out) { format.write_library(a, out); });
  const std::string name = name_in_library(library_stem(path)) + "." + std::string(format.library_extension);
  library = files.put_new(path.parent_path() / name, text).filename().string();
}

[[noreturn]] void refuse_splats(const fs::path& file, const char* advice) {
  throw base::Error(file.string(),
                    "the model is a capture (Gaussian splats), whose sizes, rotations and colours would not "
                    "follow the deformation",
                    advice);
}

// Copies external files to the folder of the new file. Does not copy files outside the old folder, and does
// not overwrite files. Returns messages for the user.
std::vector<std::string> put_companions(const fs::path& model, const Companions& companions,
                                        base::FilesTogether& files) {
  if (fs::weakly_canonical(companions.folder) == base::folder_of(model)) return {};
  std::set<std::string> copied, others, stayed;
  for (const fs::path& file : companions.files) {
    const fs::path name = file.lexically_relative(companions.folder.lexically_normal()),
                   path = model.parent_path() / name;
    std::error_code code;
    if (!fs::is_regular_file(file, code)) continue;
    if (name.empty() || *name.begin() == "..") {
      stayed.insert(file.string());
      continue;
    }
    const base::FileBytes bytes(file);
    const bool is_new = !fs::exists(fs::symlink_status(path, code));
    (is_new || base::has_bytes(path, bytes.view()) ? copied : others).insert(name.string());
    if (!is_new) continue;
    if (fs::is_directory(base::folder_of(model), code))
      fs::create_directories(path.parent_path(), code);  // if this fails, put() throws
    files.put(path, [&](const base::ByteSink& sink) { sink(bytes.view()); });
  }
  std::vector<std::string> notes;
  const auto tell = [&](const char* what, const std::set<std::string>& names) {
    const std::vector<std::string> all(names.begin(), names.end());
    if (!all.empty()) notes.push_back(what + base::joined(all, ", ", 8));
  };
  tell("copied files to which the model refers: ", copied);
  tell("not copied, because different files with these names exist: ", others);
  tell("not copied, because they are not in the folder of the model: ", stayed);
  return notes;
}

// Writes a new file with put(content, out), and its materials. Returns messages for the user.
template <class Put>
std::vector<std::string> write_new(const fs::path& path, const Content& content, const Original* original,
                                   Digits digits, base::Progress* progress, const Put& put) {
  const Format& format = surface_format(path);
  std::vector<std::string> notes;
  Attributes now = converted(format, content, original, notes);
  Content what{content.surface, content.positions, content.comments, &now, content.splats};
  base::FilesTogether files;
  put_materials(path, format, now, files, what.library, notes);
  put_text(files, path, digits, progress, [&](TextWriter& out) { put(what, out); });
  files.replace();
  return notes;
}

}  // namespace

void write(const std::filesystem::path& path, const mesh::Surface& surface,
           const std::vector<std::string>& comments) {
  write(path, Content{surface, surface.positions, comments}, nullptr, {});
}

std::vector<std::string> write(const std::filesystem::path& path, const Content& content,
                               const Original* original, Digits digits, base::Progress* progress) {
  check_written(path.string(), content.positions);
  if (!content.is_at_rest()) {
    check_deformable(path, original);
    if (original && original->capture() != Capture::none && !content.splats)
      refuse_splats(path, "deform the capture with its splats, not only its points");
  }
  if (writes_itself(original, path)) return original->write_file(path, content, digits, progress);
  const Format& format = surface_format(path);
  const bool is_for_splats = format.stores_only_splats();
  if (is_for_splats ? !content.splats : !format.holds(held::points) && content.surface.triangles.empty())
    throw base::Error(path.string(),
                      std::string(format.name) +
                          (is_for_splats ? " stores only Gaussian splats, and the model has no splats"
                                         : " stores only triangles, and the model has no triangles"),
                      "save as " + format_extensions([](const Format& f) { return f.holds(held::points); }));
  return write_new(path, content, original, digits, progress, format.write);
}

std::vector<std::string> write_animated(const std::filesystem::path& path, const Content& content,
                                        const Original* original, const MorphMotion& motion,
                                        base::Progress* progress) {
  const Format& format = surface_format(path);
  if (!format.holds_morphs)
    throw base::Error(path.string(), "this format cannot store morph targets",
                      "save as " + format_extensions(holds_morphs));
  check_motion(motion, content.surface.positions.size());
  if (content.splats || (original && original->capture() != Capture::none))
    throw base::Error(path.string(), "morph targets cannot store the motion of a capture (Gaussian splats)",
                      "save numbered files instead: frame_####.ply");
  check_written(path.string(), content.positions);
  if (writes_itself(original, path)) return original->write_file(path, content, {}, progress, &motion);
  return write_new(path, content, original, {}, nullptr, [&](const Content& what, TextWriter& out) {
    write_gltf_animated(what, motion, format.write == write_glb, out, progress);
  });
}

void check_deformable(const fs::path& file, const Original* original) {
  if (original && original->capture() == Capture::points)
    refuse_splats(file, "convert the capture to .ply or .spz with complete splats in another program");
}

void check_keeps_vertices(const std::filesystem::path& path) {
  const Format* format = find_format(path);
  if (!format || !format->write || format->keeps_order) return;
  throw base::Error(path.string(), std::string(format->name) + " does not keep the order of the vertices",
                    "save as " + format_extensions(keeps_order));
}

std::vector<std::string> Original::write(const Content&, TextWriter&) const {
  throw base::Error(name_, std::string(format_) + " files cannot be written this way",
                    "save as .glb or .obj");
}

std::vector<std::string> Original::write_file(const std::filesystem::path& path, const Content& content,
                                              Digits digits, base::Progress* progress,
                                              const MorphMotion* motion) const {
  if (motion)
    throw base::Error(path.string(), "this format cannot store morph targets",
                      "save as " + format_extensions(holds_morphs));
  base::FilesTogether files;
  std::vector<std::string> notes = put_companions(path, companions_, files);
  put_text(files, path, digits, progress,
           [&](TextWriter& out) { std::ranges::move(write(content, out), std::back_inserter(notes)); });
  files.replace();
  return notes;
}

void check_motion(const MorphMotion& motion, std::size_t vertices) {
  const auto& seconds = motion.seconds;
  if (seconds.empty()) throw base::Error("", "the animation has no keys", "add at least one key");
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const bool ascends = i == 0 || static_cast<float>(seconds[i]) > static_cast<float>(seconds[i - 1]);
    if (!std::isfinite(seconds[i]) || !ascends)
      throw base::Error("key " + std::to_string(i), "the time is not after the time of the previous key",
                        "move the key to a later time");
  }
  if (motion.moves.size() != vertices || motion.weights.size() != seconds.size() * motion.targets.size())
    throw base::Error("", "the animation does not match the number of vertices or targets of this model",
                      "create the animation for this model");
}

}  // namespace viete::formats
