#include "weights/surface_proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "mesh/point_index.h"
#include "mesh/point_tree.h"
#include "mesh/triangle.h"
#include "mesh/triangulation.h"
#include "mesh/union_find.h"
#include "pose/cage_state.h"
#include "weights/small_parts.h"

namespace viete::weights {

namespace {

using mesh::none;

constexpr double clustered_part = 0.8;  // fraction of the time that clustering takes
constexpr int most_halvings = 5;
// Number of rings to search around a cluster. With it, each vertex finds all clusters within its reach, so
// weights are continuous between clusters.
constexpr int rings = 4;
constexpr double least_mass = 0.15;  // share of a cell's area; smaller clusters join a neighbour
// If more vertices than one in this many are in parts without triangles between clusters, they are gathered.
constexpr std::size_t least_lost = 100;
constexpr double fit_reach = 1.9;  // radius of influence, in mean distances to the neighbours
// Added to the diagonal of the fit's matrix to limit extrapolation at tips. Relative to the sum of factors.
constexpr double ridge_linear = 7e-3, ridge_quadratic = 5e-3;
constexpr std::size_t gathered_share = 3;  // the target divided by the number of clusters of small parts
constexpr double reach_in_space = 1.15;    // like fit_reach, for clusters of small parts
constexpr double least_facing = 0.1;       // lower limit of the cosine between normals of cluster and vertex

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// Returns for each vertex a number that is not 0 if the vertex is on an open edge. Terms of closed edges
// cancel.
std::vector<std::uint64_t> on_open_edges(std::span<const mesh::Triangle> triangles, std::size_t vertices) {
  std::vector<std::uint64_t> sums(vertices, 0);
  for (const auto& [a, b, c] : triangles)
    for (const auto& [i, j] : {Pair{a, b}, Pair{b, c}, Pair{c, a}}) {
      sums[i] += mixed(j + 1);
      sums[j] -= mixed(i + 1);
    }
  return sums;
}

template <class T>
void sort_unique(std::vector<T>& all) {
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

/// Returns the vertices that handles own in the model or in one of its parts.
std::vector<std::uint32_t> owned_by_handles(const mesh::Surface& model,
                                            std::span<const mesh::Triangle> triangles,
                                            std::span<const std::uint32_t> place, const pose::Cage& cage,
                                            pose::Elements elements, base::WorkerPool& pool) {
  auto owned = owned_vertices(model, cage, elements, pool);
  auto sets = mesh::parts_by_triangles(place.size(), triangles);
  std::vector<std::uint32_t> number(place.size(), none);
  Bodies parts;
  for (const auto v : place) {
    auto& n = number[sets.find(v)];
    if (n == none) {
      n = static_cast<std::uint32_t>(parts.shares.size());
      parts.shares.push_back(0);
    }
    parts.of_vertex.push_back(n);
    parts.shares[n] += 1.0 / static_cast<double>(place.size());
  }
  if (parts.shares.size() > 1) own_in_bodies(owned, model, parts, cage, elements, pool);
  std::vector<std::uint32_t> all;
  for (std::size_t v = 0; v < place.size(); ++v)
    if (owned.owners[v] > 0) all.push_back(place[v]);
  return all;
}

/// Assigns vertices to connected pieces of grid cells.
class Clusters {
public:
  Clusters(const mesh::Surface& model, std::span<const mesh::Triangle> triangles)
      : model_(model), triangles_(triangles), level_(model.positions.size(), 0), masses_(level_.size(), 0) {
    low_ = mesh::used_bounds(model).low;
    for (const auto& t : triangles) {
      const double third = mesh::area(model.positions, t) / 3;
      area_ += 3 * third;
      for (const auto v : t) masses_[v] += third;
    }
  }

  /// Makes clusters for this cell size, and returns their number. Counts only clusters with area.
  std::size_t divide(double cell) {
    cell_ = cell;
    sets_.reset(level_.size());
    std::vector<std::uint64_t> cells(level_.size());
    for (std::uint32_t v = 0; v < cells.size(); ++v) cells[v] = cell_of(v);
    for (const auto& t : triangles_) {
      const std::array keys = {cells[t[0]], cells[t[1]], cells[t[2]]};
      for (std::size_t k = 0; k < 3; ++k) {
        if (keys[k] == keys[(k + 1) % 3]) sets_.join(t[k], t[(k + 1) % 3]);
      }
    }
    return join_small();
  }

  /// Halves the cells of clusters for the reasons in SurfaceProxy. `apart` has the vertices that handles own:
  /// they must be in different clusters. Returns false if no cell was halved.
  bool refine(std::span<const std::uint32_t> apart) {
    std::vector<std::uint64_t> met, cornered;
    std::vector<bool> has_triangle(level_.size(), false);
    for (const auto& t : triangles_) {
      const std::uint32_t a = sets_.find(t[0]), b = sets_.find(t[1]), c = sets_.find(t[2]);
      if (a == b && b == c) continue;
      const bool corner = a != b && b != c && c != a;
      auto& pairs = corner ? cornered : met;
      for (const auto& [i, j] : {Pair{a, b}, Pair{b, c}, Pair{c, a}})
        if (i != j) pairs.push_back(std::uint64_t{std::min(i, j)} << 32 | std::max(i, j));
      if (corner) has_triangle[a] = has_triangle[b] = has_triangle[c] = true;
    }
    sort_unique(met);
    sort_unique(cornered);
    std::vector<std::uint64_t> loose;
    std::ranges::set_difference(met, cornered, std::back_inserter(loose));
    std::vector<bool> coarse(level_.size(), false);
    for (const auto pair : loose) coarse[pair >> 32] = coarse[pair & 0xffffffff] = true;
    std::vector<std::uint32_t> held(level_.size(), none);
    for (const auto v : apart) {
      auto& first = held[sets_.find(v)];
      if (first != none && first != v) coarse[sets_.find(v)] = true;
      first = v;
    }
    bool any = false;
    for (std::uint32_t v = 0; v < level_.size(); ++v) {
      const auto set = sets_.find(v);
      if (masses_[v] > 0 && (coarse[set] || !has_triangle[set]) && level_[v] < most_halvings) {
        ++level_[v];
        any = true;
      }
    }
    return any;
  }

  std::uint32_t find(std::uint32_t v) { return sets_.find(v); }

  /// Makes clusters with the properties in SurfaceProxy: at most `target`, if that is possible.
  template <class Report>
  void make(std::size_t target, std::span<const std::uint32_t> apart, const Report& report) {
    sets_.reset(level_.size());
    if (!(area_ > 0)) return;
    double cell = std::sqrt(1.3 * area_ / static_cast<double>(target));
    const auto divided = [&] {
      report();
      return divide(cell);
    };
    for (int tries = 0; tries < 6; ++tries) {
      std::size_t count = divided();
      while (count <= target && refine(apart)) count = divided();
      if (count <= target) break;
      cell *= 1.03 * std::sqrt(static_cast<double>(count) / static_cast<double>(target));
    }
  }

  /// Marks the vertices of parts in which no triangle has corners in three clusters. Returns their number.
  std::size_t mark_lost(std::vector<bool>& lost) {
    auto parts = mesh::parts_by_triangles(level_.size(), triangles_);
    std::vector<bool> kept(level_.size(), false);
    for (const auto& t : triangles_) {
      const std::uint32_t a = sets_.find(t[0]), b = sets_.find(t[1]), c = sets_.find(t[2]);
      if (a != b && b != c && c != a) kept[parts.find(t[0])] = true;
    }
    std::size_t count = 0;
    for (const auto& t : triangles_) {
      if (kept[parts.find(t[0])]) continue;
      for (const auto v : t) {
        count += !lost[v];
        lost[v] = true;
      }
    }
    return count;
  }

private:
  std::uint64_t cell_of(std::uint32_t v) const {
    const double scale = (1u << level_[v]) / cell_;
    std::uint64_t key = level_[v];
    for (std::size_t i = 0; i < 3; ++i) {
      const double place = std::clamp((model_.positions[v][i] - low_[i]) * scale, 0.0, 1e15);  // unused: any
      key = key << 20 | (static_cast<std::uint64_t>(place) & 0xfffff);
    }
    return key;
  }

  std::size_t join_small() {
    std::vector<double> mass(level_.size(), 0);
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < level_.size(); ++v) mass[sets_.find(v)] += masses_[v];
    for (const double m : mass) count += m > 0;
    std::vector<std::uint32_t> best(level_.size(), none);
    const auto is_small = [&](std::uint32_t set) {
      return mass[set] * (1u << 2 * level_[set]) < least_mass * cell_ * cell_;
    };
    for (const auto& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = sets_.find(t[k]), b = sets_.find(t[(k + 1) % 3]);
        if (a == b) continue;
        for (const auto& [set, other] : {Pair{a, b}, Pair{b, a}}) {
          if (is_small(set) && (best[set] == none || mass[other] > mass[best[set]])) best[set] = other;
        }
      }
    for (std::uint32_t set = 0; set < best.size(); ++set) {
      if (best[set] != none && sets_.join(set, best[set])) --count;
    }
    return count;
  }

  const mesh::Surface& model_;
  std::span<const mesh::Triangle> triangles_;
  std::vector<std::uint8_t> level_;
  std::vector<double> masses_;
  mesh::UnionFind sets_;
  mesh::Point low_;
  double area_ = 0, cell_ = 0;
};

}  // namespace

SurfaceProxy::SurfaceProxy(const mesh::Surface& model, const pose::Cage* cage, pose::Elements elements,
                           std::size_t target, base::WorkerPool& pool, base::Progress* progress,
                           std::size_t most_gathered)
    : model_(model) {
  const auto place = mesh::lowest_in_place(model.positions);
  for (auto t : mesh::split_unsettled(model, 0).surface.triangles) {  // from the lowest vertices
    for (auto& v : t) v = place[v];
    if (!mesh::repeats_corner(t)) triangles_.push_back(t);
  }
  const auto has_area = [&](const auto& t) { return mesh::area(model.positions, t) > 0; };
  if (std::ranges::none_of(triangles_, has_area))
    throw base::Error("", "all triangles of the model have zero area; these weights need a surface",
                      "choose the weights \"inverse\", or another model");
  if (progress) progress->report(0.1);
  std::vector<std::uint32_t> owned;
  if (cage) owned = owned_by_handles(model, triangles_, place, *cage, elements, pool);
  std::vector<bool> small = in_small_parts(model_, triangles_, target);
  gathered_ = static_cast<std::size_t>(
      std::ranges::count_if(place, [&](auto v) { return static_cast<bool>(small[v]); }));
  if (gathered_ > most_gathered) return;
  cluster(target, std::move(small), place, owned, progress);
  place_clusters();
  triangles_ = {};
  if (progress) progress->report(0.9);
  if (cage) {
    move_to(owned);
    adopt_loose_vertices();
  }
  find_neighbours();
}

void SurfaceProxy::cluster(std::size_t target, std::vector<bool> small,
                           const std::vector<std::uint32_t>& place, std::span<const std::uint32_t> apart,
                           base::Progress* progress) {
  double left = 0.8;
  const auto report = [&] {
    if (progress) progress->report(0.9 - (left *= 0.85));
  };
  std::vector<mesh::Triangle> large;
  std::optional<Clusters> clusters;
  for (std::size_t lost = place.size(); lost * least_lost > place.size();) {
    large.clear();
    std::ranges::copy_if(triangles_, std::back_inserter(large), [&](const auto& t) { return !small[t[0]]; });
    clusters.emplace(model_, large);
    clusters->make(target, apart, report);
    std::vector<bool> marked = small;
    lost = clusters->mark_lost(marked);
    if (lost * least_lost > place.size()) small = std::move(marked);
  }
  std::vector<bool> used(place.size(), false);
  for (const auto& t : large) used[t[0]] = used[t[1]] = used[t[2]] = true;
  std::vector<std::uint32_t> number(place.size(), none);
  of_vertex_.assign(place.size(), none);
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (!used[place[v]]) continue;
    auto& n = number[clusters->find(place[v])];
    if (n == none) n = count++;
    of_vertex_[v] = n;
  }
  first_gathered_ = count;
  surface_.positions.resize(count);
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < place.size(); ++v)
    if (small[place[v]]) vertices.push_back(v);
  gathered_ = vertices.size();
  if (vertices.empty()) return;
  const Cells cells = cells_of(model_, vertices, target / gathered_share);
  for (std::size_t i = 0; i < vertices.size(); ++i) of_vertex_[vertices[i]] = count + cells.of_vertex[i];
  surface_.positions.resize(count + cells.count);
  cell_ = cells.size;
}

