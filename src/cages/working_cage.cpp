#include "cages/working_cage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace viete::cages {

namespace {

constexpr std::size_t cells_along = 20;
constexpr std::uint32_t new_vertex = std::numeric_limits<std::uint32_t>::max();

VertexId vertex(std::uint32_t v) {
  return VertexId(static_cast<int>(v));
}

std::uint32_t number(VertexId v) {
  return static_cast<std::uint32_t>(v.idx());
}

double half_angle(const mesh::Corners& t, const Point& from) {
  return mesh::half_solid_angle(t[0] - from, t[1] - from, t[2] - from);
}

Vec3 normal_of(const mesh::Corners& t) {
  return mesh::cross(t[1] - t[0], t[2] - t[0]);
}

}  // namespace

double quality(const mesh::Corners& t) {
  const double sides =
      mesh::squared_norm(t[1] - t[0]) + mesh::squared_norm(t[2] - t[1]) + mesh::squared_norm(t[0] - t[2]);
  return sides > 0 ? 2 * std::sqrt(3.0) * mesh::norm(normal_of(t)) / sides : 0;
}

WorkingCage::WorkingCage(const Shell& shell, const mesh::TriangleTree& model, const Clearance& clearance,
                         double margin, std::span<const Point> enclosed)
    : positions_(shell.positions),
      model_(model),
      clearance_(clearance),
      margin_(margin),
      enclosed_(enclosed),
      faces_(shell.triangles.size()),
      placed_(shell.triangles.size()),
      cells_(cells_along * cells_along * cells_along) {
  connectivity_.request_vertex_status();
  connectivity_.request_edge_status();
  connectivity_.request_halfedge_status();
  connectivity_.request_face_status();
  connectivity_.reserve(positions_.size(), 3 * faces_ / 2 + 3, faces_);
  for (std::size_t v = 0; v < positions_.size(); ++v) connectivity_.add_vertex();
  for (const auto& t : shell.triangles) {
    const FaceId f = connectivity_.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
    assert(f.is_valid());
    place(f);
  }
}

mesh::Triangle WorkingCage::vertices(FaceId f) const {
  const auto h = connectivity_.halfedge_handle(f), next = connectivity_.next_halfedge_handle(h);
  return {number(connectivity_.from_vertex_handle(h)), number(connectivity_.to_vertex_handle(h)),
          number(connectivity_.to_vertex_handle(next))};
}

Vec3 WorkingCage::normal(FaceId f) const {
  return normal_of(corners(f));
}

void WorkingCage::star_of(VertexId v, Star& star) const {
  star.clear();
  for (auto h = connectivity_.cvoh_iter(v); h.is_valid(); ++h) {
    if (connectivity_.is_boundary(*h)) continue;
    const auto next = connectivity_.next_halfedge_handle(*h);
    star.rim.push_back(
        {number(connectivity_.to_vertex_handle(*h)), number(connectivity_.to_vertex_handle(next))});
    star.replaced.push_back(connectivity_.face_handle(*h));
  }
  star.on_mirror = connectivity_.is_boundary(v);
}

void WorkingCage::star_of(HalfEdgeId h, Star& star) const {
  star.clear();
  const VertexId ends[] = {connectivity_.to_vertex_handle(h), connectivity_.from_vertex_handle(h)};
  for (int i = 0; i < 2; ++i) {
    const std::uint32_t other = number(ends[1 - i]);
    for (auto out = connectivity_.cvoh_iter(ends[i]); out.is_valid(); ++out) {
      if (connectivity_.is_boundary(*out)) continue;
      const std::uint32_t a = number(connectivity_.to_vertex_handle(*out));
      const std::uint32_t b =
          number(connectivity_.to_vertex_handle(connectivity_.next_halfedge_handle(*out)));
      const bool shared = a == other || b == other;
      if (!shared) star.rim.push_back({a, b});
      if (!shared || i == 0) star.replaced.push_back(connectivity_.face_handle(*out));
    }
  }
  star.on_mirror = connectivity_.is_boundary(ends[0]) || connectivity_.is_boundary(ends[1]);
}

