#include "cages/edit.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "mesh/repair.h"
#include "mesh/triangle.h"
#include "mesh/triangulation.h"
#include "mesh/union_find.h"

namespace viete::cages {

namespace {

using mesh::Point, mesh::Surface, mesh::Vec3;
using Polygon = std::vector<std::uint32_t>;

mesh::Edge edge_of(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

class Polygons {
public:
  explicit Polygons(const Surface& cage) : positions_(cage.positions), around_(cage.positions.size()) {
    for (std::uint32_t v = 0; v < positions_.size(); ++v) origins_.push_back({{v}});
    for (std::size_t p = 0; p < cage.polygon_count(); ++p)
      put({cage.polygon(p).begin(), cage.polygon(p).end()});
  }

  std::vector<Polygon> all;  // a removed polygon is empty

  void put(Polygon p) {
    for (const auto v : p) around_[v].push_back(static_cast<std::uint32_t>(all.size()));
    all.push_back(std::move(p));
  }

  // Returns the polygons that put() added at the vertex v and for which accepts(polygon) is true.
  template <class Accepts>
  std::vector<std::uint32_t> around(std::uint32_t v, Accepts accepts) const {
    std::vector<std::uint32_t> found;
    std::ranges::copy_if(around_[v], std::back_inserter(found),
                         [&](std::uint32_t p) { return accepts(all[p]); });
    return found;
  }

  const Point& at(std::uint32_t v) const { return positions_[v]; }
  void move(std::uint32_t v, const Point& to) { positions_[v] = to; }

  std::uint32_t add(const Point& at, Origin origin) {
    positions_.push_back(at);
    origins_.push_back(std::move(origin));
    around_.emplace_back();
    return static_cast<std::uint32_t>(positions_.size() - 1);
  }

  std::uint32_t add_middle(const Polygon& of) {
    Point sum{0, 0, 0};
    Origin origin;
    for (const auto v : of) {
      sum = sum + positions_[v];
      origin.of.insert(origin.of.end(), origins_[v].of.begin(), origins_[v].of.end());
      origin.mirrored = origins_[v].mirrored;
    }
    return add((1 / static_cast<double>(of.size())) * sum, std::move(origin));
  }

  const Origin& origin(std::uint32_t v) const { return origins_[v]; }

  // If the polygon contains the vertex v several times, splits the polygon at v.
  void part_at(std::uint32_t v, std::size_t number) {
    for (std::ptrdiff_t left = std::ranges::count(all[number], v); left > 1; --left) {
      Polygon& p = all[number];
      const auto first = std::ranges::find(p, v), again = std::find(first + 1, p.end(), v);
      Polygon loop(first, again);
      p.erase(first, again);
      all.push_back(std::move(loop));  // invalidates p
    }
  }

  // Removes polygons with fewer than three corners, and unused vertices.
  Edited finish(const std::vector<std::uint32_t>& selection) {
    std::erase_if(all, [](const Polygon& p) { return p.size() < 3; });
    std::vector<std::uint8_t> used(positions_.size(), 0);
    for (const Polygon& p : all) {
      for (const auto v : p) used[v] = 1;
    }
    std::vector<std::uint32_t> number(positions_.size(), 0);
    Edited edited;
    for (std::uint32_t v = 0; v < positions_.size(); ++v) {
      if (!used[v]) continue;
      number[v] = static_cast<std::uint32_t>(edited.surface.positions.size());
      edited.surface.positions.push_back(positions_[v]);
      edited.origins.push_back(std::move(origins_[v]));
    }
    edited.surface.polygon_starts.push_back(0);
    for (const Polygon& p : all) {
      for (const auto v : p) edited.surface.corners.push_back(number[v]);
      edited.surface.polygon_starts.push_back(static_cast<std::uint32_t>(edited.surface.corners.size()));
    }
    mesh::triangulate(edited.surface);
    for (const auto v : selection) {
      if (used[v]) edited.selection.push_back(number[v]);
    }
    std::ranges::sort(edited.selection);
    return edited;
  }

private:
  std::vector<Point> positions_;
  std::vector<Origin> origins_;
  std::vector<std::vector<std::uint32_t>> around_;
};

std::vector<Point> places_of(const Polygons& cage, const Polygon& p) {
  std::vector<Point> places;
  for (const auto v : p) places.push_back(cage.at(v));
  return places;
}

std::vector<Polygon> triangles_of(const Polygons& cage, const Polygon& p) {
  std::vector<Polygon> triangles;
  for (const auto& [i, j, k] : mesh::triangulation(places_of(cage, p)))
    triangles.push_back({p[i], p[j], p[k]});
  return triangles;
}

// True if the polygon is star-shaped around the mean position of its corners.
bool is_about_its_middle(const Polygons& cage, const Polygon& p) {
  std::vector<Point> fan = places_of(cage, p);
  Point sum{0, 0, 0};
  for (const Point& at : fan) sum = sum + at;
  fan.push_back(fan.front());
  fan.insert(fan.begin(), (1 / static_cast<double>(p.size())) * sum);
  return mesh::is_fan(fan);
}

Vec3 area_of(const Polygons& cage, const Polygon& p) {
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    sum = sum + mesh::cross(cage.at(p[i]) - cage.at(p[0]), cage.at(p[i + 1]) - cage.at(p[0]));
  return sum;
}

// Returns the boundary of the polygons. If it is not a single loop, returns an empty polygon.
Polygon rim_of(const std::vector<Polygon>& polygons) {
  std::set<std::array<std::uint32_t, 2>> sides;
  for (const Polygon& p : polygons) {
    for (std::size_t i = 0; i < p.size(); ++i) sides.insert({p[i], p[(i + 1) % p.size()]});
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [a, b] : sides) {
    if (sides.contains({b, a})) continue;
    if (!next.emplace(a, b).second) return {};
  }
  Polygon rim;
  if (next.empty()) return rim;
  for (std::uint32_t v = next.begin()->first; rim.empty() || v != rim.front(); v = next.at(v)) {
    if (rim.size() == next.size() || !next.contains(v)) return {};
    rim.push_back(v);
  }
  return rim.size() == next.size() ? rim : Polygon{};
}

std::size_t side_of(const Polygon& p, const mesh::Edge& edge) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (edge_of(p[i], p[(i + 1) % p.size()]) == edge) return i;
  }
  return p.size();
}

// Inserts the vertex `middle` on the edge. The new polygon starts at this vertex.
Polygon split(const Polygon& p, const mesh::Edge& edge, std::uint32_t middle) {
  Polygon with;
  for (std::size_t i = 0; i < p.size(); ++i) {
    with.push_back(p[i]);
    if (edge_of(p[i], p[(i + 1) % p.size()]) == edge) with.push_back(middle);
  }
  std::ranges::rotate(with, std::ranges::find(with, middle));
  return with;
}

// Merges the polygons into one polygon, without the corners for which `goes` is true. If the boundary of the
// polygons is not a single loop, or fewer than three corners remain, does nothing.
template <class Goes>
void unite(Polygons& cage, const std::vector<std::uint32_t>& numbers, Goes goes) {
  std::vector<Polygon> united;
  for (const auto p : numbers) united.push_back(cage.all[p]);
  Polygon rim = rim_of(united);
  std::erase_if(rim, goes);
  if (rim.size() < 3) return;
  for (const auto p : numbers) cage.all[p].clear();
  cage.put(std::move(rim));
}

std::vector<std::uint32_t> with_edge(const Polygons& cage, const mesh::Edge& edge) {
  return cage.around(edge[0], [&](const Polygon& p) { return side_of(p, edge) < p.size(); });
}

// Triangles that are connected across edges with exactly two triangles. Removed in ascending order: open
// patches, then closed patches, each by area. Patches with `keep` stay.
struct Patch {
  bool keep = true, closed = true;
  double area = 0;