void SurfaceProxy::place_clusters() {
  auto& p = surface_.positions;
  const auto open = on_open_edges(triangles_, of_vertex_.size());
  std::vector<bool> has_open(p.size(), false);
  for (std::size_t v = 0; v < of_vertex_.size(); ++v)
    if (of_vertex_[v] != none && open[v]) has_open[of_vertex_[v]] = true;
  members_ = mesh::make_adjacency(p.size(), [&](const auto& add) {
    for (std::uint32_t v = 0; v < of_vertex_.size(); ++v)
      if (const auto c = of_vertex_[v]; c != none && (open[v] || !has_open[c])) add(c, v);
  });
  for (std::size_t c = 0; c < p.size(); ++c) {
    for (const auto v : members_.of(c)) p[c] = p[c] + model_.positions[v];
    p[c] = (1 / static_cast<double>(members_.of(c).size())) * p[c];
  }
  std::vector<mesh::Triangle> triangles;
  for (const auto& t : triangles_) {
    mesh::Triangle u = {of_vertex_[t[0]], of_vertex_[t[1]], of_vertex_[t[2]]};
    if (mesh::repeats_corner(u)) continue;
    std::ranges::rotate(u, std::ranges::min_element(u));
    triangles.push_back(u);
  }
  for (auto t : joints(p, first_gathered_, cell_)) {
    std::ranges::rotate(t, std::ranges::min_element(t));
    triangles.push_back(t);
  }
  sort_unique(triangles);
  surface_ = mesh::from_triangles(std::move(surface_.positions), triangles);
}

