#include "deform/corner_maps.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <utility>
#include <vector>

#include "deform/face_maps.h"
#include "mesh/adjacency.h"
#include "mesh/repair.h"

namespace viete::deform {

namespace {

using Positions = std::span<const mesh::Point>;

// Volume of a basis to the product of its lengths; below it the basis is flat.
constexpr double flat_basis = 1e-9;

// A corner of a polygon, and the side that runs from it to the next one.
struct Corner {
  std::uint32_t polygon, previous, at, next;  // the last three are vertices
  std::uint32_t own, following;               // places among all, its own and the next corner's
};

std::vector<Corner> corners_of(const mesh::Surface& surface) {
  std::vector<Corner> corners;
  for (std::uint32_t p = 0; p < surface.polygon_count(); ++p) {
    const std::size_t first = surface.polygon_starts[p], n = surface.polygon_starts[p + 1] - first;
    for (std::size_t i = 0; i < n; ++i) {
      corners.push_back({p, surface.corners[first + (i + n - 1) % n], surface.corners[first + i],
                         surface.corners[first + (i + 1) % n], static_cast<std::uint32_t>(first + i),
                         static_cast<std::uint32_t>(first + (i + 1) % n)});
    }
  }
  return corners;
}

Vec3 unit(const Vec3& v) {
  const double size = largest_abs(v);
  if (!(size > 0)) return {0, 0, 0};
  const Vec3 once = (1 / size) * v;
  return (1 / norm(once)) * once;
}

Vec3 area_at(const Corner& c, Positions at) {
  return cross(at[c.next] - at[c.at], at[c.previous] - at[c.at]);
}

// A polygon's area, and the mean of its corners.
struct Plane {
  Vec3 area{0, 0, 0}, centroid{0, 0, 0};
};

std::span<const std::uint32_t> polygon_corners(const mesh::Surface& surface, std::uint32_t polygon) {
  const auto first = surface.polygon_starts[polygon];
  return std::span(surface.corners).subspan(first, surface.polygon_starts[polygon + 1] - first);
}

Plane plane_of(const mesh::Surface& surface, std::uint32_t polygon, Positions at) {
  const auto corners = polygon_corners(surface, polygon);
  const Vec3& first = at[corners[0]];
  Plane plane;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = at[corners[i]] - first, b = at[corners[(i + 1) % corners.size()]] - first;
    plane.area = plane.area + cross(a, b);
  }
  plane.centroid = polygon_center(surface, polygon, at);
  return plane;
}

// The three vectors of a map.
struct Span {
  Vec3 u, v, n;
};

bool flat(const Span& s) {
  const Vec3 u = unit(s.u), v = unit(s.v), n = unit(s.n);
  return !(std::abs(dot(cross(u, v), n)) > flat_basis);
}

RestBasis rest_basis_of(const Span& s) {
  if (flat(s)) return {};
  // Duals of unit vectors, so that lengths neither over- nor underflow.
  const double lu = norm(s.u), lv = norm(s.v), ln = norm(s.n);
  const Vec3 u = (1 / lu) * s.u, v = (1 / lv) * s.v, n = (1 / ln) * s.n;
  const double volume = dot(cross(u, v), n);
  return {0,
          s.u,
          s.v,
          s.n,
          (1 / (volume * lu)) * cross(v, n),
          (1 / (volume * lv)) * cross(n, u),
          (1 / (volume * ln)) * cross(u, v)};
}

// Which maps there are, those of an element after each other.
struct Table {
  std::vector<Corner> corners;        // of each map; of edges, where the side begins
  std::vector<std::uint32_t> owners;  // of each map, ascending
  std::vector<std::uint32_t> starts;  // of each element, in maps; one more than elements
  std::vector<std::uint32_t> map_of;  // of each corner of the surface; none: not_one