  auto operator<=>(const Patch&) const = default;
};

// Returns the polygons of the next patch to remove. If all patches can stay, returns no polygons.
std::vector<std::uint32_t> polygons_of_fin(const Surface& cage) {
  const auto table = mesh::half_edges(cage.positions.size(), mesh::welded(cage).triangles);
  mesh::UnionFind patch_of(cage.triangles.size());
  mesh::for_inner_edges(table, [&](std::size_t, const mesh::HalfEdge& s, const mesh::HalfEdge& t) {
    patch_of.join(s.triangle, t.triangle);
  });
  std::vector<double> areas;
  for (std::uint32_t t = 0; t < cage.triangles.size(); ++t) {
    const auto [a, b, c] = mesh::corners_of(cage.positions, cage.triangles[t]);
    areas.push_back(mesh::has_area(a, b, c) ? mesh::norm(mesh::cross(b - a, c - a)) : 0);
    if (t > 0 && cage.triangle_polygon[t - 1] == cage.triangle_polygon[t]) patch_of.join(t - 1, t);
  }
  std::vector<Patch> patches(cage.triangles.size());
  for (std::uint32_t t = 0; t < areas.size(); ++t) patches[patch_of.find(t)].area += areas[t];
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto sides = table.of(e);
    const bool fin = sides.size() > 2 && sides.size() % 2 == 1 &&
                     std::ranges::all_of(sides, [&](const auto& side) { return areas[side.triangle] > 0; });
    for (const mesh::HalfEdge& side : sides) {
      Patch& patch = patches[patch_of.find(side.triangle)];
      patch.keep &= !fin;
      patch.closed &= sides.size() > 1;
    }
  }
  const auto first = std::ranges::min_element(patches);
  std::vector<std::uint32_t> polygons;
  for (std::uint32_t t = 0; t < areas.size(); ++t)
    if (!first->keep && patch_of.find(t) == first - patches.begin())
      polygons.push_back(cage.triangle_polygon[t]);
  return polygons;
}

}  // namespace

