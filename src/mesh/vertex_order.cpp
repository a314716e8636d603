#include "mesh/vertex_order.h"

#include <algorithm>
#include <span>

#include "base/text.h"

namespace viete::mesh {

namespace {

std::size_t count_of(const Adjacency& faces) {
  return faces.starts.size() - 1;
}

// Returns the corners of each face.
Adjacency faces_of(const Surface& s, bool polygons) {
  if (polygons) return {s.polygon_starts, s.corners};
  Adjacency faces{{0}, {}};
  for (const Triangle& t : s.triangles) {
    faces.items.insert(faces.items.end(), t.begin(), t.end());
    faces.starts.push_back(static_cast<std::uint32_t>(faces.items.size()));
  }
  return faces;
}

// Rotates the corners of each face, so that the lowest vertex is first. Returns the ascending order of faces.
std::vector<std::uint32_t> sort(Adjacency& faces) {
  for (std::size_t f = 0; f < count_of(faces); ++f) {
    const auto face = std::span(faces.items).subspan(faces.starts[f], faces.of(f).size());
    std::ranges::rotate(face, std::ranges::min_element(face));
  }
  std::vector<std::uint32_t> order = first_numbers(count_of(faces));
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return std::ranges::lexicographical_compare(faces.of(a), faces.of(b));
  });
  return order;
}

// Returns true if the faces are equal in any order and with any first corners.
bool equal_sets(Adjacency a, Adjacency b) {
  if (count_of(a) != count_of(b) || a.items.size() != b.items.size()) return false;
  return std::ranges::equal(
      sort(a), sort(b), [&](std::size_t i, std::size_t j) { return std::ranges::equal(a.of(i), b.of(j)); });
}

// Returns a vertex of `found` for each vertex of `wanted`, if faces and corners have the same order.
std::optional<std::vector<std::uint32_t>> order_by_corners(const Adjacency& found, const Adjacency& wanted,
                                                           std::size_t vertices) {
  if (found.starts != wanted.starts) return std::nullopt;
  std::vector<std::uint32_t> order(vertices, none), taken(vertices, none);
  for (std::size_t c = 0; c < wanted.items.size(); ++c) {
    const std::uint32_t w = wanted.items[c], f = found.items[c];
    if (order[w] == none && taken[f] == none) {
      order[w] = f;
      taken[f] = w;
    }
    if (order[w] != f) return std::nullopt;
  }
  std::uint32_t next = 0;
  for (auto& v : order) {
    if (v != none) continue;
    while (taken[next] != none) ++next;
    v = next++;
  }
  return order;
}

std::string face_text(const Adjacency& faces, std::size_t face) {
  std::string text;
  for (const std::uint32_t v : faces.of(face)) text += (text.empty() ? "" : " ") + std::to_string(v);
  return text;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> vertex_order(const Surface& found, const Surface& wanted,
                                                       bool keeps_order) {
  const std::size_t vertices = wanted.positions.size();
  if (found.positions.size() != vertices) return std::nullopt;
  std::vector<std::uint32_t> same = first_numbers(vertices);
  if (same_faces(found, wanted) || found.polygon_count() == 0) return same;
  const bool polygons = found.polygon_count() == wanted.polygon_count();
  const Adjacency theirs = faces_of(found, polygons), ours = faces_of(wanted, polygons);
  if (keeps_order && equal_sets(theirs, ours)) return same;
  return order_by_corners(theirs, ours, vertices);
}

std::string first_difference(const Surface& found, const Surface& wanted, const std::string& of) {
  const auto counts = [&](std::size_t theirs, std::size_t ours, const char* what) {
    return "the file has " + base::with_thousands(theirs) + " " + what + ", " + of + " has " +
           base::with_thousands(ours);
  };
  if (found.positions.size() != wanted.positions.size())
    return counts(found.positions.size(), wanted.positions.size(), "vertices");
  const bool polygons = found.polygon_count() == wanted.polygon_count();
  const Adjacency theirs = faces_of(found, polygons), ours = faces_of(wanted, polygons);
  if (count_of(theirs) != count_of(ours)) return counts(count_of(theirs), count_of(ours), "faces");
  std::vector<std::size_t> differing;
  for (std::size_t face = 0; face < count_of(ours); ++face)
    if (!std::ranges::equal(theirs.of(face), ours.of(face))) differing.push_back(face);
  const bool reordered = 2 * differing.size() > count_of(ours);
  const std::size_t face = differing.empty() ? 0 : differing[0];
  return (reordered ? "neither the vertices nor the faces are in the order of " + of + ": " : "") + "face " +
         std::to_string(face) + " (counted from 0) has the vertices " + face_text(theirs, face) + ", in " +
         of + " " + face_text(ours, face);
}

}  // namespace viete::mesh