Vec3 WorkingCage::outward(const Star& star) const {
  Vec3 n{0, 0, 0};
  for (const FaceId f : star.replaced) n = n + normal(f);
  if (star.on_mirror) n[0] = 0;
  const double length = mesh::norm(n);
  return length > 0 ? (1 / length) * n : n;
}

Point WorkingCage::drawn_in(const Star& star, const Point& x, const Shape& shape) {
  double longest = 0;
  Point middle{0, 0, 0};
  for (const auto& [a, b] : star.rim) {
    longest = std::max(longest, mesh::norm(at(a) - x));
    middle = middle + (1.0 / static_cast<double>(star.rim.size())) * at(a);
  }
  const Vec3 inward = -1 * outward(star);
  Vec3 away = middle - x;
  if (star.on_mirror) away[0] = 0;
  const double far = mesh::norm(away);
  away = far > 0 ? (1 / far) * away : inward;
  const double before = added_volume(star, x);
  for (double t = 0.5 * longest; t > 0.05 * step(); t *= 0.5)
    for (const Vec3& along : {inward, away, 0.5 * (inward + away)}) {
      const Point to = x + t * along;
      if (added_volume(star, to) < before && fits(star, to, shape)) return to;
    }
  return x;
}

double WorkingCage::added_volume(const Star& star, const Point& x) const {
  double six = 0;  // six times the volume between x and the old triangles
  for (const FaceId f : star.replaced) {
    const mesh::Corners t = corners(f);
    six += mesh::dot(x - t[0], mesh::cross(t[1] - t[0], t[2] - t[0]));
  }
  return six / 6;
}

void WorkingCage::star_of(Connectivity::EdgeHandle e, Star& star) const {
  star.clear();
  for (const unsigned side : {0U, 1U}) {
    const auto h = connectivity_.halfedge_handle(e, side);
    if (connectivity_.is_boundary(h)) {
      star.on_mirror = true;
      continue;
    }
    const std::uint32_t a = number(connectivity_.from_vertex_handle(h)),
                        b = number(connectivity_.to_vertex_handle(h));
    const std::uint32_t c = number(connectivity_.to_vertex_handle(connectivity_.next_halfedge_handle(h)));
    star.rim.push_back({b, c});
    star.rim.push_back({c, a});
    star.replaced.push_back(connectivity_.face_handle(h));
  }
}

double WorkingCage::volume() const {
  double six = 0;
  for (auto f = connectivity_.faces_sbegin(); f != connectivity_.faces_end(); ++f) {
    const mesh::Corners t = corners(*f);
    six += mesh::dot(t[0], mesh::cross(t[1], t[2]));
  }
  return six / 6;
}

bool WorkingCage::fits(const Star& star, const Point& x, const Shape& shape) {
  if (star.rim.size() > shape.most_triangles) return false;
  if (mirrored() && !star.on_mirror && x[0] < 0.25 * step()) return false;
  if (clearance_.at(x) < margin_) return false;
  now_.clear();
  for (const auto& [a, b] : star.rim) {
    now_.push_back({{new_vertex, a, b}, {x, at(a), at(b)}});
    if (quality(now_.back().corners) < shape.least_quality) return false;
  }
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const auto [a, b] = star.rim[i];
    const Vec3 n = normal_of(now_[i].corners);
    // Tests the angles to two neighbours: the triangle across the rim, and the next new triangle.
    const auto across = connectivity_.opposite_face_handle(connectivity_.find_halfedge(vertex(a), vertex(b)));
    if (across.is_valid() && mesh::cosine(n, normal(across)) < shape.least_cosine) return false;
    for (std::size_t j = 0; j < now_.size(); ++j) {
      if (star.rim[j][0] == b && mesh::cosine(n, normal_of(now_[j].corners)) < shape.least_cosine)
        return false;
    }
  }
  for (const auto& t : now_) {
    if (!clearance_.is_clear(t.corners, margin_)) return false;
  }
  return !passes_over_a_point(star.replaced) && !crosses(now_, star.replaced) &&
         std::ranges::none_of(now_, [&](const auto& t) { return is_near_model(t.corners, exact_margin_); });
}

