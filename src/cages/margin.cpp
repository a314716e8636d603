#include "cages/margin.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace viete::cages {

namespace {

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
  // Which triangles are too near, and where their corners should go.
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

  // False if none could move.
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
  std::vector<Vec3> away_;                  // of each vertex
  std::vector<std::uint8_t> stale_, near_;  // of each triangle: not looked at since it moved; too near then
};

}  // namespace

std::size_t keep_margin(WorkingCage& cage, double margin, base::Progress* progress) {
  return MarginKeeper(cage, margin, progress).run();
}

}  // namespace viete::cages
