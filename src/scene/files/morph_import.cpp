#include "scene/files/morph_import.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/text.h"
#include "mesh/formats/format_table.h"
#include "mesh/formats/read.h"
#include "mesh/point_tree.h"

namespace viete::scene {

namespace fs = std::filesystem;

namespace {

// "pose_2" before "pose_10".
bool before_by_numbers(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
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
    if (mesh::is_a(mesh::holds_surface, at->path()) && at->is_regular_file(ignored))
      files.push_back(at->path());
  }
  if (code) throw base::Error(folder.string(), "cannot be read: " + code.message(), "check the folder");
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
      refused.push_back(std::string(error.what()) + "; skipped");
    }
  }
  if (taken == 0)
    throw base::Error(folder.string(),
                      files.empty() ? "there is no model in this folder"
                                    : "none of its " + base::counted(files.size(), "model") + " is " + wanted,
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

// The range of positions that GPUs and deformers support, as for any opened surface.
void check_places(const std::string& place, std::span<const mesh::Point> positions) {
  constexpr double largest = 1e32;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (mesh::largest_abs(positions[v]) <= largest) continue;
    throw base::Error(place, "vertex " + std::to_string(v) + " is too far away to be drawn",
                      "export it again in another unit");
  }
}

void check_points(const std::string& place, std::size_t found, const PosedSurface& of) {
  const std::size_t wanted = of.surface.positions.size();
  if (found == wanted) return;
  throw base::Error(place,
                    "it moves " + base::counted(found, "point") + ", and " + of.what + " has " +
                        base::with_thousands(wanted) + " vertices",
                    std::string("choose a file made from ") + of.what);
}

std::vector<mesh::Point> MorphPositions::of_surface(const std::vector<mesh::Point>& of_file) const {
  std::vector<mesh::Point> positions;
  for (const auto v : order) positions.push_back(of_file[v]);
  return positions;
}

namespace {

// Each vertex has one partner.
std::vector<std::uint32_t> order_by_place(const std::string& file, const mesh::Surface& found,
                                          const PosedSurface& of) {
  std::vector<std::uint32_t> all(found.positions.size());
  std::iota(all.begin(), all.end(), 0U);
  if (mesh::same_faces(found, of.surface)) return all;
  const mesh::PointTree tree(found.positions, all);
  std::vector<bool> taken(all.size());
  const double near = 1e-6 * mesh::used_bounds(of.surface).diagonal();
  std::vector<std::uint32_t> order;
  for (const mesh::Point& p : of.surface.positions) {
    const std::uint32_t v = tree.nearest(p);
    if (taken[v] || mesh::norm(found.positions[v] - p) > near)
      throw base::Error(
          file,
          std::string("its rest shape is not ") + of.what + ": it has no vertex at the position of vertex " +
              std::to_string(order.size()),
          std::string("export ") + of.what + " itself, as it is at rest, in the same axes and unit");
    taken[v] = true;
    order.push_back(v);
  }
  return order;
}

}  // namespace

MorphPositions morphs_of(const std::filesystem::path& file, const PosedSurface& of,
                         std::vector<std::string>& warnings) {
  constexpr bool played = true;
  const mesh::ReadResult read = mesh::read(file, nullptr, played);
  warnings.insert(warnings.end(), read.warnings.begin(), read.warnings.end());
  MorphPositions found{read.original ? read.original->morphs() : nullptr, {}};
  if (!found.clip) return found;
  check_points(file.string(), read.surface.positions.size(), of);
  found.order = order_by_place(file.string(), read.surface, of);
  warnings.insert(warnings.end(), found.clip->notes().begin(), found.clip->notes().end());
  return found;
}

}  // namespace viete::scene
