#include "scene/document/selecting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "mesh/adjacency.h"
#include "scene/document/elements.h"

namespace viete::scene {

namespace {

using mesh::Vec3;
using Numbers = std::vector<std::uint32_t>;
using Flags = std::vector<std::uint8_t>;

constexpr double least_cosine = 0.5;  // limit for the angle between consecutive edges of a loop
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

template <class Holds>
Selection those_of(const deform::Cage& cage, ElementKind kind, const Holds& holds) {
  Numbers found;
  for (std::uint32_t i = 0; i < element_count(cage, kind); ++i) {
    if (holds(i)) found.push_back(i);
  }
  return Selection(kind, found);
}

template <class Holds>
bool any_vertex(const deform::Cage& cage, ElementKind kind, std::uint32_t i, const Holds& holds) {
  const auto vertices = element_vertices(cage, kind, i);
  return std::ranges::any_of(vertices, holds);
}

// Vertices of these elements; for vertices, also those connected by edges.
Flags touched_by(const deform::Cage& cage, const Selection& selection) {
  Flags touched(cage.surface.positions.size(), 0);
  for (const auto v : selected_vertices(cage, selection)) touched[v] = 1;
  if (selection.kind() != ElementKind::vertex) return touched;
  const Flags own = touched;
  for (const auto& [a, b] : cage.edges) {
    if (own[a] || own[b]) touched[a] = touched[b] = 1;
  }
  return touched;
}

Vec3 unit(const Vec3& v) {
  const double length = mesh::norm(v);
  return length > 0 ? (1 / length) * v : v;
}

// The area vector: along the normal, twice the area.
Vec3 area_of(const deform::Cage& cage, std::span<const mesh::Point> positions, std::uint32_t face) {
  const auto corners = element_vertices(cage, ElementKind::face, face);
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const mesh::Point& a = positions[corners[0]];
    sum = sum + mesh::cross(positions[corners[i - 1]] - a, positions[corners[i]] - a);
  }
  return sum;
}

// Edges and faces at vertices, and faces at edges.
class Neighbourhood {
public:
  explicit Neighbourhood(const deform::Cage& cage) : cage_(cage) {
    const auto vertices = cage.surface.positions.size();
    edges_ = mesh::make_adjacency(vertices, [&](const auto& add) {
      for (std::uint32_t e = 0; e < cage.edges.size(); ++e) {
        for (const auto v : cage.edges[e]) add(v, e);
      }
    });
    const auto faces = static_cast<std::uint32_t>(cage.surface.polygon_count());
    for (std::uint32_t f = 0; f < faces; ++f) sides_.push_back(sides_of(f));
    faces_ = mesh::make_adjacency(cage.edges.size(), [&](const auto& add) {
      for (std::uint32_t f = 0; f < faces; ++f) {
        for (const auto e : sides_[f]) add(e, f);
      }
    });
  }

  std::span<const std::uint32_t> edges_at(std::uint32_t v) const { return edges_.of(v); }
  std::span<const std::uint32_t> faces_along(std::uint32_t e) const { return faces_.of(e); }
  const Numbers& sides(std::uint32_t f) const { return sides_[f]; }

  std::uint32_t edge_between(std::uint32_t a, std::uint32_t b) const {
    for (const auto e : edges_at(a)) {
      if (other_end(e, a) == b) return e;
    }
    return none;
  }
  std::uint32_t other_end(std::uint32_t e, std::uint32_t v) const {
    const auto& [a, b] = cage_.edges[e];
    return a == v ? b : a;
  }
  bool on_rim(std::uint32_t e) const { return faces_along(e).size() == 1; }
  bool share_face(std::uint32_t e, std::uint32_t other) const {
    return std::ranges::any_of(faces_along(e),
                               [&](auto f) { return std::ranges::count(sides_[f], other) > 0; });
  }
  Vec3 middle(std::uint32_t e) const {
    const auto& p = cage_.surface.positions;
    return 0.5 * (p[cage_.edges[e][0]] + p[cage_.edges[e][1]]);
  }
  Vec3 way(std::uint32_t from, std::uint32_t to) const {
    return unit(cage_.surface.positions[to] - cage_.surface.positions[from]);
  }

private:
  Numbers sides_of(std::uint32_t f) const {
    const auto corners = element_vertices(cage_, ElementKind::face, f);
    Numbers sides;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto e = edge_between(corners[i], corners[(i + 1) % corners.size()]);
      if (e != none) sides.push_back(e);
    }
    return sides;
  }

  const deform::Cage& cage_;
  mesh::Adjacency edges_, faces_;
  std::vector<Numbers> sides_;
};

