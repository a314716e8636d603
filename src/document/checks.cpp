#include "document/checks.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <ranges>
#include <utility>

#include "base/text.h"
#include "mesh/defects.h"
#include "mesh/repair.h"
#include "mesh/triangle_tree.h"
#include "mesh/triangulation.h"

namespace viete::document {

namespace {

using Elements = std::vector<std::uint32_t>;

void add(std::vector<Finding>& all, Defect defect, Subject subject, ElementKind kind, Elements elements) {
  if (!elements.empty()) all.push_back({defect, subject, kind, std::move(elements), {}});
}

void add_edges(std::vector<Finding>& all, Defect defect, Subject subject,
               const std::vector<mesh::Edge>& edges) {
  if (!edges.empty()) all.push_back({defect, subject, ElementKind::edge, {}, edges});
}

Elements faces_of(const mesh::Surface& surface, Elements triangles) {
  for (auto& t : triangles) t = surface.triangle_polygon[t];
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

void check_edges(std::vector<Finding>& found, const mesh::Surface& surface, const mesh::Summary& summary,
                 Subject subject) {
  add_edges(found, Defect::open, subject, summary.boundary_edges);
  add_edges(found, Defect::nonmanifold_edge, subject, summary.nonmanifold_edges);
  add(found, Defect::pinched_vertex, subject, ElementKind::vertex, mesh::nonmanifold_vertices(surface));
  add_edges(found, Defect::misoriented, subject, summary.misoriented_edges);
  if (summary.inside_out()) {
    Elements all(surface.polygon_count());
    std::iota(all.begin(), all.end(), 0u);
    add(found, Defect::inside_out, subject, ElementKind::face, std::move(all));
  }
  add(found, Defect::degenerate, subject, ElementKind::face, summary.degenerate_polygons);
}

// Joins vertices at equal positions. Removes the sides of repeated faces, which the deformation ignores, by
// joining their corners.
mesh::Surface acting_faces(const mesh::Surface& cage, const std::vector<std::uint8_t>& repeated) {
  mesh::Surface joined = mesh::welded(cage);
  for (std::size_t p = 0; p < repeated.size(); ++p)
    for (auto c = joined.polygon_starts[p]; repeated[p] && c < joined.polygon_starts[p + 1]; ++c)
      joined.corners[c] = joined.corners[joined.polygon_starts[p]];
  for (std::size_t t = 0; t < joined.triangles.size(); ++t)
    if (repeated[joined.triangle_polygon[t]]) joined.triangles[t].fill(joined.triangles[t][0]);
  return joined;
}

struct Words {
  const char *one, *several;       // the title for one element and for several elements, without the number
  const char *of_cage, *of_model;  // the explanation for a cage and for a model
};

const Words& words_of(Defect defect) {
  static constexpr Words all[] = {
      {"vertex outside the cage", "vertices outside the cage", "",
       "With mean value weights, these vertices can move against the drag. All other weights work."},
      {"self-intersecting face", "self-intersecting faces",
       "Faces of the cage intersect. The model near the intersection follows all of these faces.", ""},
      {"open edge", "open edges",
       "The cage has a hole. Log space deformers still work; with mean value weights, the model follows "
       "rotation and stretch less exactly.",
       "The model has holes. The deformation is not affected."},
      {"edge with more than two faces", "edges with more than two faces",
       "More than two faces share this edge. If these faces rotate far apart, the deformation nearby is "
       "unpredictable.",
       "The deformation is not affected. Shading can be uneven there."},
      {"vertex shared by separate parts", "vertices shared by separate parts",
       "Parts of the cage share only this vertex. Dragging the vertex moves all of these parts.",
       "The deformation is not affected. Shading can be uneven there."},
      {"edge between faces of opposite orientation", "edges between faces of opposite orientation",
       "Orient all faces outward: mean value weights are wrong here. Log space deformers are not affected.",
       "Neighbouring faces point to opposite sides. Shading is wrong; the deformation is not affected."},
      {"face pointing inward", "faces, all pointing inward",
       "All faces point inward. Viete works normally, but other programs may not.",
       "All faces point inward. The deformation is not affected; other programs may show it wrongly."},
      {"face without area", "faces without area",
       "The face has no area and therefore no influence. The model follows the neighbouring faces instead.",
       "The face is invisible. The deformation is not affected."},
      {"very thin face", "very thin faces",
       "The face is very thin: small moves of its vertices rotate or stretch the model strongly.", ""},
      {"duplicate vertex", "duplicate vertices",
       "Two vertices are at the same place. Merge them; otherwise the cage tears when you drag only one.",
       "Vertices coincide, for example along seams. They stay together, but shading shows an edge."},
      {"vertex without a face", "vertices without a face",
       "The vertex belongs to no face. Dragging it has no effect.",
       "The vertex belongs to no face. It is deformed and exported but invisible."},
      {"repeated face", "repeated faces",
       "The face has the corners of an earlier face. The deformation ignores it.", ""}};
  return all[static_cast<std::size_t>(defect)];
}

}  // namespace

std::string title(const Finding& finding) {
  const Words& words = words_of(finding.defect);
  return base::with_thousands(finding.size()) + ' ' + (finding.size() == 1 ? words.one : words.several);
}

std::string first_elements(const Finding& finding, std::size_t most) {
  std::string text;
  const std::size_t shown = std::min(most, finding.size());
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += ", ";
    if (finding.kind == ElementKind::edge) {
      text += std::to_string(finding.edges[i][0]) + '-' + std::to_string(finding.edges[i][1]);
    } else {
      text += std::to_string(finding.elements[i]);
    }
  }
  if (shown == finding.size()) return text;
  return text + " and " + base::with_thousands(finding.size() - shown) + " more";
}

std::vector<std::uint32_t> vertices_of(const Finding& finding, const mesh::Surface& surface,
                                       std::size_t element) {
  if (finding.kind == ElementKind::edge) return {finding.edges[element][0], finding.edges[element][1]};
  const auto index = finding.elements[element];
  if (finding.kind == ElementKind::vertex) return {index};
  return {surface.polygon(index).begin(), surface.polygon(index).end()};
}

std::vector<Finding> check_model(const mesh::Surface& model, const mesh::Summary& summary) {
  std::vector<Finding> found;
  if (model.triangles.empty()) return found;  // points, which are drawn without faces
  check_edges(found, model, summary, Subject::model);
  add(found, Defect::doubled_vertex, Subject::model, ElementKind::vertex, mesh::duplicate_vertices(model));
  add(found, Defect::unused_vertex, Subject::model, ElementKind::vertex, summary.unused_vertices);
  return found;
}

std::vector<Finding> check_cage(const mesh::Surface& cage, base::Progress* progress) {
  constexpr double thin = 1e-3;
  std::vector<Finding> found;
  const auto repeated = mesh::repeated_polygons(cage);
  const mesh::Surface split = mesh::split_at_centers(cage, repeated).surface;
  add(found, Defect::self_intersection, Subject::cage, ElementKind::face,
      faces_of(split, mesh::self_intersecting_triangles(split, progress)));
  const mesh::Surface joined = acting_faces(cage, repeated);
  mesh::Summary summary = mesh::summarize(joined);
  std::erase_if(summary.degenerate_polygons, [&](auto p) { return repeated[p]; });
  check_edges(found, joined, summary, Subject::cage);
  add(found, Defect::thin, Subject::cage, ElementKind::face,
      faces_of(split, mesh::thin_triangles(split, thin)));
  Elements repeats;
  for (std::uint32_t p = 0; p < repeated.size(); ++p)
    if (repeated[p]) repeats.push_back(p);
  add(found, Defect::repeated_face, Subject::cage, ElementKind::face, std::move(repeats));
  const auto doubled = mesh::duplicate_vertices(cage);
  add(found, Defect::doubled_vertex, Subject::cage, ElementKind::vertex, doubled);
  // Welding leaves duplicate vertices without faces. Such vertices do not count as unused.
  Elements unused;
  std::set_difference(summary.unused_vertices.begin(), summary.unused_vertices.end(), doubled.begin(),
                      doubled.end(), std::back_inserter(unused));
  add(found, Defect::unused_vertex, Subject::cage, ElementKind::vertex, std::move(unused));
  return found;
}

std::optional<Finding> check_enclosure(const mesh::Surface& cage, const mesh::Surface& model,
                                       base::Progress* progress) {
  const auto repeated = mesh::repeated_polygons(cage);
  const mesh::Surface split = mesh::split_at_centers(cage, repeated).surface;
  const mesh::Surface around = mesh::consistently_oriented(mesh::welded(split));
  Elements outside = mesh::points_outside(around, model.positions, nullptr, progress);
  if (outside.empty()) return std::nullopt;
  return Finding{Defect::vertices_outside, Subject::model, ElementKind::vertex, std::move(outside), {}};
}

std::vector<Finding> check(const OpenedSurface& model, const OpenedSurface& cage, base::Progress* progress) {
  std::vector<Finding> found;
  if (cage.surface) {
    if (progress) progress->section(0, 0.1);
    found = check_cage(*cage.surface, progress);
    if (progress) progress->section(0.1, 0.9);
    if (auto outside = check_enclosure(*cage.surface, *model.surface, progress))
      found.push_back(*std::move(outside));
  }
  if (progress) progress->section(0.9, 1);
  std::ranges::move(check_model(*model.surface, model.summary), std::back_inserter(found));
  std::stable_partition(found.begin(), found.end(), matters);
  return found;
}

std::string meaning(const Finding& finding) {
  const Words& words = words_of(finding.defect);
  return finding.subject == Subject::cage ? words.of_cage : words.of_model;
}

bool matters(const Finding& finding) {
  if (finding.subject == Subject::model) return finding.defect == Defect::vertices_outside;
  return finding.defect != Defect::inside_out && finding.defect != Defect::unused_vertex &&
         finding.defect != Defect::repeated_face;
}

namespace {

// Returns the signed volume of each part, divided by the cube of the cage's diagonal. If the faces of a part
// point outward, its volume is positive.
std::vector<double> volumes(const pose::Cage& cage, std::span<const mesh::Point> of_vertices) {
  const std::vector<mesh::Point> positions = pose::with_centers(cage, of_vertices);
  const auto& triangles = cage.elements.triangles;
  std::vector<double> all(cage.roots.size(), 0);
  for (std::size_t e = 0; e < cage.element_count(); ++e) {
    if (cage.parts[e] >= all.size()) continue;
    const auto& center = positions[triangles[cage.roots[cage.parts[e]]][0]];
    mesh::Vec3 corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = (1 / cage.diagonal) * (positions[triangles[e][i]] - center);
    all[cage.parts[e]] += mesh::dot(corners[0], mesh::cross(corners[1], corners[2])) / 6;
  }
  return all;
}

std::size_t parts_inside_out(const pose::Cage& cage, const pose::Pose& pose) {
  if (!cage.closed) return 0;
  const auto rest = volumes(cage, cage.surface.positions), posed = volumes(cage, pose.positions);
  std::size_t count = 0;
  for (std::size_t part = 0; part < rest.size(); ++part) count += rest[part] * posed[part] < 0;
  return count;
}

std::string inside_out_note(std::size_t count, std::size_t parts) {
  const std::string which = parts == 1
                                ? "The cage is"
                                : std::to_string(count) + " of " + std::to_string(parts) +
                                      (count == 1 ? " parts of the cage is" : " parts of the cage are");
  return which +
         " mirrored in this pose: the model folds, because log space cannot represent mirroring; use mean "
         "value weights";
}

}  // namespace

std::vector<std::string> pose_notes(const pose::LogReport& report, const pose::Cage& cage,
                                    const pose::Pose& pose) {
  std::vector<std::string> notes;
  if (!report.collapsed.empty()) {
    const Elements faces = faces_of(cage.elements, report.collapsed);
    notes.push_back(base::counted(faces.size(), "face") + " of the cage collapsed (first: face " +
                    std::to_string(faces.front()) + "); a minimum stretch is used there");
  }
  if (report.torn.empty()) return notes;
  const std::size_t inside_out = parts_inside_out(cage, pose);
  if (inside_out > 0) notes.push_back(inside_out_note(inside_out, cage.roots.size()));
  if (inside_out < cage.roots.size()) {
    const auto a = cage.polygon_of(report.torn.front()[0]), b = cage.polygon_of(report.torn.front()[1]);
    const std::string first =
        a == b ? "within face " + std::to_string(a) : "faces " + std::to_string(a) + ", " + std::to_string(b);
    notes.push_back(base::counted(report.torn.size(), "pair") +
                    " of neighbouring cage faces rotated more than 120 degrees relative to each other "
                    "(first: " +
                    first + "); the model may fold there");
  }
  return notes;
}

std::vector<std::array<std::uint32_t, 2>> torn_edges(const pose::LogReport& report, const pose::Cage& cage,
                                                     std::size_t most) {
  const auto& triangles = cage.elements.triangles;
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& [a, b] : report.torn | std::views::take(most)) {
    if (std::max(a, b) >= triangles.size()) continue;
    std::vector<std::uint32_t> ends;
    std::ranges::copy_if(triangles[a], std::back_inserter(ends), [&, other = b](std::uint32_t v) {
      return std::ranges::count(triangles[other], v) > 0;
    });
    const bool in_polygon =
        std::ranges::any_of(ends, [&](auto v) { return v >= cage.surface.positions.size(); });
    if (ends.size() == 2 && !in_polygon) edges.push_back({ends[0], ends[1]});
  }
  return edges;
}

}  // namespace viete::document