  std::span<const Corner> of(std::uint32_t element) const {
    return std::span(corners).subspan(starts[element], starts[element + 1] - starts[element]);
  }
};
constexpr std::uint32_t not_one = ~0u;

// owner(corner): the element, or not_one.
template <class Owner>
Table make_table(const std::vector<Corner>& corners, std::size_t elements, const Owner& owner) {
  Table t;
  const auto lists = mesh::make_adjacency(elements, [&](const auto& add) {
    for (std::uint32_t c = 0; c < corners.size(); ++c) {
      if (const auto o = owner(corners[c]); o != not_one) add(o, c);
    }
  });
  t.map_of.assign(corners.size(), not_one);
  t.starts = lists.starts;
  for (std::uint32_t e = 0; e < elements; ++e) {
    for (const auto c : lists.of(e)) {
      t.map_of[c] = static_cast<std::uint32_t>(t.corners.size());
      t.corners.push_back(corners[c]);
      t.owners.push_back(e);
    }
  }
  return t;
}

// Sides of polygons along the same edge, vertices at one place counting as one: pairs of corners where they
// begin, and whether they run the same way.
struct Beside {
  std::uint32_t a, b;
  bool same_way;
};

std::vector<Beside> sides_beside(const Cage& cage, const std::vector<Corner>& corners) {
  struct Side {
    mesh::Edge edge;
    std::uint32_t corner;
    bool forward;
    auto operator<=>(const Side&) const = default;
  };
  const mesh::Surface welded = mesh::welded(cage.surface);
  std::vector<Side> sides;
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    const auto a = welded.corners[c], b = welded.corners[corners[c].following];
    if (a != b) sides.push_back({{std::min(a, b), std::max(a, b)}, c, a < b});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<Beside> pairs;
  for (std::size_t n = 1; n < sides.size(); ++n) {
    const Side &s = sides[n - 1], &t = sides[n];
    if (s.edge == t.edge) pairs.push_back({s.corner, t.corner, s.forward == t.forward});
  }
  return pairs;
}

class Pairs {
public:
  explicit Pairs(const Table& table) : table_(table) {}

  void add(std::uint32_t corner, std::uint32_t other) {
    const auto a = table_.map_of[corner], b = table_.map_of[other];
    if (a != not_one && b != not_one && a != b) all.push_back({std::min(a, b), std::max(a, b)});
  }

  std::vector<mesh::Edge> all;

private:
  const Table& table_;
};

enum class Kind { edges, vertices };

// Maps are neighbours where their corners follow each other along a polygon, and across edges.
std::vector<mesh::Edge> neighbours(const Cage& cage, const std::vector<Corner>& corners, const Table& table,
                                   Kind kind) {
  Pairs pairs(table);
  for (std::uint32_t c = 0; c < corners.size(); ++c) pairs.add(c, corners[c].following);
  for (const auto& [a, b, same_way] : sides_beside(cage, corners)) {
    const auto end_a = corners[a].following, end_b = corners[b].following;
    if (kind == Kind::edges) {
      pairs.add(a, b);
    } else {
      pairs.add(a, same_way ? b : end_b), pairs.add(end_a, same_way ? end_b : b);
    }
  }
  return std::move(pairs.all);
}

// The lowest part of the triangles of each polygon.
std::vector<std::uint32_t> parts_of_polygons(const Cage& cage) {
  std::vector<std::uint32_t> parts(cage.surface.polygon_count(),
                                   static_cast<std::uint32_t>(cage.roots.size()));
  for (std::size_t e = 0; e < cage.element_count(); ++e) {
    auto& part = parts[cage.surface.triangle_polygon[e]];
    part = std::min(part, cage.parts[e]);
  }
  return parts;
}

// What the maps of one kind are made of.
struct Shape {
  Shape(const Cage& of, Table maps) : cage(of), table(std::move(maps)) {}
  virtual ~Shape() = default;
  /// The map's own two vectors, and the area of its polygon there.
  virtual Span own(const Corner& corner, Positions at) const = 0;
  /// What the maps of an element share as their third vector.
  virtual Vec3 shared(std::uint32_t element, Positions at) const = 0;
  virtual Vec3 center(std::uint32_t element, Positions at, const Vec3& origin) const = 0;

  const Cage& cage;
  const Table table;
};

struct EdgeShape : Shape {
  using Shape::Shape;
  Span own(const Corner& c, Positions at) const override {
    const Plane plane = plane_of(cage.surface, c.polygon, at);
    return {at[c.next] - at[c.at], plane.centroid - 0.5 * (at[c.at] + at[c.next]), plane.area};
  }
  Vec3 shared(std::uint32_t element, Positions at) const override {
    Vec3 normals{0, 0, 0};
    for (const Corner& c : table.of(element))
      normals = normals + unit(plane_of(cage.surface, c.polygon, at).area);
    const auto& [a, b] = cage.edges[element];
    return norm(at[b] - at[a]) * unit(normals);
  }
  Vec3 center(std::uint32_t element, Positions at, const Vec3& origin) const override {
    const auto& [a, b] = cage.edges[element];
    return 0.5 * ((at[a] - origin) + (at[b] - origin));
  }
};

struct VertexShape : Shape {
  using Shape::Shape;
  Span own(const Corner& c, Positions at) const override {
    return {at[c.next] - at[c.at], at[c.previous] - at[c.at], area_at(c, at)};
  }
  Vec3 shared(std::uint32_t element, Positions at) const override {
    Vec3 normals{0, 0, 0};
    double twice_area = 0;
    for (const Corner& c : table.of(element)) {
      const Vec3 area = area_at(c, at);
      normals = normals + unit(area);
      twice_area += norm(area);
    }
    return std::sqrt(twice_area / 2) * unit(normals);
  }
  Vec3 center(std::uint32_t element, Positions at, const Vec3& origin) const override {
    return at[element] - origin;
  }
};

struct PolygonShape : VertexShape {
  PolygonShape(const Cage& of, Table maps, std::vector<std::uint8_t> is_cut)
      : VertexShape(of, std::move(maps)), cut(std::move(is_cut)) {}
  Vec3 center(std::uint32_t element, Positions at, const Vec3& origin) const override {
    const auto polygon = cage.surface.triangle_polygon[element];
    return cut[polygon] ? element_center(cage, element, at, origin)
                        : polygon_center(cage.surface, polygon, at) - origin;
  }

