#include "cages/collapse.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

namespace viete::cages {

namespace {

// The weighted sum of squared distances from x to planes and points: x^T * a * x - 2 * b^T * x + c.
struct Quadric {
  std::array<double, 6> a{};  // the entries xx, xy, xz, yy, yz and zz of a symmetric matrix
  Vec3 b{};
  double c = 0;

  void add_plane(const Vec3& unit, const Point& on, double weight) {
    const double d = mesh::dot(unit, on);
    a[0] += weight * unit[0] * unit[0];
    a[1] += weight * unit[0] * unit[1];
    a[2] += weight * unit[0] * unit[2];
    a[3] += weight * unit[1] * unit[1];
    a[4] += weight * unit[1] * unit[2];
    a[5] += weight * unit[2] * unit[2];
    b = b + (weight * d) * unit;
    c += weight * d * d;
  }
  void add_point(const Point& p, double weight) {
    for (const std::size_t k : {0, 3, 5}) a[k] += weight;
    b = b + weight * p;
    c += weight * mesh::squared_norm(p);
  }
  void add(const Quadric& other) {
    for (std::size_t k = 0; k < 6; ++k) a[k] += other.a[k];
    b = b + other.b;
    c += other.c;
  }
  double operator()(const Point& x) const {
    const double xax = a[0] * x[0] * x[0] + a[3] * x[1] * x[1] + a[5] * x[2] * x[2] +
                       2 * (a[1] * x[0] * x[1] + a[2] * x[0] * x[2] + a[4] * x[1] * x[2]);
    return std::max(0.0, xax - 2 * mesh::dot(b, x) + c);
  }
  // The matrix has an inverse, because add_point() makes it positive definite.
  Point minimum() const {
    const Vec3 r0{a[0], a[1], a[2]}, r1{a[1], a[3], a[4]}, r2{a[2], a[4], a[5]};
    const Vec3 c0 = mesh::cross(r1, r2), c1 = mesh::cross(r2, r0), c2 = mesh::cross(r0, r1);
    return (1 / mesh::dot(r0, c0)) * (b[0] * c0 + b[1] * c1 + b[2] * c2);
  }
};

// Shape limits. Each entry permits worse triangles than the previous entry.
constexpr std::array<Shape, 3> shapes = {{{0.05, -0.8, 13}, {0.03, -0.85, 14}, {0.01, -0.95, 16}}};

struct Candidate {
  double cost;
  int edge;
  std::uint32_t stamps;  // the cost is outdated if stamps_of() the edge now returns another value
  bool placed;           // true if the cost belongs to a position that fits
  Point place{};

  bool operator<(const Candidate& other) const {
    return cost > other.cost || (cost == other.cost && edge > other.edge);
  }
};

class Collapse {
public:
  Collapse(WorkingCage& cage, std::size_t triangles, Accuracy accuracy, base::Progress* progress)
      : cage_(cage),
        mesh_(cage.connectivity()),
        target_(triangles),
        accuracy_(accuracy),
        progress_(progress),
        start_(cage.face_count()),
        quadrics_(cage.vertex_slots()),
        stamps_(cage.vertex_slots(), 0) {
    for (auto f = mesh_.faces_sbegin(); f != mesh_.faces_end(); ++f) add_face(*f);
  }

  bool run() {
    for (const Shape& shape : shapes) {
      if (cage_.face_count() <= target_) return true;
      shape_ = shape;
      queue_ = {};
      blocked_.assign(mesh_.n_edges(), 0);
      for (auto e = mesh_.edges_sbegin(); e != mesh_.edges_end(); ++e) {
        report();
        push(*e);
      }
      while (!queue_.empty() && cage_.face_count() > target_) {
        report();
        const Candidate next = queue_.top();
        queue_.pop();
        consider(next);
      }
    }
    return cage_.face_count() <= target_;
  }

private:
  void report() const {
    if (!progress_) return;
    const auto gone = static_cast<double>(start_ - cage_.face_count());
    progress_->report(gone / static_cast<double>(start_ - std::min(target_, start_) + 2));
  }

