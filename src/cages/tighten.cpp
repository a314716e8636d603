#include "cages/collapse.h"

#include <algorithm>
#include <cmath>

namespace viete::cages {

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