  const std::vector<std::uint8_t> cut;  // polygons that are concave
};

// The vectors of a map; alone: without what its element shares, across its own two.
Span map_span(const Shape& shape, std::uint32_t m, bool alone, Positions at) {
  Span s = shape.own(shape.table.corners[m], at);
  s.n = alone ? side_along(s.n) : shape.shared(shape.table.owners[m], at);
  return s;
}

class CornerMaps : public ElementMaps {
public:
  /// Without sharing, and where what is shared lies in the plane of the map's own vectors, the third vector
  /// is across these.
  CornerMaps(std::unique_ptr<const Shape> shape, MapGraph graph, mesh::Adjacency vertices,
             std::vector<std::uint8_t> alone)
      : ElementMaps(std::move(graph), std::move(vertices), shape->table.owners, equal_shares(shape->table)),
        shape_(std::move(shape)),
        alone_(std::move(alone)) {
    for (std::uint32_t m = 0; m < count(); ++m)
      bases_.push_back(rest_basis_of(span_of(m, shape_->cage.surface.positions)));
  }

  void compute(Positions posed, const Vec3& origin, std::span<const std::uint32_t> which,
               std::span<AffineMap> maps) const override {
    for (const auto m : which) {
      maps[m] = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, shape_->center(owners()[m], posed, origin)};
      if (graph().skipped[m]) continue;
      const auto [u, v, n] = span_of(m, posed);
      maps[m].linear = linear_map(bases_[m], u, v, n);
    }
  }

private:
  static std::vector<double> equal_shares(const Table& table) {
    std::vector<double> shares;
    for (const auto owner : table.owners)
      shares.push_back(1.0 / (table.starts[owner + 1] - table.starts[owner]));
    return shares;
  }

  Span span_of(std::uint32_t m, Positions at) const { return map_span(*shape_, m, alone_[m], at); }

  std::unique_ptr<const Shape> shape_;
  std::vector<std::uint8_t> alone_;
  std::vector<RestBasis> bases_;
};

// Of vertices the neighbours of its corners, which are all that its triangles and its polygons' sides have;
// of edges all vertices of the polygons beside.
mesh::Adjacency movers(const Shape& shape, Kind kind) {
  const mesh::Surface& surface = shape.cage.surface;
  return mesh::make_adjacency(shape.table.corners.size(), [&](const auto& add) {
    for (std::uint32_t m = 0; m < shape.table.corners.size(); ++m) {
      for (const Corner& c : shape.table.of(shape.table.owners[m])) {
        if (kind == Kind::vertices) {
          add(m, c.previous), add(m, c.at), add(m, c.next);
          continue;
        }
        for (auto i = surface.polygon_starts[c.polygon]; i < surface.polygon_starts[c.polygon + 1]; ++i)
          add(m, surface.corners[i]);
      }
    }
  });
}

std::unique_ptr<const ElementMaps> corner_maps(std::unique_ptr<const Shape> shape,
                                               std::vector<mesh::Edge> neighbours, Kind kind, bool sharing) {
  const Cage& cage = shape->cage;
  const Table& table = shape->table;
  const auto& rest = cage.surface.positions;
  std::vector<std::uint8_t> alone, skipped;
  for (std::uint32_t m = 0; m < table.corners.size(); ++m) {
    alone.push_back(!sharing || flat(map_span(*shape, m, false, rest)));
    skipped.push_back(alone.back() && flat(map_span(*shape, m, true, rest)));
  }
  MapGraph graph = map_graph(
      cage, std::move(neighbours), std::move(skipped),
      [&, parts = parts_of_polygons(cage)](std::uint32_t m) { return parts[table.corners[m].polygon]; });
  mesh::Adjacency vertices = movers(*shape, kind);
  return std::make_unique<CornerMaps>(std::move(shape), std::move(graph), std::move(vertices),
                                      std::move(alone));
}

std::unique_ptr<const ElementMaps> maps_of_vertices(const Cage& cage, bool sharing) {
  const auto corners = corners_of(cage.surface);
  Table table = make_table(corners, cage.surface.positions.size(), [](const Corner& c) { return c.at; });
  auto pairs = neighbours(cage, corners, table, Kind::vertices);
  return corner_maps(std::make_unique<VertexShape>(cage, std::move(table)), std::move(pairs), Kind::vertices,
                     sharing);
}