bool WorkingCage::fits(const std::array<mesh::Triangle, 2>& now, const std::array<FaceId, 2>& replaced,
                       const Shape& shape) {
  now_.clear();
  for (const auto& t : now) now_.push_back({t, corners(t)});
  for (const auto& t : now_) {
    if (quality(t.corners) < shape.least_quality || !clearance_.is_clear(t.corners, margin_)) return false;
  }
  if (mesh::cosine(normal_of(now_[0].corners), normal_of(now_[1].corners)) < shape.least_cosine) return false;
  return !passes_over_a_point(replaced) && !crosses(now_, replaced) &&
         std::ranges::none_of(now_, [&](const auto& t) { return is_near_model(t.corners, exact_margin_); });
}

// Triangles with a common edge do not intersect: the least cosine excludes folded triangles. Triangles with
// one common vertex intersect if, in one triangle, the side opposite the vertex crosses the other triangle.
bool WorkingCage::cross(const Candidate& s, const Candidate& t) {
  int shared = 0;
  std::size_t of_s = 0, of_t = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (s.vertices[i] != t.vertices[j]) continue;
      ++shared;
      of_s = i;
      of_t = j;
    }
  if (shared == 0) return mesh::intersect(s.corners, t.corners);
  if (shared > 1) return false;
  return mesh::crosses(s.corners[(of_s + 1) % 3], s.corners[(of_s + 2) % 3], t.corners) ||
         mesh::crosses(t.corners[(of_t + 1) % 3], t.corners[(of_t + 2) % 3], s.corners);
}

template <class Visit>
void WorkingCage::for_cells(const mesh::Bounds& box, Visit&& visit) const {
  const Grid& grid = clearance_.grid();
  Index3 low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    const double scale = cells_along / (grid.step * static_cast<double>(grid.size[k]));
    const auto cell = [&](double x) {
      return static_cast<std::size_t>(
          std::max(0.0, std::min((x - grid.origin[k]) * scale, cells_along - 1.0)));
    };
    low[k] = cell(box.low[k]);
    high[k] = cell(box.high[k]);
  }
  for_box(low, high, [&](std::size_t i, std::size_t j, std::size_t k) {
    visit((k * cells_along + j) * cells_along + i);
  });
}

void WorkingCage::place(FaceId f) {
  take_away(f);
  const auto number = static_cast<std::uint32_t>(f.idx());
  Placed& placed = placed_[number];
  placed.triangle = {vertices(f), corners(f)};
  placed.box = mesh::bounds(placed.triangle.corners);
  placed.is_placed = true;
  for_cells(placed.box, [&](std::size_t cell) { cells_[cell].push_back(number); });
}

void WorkingCage::take_away(FaceId f) {
  const auto number = static_cast<std::uint32_t>(f.idx());
  Placed& placed = placed_[number];
  if (!std::exchange(placed.is_placed, false)) return;
  for_cells(placed.box, [&](std::size_t cell) { std::erase(cells_[cell], number); });
}

bool WorkingCage::crosses(std::span<const Candidate> now, std::span<const FaceId> replaced) {
  for (std::size_t i = 0; i < now.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (cross(now[i], now[j])) return true;
    }
  for (const auto& t : now) {
    ++question_;
    for (const FaceId f : replaced) placed_[static_cast<std::size_t>(f.idx())].seen = question_;
    const mesh::Bounds box = mesh::bounds(t.corners);
    bool crossed = false;
    for_cells(box, [&](std::size_t cell) {
      if (crossed) return;
      for (const std::uint32_t f : cells_[cell]) {
        Placed& other = placed_[f];
        if (std::exchange(other.seen, question_) == question_) continue;
        if (mesh::meet(other.box, box) && cross(t, other.triangle)) crossed = true;
      }
    });
    if (crossed) return true;
  }
  return false;
}