void SurfaceProxy::find_neighbours() {
  const auto& p = surface_.positions;
  normals_.assign(p.size(), Vec3{0, 0, 0});
  std::vector<std::vector<std::uint32_t>> ring(p.size());
  for (const auto& t : surface_.triangles) {
    const Vec3 normal = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    const bool gathers = *std::ranges::max_element(t) >= first_gathered_;
    for (std::size_t k = 0; k < 3; ++k) {
      if (gathers && t[k] < first_gathered_) continue;  // the surface is interpolated as without small parts
      normals_[t[k]] = normals_[t[k]] + normal;
      ring[t[k]].push_back(t[(k + 1) % 3]);
      ring[t[k]].push_back(t[(k + 2) % 3]);
    }
  }
  radii_.assign(p.size(), 0);
  for (std::size_t c = 0; c < p.size(); ++c) {
    sort_unique(ring[c]);
    for (const auto other : ring[c]) radii_[c] += norm(p[other] - p[c]);
    if (!ring[c].empty())
      radii_[c] *= (c < first_gathered_ ? fit_reach : reach_in_space) / static_cast<double>(ring[c].size());
    if (const double length = norm(normals_[c]); length > 0) normals_[c] = (1 / length) * normals_[c];
  }
  std::vector<double> extents(p.size(), 0);  // largest distance to a vertex of the cluster
  for (std::size_t v = 0; v < of_vertex_.size(); ++v) {
    if (of_vertex_[v] == none) continue;
    auto& extent = extents[of_vertex_[v]];
    extent = std::max(extent, norm(model_.positions[v] - p[of_vertex_[v]]));
  }
  std::vector<std::uint32_t> seen(p.size(), none), found;
  nearby_.clear();
  starts_ = {0};
  for (std::uint32_t c = 0; c < p.size(); ++c) {
    found = {c};
    seen[c] = c;
    std::size_t at = 0;
    for (int step = 0; step < rings; ++step)
      for (const std::size_t end = found.size(); at < end; ++at)
        for (const auto other : ring[found[at]])
          if (std::exchange(seen[other], c) != c) found.push_back(other);
    for (const auto other : found)
      if (norm(p[other] - p[c]) < radii_[other] + extents[c]) nearby_.push_back(other);
    starts_.push_back(static_cast<std::uint32_t>(nearby_.size()));
  }
}