// The continuation of edge e at vertex v.
std::uint32_t next_edge(const Neighbourhood& around, std::uint32_t e, std::uint32_t v) {
  const auto edges = around.edges_at(v);
  if (around.on_rim(e)) {
    Numbers rims;
    std::ranges::copy_if(edges, std::back_inserter(rims),
                         [&](auto other) { return other != e && around.on_rim(other); });
    return rims.size() == 1 ? rims.front() : none;
  }
  const bool quads = std::ranges::all_of(edges, [&](auto other) {
    return std::ranges::all_of(around.faces_along(other),
                               [&](auto f) { return around.sides(f).size() == 4; });
  });
  if (quads) {
    if (edges.size() != 4) return none;
    Numbers opposite;
    std::ranges::copy_if(edges, std::back_inserter(opposite),
                         [&](auto other) { return other != e && !around.share_face(e, other); });
    return opposite.size() == 1 ? opposite.front() : none;
  }
  const Vec3 along = around.way(around.other_end(e, v), v);
  std::uint32_t best = none;
  double straightest = least_cosine;
  for (const auto other : edges) {
    const double cosine = mesh::dot(along, around.way(v, around.other_end(other, v)));
    if (other != e && cosine > straightest) straightest = cosine, best = other;
  }
  return best;
}

// Follows the loop from e at v until it ends or returns to a visited edge.
void run_along(const Neighbourhood& around, std::uint32_t e, std::uint32_t v, Flags& taken) {
  for (;;) {
    e = next_edge(around, e, v);
    if (e == none || taken[e]) return;
    taken[e] = 1;
    v = around.other_end(e, v);
  }
}

Flags edge_loops(const deform::Cage& cage, const Neighbourhood& around, const Numbers& seeds) {
  Flags all(cage.edges.size(), 0);
  for (const auto e : seeds) {
    if (all[e]) continue;               // part of a known loop
    Flags taken(cage.edges.size(), 0);  // edges of this loop, which may cross others
    taken[e] = 1;
    for (const auto v : cage.edges[e]) run_along(around, e, v, taken);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] |= taken[i];
  }
  return all;
}

// The side by which a strip leaves the face, after entering by `from` in this direction.
std::uint32_t way_out(const Neighbourhood& around, std::uint32_t face, std::uint32_t from,
                      const Vec3& along) {
  const Numbers& sides = around.sides(face);
  if (sides.size() == 4) return sides[(std::ranges::find(sides, from) - sides.begin() + 2) % 4];
  std::uint32_t best = none;
  double farthest = 0;
  for (const auto side : sides) {
    const double far = mesh::dot(along, around.middle(side) - around.middle(from));
    if (side != from && far > farthest) farthest = far, best = side;
  }
  return best;
}

// Follows a strip into `face` across `from`. The direction is that of the last two steps, since strips of
// triangles alternate left and right.
void run_across(const Neighbourhood& around, std::uint32_t face, std::uint32_t from, Vec3 along, Flags& taken,
                Flags& crossed) {
  Vec3 before = around.middle(from) - along;
  for (;;) {
    const std::uint32_t out = way_out(around, face, from, along);
    if (out == none || around.faces_along(out).size() != 2) return;
    const auto faces = around.faces_along(out);
    face = faces[0] == face ? faces[1] : faces[0];
    if (taken[face]) return;
    taken[face] = crossed[out] = 1;
    along = unit(around.middle(out) - before);
    before = around.middle(from);
    from = out;
  }
}

Flags face_loops(const deform::Cage& cage, const Neighbourhood& around, const Selection& faces) {
  Flags all(cage.surface.polygon_count(), 0), crossed(cage.edges.size(), 0);
  for (std::uint32_t e = 0; e < cage.edges.size(); ++e) {
    const auto along = around.faces_along(e);
    if (crossed[e] || along.size() != 2 || !faces.contains(along[0]) || !faces.contains(along[1])) continue;
    Flags taken(all.size(), 0);
    taken[along[0]] = taken[along[1]] = 1;
    const Vec3 way = unit(mesh::Vec3(deform::polygon_center(cage.surface, along[1], cage.surface.positions)) -
                          deform::polygon_center(cage.surface, along[0], cage.surface.positions));
    run_across(around, along[1], e, way, taken, crossed);
    run_across(around, along[0], e, -1 * way, taken, crossed);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] |= taken[i];
  }
  return all;
}

bool alike(double a, double b) {
  return std::abs(a - b) <= 0.1 * std::max(a, b);
}

