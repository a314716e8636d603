#include "pose/pose_file.h"

#include <algorithm>
#include <charconv>
#include <locale>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "foreign/read.h"
#include "formats/format_table.h"
#include "formats/source.h"
#include "formats/write.h"
#include "mesh/half_edges.h"
#include "mesh/triangle.h"
#include "mesh/vertex_order.h"

namespace viete::pose {

namespace {

constexpr std::string_view turns_mark = "viete turns:";

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r#");
  return begin == std::string_view::npos ? "" : text.substr(begin);
}

// Parses a line `viete turns: part 0: x y z`. Returns false if the text, the part or the turn is invalid.
bool read_turn(std::string_view line, std::vector<Vec3>& turns) {
  std::istringstream in{std::string(trimmed(line).substr(turns_mark.size()))};
  in.imbue(std::locale::classic());
  std::string word;
  std::size_t part = 0;
  char colon = 0;
  Vec3 v{};
  in >> word >> part >> colon >> v[0] >> v[1] >> v[2];
  if (!in || word != "part" || colon != ':' || part >= turns.size() || !(norm(v) <= largest_turn))
    return false;
  turns[part] = v;
  return true;
}

std::vector<Vec3> read_turns(const std::vector<std::string>& comments, const Cage& cage,
                             const std::string& file, std::vector<std::string>& warnings) {
  std::vector<Vec3> turns(cage.roots.size(), Vec3{0, 0, 0});
  bool any = false;
  for (const auto& comment : comments) {
    if (!trimmed(comment).starts_with(turns_mark)) continue;
    if (read_turn(comment, turns)) {
      any = true;
    } else {
      warnings.push_back(file + ": the rotations in this line do not fit the cage and are ignored: " +
                         comment.substr(0, 80));
    }
  }
  return any ? turns : std::vector<Vec3>{};
}

void warn_of_collapsed(const mesh::Surface& posed, const Cage& cage, const std::string& file,
                       std::vector<std::string>& warnings) {
  std::vector<std::uint32_t> faces;
  const auto p = with_centers(cage, posed.positions);
  for (std::size_t e = 0; e < cage.element_count(); ++e) {
    const auto& [a, b, c] = cage.elements.triangles[e];
    const bool collapses = !cage.degenerate[e] && !mesh::has_area(p[a], p[b], p[c]);
    if (collapses && (faces.empty() || faces.back() != cage.polygon_of(e)))
      faces.push_back(cage.polygon_of(e));
  }
  if (faces.empty()) return;
  warnings.push_back(file + ": " + std::to_string(faces.size()) + " of " +
                     std::to_string(cage.surface.polygon_count()) +
                     " cage faces have no area in this pose (first: face " + std::to_string(faces[0]) +
                     "); a minimum stretch is used for them");
}

// Returns the vertices of the file in the order of the cage. Vertices that are matched by the faces, and
// faces that divide the cage's polygons otherwise, cause a warning.
std::vector<std::uint32_t> order_of(const formats::ReadResult& read, const Cage& cage,
                                    const std::string& file, std::vector<std::string>& warnings) {
  const bool keeps_order = formats::describes(formats::keeps_order, read.format);
  if (auto order = mesh::vertex_order(read.surface, cage.surface, keeps_order)) {
    if (!std::ranges::is_sorted(*order))
      warnings.push_back(file + ": the vertex order differs; vertices were matched by the faces");
    return *std::move(order);
  }
  const auto found = mesh::polygon_edges(read.surface), wanted = mesh::polygon_edges(cage.surface);
  if (!keeps_order || !(std::ranges::includes(found, wanted) || std::ranges::includes(wanted, found)))
    throw base::Error(file, mesh::first_difference(read.surface, cage.surface, "the cage"),
                      "export the pose with the vertex order or the face order of the cage, as " +
                          formats::format_names(formats::keeps_order));
  warnings.push_back(file +
                     ": the faces of this pose differ from the faces of the cage; only the vertex "
                     "positions are used");
  return mesh::first_numbers(read.surface.positions.size());
}

std::string turn_line(std::size_t part, const Vec3& v) {
  std::string line = std::string(turns_mark) + " part " + std::to_string(part) + ":";
  for (const double x : v) {
    char text[40];
    line += ' ';
    line.append(text, std::to_chars(text, text + sizeof text, x, std::chars_format::general, 17).ptr);
  }
  return line;
}

}  // namespace

Pose read_pose(const std::filesystem::path& path, const Cage& cage, std::vector<std::string>& warnings) {
  formats::ReadResult read = foreign::read(path);
  const std::string file = path.string();
  check_pose(cage, read.surface.positions.size(), file);
  warnings.insert(warnings.end(), read.warnings.begin(), read.warnings.end());
  read.surface.positions =
      mesh::picked<mesh::Point>(read.surface.positions, order_of(read, cage, file, warnings));
  warn_of_collapsed(read.surface, cage, file, warnings);
  std::vector<Vec3> turns = read_turns(read.comments, cage, file, warnings);
  return {std::move(read.surface.positions), std::move(turns)};
}

void write_pose(const std::filesystem::path& path, const Cage& cage, const Pose& pose) {
  check_pose(cage, pose.positions.size(), path.string());
  formats::check_keeps_vertices(path);
  std::vector<std::string> comments;
  for (std::size_t part = 0; part < pose.turns.size(); ++part) {
    if (largest_abs(pose.turns[part]) > 0) comments.push_back(turn_line(part, pose.turns[part]));
  }
  mesh::Surface surface = cage.surface;
  surface.positions = pose.positions;
  formats::write(path, surface, comments);
}

}  // namespace viete::pose