// Moves clusters to owned vertices. ThinPlate then has springs at the same positions as without a proxy.
void SurfaceProxy::move_to(std::span<const std::uint32_t> owned) {
  std::vector<bool> used(surface_.positions.size(), false);
  for (const auto& t : surface_.triangles) used[t[0]] = used[t[1]] = used[t[2]] = true;
  for (const auto v : owned)
    if (used[of_vertex_[v]]) surface_.positions[of_vertex_[v]] = model_.positions[v];
}

// Assigns vertices without a triangle to the nearest cluster.
void SurfaceProxy::adopt_loose_vertices() {
  if (std::ranges::find(of_vertex_, none) == of_vertex_.end()) return;
  const mesh::PointTree tree(surface_.positions, mesh::first_numbers(surface_.positions.size()));
  for (std::size_t v = 0; v < of_vertex_.size(); ++v)
    if (of_vertex_[v] == none) of_vertex_[v] = tree.nearest(model_.positions[v]);
}

namespace {

// Sums of factor * x^i * y^j for i + j <= 4, at the index place_of(i, j).
using Powers = std::array<double, 15>;

constexpr std::size_t place_of(std::size_t i, std::size_t j) {
  return (i + j) * (i + j + 1) / 2 + j;
}

void add_powers(const std::array<double, 2>& place, double factor, Powers& sums) {
  Powers powers;
  powers[0] = factor;
  for (std::size_t d = 1; d <= 4; ++d) {
    for (std::size_t j = 0; j < d; ++j)
      powers[place_of(d - j, j)] = place[0] * powers[place_of(d - 1 - j, j)];
    powers[place_of(0, d)] = place[1] * powers[place_of(0, d - 1)];
  }
  for (std::size_t k = 0; k < powers.size(); ++k) sums[k] += powers[k];
}

// Returns the first column of the inverse of a positive definite matrix, by L D L^T. Replaces the matrix, of
// which only the lower triangle is read, by the factors.
template <std::size_t n>
std::array<double, n> first_of_inverse(double (&l)[n][n]) {
  double inverse[n];
  for (std::size_t k = 0; k < n; ++k) {
    inverse[k] = 1 / l[k][k];
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = l[i][k] * inverse[k];
      for (std::size_t j = k + 1; j <= i; ++j) l[i][j] -= factor * l[j][k];
    }
    for (std::size_t i = k + 1; i < n; ++i) l[i][k] *= inverse[k];
  }
  std::array<double, n> result{1};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) result[i] -= l[i][j] * result[j];
  for (std::size_t i = 0; i < n; ++i) result[i] *= inverse[i];
  for (std::size_t i = n; i-- > 0;)
    for (std::size_t j = i + 1; j < n; ++j) result[i] -= l[j][i] * result[j];
  return result;
}