  Quadric& quadric(VertexId v) { return quadrics_[static_cast<std::size_t>(v.idx())]; }
  std::uint32_t& stamp(VertexId v) { return stamps_[static_cast<std::size_t>(v.idx())]; }

  void add_face(FaceId f) {
    const Vec3 n = cage_.normal(f);
    const double length = mesh::norm(n);
    if (!(length > 0)) return;
    const double area = 0.5 * length;
    for (auto v = mesh_.fv_iter(f); v.is_valid(); ++v) {
      quadric(*v).add_plane((1 / length) * n, cage_.at(*v), area / 3);
      // In flat regions, the distances to the corners keep the triangles even.
      quadric(*v).add_point(cage_.at(*v), 1e-3 * area / 3);
    }
  }

  std::uint32_t stamps_of(Connectivity::EdgeHandle e) {
    const auto h = mesh_.halfedge_handle(e, 0);
    return stamp(mesh_.from_vertex_handle(h)) + stamp(mesh_.to_vertex_handle(h));
  }

  // Returns the half-edge whose `to` vertex remains. If one end is on the mirror plane, this end remains.
  HalfEdgeId direction(Connectivity::EdgeHandle e) const {
    const auto h = mesh_.halfedge_handle(e, 0);
    return mesh_.is_boundary(mesh_.from_vertex_handle(h)) ? mesh_.opposite_halfedge_handle(h) : h;
  }

  Quadric joined(HalfEdgeId h) {
    Quadric q = quadric(mesh_.from_vertex_handle(h));
    q.add(quadric(mesh_.to_vertex_handle(h)));
    return q;
  }

  Point best_place(const Quadric& q, bool on_mirror) {
    if (!on_mirror) return q.minimum();
    Quadric flat = q;
    flat.add_plane({1, 0, 0}, {0, 0, 0}, 1e3 * (q.a[0] + q.a[3] + q.a[5]));
    Point x = flat.minimum();
    x[0] = 0;
    return x;
  }

  void push(Connectivity::EdgeHandle e) {
    const HalfEdgeId h = direction(e);
    if (accuracy_ == Accuracy::volume) return push_placed(e, h);
    const Quadric q = joined(h);
    blocked_[static_cast<std::size_t>(e.idx())] = 0;
    queue_.push({price(q, best_place(q, mesh_.is_boundary(mesh_.to_vertex_handle(h)))), e.idx(), stamps_of(e),
                 false});
  }

  void push_placed(Connectivity::EdgeHandle e, HalfEdgeId h) {
    block(e);
    if (!mesh_.is_collapse_ok(h) || makes_chord(h)) return;
    auto place = find_place(h, joined(h));
    if (!place) return;
    for (int i = 0; i < 2; ++i) place = cage_.drawn_in(star_, *place, shape_);
    blocked_[static_cast<std::size_t>(e.idx())] = 0;
    queue_.push({cage_.added_volume(star_, *place), e.idx(), stamps_of(e), true, *place});
  }

  void consider_placed(const Candidate& next, HalfEdgeId h) {
    cage_.star_of(h, star_);
    if (!cage_.fits(star_, next.place, shape_)) return push_placed(mesh_.edge_handle(h), h);
    const VertexId to = mesh_.to_vertex_handle(h);
    const Quadric q = joined(h);
    cage_.collapse(h, next.place);
    quadric(to) = q;
    tighten_around(cage_, to);
    renew_wide(to);
  }

  // Computes the costs of all edges at the vertex's neighbours again, because tighten_around() moved them.
  void renew_wide(VertexId v) {
    ++stamp(v);
    std::vector<int> changed;
    for (auto neighbor = mesh_.cvv_iter(v); neighbor.is_valid(); ++neighbor) {
      ++stamp(*neighbor);
      for (auto e = mesh_.cve_iter(*neighbor); e.is_valid(); ++e) changed.push_back(e->idx());
    }
    std::ranges::sort(changed);
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (const int e : changed) push(Connectivity::EdgeHandle(e));
  }