Edited split_edges(const Surface& surface, std::span<const mesh::Edge> edges) {
  Polygons cage(surface);
  std::vector<std::uint32_t> made;
  for (const mesh::Edge& edge : edges) {
    const std::uint32_t middle = cage.add_middle({edge[0], edge[1]});
    made.push_back(middle);
    for (const auto number : with_edge(cage, edge)) {
      const Polygon p = split(std::exchange(cage.all[number], {}), edge, middle);
      for (Polygon& t : triangles_of(cage, p)) cage.put(std::move(t));
    }
  }
  return cage.finish(made);
}

Edited cut_polygons(const Surface& surface, std::span<const std::uint32_t> polygons) {
  Polygons cage(surface);
  std::vector<std::uint32_t> made;
  for (const std::uint32_t number : polygons) {
    Polygon p = std::exchange(cage.all[number], {});
    if (!is_about_its_middle(cage, p)) {
      std::vector<Polygon> triangles = triangles_of(cage, p);
      const auto area = [&](const Polygon& t) { return mesh::norm(area_of(cage, t)); };
      const auto largest = std::ranges::max_element(triangles, {}, area);
      p = std::exchange(*largest, {});
      for (Polygon& t : triangles) cage.put(std::move(t));
    }
    made.push_back(cage.add_middle(p));
    for (std::size_t i = 0; i < p.size(); ++i) cage.put({made.back(), p[i], p[(i + 1) % p.size()]});
  }
  return cage.finish(made);
}

Edited merge_vertices(const Surface& surface, std::span<const std::uint32_t> vertices) {
  Polygons cage(surface);
  const std::uint32_t one = cage.add_middle({vertices.begin(), vertices.end()});
  const std::set<std::uint32_t> merged(vertices.begin(), vertices.end());
  for (std::size_t number = 0, count = cage.all.size(); number < count; ++number) {
    for (auto& v : cage.all[number]) v = merged.contains(v) ? one : v;
    cage.part_at(one, number);
  }
  return cage.finish({one});
}

Edited dissolve_vertices(const Surface& surface, std::span<const std::uint32_t> vertices) {
  Polygons cage(surface);
  for (const std::uint32_t v : vertices) {
    const auto at_v = [v](const Polygon& p) { return std::ranges::find(p, v) != p.end(); };
    unite(cage, cage.around(v, at_v), [v](std::uint32_t corner) { return corner == v; });
  }
  return cage.finish({});
}

Edited dissolve_edges(const Surface& surface, std::span<const mesh::Edge> edges) {
  Polygons cage(surface);
  for (const mesh::Edge& edge : edges)
    unite(cage, with_edge(cage, edge), [](std::uint32_t) { return false; });
  return cage.finish({});
}

Edited remove_polygons(const Surface& surface, std::span<const std::uint32_t> polygons) {
  Polygons cage(surface);
  for (const std::uint32_t p : polygons) cage.all[p].clear();
  return cage.finish({});
}

Surface without_fins(Surface cage) {
  for (auto fin = polygons_of_fin(cage); !fin.empty(); fin = polygons_of_fin(cage))
    cage = remove_polygons(cage, fin).surface;
  return cage;
}

Edited extrude(const Surface& surface, std::span<const std::uint32_t> polygons, double distance) {
  Polygons cage(surface);
  std::map<std::uint32_t, std::uint32_t> lifted;
  std::set<std::array<std::uint32_t, 2>> sides;
  Vec3 normal{0, 0, 0};
  double areas = 0;
  std::vector<Vec3> normals(surface.positions.size(), {0, 0, 0});
  for (const std::uint32_t number : polygons) {
    const Polygon& p = cage.all[number];
    const Vec3 area = area_of(cage, p);
    normal = normal + area;
    areas += mesh::norm(area);
    for (const auto v : p) normals[v] = normals[v] + area;
    for (std::size_t i = 0; i < p.size(); ++i) sides.insert({p[i], p[(i + 1) % p.size()]});
  }
  const double length = mesh::norm(normal);
  const bool together = length > 0.1 * areas;
  const auto up = [&](std::uint32_t v) {
    const Vec3& direction = together ? normal : normals[v];
    const double size = mesh::norm(direction);
    return size > 0 ? (distance / size) * direction : Vec3{0, 0, 0};
  };
  std::vector<std::uint32_t> made;
  for (const std::uint32_t number : polygons)
    for (auto& v : cage.all[number]) {
      const auto [place, is_new] = lifted.try_emplace(v, 0);
      if (is_new) {
        const Point at = cage.at(v) + up(v);
        made.push_back(place->second = cage.add(at, cage.origin(v)));
      }
      v = place->second;
    }
  for (const auto& [a, b] : sides) {
    if (!sides.contains({b, a})) cage.all.push_back({a, b, lifted.at(b), lifted.at(a)});
  }
  return cage.finish(made);
}