// Solves the normal equations of the fit. The value of the fitted polynomial at the vertex is the sum of
// factor * value * (result[0] + result[1] * x + result[2] * y + result[3] * x^2 + ...) over the clusters.
std::array<double, 6> fitted_value(const Powers& sums) {
  constexpr std::size_t x[] = {0, 1, 0, 2, 1, 0}, y[] = {0, 0, 1, 0, 1, 2};
  double l[6][6];
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j <= i; ++j) l[i][j] = sums[place_of(x[i] + x[j], y[i] + y[j])];
  const double weight = l[0][0];
  for (std::size_t k = 1; k < 3; ++k) l[k][k] += ridge_linear * weight;
  for (const std::size_t k : {3, 5}) l[k][k] += ridge_quadratic * weight;
  l[4][4] += 0.5 * ridge_quadratic * weight;  // x * y: the result does not depend on the axes
  return first_of_inverse(l);
}

}  // namespace

void SurfaceProxy::terms(std::uint32_t vertex, std::vector<Term>& terms) const {
  const auto own = of_vertex_[vertex];
  const std::span near(nearby_.data() + starts_[own], nearby_.data() + starts_[own + 1]);
  const mesh::Point& p = model_.positions[vertex];
  terms.clear();
  Vec3 normal{0, 0, 0};
  double all = 0, radius = 0;
  for (const auto c : near) {
    const double part = squared_norm(surface_.positions[c] - p) / (radii_[c] * radii_[c]);
    if (!(part < 1)) continue;
    const double left = 1 - part;
    terms.push_back({c, left * left * left});
    normal = normal + terms.back().factor * normals_[c];
    all += terms.back().factor;
    radius += terms.back().factor * radii_[c];
  }
  const auto take_own = [&] { terms.assign(1, {own, 1}); };
  if (terms.size() < 3) return take_own();
  radius /= all;
  if (own >= first_gathered_) return fit_in_space(p, radius, terms);
  // u and v are axes of the tangent plane, divided by the mean radius of the clusters.
  const std::size_t least = static_cast<std::size_t>(
      std::ranges::min_element(normal, {}, [](double x) { return std::abs(x); }) - normal.begin());
  Vec3 axis{0, 0, 0};
  axis[least] = 1;
  Vec3 u = cross(normal, axis);
  const double length = norm(u);
  if (!(length > 0)) return take_own();
  u = (1 / (length * radius)) * u;
  const Vec3 v = (1 / norm(normal)) * cross(normal, u);
  std::array<std::array<double, 2>, 64> places;  // u and v coordinates of the clusters
  Powers sums{};
  terms.resize(std::min(terms.size(), places.size()));
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Vec3 d = surface_.positions[terms[i].cluster] - p;
    places[i] = {dot(u, d), dot(v, d)};
    terms[i].factor *= std::max(least_facing, dot(normals_[terms[i].cluster], normal) / norm(normal));
    add_powers(places[i], terms[i].factor, sums);
  }
  const auto fit = fitted_value(sums);
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto [x, y] = places[i];
    terms[i].factor *= fit[0] + x * (fit[1] + x * fit[3] + y * fit[4]) + y * (fit[2] + y * fit[5]);
  }
}