  // True if the collapse makes an edge between two vertices on the mirror plane, inside the half cage. Such
  // an edge would coincide with its mirror image.
  bool makes_chord(HalfEdgeId h) const {
    const VertexId from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    if (!mesh_.is_boundary(to)) return false;
    const bool along = mesh_.is_boundary(mesh_.edge_handle(h));
    for (auto v = mesh_.cvv_iter(from); v.is_valid(); ++v) {
      if (*v == to || !mesh_.is_boundary(*v)) continue;
      const bool beside = mesh_.find_halfedge(to, *v).is_valid();
      if (along ? !mesh_.is_boundary(mesh_.edge_handle(mesh_.find_halfedge(from, *v))) : !beside) return true;
    }
    return false;
  }

  void consider(const Candidate& next) {
    const Connectivity::EdgeHandle e(next.edge);
    if (mesh_.status(e).deleted() || next.stamps != stamps_of(e)) return;
    const HalfEdgeId h = direction(e);
    if (!mesh_.is_collapse_ok(h) || makes_chord(h)) return block(e);
    if (accuracy_ == Accuracy::volume) return consider_placed(next, h);
    const Quadric q = joined(h);
    const auto place = find_place(h, q);
    if (!place) return block(e);
    const double cost = price(q, *place);
    const double rounding = 1e-9 * cost;
    if (!next.placed && !queue_.empty() && cost > 1.25 * next.cost + rounding && cost > queue_.top().cost) {
      queue_.push({cost, next.edge, next.stamps, true});
      return;
    }
    const VertexId to = mesh_.to_vertex_handle(h);
    cage_.collapse(h, *place);
    quadric(to) = q;
    ++stamp(to);
    renew(to);
  }

  // Returns the cost as a volume: the area * the root of the mean squared distance.
  static double price(const Quadric& q, const Point& x) {
    return std::sqrt(q(x) * (q.a[0] + q.a[3] + q.a[5]));
  }

  void block(Connectivity::EdgeHandle e) { blocked_[static_cast<std::size_t>(e.idx())] = 1; }

  // Updates the edges of the vertex, and the blocked edges of its neighbours.
  void renew(VertexId v) {
    for (auto e = mesh_.cve_iter(v); e.is_valid(); ++e) push(*e);
    for (auto neighbor = mesh_.cvv_iter(v); neighbor.is_valid(); ++neighbor)
      for (auto e = mesh_.cve_iter(*neighbor); e.is_valid(); ++e) {
        if (blocked_[static_cast<std::size_t>(e->idx())]) push(*e);
      }
  }

  // Returns the first fitting position: the quadric's minimum, a position farther outward, or an edge's end.
  std::optional<Point> find_place(HalfEdgeId h, const Quadric& q) {
    cage_.star_of(h, star_);
    const Point best = best_place(q, star_.on_mirror);
    if (cage_.fits(star_, best, shape_)) return best;
    Vec3 outward{0, 0, 0};
    double area = 0;
    for (const FaceId f : star_.replaced) {
      const Vec3 n = cage_.normal(f);
      outward = outward + n;
      area += mesh::norm(n);
    }
    if (star_.on_mirror) outward[0] = 0;
    const double length = mesh::norm(outward);
    if (length > 0.1 * area) {
      outward = (1 / length) * outward;
      const double most = std::sqrt(area);
      for (double t = 0.25 * cage_.step(), inside = 0; t < most; inside = t, t *= 2) {
        if (!cage_.fits(star_, best + t * outward, shape_)) continue;
        return best + halved(best, outward, inside, t) * outward;
      }
    }
    for (const VertexId end : {mesh_.to_vertex_handle(h), mesh_.from_vertex_handle(h)}) {
      if (star_.on_mirror && !mesh_.is_boundary(end)) continue;
      if (cage_.fits(star_, cage_.at(end), shape_)) return cage_.at(end);
    }
    return std::nullopt;
  }

  double halved(const Point& from, const Vec3& along, double bad, double good) {
    for (int i = 0; i < 2; ++i) {
      const double t = 0.5 * (bad + good);
      (cage_.fits(star_, from + t * along, shape_) ? good : bad) = t;
    }
    return good;
  }

