#include "bench/models.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>

#include "base/error.h"
#include "mesh/half_edges.h"
#include "mesh/summary.h"
#include "mesh/triangle.h"

namespace viete::bench {

namespace {

using mesh::cross, mesh::dot, mesh::Point;

// Returns points on a spiral from pole to pole (Fibonacci lattice).
std::vector<Point> directions(std::size_t count) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Point> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double r = std::sqrt(1 - z * z), a = golden * static_cast<double>(i);
    result[i] = {r * std::cos(a), r * std::sin(a), z};
  }
  return result;
}

bool sees(const std::vector<Point>& p, const mesh::Triangle& t, const Point& x) {
  return dot(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]), x - p[t[0]]) > 0;
}

// Returns the convex hull of the points. Adds the points one by one.
std::vector<mesh::Triangle> hull(const std::vector<Point>& p) {
  std::vector<mesh::Triangle> triangles = {{0, 1, 2}, {0, 2, 1}};
  for (std::uint32_t i = 3; i < p.size(); ++i) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> rim;
    const auto seen = std::stable_partition(triangles.begin(), triangles.end(),
                                            [&](const auto& t) { return !sees(p, t, p[i]); });
    for (auto t = seen; t != triangles.end(); ++t)
      for (int c = 0; c < 3; ++c) {
        const std::pair edge{(*t)[c], (*t)[(c + 1) % 3]};
        if (!rim.erase({edge.second, edge.first})) rim.insert(edge);
      }
    triangles.erase(seen, triangles.end());
    for (const auto& [a, b] : rim) triangles.push_back({a, b, i});
  }
  return triangles;
}

// If x is a non-negative combination of a triangle's corners, returns the coefficients.
std::optional<Point> in_cone(const std::vector<Point>& p, const mesh::Triangle& t, const Point& x) {
  const Point &a = p[t[0]], &b = p[t[1]], &c = p[t[2]];
  const double volume = dot(a, cross(b, c));
  const Point w{dot(x, cross(b, c)) / volume, dot(a, cross(x, c)) / volume, dot(a, cross(b, x)) / volume};
  if (w[0] < -1e-9 || w[1] < -1e-9 || w[2] < -1e-9) return std::nullopt;
  return w;
}

// Returns a radius for each direction: with corners at these radii, `triangles` enclose the model. A vertex
// with the coefficients w in a triangle (see in_cone()) needs corners with radii of at least w_0 + w_1 + w_2.
std::vector<double> radii_around(const mesh::Surface& model, const Point& center,
                                 const std::vector<Point>& directions,
                                 const std::vector<mesh::Triangle>& triangles) {
  std::vector<double> radii(directions.size(), 0.05 * mesh::bounds(model.positions).diagonal());
  std::size_t last = 0;
  for (const Point& v : model.positions) {
    const Point x = v - center;
    std::optional<Point> w;
    for (std::size_t n = 0; n < triangles.size() && !w; ++n) {
      const std::size_t t = (last + n) % triangles.size();
      if ((w = in_cone(directions, triangles[t], x))) last = t;
    }
    if (!w) continue;
    for (const auto corner : triangles[last])
      radii[corner] = std::max(radii[corner], (*w)[0] + (*w)[1] + (*w)[2]);
  }
  return radii;
}

mesh::Surface of_size(mesh::Surface model, std::size_t count) {
  while (count > 2 * model.positions.size()) model = subdivided(model);
  if (count == 0 || 2 * count > model.positions.size()) return model;
  std::vector<mesh::Triangle> kept;
  for (const auto& t : model.triangles)
    if (t[0] < count && t[1] < count && t[2] < count) kept.push_back(t);
  model.positions.resize(std::max<std::size_t>(count, 3));
  return mesh::from_triangles(std::move(model.positions), kept);
}

using mesh::norm, mesh::squared_norm;

bool has_area(std::span<const Point> p, const mesh::Triangle& t) {
  return mesh::has_area(p[t[0]], p[t[1]], p[t[2]]);
}

// The common apex of all tetrahedra is a vertex, so that models far from 0 lose no digits.
double volume_of(std::span<const Point> p, std::span<const mesh::Triangle> triangles) {
  const Point& apex = p[triangles[0][0]];
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += dot(p[a] - apex, cross(p[b] - apex, p[c] - apex));
  return sum / 6;
}

// Returns the angle between the normals of the triangles a b c and b a d, or 0 if they are coplanar.
double hinge_angle(std::span<const Point> p, const std::array<std::uint32_t, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  const Point edge = p[b] - p[a], n = cross(edge, p[c] - p[a]), m = cross(p[d] - p[a], edge);
  return std::atan2(dot(edge, cross(n, m)) / norm(edge), dot(n, m));
}

std::uint32_t opposite(const mesh::Triangle& t, const mesh::Edge& edge) {
  return *std::find_if(t.begin(), t.end(), [&](auto v) { return v != edge[0] && v != edge[1]; });
}

}  // namespace

document::Document open_model(const std::filesystem::path& model, const std::filesystem::path& cage) {
  document::Document document = document::open_document(model, cage);
  document::check_drawable(document);
  return document;
}

BenchModel::BenchModel(const ModelOptions& options) {
  const document::Document opened = open_model(options.model, options.cage);
  model = of_size(*opened.model().surface, options.count);
  if (opened.has_cage()) {
    cages = {opened.cage()};
    return;
  }
  for (const std::size_t faces : options.faces)
    cages.push_back(std::make_shared<const pose::Cage>(pose::make_cage(star_cage(model, faces))));
}