Edited subdivide(const Surface& surface) {
  Polygons cage(surface);
  std::map<mesh::Edge, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] = middles.try_emplace(edge_of(a, b), 0);
    if (is_new) place->second = cage.add_middle({a, b});
    return place->second;
  };
  std::vector<Polygon> finer;
  const auto add = [&](const Polygon& p) {
    const std::size_t n = p.size();
    const auto after = [&](std::size_t i) { return middle(p[i], p[(i + 1) % n]); };
    if (n == 3) finer.push_back({after(0), after(1), after(2)});
    const std::uint32_t center = n == 3 ? 0 : cage.add_middle(p);
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t before = after((i + n - 1) % n);
      if (n == 3) finer.push_back({p[i], after(i), before});
      if (n != 3) finer.push_back({p[i], after(i), center, before});
    }
  };
  for (const Polygon& p : std::exchange(cage.all, {})) {
    if (is_about_its_middle(cage, p)) {
      add(p);
    } else {
      std::ranges::for_each(triangles_of(cage, p), add);
    }
  }
  cage.all = std::move(finer);
  return cage.finish({});
}

Edited mirrored(const Surface& surface, const Plane& plane) {
  Polygons cage(surface);
  // Vertices that are nearer to the plane than this distance are moved onto the plane.
  const double near = 1e-3 * mesh::used_bounds(surface).diagonal();
  const auto height = [&](std::uint32_t v) { return mesh::dot(plane.normal, cage.at(v)) - plane.offset; };
  const auto count = static_cast<std::uint32_t>(surface.positions.size());
  for (std::uint32_t v = 0; v < count; ++v) {
    if (std::abs(height(v)) <= near) cage.move(v, cage.at(v) - height(v) * plane.normal);
  }
  const auto above = [&](std::uint32_t v) { return height(v) > 0.5 * near; };
  const auto below = [&](std::uint32_t v) { return height(v) < -0.5 * near; };
  // Goes from corner i in steps of `step` to the first corner outside the plane. True if it is above.
  const auto comes_out_above = [&](const Polygon& p, std::size_t i, std::size_t step) {
    while (!above(p[i]) && !below(p[i])) i = (i + step) % p.size();
    return above(p[i]);
  };
  std::map<mesh::Edge, std::uint32_t> cuts;
  const auto cut = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] = cuts.try_emplace(edge_of(a, b), 0);
    if (is_new) {
      const double t = height(a) / (height(a) - height(b));
      Origin origin = cage.origin(t < 0.5 ? a : b);
      place->second = cage.add(cage.at(a) + t * (cage.at(b) - cage.at(a)), std::move(origin));
    }
    return place->second;
  };
  std::vector<Polygon> half;
  const auto keep_above = [&](const Polygon& p) {
    if (std::ranges::none_of(p, above)) return;
    Polygon& kept = half.emplace_back();
    for (std::size_t i = 0; i < p.size(); ++i) {
      const std::uint32_t a = p[i], b = p[(i + 1) % p.size()];
      if (!below(a) && (comes_out_above(p, i, 1) || comes_out_above(p, i, p.size() - 1))) kept.push_back(a);
      if ((above(a) && below(b)) || (below(a) && above(b))) kept.push_back(cut(a, b));
    }
  };
  for (const Polygon& p : cage.all) {
    std::size_t rises = 0;  // edges that lead above the plane; if 2, the part above can be two pieces
    for (std::size_t i = 0; i < p.size(); ++i) rises += !above(p[i]) && above(p[(i + 1) % p.size()]);
    if (rises < 2) {
      keep_above(p);
    } else {
      std::ranges::for_each(triangles_of(cage, p), keep_above);
    }
  }
  std::map<std::uint32_t, std::uint32_t> images;
  const auto image = [&](std::uint32_t v) {
    if (!above(v)) return v;
    const auto [place, is_new] = images.try_emplace(v, 0);
    if (is_new) {
      const Point at = cage.at(v) - (2 * height(v)) * plane.normal;
      place->second = cage.add(at, {cage.origin(v).of, true});
    }
    return place->second;
  };
  cage.all = half;
  for (const Polygon& p : half) {
    Polygon turned;
    turned.push_back(image(p.front()));  // same first corner, so that the triangulation is mirrored
    for (std::size_t i = p.size() - 1; i > 0; --i) turned.push_back(image(p[i]));
    cage.all.push_back(std::move(turned));
  }
  return cage.finish({});
}

}  // namespace viete::cages