  WorkingCage& cage_;
  Connectivity& mesh_;
  std::size_t target_;
  Accuracy accuracy_;
  base::Progress* progress_;
  std::size_t start_;
  Shape shape_;
  std::vector<Quadric> quadrics_;
  std::vector<std::uint32_t> stamps_;
  std::vector<std::uint8_t> blocked_;
  std::priority_queue<Candidate> queue_;
  Star star_;
};

}  // namespace

bool collapse_to(WorkingCage& cage, std::size_t triangles, Accuracy accuracy, base::Progress* progress) {
  return Collapse(cage, triangles, accuracy, progress).run();
}

namespace {

class Tightening {
public:
  explicit Tightening(WorkingCage& cage) : cage_(cage), mesh_(cage.connectivity()) {}

  void around(VertexId v) {
    for (auto neighbor = mesh_.cvv_iter(v); neighbor.is_valid(); ++neighbor) pull_in(*neighbor);
  }

  // Calls report(f) before each change. f is the finished fraction of the round.
  template <class Report>
  void round(Report&& report) {
    for (auto e = mesh_.edges_sbegin(); e != mesh_.edges_end(); ++e) {
      report(0);
      turn(*e);
    }
    const auto all = static_cast<double>(mesh_.n_vertices());
    for (auto v = mesh_.vertices_sbegin(); v != mesh_.vertices_end(); ++v) {
      if (mesh_.is_isolated(*v)) continue;
      report(v->idx() / all);
      even_out(*v);
      pull_in(*v);
    }
  }

private:
  // Returns shape limits that permit triangles about as bad as the current triangles around the vertex.
  Shape shape_for(VertexId v) {
    cage_.star_of(v, star_);
    Shape shape = {0.1, -0.75, 64};
    for (const FaceId f : star_.replaced)
      shape.least_quality = std::min(shape.least_quality, 0.9 * quality(cage_.corners(f)));
    for (auto e = mesh_.cve_iter(v); e.is_valid(); ++e)
      shape.least_cosine = std::min(shape.least_cosine, cosine(*e));
    for (const auto& [a, b] : star_.rim) {
      const auto h = mesh_.find_halfedge(VertexId(static_cast<int>(a)), VertexId(static_cast<int>(b)));
      shape.least_cosine = std::min(shape.least_cosine, cosine(mesh_.edge_handle(h)));
    }
    shape.least_cosine -= 0.02;
    return shape;
  }

  double cosine(Connectivity::EdgeHandle e) const {
    if (mesh_.is_boundary(e)) return 1;
    return mesh::cosine(cage_.normal(mesh_.face_handle(mesh_.halfedge_handle(e, 0))),
                        cage_.normal(mesh_.face_handle(mesh_.halfedge_handle(e, 1))));
  }

  void even_out(VertexId v) {
    const Shape shape = shape_for(v);
    const Point x = cage_.at(v);
    Point middle{0, 0, 0};
    double weight = 0;
    for (const auto& [a, b] : star_.rim) {
      middle = middle + cage_.at(a) + cage_.at(b);
      weight += 2;
    }
    const Vec3 n = cage_.outward(star_);
    Vec3 along = (1 / weight) * middle - x;
    if (star_.on_mirror) along[0] = 0;
    along = along - mesh::dot(along, n) * n;
    for (double t : {0.5, 0.2}) {
      if (!cage_.fits(star_, x + t * along, shape)) continue;
      cage_.move(v, x + t * along);
      return;
    }
  }

  void pull_in(VertexId v) {
    const Shape shape = shape_for(v);
    const Point x = cage_.at(v), to = cage_.drawn_in(star_, x, shape);
    if (to != x) cage_.move(v, to);
  }

  static double worth(const mesh::Corners& s, const mesh::Corners& t) {
    return std::min(quality(s), quality(t));
  }

