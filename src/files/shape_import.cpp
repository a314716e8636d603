#include "files/shape_import.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "foreign/read.h"
#include "formats/format_table.h"
#include "formats/point_cache.h"
#include "mesh/normals.h"
#include "mesh/point_tree.h"
#include "mesh/triangle.h"
#include "mesh/vertex_order.h"

namespace viete::files {

namespace fs = std::filesystem;

namespace {

// Compares numbers in names by their value: "pose_2" is before "pose_10".
bool before_by_numbers(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
      continue;
    }
    const auto run = [&](const std::string& text, std::size_t& at) {
      while (at + 1 < text.size() && text[at] == '0' && digit(text[at + 1])) ++at;
      const std::size_t begin = at;
      while (at < text.size() && digit(text[at])) ++at;
      return text.substr(begin, at - begin);
    };
    const std::string x = run(a, i), y = run(b, j);
    if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
  }
  return a.size() - i < b.size() - j;
}

std::vector<fs::path> models_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
    std::error_code ignored;
    if (formats::is_a(formats::holds_surface, at->path()) && at->is_regular_file(ignored))
      files.push_back(at->path());
  }
  if (code)
    throw base::Error(folder.string(), "the folder cannot be read: " + code.message(), "check the folder");
  sort_by_numbers(files);
  return files;
}

}  // namespace

void sort_by_numbers(std::vector<fs::path>& files) {
  std::ranges::sort(files, before_by_numbers, [](const fs::path& p) { return p.filename().string(); });
}

void read_folder(const fs::path& folder, const char* wanted, const char* advice,
                 const std::function<bool(const fs::path&)>& read, std::vector<std::string>& warnings,
                 base::Progress* progress) {
  const std::vector<fs::path> files = models_in(folder);
  std::vector<std::string> refused;
  std::size_t taken = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (progress) progress->report(static_cast<double>(i) / static_cast<double>(files.size()));
    try {
      if (read(files[i])) ++taken;
    } catch (const base::Error& error) {
      refused.push_back("skipped " + std::string(error.what()));
    }
  }
  if (taken == 0)
    throw base::Error(folder.string(),
                      files.empty() ? "there is no model in this folder"
                                    : "no model in this folder is " + std::string(wanted),
                      advice);
  warnings.insert(warnings.end(), refused.begin(), refused.end());
}

std::vector<base::NumberedFile> files_of(const base::NumberedName& name) {
  auto files = name.find();
  if (files.empty())
    throw base::Error(name.pattern(), "no file matches this name with digits in place of #",
                      "check the name and use one # for each digit");
  return files;
}

void check_places(const std::string& place, std::span<const mesh::Point> positions) {
  constexpr double largest = 1e32;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (mesh::largest_abs(positions[v]) <= largest) continue;
    throw base::Error(place, "vertex " + std::to_string(v) + " is too far away to be drawn",
                      "export it again at a smaller scale");
  }
}

void check_points(const std::string& place, std::size_t found, const PosedSurface& of) {
  const std::size_t wanted = of.surface.positions.size();
  if (found == wanted) return;
  throw base::Error(place,
                    "the file has " + base::counted(found, "point") + ", and " + of.what + " has " +
                        base::with_thousands(wanted) + " vertices",
                    std::string("choose a file made from ") + of.what);
}

namespace {

// For each vertex of the surface, returns its index in the file. If faces differ, compares positions.
std::vector<std::uint32_t> order_by_place(const std::string& file, const mesh::Surface& found,
                                          const PosedSurface& of) {
  const std::vector<std::uint32_t> all = mesh::first_numbers(found.positions.size());
  if (mesh::same_faces(found, of.surface)) return all;
  const mesh::PointTree tree(found.positions, all);
  std::vector<bool> taken(all.size());
  const double near = 1e-6 * mesh::used_bounds(of.surface).diagonal();
  std::vector<std::uint32_t> order;
  for (const mesh::Point& p : of.surface.positions) {
    const std::uint32_t v = tree.nearest(p);
    if (taken[v] || mesh::norm(found.positions[v] - p) > near)
      throw base::Error(file,
                        std::string("the rest shape differs from ") + of.what +
                            ": the file has no vertex at the position of vertex " +
                            std::to_string(order.size()),
                        std::string("export ") + of.what + " at rest with the same axes and unit");
    taken[v] = true;
    order.push_back(v);
  }
  return order;
}

}  // namespace

MorphPositions morphs_of(const std::filesystem::path& file, const PosedSurface& of,
                         std::vector<std::string>& warnings) {
  constexpr bool played = true;
  const formats::ReadResult read = foreign::read(file, nullptr, played);
  warnings.insert(warnings.end(), read.warnings.begin(), read.warnings.end());
  MorphPositions found{read.original ? read.original->morphs() : nullptr, {}};
  if (!found.clip) return found;
  check_points(file.string(), read.surface.positions.size(), of);
  found.order = order_by_place(file.string(), read.surface, of);
  warnings.insert(warnings.end(), found.clip->notes().begin(), found.clip->notes().end());
  return found;
}