// True if an enclosed point is between the triangles in now_ and the replaced triangles. Together, these
// triangles form a closed surface. Half of its solid angle is +-2 pi from inside, and 0 from outside.
bool WorkingCage::passes_over_a_point(std::span<const FaceId> replaced) const {
  if (enclosed_.empty()) return false;
  mesh::Bounds box = mesh::bounds(now_.front().corners);
  const auto widen = [&](const mesh::Corners& t) {
    for (const Point& p : t) mesh::extend(box, p);
  };
  for (const auto& t : now_) widen(t.corners);
  for (const FaceId f : replaced) widen(corners(f));
  return std::ranges::any_of(enclosed_, [&](Point p) {
    if (mirrored()) p[0] = std::abs(p[0]);
    if (!mesh::meet(box, {p, p})) return false;
    const auto halves_at = [&](const Point& from) {
      double halves = 0;
      for (const auto& t : now_) halves += half_angle(t.corners, from);
      for (const FaceId f : replaced) halves -= half_angle(corners(f), from);
      return halves;
    };
    const double halves = halves_at(p) + (mirrored() ? halves_at({-p[0], p[1], p[2]}) : 0);
    return std::abs(halves) > std::numbers::pi;
  });
}

// Tests the model itself, because the clearance misses details that are thinner than a grid cell.
bool WorkingCage::is_near_model(const mesh::Corners& t, double distance) const {
  if (!mesh::has_plane(t) || model_.is_near(t, distance)) return true;
  if (!mirrored()) return false;
  mesh::Corners image = t;
  for (Point& p : image) p[0] = -p[0];
  return model_.is_near(image, distance);
}

void WorkingCage::move(VertexId v, const Point& x) {
  positions_[static_cast<std::size_t>(v.idx())] = x;
  for (auto f = connectivity_.cvf_iter(v); f.is_valid(); ++f) place(*f);
}

void WorkingCage::collapse(HalfEdgeId h, const Point& x) {
  const VertexId v = connectivity_.to_vertex_handle(h);
  for (const HalfEdgeId side : {h, connectivity_.opposite_halfedge_handle(h)}) {
    if (connectivity_.is_boundary(side)) continue;
    take_away(connectivity_.face_handle(side));
    --faces_;
  }
  connectivity_.collapse(h);
  move(v, x);
}

void WorkingCage::flip(Connectivity::EdgeHandle e) {
  connectivity_.flip(e);
  for (const int side : {0, 1}) {
    place(connectivity_.face_handle(connectivity_.halfedge_handle(e, static_cast<unsigned>(side))));
  }
}

VertexId WorkingCage::split(Connectivity::EdgeHandle e, const Point& x) {
  const VertexId v = connectivity_.add_vertex();
  faces_ += connectivity_.is_boundary(e) ? 1 : 2;
  connectivity_.split(e, v);
  positions_.push_back(x);
  placed_.resize(connectivity_.n_faces());
  move(v, x);
  return v;
}

Shell WorkingCage::shell() const {
  Shell shell;
  std::vector<std::uint32_t> numbers(positions_.size(), 0);
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    const VertexId id(static_cast<int>(v));
    if (connectivity_.status(id).deleted() || connectivity_.is_isolated(id)) continue;
    numbers[v] = static_cast<std::uint32_t>(shell.positions.size());
    shell.positions.push_back(positions_[v]);
  }
  for (auto f = connectivity_.faces_sbegin(); f != connectivity_.faces_end(); ++f) {
    auto v = connectivity_.cfv_iter(*f);
    mesh::Triangle t;
    for (auto& corner : t) corner = numbers[static_cast<std::size_t>((*v++).idx())];
    shell.triangles.push_back(t);
  }
  return shell;
}

}  // namespace viete::cages