  void turn(Connectivity::EdgeHandle e) {
    if (mesh_.is_boundary(e) || !mesh_.is_flip_ok(e)) return;
    const auto h = mesh_.halfedge_handle(e, 0), g = mesh_.halfedge_handle(e, 1);
    const VertexId a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
    const VertexId c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
    const VertexId d = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(g));
    if (mesh_.is_boundary(c) && mesh_.is_boundary(d)) return;
    if (mesh_.valence(a) <= 4 || mesh_.valence(b) <= 4 || mesh_.valence(c) >= 9 || mesh_.valence(d) >= 9)
      return;
    const Point &pa = cage_.at(a), &pb = cage_.at(b), &pc = cage_.at(c), &pd = cage_.at(d);
    const double before = worth({pa, pb, pc}, {pb, pa, pd});
    const double size =
        std::cbrt(mesh::squared_norm(pa - pb) * mesh::squared_norm(pc - pd) * mesh::squared_norm(pa - pc));
    // Six times the volume that the flip removes.
    const double lost = mesh::dot(pc - pa, mesh::cross(pb - pa, pd - pa));
    const double gain =
        worth({pa, pd, pc}, {pd, pb, pc}) - before + lost / std::max(std::pow(size, 1.5), 1e-300);
    if (gain < 0.08) return;
    Shape shape{std::min(0.3, before), std::min(-0.2, cosine(e)), 64};
    const auto number = [](VertexId v) { return static_cast<std::uint32_t>(v.idx()); };
    const std::array<mesh::Triangle, 2> now = {
        {{number(a), number(d), number(c)}, {number(d), number(b), number(c)}}};
    if (cage_.fits(now, {mesh_.face_handle(h), mesh_.face_handle(g)}, shape)) cage_.flip(e);
  }

  WorkingCage& cage_;
  Connectivity& mesh_;
  Star star_;
};

// A possible split of an edge: the volume that the split saves, the edge, and the position of the new vertex.
struct Split {
  double gain;
  int edge;
  Point place;
};

std::vector<Split> splits_of(WorkingCage& cage, base::Progress* progress) {
  const Shape shape{0.05, -0.8, 64};
  const Connectivity& mesh = cage.connectivity();
  std::vector<Split> splits;
  Star star;
  for (auto e = mesh.edges_sbegin(); e != mesh.edges_end(); ++e) {
    if (progress) progress->report(0);
    const auto h = mesh.halfedge_handle(*e, 0);
    const Point middle = 0.5 * (cage.at(mesh.from_vertex_handle(h)) + cage.at(mesh.to_vertex_handle(h)));
    cage.star_of(*e, star);
    Point place = cage.drawn_in(star, middle, shape);
    if (place == middle) continue;
    place = cage.drawn_in(star, place, shape);
    splits.push_back({-cage.added_volume(star, place), e->idx(), place});
  }
  std::ranges::sort(splits, [](const Split& a, const Split& b) {
    return a.gain > b.gain || (a.gain == b.gain && a.edge < b.edge);
  });
  return splits;
}

}  // namespace

void refine_to(WorkingCage& cage, std::size_t triangles, base::Progress* progress) {
  Connectivity& mesh = cage.connectivity();
  Star star;
  while (cage.face_count() < triangles) {
    const std::size_t before = cage.face_count();
    std::vector<std::uint8_t> changed(mesh.n_vertices() + triangles, 0);
    for (const Split& split : splits_of(cage, progress)) {
      const Connectivity::EdgeHandle e(split.edge);
      cage.star_of(e, star);
      if (cage.face_count() + star.replaced.size() > triangles) continue;
      const bool apart = std::ranges::none_of(
          star.rim, [&](const auto& edge) { return changed[edge[0]] || changed[edge[1]]; });
      if (!apart || !cage.fits(star, split.place, {0.05, -0.8, 64})) continue;
      for (const auto& edge : star.rim) changed[edge[0]] = changed[edge[1]] = 1;
      cage.split(e, split.place);
    }
    if (cage.face_count() == before) return;
  }
}

void tighten_around(WorkingCage& cage, VertexId v) {
  Tightening(cage).around(v);
}

void tighten(WorkingCage& cage, int rounds, base::Progress* progress) {
  Tightening tightening(cage);
  for (int i = 0; i < rounds; ++i) {
    tightening.round([&](double share) {
      if (progress) progress->report((i + share) / rounds);
    });
  }
}

}  // namespace viete::cages