// The measure of each element: the number of edges for vertices.
std::vector<double> sizes_of(const deform::Cage& cage, std::span<const mesh::Point> positions,
                             ElementKind kind) {
  std::vector<double> sizes(element_count(cage, kind), 0);
  if (kind == ElementKind::vertex) {
    for (const auto& edge : cage.edges) {
      for (const auto v : edge) sizes[v] += 1;
    }
    return sizes;
  }
  for (std::uint32_t i = 0; i < sizes.size(); ++i)
    sizes[i] = kind == ElementKind::face
                   ? mesh::norm(area_of(cage, positions, i))
                   : mesh::norm(positions[cage.edges[i][1]] - positions[cage.edges[i][0]]);
  return sizes;
}

// Unique values: a thousand selected elements have few different sizes.
std::vector<double> distinct(std::vector<double> values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

Selection grown(const deform::Cage& cage, const Selection& selection) {
  if (selection.kind() == ElementKind::probe) return selection;
  const Flags touched = touched_by(cage, selection);
  const auto kind = selection.kind();
  return those_of(cage, kind,
                  [&](auto i) { return any_vertex(cage, kind, i, [&](auto v) { return touched[v] != 0; }); });
}

Selection shrunk(const deform::Cage& cage, const Selection& selection) {
  if (selection.kind() == ElementKind::probe) return selection;
  const auto kind = selection.kind();
  Selection others = selection;
  others.invert(element_count(cage, kind));
  const Flags touched = touched_by(cage, others);
  return those_of(cage, kind, [&](auto i) {
    return selection.contains(i) && !any_vertex(cage, kind, i, [&](auto v) { return touched[v] != 0; });
  });
}

Selection looped(const deform::Cage& cage, const Selection& selection) {
  const auto kind = selection.kind();
  if (kind == ElementKind::probe) return selection;
  const Neighbourhood around(cage);
  Selection all = selection;
  if (kind == ElementKind::face) {
    const Flags taken = face_loops(cage, around, selection);
    all.apply(those_of(cage, kind, [&](auto f) { return taken[f] != 0; }).indices(), SelectMode::add);
    return all;
  }
  const Flags taken = edge_loops(cage, around, converted(cage, selection, ElementKind::edge).indices());
  const Selection edges = those_of(cage, ElementKind::edge, [&](auto e) { return taken[e] != 0; });
  all.apply(kind == ElementKind::edge ? edges.indices() : selected_vertices(cage, edges), SelectMode::add);
  return all;
}

Selection similar(const deform::Cage& cage, std::span<const mesh::Point> positions,
                  const Selection& selection) {
  const auto kind = selection.kind();
  if (kind == ElementKind::probe) return selection;
  const auto sizes = sizes_of(cage, positions, kind);
  std::vector<double> wanted;
  for (const auto i : selection.indices()) wanted.push_back(sizes[i]);
  wanted = distinct(std::move(wanted));
  return those_of(cage, kind, [&](auto i) {
    return std::ranges::any_of(wanted, [&](double size) {
      return kind == ElementKind::vertex ? size == sizes[i] : alike(size, sizes[i]);
    });
  });
}

Selection facing(const deform::Cage& cage, std::span<const mesh::Point> positions,
                 const Selection& selection) {
  constexpr double cosine = 0.9659258;  // 15 degrees
  const auto kind = selection.kind();
  if (kind != ElementKind::edge && kind != ElementKind::face) return selection;
  std::vector<Vec3> ways(element_count(cage, kind));
  for (std::uint32_t i = 0; i < ways.size(); ++i)
    ways[i] = unit(kind == ElementKind::face ? area_of(cage, positions, i)
                                             : positions[cage.edges[i][1]] - positions[cage.edges[i][0]]);
  return those_of(cage, kind, [&](auto i) {
    return selection.contains(i) || std::ranges::any_of(selection.indices(), [&](auto s) {
             const double along = mesh::dot(ways[s], ways[i]);
             return (kind == ElementKind::edge ? std::abs(along) : along) >= cosine;
           });
  });
}

Selection on_side(const deform::Cage& cage, ElementKind kind, int axis, bool positive, double middle) {
  const double slack = 1e-6 * cage.diagonal;
  const auto beyond = [&](std::uint32_t v) {
    const double x = cage.surface.positions[v][static_cast<std::size_t>(axis)] - middle;
    return positive ? x : -x;
  };
  return those_of(cage, kind, [&](auto i) {
    return any_vertex(cage, kind, i, [&](auto v) { return beyond(v) > slack; }) &&
           !any_vertex(cage, kind, i, [&](auto v) { return beyond(v) < -slack; });
  });
}

}  // namespace viete::scene