std::string without_prefix(const std::string& name, const std::string& prefix) {
  return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
}

mesh::Surface subdivided(const mesh::Surface& surface) {
  std::vector<Point> positions = surface.positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, fresh] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(positions.size()));
    if (fresh) {
      const Point p = positions[a], q = positions[b];
      positions.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
    }
    return at->second;
  };
  std::vector<mesh::Triangle> triangles;
  for (const auto& t : surface.triangles) {
    const auto a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    triangles.insert(triangles.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
  }
  return mesh::from_triangles(std::move(positions), triangles);
}

mesh::Surface star_cage(const mesh::Surface& model, std::size_t faces) {
  const auto unit = directions(faces / 2 + 2);
  const auto triangles = hull(unit);
  const Point center = mesh::bounds(model.positions).center();
  const auto radii = radii_around(model, center, unit, triangles);
  std::vector<Point> positions(unit.size());
  for (std::size_t i = 0; i < unit.size(); ++i)
    for (int k = 0; k < 3; ++k) positions[i][k] = center[k] + 1.06 * radii[i] * unit[i][k];
  return mesh::from_triangles(std::move(positions), triangles);
}

pose::Pose moderate_pose(const pose::Cage& cage) {
  const auto box = mesh::bounds(cage.surface.positions);
  const Point size = box.high - box.low, middle = box.center();
  const int z = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  const int x = (z + 1) % 3, y = (z + 2) % 3;
  std::mt19937_64 random(20160101);
  std::uniform_real_distribution<double> noise(-0.01 * cage.diagonal, 0.01 * cage.diagonal);
  pose::Pose pose = pose::rest_pose(cage);
  for (auto& p : pose.positions) {
    const double along = (p[z] - middle[z]) / size[z], twist = 0.8 * along, bend = 0.5 * along;
    const double u = p[x] - middle[x], v = p[y] - middle[y], w = 1.2 * (p[z] - middle[z]);
    const double a = u * std::cos(twist) - v * std::sin(twist), b = u * std::sin(twist) + v * std::cos(twist);
    p[x] = middle[x] + a * std::cos(bend) - w * std::sin(bend) + noise(random);
    p[z] = middle[z] + a * std::sin(bend) + w * std::cos(bend) + noise(random);
    p[y] = middle[y] + b + noise(random);
  }
  return pose;
}

RestModel::RestModel(const mesh::Surface& model) : positions_(model.positions), triangles_(model.triangles) {
  add_faces(model);
  add_hinges(model);
  const mesh::Summary summary = mesh::summarize(model);
  if (summary.closed() && summary.oriented()) volume_ = volume_of(positions_, triangles_);
}

void RestModel::add_faces(const mesh::Surface& model) {
  shares_.resize(positions_.size());
  for (const mesh::Triangle& t : model.triangles) {
    const auto face = analysis::flat_face(positions_, t);
    if (!face) {
      ++without_area_;
      continue;
    }
    faces_.push_back(*face);
    area_ += faces_.back().area();
    for (const auto corner : t) shares_[corner] += faces_.back().area();
  }
  if (faces_.empty())
    throw base::Error("", "all triangles of the model have zero area", "choose another model");
  for (double& share : shares_) share /= 3 * area_;
}

void RestModel::add_hinges(const mesh::Surface& model) {
  const mesh::HalfEdges table = mesh::half_edges(positions_.size(), model.triangles);
  mesh::for_inner_edges(table, [&](std::size_t e, const mesh::HalfEdge& s, const mesh::HalfEdge& t) {
    const mesh::Edge& edge = table.edges[e];
    const auto &first = model.triangles[s.triangle], &second = model.triangles[t.triangle];
    if (!has_area(positions_, first) || !has_area(positions_, second)) return;
    Hinge hinge{{edge[0], edge[1], opposite(first, edge), opposite(second, edge)}, 0, 0};
    hinge.weight = 3 * squared_norm(positions_[edge[1]] - positions_[edge[0]]) /
                   (mesh::area(positions_, first) + mesh::area(positions_, second));
    hinge.angle = hinge_angle(positions_, hinge.corners);
    hinges_.push_back(hinge);
  });
}

Distortion RestModel::distortion(std::span<const Point> positions) const {
  Distortion result;
  for (const analysis::FlatFace& f : faces_) {
    const auto [x, y] = analysis::plane_map(f, positions);  // columns of J in space
    const bool lost = !has_area(positions, f.corners);
    const double stretch = lost ? 0 : norm(cross(x, y));  // area ratio det J
    result.energy +=
        f.area() / area_ * ((squared_norm(x) + squared_norm(y)) * (1 + 1 / (stretch * stretch)) - 4);
    result.collapsed += lost;
  }
  if (result.collapsed) result.energy = std::numeric_limits<double>::infinity();
  return result;
}

double RestModel::bending(std::span<const Point> positions) const {
  double sum = 0;
  for (const Hinge& hinge : hinges_) {
    const double turned =
        std::remainder(hinge_angle(positions, hinge.corners) - hinge.angle, 2 * std::numbers::pi);
    sum += hinge.weight * turned * turned;
  }
  return sum;
}

double RestModel::volume(std::span<const Point> positions) const {
  return encloses() ? volume_of(positions, triangles_) / volume_ : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace viete::bench