// Those of a polygon that have a map, of these corners of the whole surface.
std::vector<Corner> corners_with_maps(const Cage& cage, std::span<const Corner> corners) {
  const auto& rest = cage.surface.positions;
  std::vector<Corner> some;
  for (const Corner& c : corners) {
    const Span s{rest[c.next] - rest[c.at], rest[c.previous] - rest[c.at], side_along(area_at(c, rest))};
    if (!flat(s)) some.push_back(c);
  }
  if (some.empty()) some.push_back(corners.front());
  if (corners.size() == 3) some.resize(1);  // its corners all have the same
  return some;
}

// Of each triangle all of its polygon; of a concave one, whose ends may be far from each other, its own.
Table table_of_polygons(const Cage& cage, const std::vector<Corner>& corners,
                        std::span<const std::uint8_t> concave) {
  const mesh::Surface& surface = cage.surface;
  Table t;
  t.starts.push_back(0);
  for (std::uint32_t e = 0; e < cage.element_count(); ++e) {
    const auto polygon = surface.triangle_polygon[e];
    const auto first = surface.polygon_starts[polygon];
    const auto all = corners_with_maps(
        cage, std::span(corners).subspan(first, surface.polygon_starts[polygon + 1] - first));
    const auto is_own = [&](const Corner& c) {
      return !concave[polygon] || std::ranges::count(surface.triangles[e], c.at) > 0;
    };
    const bool some = std::ranges::any_of(all, is_own);
    for (const Corner& c : all) {
      if (some && !is_own(c)) continue;
      t.corners.push_back(c);
      t.owners.push_back(e);
    }
    t.starts.push_back(static_cast<std::uint32_t>(t.corners.size()));
  }
  return t;
}

// All maps of a polygon, in whatever triangle of it, and across edges its first ones; of a concave one those
// of a corner, along its sides, and across them.
std::vector<mesh::Edge> neighbours_of_polygons(const Cage& cage, const std::vector<Corner>& corners,
                                               const Table& table, std::span<const std::uint8_t> concave) {
  std::vector<std::uint32_t> first(corners.size(), not_one);
  const auto first_for = [&](const Corner& c) -> std::uint32_t& {
    return first[concave[c.polygon] ? c.own : cage.surface.polygon_starts[c.polygon]];
  };
  std::vector<mesh::Edge> pairs;
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    if (a != not_one && b != not_one && a != b) pairs.push_back({std::min(a, b), std::max(a, b)});
  };
  for (std::uint32_t m = 0; m < table.corners.size(); ++m) {
    auto& known = first_for(table.corners[m]);
    if (known == not_one) known = m;
    add(known, m);
  }
  for (const auto& side : sides_beside(cage, corners))
    add(first_for(corners[side.a]), first_for(corners[side.b]));
  std::uint32_t before = not_one;
  for (const Corner& c : corners) {
    const auto m = first_for(c);
    if (!concave[c.polygon] || m == not_one) continue;
    if (before != not_one && table.corners[before].polygon == c.polygon) add(before, m);
    before = m;
  }
  return pairs;
}

}  // namespace

std::unique_ptr<const ElementMaps> polygon_maps(const Cage& cage) {
  const auto corners = corners_of(cage.surface);
  std::vector<std::uint8_t> concave;
  for (std::uint32_t p = 0; p < cage.surface.polygon_count(); ++p)
    concave.push_back(is_concave(cage.surface, p));
  Table table = table_of_polygons(cage, corners, concave);
  auto pairs = neighbours_of_polygons(cage, corners, table, concave);
  return corner_maps(std::make_unique<PolygonShape>(cage, std::move(table), std::move(concave)),
                     std::move(pairs), Kind::edges, false);
}

std::unique_ptr<const ElementMaps> edge_maps(const Cage& cage) {
  const auto corners = corners_of(cage.surface);
  Table table = make_table(corners, cage.edges.size(), [&](const Corner& c) {
    const mesh::Edge edge{std::min(c.at, c.next), std::max(c.at, c.next)};
    const auto found = std::lower_bound(cage.edges.begin(), cage.edges.end(), edge);
    return found != cage.edges.end() && *found == edge
               ? static_cast<std::uint32_t>(found - cage.edges.begin())
               : not_one;
  });
  auto pairs = neighbours(cage, corners, table, Kind::edges);
  return corner_maps(std::make_unique<EdgeShape>(cage, std::move(table)), std::move(pairs), Kind::edges,
                     true);
}

std::unique_ptr<const ElementMaps> vertex_maps(const Cage& cage) {
  return maps_of_vertices(cage, true);
}

std::unique_ptr<const ElementMaps> vertex_face_maps(const Cage& cage) {
  return maps_of_vertices(cage, false);
}

}  // namespace viete::deform