void check_shape_rest(const std::string& place, const mesh::Surface& model) {
  const auto& p = model.positions;
  const auto has_area = [&](const mesh::Triangle& t) { return mesh::has_area(p[t[0]], p[t[1]], p[t[2]]); };
  if (std::ranges::any_of(model.triangles, has_area)) return;
  throw base::Error(place,
                    model.triangles.empty() ? "shapes need a model with faces, and this model has only points"
                                            : "all faces of this model have zero area",
                    "choose another model as the rest shape");
}

void check_shape_count(const std::string& file, std::size_t count, const mesh::Surface& model) {
  if (count > document::Timeline::most_keys)
    throw base::Error(file,
                      "there are " + base::counted(count, "shape") + ", and a timeline can have " +
                          base::with_thousands(document::Timeline::most_keys),
                      "choose fewer shapes");
  // Memory for positions and log vectors.
  base::require_memory({120.0 * static_cast<double>(count) * static_cast<double>(model.positions.size()) +
                            72.0 * static_cast<double>(count) * static_cast<double>(model.triangles.size()),
                        base::counted(count, "shape") + " of the model take", "choose fewer shapes", file});
}

namespace {

class ShapeReader {
public:
  ShapeReader(const mesh::Surface& model, base::Progress* progress) : model_(model), progress_(progress) {}

  void add(const fs::path& file) {
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) return add_folder(file);
    if (base::NumberedName::is_pattern(file)) return add_sequence(base::NumberedName(file));
    all_.files.push_back(file);
    if (formats::point_cache_format(file)) return add_cache(file);
    const bool may_have_morphs = formats::is_a(formats::holds_morphs, file) || foreign::kind_of(file);
    if (may_have_morphs && add_morphs(file)) return;
    add_model(file);
  }

  ImportedShapes take() { return std::move(all_); }

private:
  void put(const std::string& place, std::string name, std::vector<mesh::Point> positions) {
    check_places(place, positions);
    all_.shapes.push_back(
        {std::move(name), std::make_shared<const std::vector<mesh::Point>>(std::move(positions))});
  }

  void add_sequence(const base::NumberedName& name) {
    const auto files = files_of(name);
    check_shape_count(name.pattern(), files.size(), model_);
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (progress_) progress_->report(static_cast<double>(i) / static_cast<double>(files.size()));
      add(files[i].path);
    }
  }

  void add_folder(const fs::path& folder) {
    const auto take = [&](const fs::path& file) {
      const std::size_t before = all_.shapes.size();
      add(file);
      // Drops a shape that equals the model at rest: a folder often contains the model itself.
      if (!all_.shapes.empty() && *all_.shapes.back().shape == model_.positions) all_.shapes.pop_back();
      return all_.shapes.size() > before;
    };
    read_folder(folder, "a shape of this model",
                "choose a folder with shapes of the model (same vertices and faces)", take, all_.warnings,
                progress_);
  }

  void add_cache(const fs::path& file) {
    const formats::PointCache cache(file);
    check_points(file.string(), cache.head().points, {model_, "the model"});
    check_shape_count(file.string(), cache.head().frames, model_);
    for (std::size_t i = 0; i < cache.head().frames; ++i) {
      const std::string name = "frame " + std::to_string(i + 1);
      put(file.string() + ": " + name, cache.head().frames == 1 ? file.stem().string() : name,
          cache.frame(i));
    }
    const auto& warnings = cache.warnings();
    all_.warnings.insert(all_.warnings.end(), warnings.begin(), warnings.end());
  }

  // If the file has no morph targets, returns false.
  bool add_morphs(const fs::path& file) {
    std::vector<std::string> warnings;
    const MorphPositions morphs = morphs_of(file, {model_, "the model"}, warnings);
    if (!morphs.clip) return false;
    all_.warnings.insert(all_.warnings.end(), warnings.begin(), warnings.end());
    const auto& targets = morphs.clip->targets();
    check_shape_count(file.string(), targets.size(), model_);
    for (std::size_t i = 0; i < targets.size(); ++i)
      put(file.string() + ": " + targets[i], targets[i], morphs.at_target(i));
    return true;
  }

  void add_model(const fs::path& file) {
    const formats::ReadResult read = foreign::read(file);
    all_.warnings.insert(all_.warnings.end(), read.warnings.begin(), read.warnings.end());
    put(file.string(), file.stem().string(), in_order(file.string(), read));
  }

  std::vector<mesh::Point> in_order(const std::string& file, const formats::ReadResult& read) {
    const bool keeps_order = formats::describes(formats::keeps_order, read.format);
    const auto order = mesh::vertex_order(read.surface, model_, keeps_order);
    if (!order)
      throw base::Error(file, mesh::first_difference(read.surface, model_, "the model"),
                        "choose a shape of the same model, exported with its vertex order or its face order");
    std::vector<mesh::Point> positions = mesh::picked<mesh::Point>(read.surface.positions, *order);
    if (!std::ranges::is_sorted(*order))
      all_.warnings.push_back(file + ": the vertex order differs; vertices were matched by the faces");
    return positions;
  }

  const mesh::Surface& model_;
  base::Progress* progress_;
  ImportedShapes all_;
};

}  // namespace

ImportedShapes read_shapes(std::span<const fs::path> files, const mesh::Surface& model,
                           base::Progress* progress) {
  ShapeReader reader(model, progress);
  for (const fs::path& file : files) reader.add(file);
  return reader.take();
}

}  // namespace viete::files