// Multiplies the factors by those of the value at p of a linear polynomial that is fitted to the clusters.
void SurfaceProxy::fit_in_space(const mesh::Point& p, double radius, std::vector<Term>& terms) const {
  const double scale = 1 / radius;
  double l[4][4] = {};
  for (const auto& [cluster, factor] : terms) {
    const Vec3 d = scale * (surface_.positions[cluster] - p);
    const double row[] = {1, d[0], d[1], d[2]};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j <= i; ++j) l[i][j] += factor * row[i] * row[j];
  }
  for (std::size_t k = 1; k < 4; ++k) l[k][k] += ridge_linear * l[0][0];
  const auto fit = first_of_inverse(l);
  for (auto& [cluster, factor] : terms)
    factor *= fit[0] + scale * dot({fit[1], fit[2], fit[3]}, surface_.positions[cluster] - p);
}

ProxyWeights::ProxyWeights(const mesh::Surface& model, const pose::Cage& cage,
                           const pose::Weighting& weighting, base::WorkerPool& pool, base::Progress* progress,
                           std::size_t clusters)
    : proxy_([&] {
        const base::ProgressPart part(progress, 0, clustered_part);
        return SurfaceProxy(model, &cage, weighting.elements, clusters, pool, progress);
      }()),
      handles_(handle_count(cage, weighting.elements)) {
  const base::ProgressPart rest(progress, clustered_part, 1);
  const SurfaceSystem system(proxy_.surface(), cage, weighting, pool, progress);
  const std::size_t n = proxy_.surface().positions.size();
  weights_.resize(n * handles_);
  const auto store = [&](const SurfaceSystem::Solved& solved) {
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t j = 0; j < solved.count; ++j)
        weights_[c * handles_ + solved.first + j] = static_cast<float>(std::max(solved.of(c)[j], 0.0));
  };
  system.solve(store, pool, progress);
  for (std::size_t c = 0; c < n; ++c) {
    const std::span row(weights_.data() + c * handles_, handles_);
    const auto sum = std::accumulate(row.begin(), row.end(), 0.0);
    for (float& w : row) w = static_cast<float>(static_cast<double>(w) / sum);
  }
}

void ProxyWeights::row(std::uint32_t vertex, std::span<double> row) const {
  thread_local std::vector<SurfaceProxy::Term> terms;
  proxy_.terms(vertex, terms);
  std::ranges::fill(row, 0.0);
  for (const auto& [cluster, factor] : terms) {
    const auto weights = of_cluster(cluster);
    for (std::size_t j = 0; j < row.size(); ++j) row[j] += factor * static_cast<double>(weights[j]);
  }
  normalise(row);  // corrects the rounding of the clusters' weights
}

}  // namespace viete::weights
