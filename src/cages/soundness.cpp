#include "cages/soundness.h"

#include <utility>

#include "cages/subject.h"
#include "mesh/defects.h"
#include "mesh/summary.h"
#include "mesh/triangle_tree.h"
#include "mesh/triangulation.h"
#include "mesh/union_find.h"

namespace viete::cages {

namespace {

std::vector<std::uint32_t> one_vertex_a_part(std::size_t vertices,
                                             std::span<const mesh::Triangle> triangles) {
  mesh::UnionFind parts = mesh::parts_by_triangles(vertices, triangles);
  std::vector<std::uint8_t> taken(vertices, 0);
  std::vector<std::uint32_t> firsts;
  for (const auto& t : triangles) {
    if (!std::exchange(taken[parts.find(t[0])], std::uint8_t{1})) firsts.push_back(t[0]);
  }
  return firsts;
}

constexpr int most_rounds = 24;

class MarginKeeper {
public:
  MarginKeeper(WorkingCage& cage, double margin, base::Progress* progress)
      : cage_(cage), mesh_(cage.connectivity()), margin_(margin), progress_(progress) {}

  std::size_t run() {
    stale_.assign(mesh_.n_faces(), 1);
    near_.assign(mesh_.n_faces(), 0);
    for (int i = 0;; ++i) {
      const auto report = [&] {
        if (progress_) progress_->report(static_cast<double>(i) / (most_rounds + 1));
      };
      const std::size_t found = look(report);
      if (found == 0 || i == most_rounds || !push_all(report)) return found;
    }
  }

private:
  // Returns the number of triangles that are too near. Writes the directions for their vertices to away_.
  template <class Report>
  std::size_t look(Report&& report) {
    away_.assign(mesh_.n_vertices(), {0, 0, 0});
    std::size_t found = 0;
    for (auto f = mesh_.faces_sbegin(); f != mesh_.faces_end(); ++f) {
      const auto number = static_cast<std::size_t>(f->idx());
      if (std::exchange(stale_[number], std::uint8_t{0})) {
        report();
        near_[number] = cage_.is_near_model(*f, margin_);
      }
      if (!near_[number]) continue;
      ++found;
      const Vec3 n = cage_.normal(*f);
      for (const auto v : cage_.vertices(*f)) away_[v] = away_[v] + (1 / mesh::norm(n)) * n;
    }
    return found;
  }

  // Moves vertices away from the model. If no vertex can move, returns false.
  template <class Report>
  bool push_all(Report&& report) {
    bool moved = false;
    for (auto v = mesh_.vertices_sbegin(); v != mesh_.vertices_end(); ++v) {
      Vec3 along = away_[static_cast<std::size_t>(v->idx())];
      cage_.star_of(*v, star_);
      if (star_.on_mirror) along[0] = 0;
      const double length = mesh::norm(along);
      if (!(length > 0)) continue;
      report();
      moved |= push(*v, (1 / length) * along);
      moved |= push(*v, cage_.outward(star_));
    }
    return moved;
  }

  bool push(VertexId v, const Vec3& along) {
    constexpr Shape any_shape{0.01, -0.95, 64};
    for (const double t : {0.2, 0.05}) {
      const Point place = cage_.at(v) + (t * margin_) * along;
      if (!cage_.fits(star_, place, any_shape)) continue;
      cage_.move(v, place);
      for (const FaceId f : star_.replaced) stale_[static_cast<std::size_t>(f.idx())] = 1;
      return true;
    }
    return false;
  }

  WorkingCage& cage_;
  Connectivity& mesh_;
  double margin_;
  base::Progress* progress_;
  Star star_;
  std::vector<Vec3> away_;           // one per vertex: the direction away from the model
  std::vector<std::uint8_t> stale_;  // 1 for a triangle that moved after the last check
  std::vector<std::uint8_t> near_;   // 1 for a triangle that was too near in the last check
};

}  // namespace

Soundness soundness(const mesh::Surface& cage, std::span<const mesh::Point> positions,
                    std::span<const mesh::Triangle> triangles, const mesh::TriangleTree& tree,
                    base::WorkerPool& pool, base::Progress* progress) {
  Soundness found;
  const mesh::Summary summary = mesh::summarize(cage);
  found.open_edges =
      summary.boundary_edges.size() + summary.nonmanifold_edges.size() + summary.misoriented_edges.size();
  found.pinched_vertices = mesh::nonmanifold_vertices(cage).size();
  const mesh::Surface split = mesh::split_at_centers(cage).surface;
  found.crossing = mesh::self_intersecting_triangles(split, progress);
  for (std::uint32_t t = 0; t < split.triangles.size(); ++t) {
    if (progress) progress->report(1);
    const mesh::Corners here = mesh::corners_of(split.positions, split.triangles[t]);
    if (mesh::has_plane(here) && tree.is_near(here)) found.cutting.push_back(t);
  }
  const auto firsts = one_vertex_a_part(positions.size(), triangles);
  const auto places = mesh::picked(positions, firsts);
  for (const auto i : mesh::points_outside(split, places, &pool)) found.outside.push_back(firsts[i]);
  return found;
}

Soundness soundness(const mesh::Surface& cage, const mesh::Surface& model, base::WorkerPool& pool) {
  const Frame frame = frame_of(model, std::nullopt);
  const FramedModel framed = model_in(frame, model);
  mesh::Surface around = cage;
  for (mesh::Point& p : around.positions) p = frame.into(p);
  const mesh::TriangleTree tree(framed.positions, framed.triangles);
  return soundness(around, framed.positions, framed.triangles, tree, pool);
}

std::size_t keep_margin(WorkingCage& cage, double margin, base::Progress* progress) {
  return MarginKeeper(cage, margin, progress).run();
}

}  // namespace viete::cages
