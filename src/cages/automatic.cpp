#include "cages/automatic.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/quantity.h"
#include "cages/clearance.h"
#include "cages/collapse.h"
#include "cages/extraction.h"
#include "cages/frame.h"
#include "cages/hull.h"
#include "cages/margin.h"
#include "cages/quads.h"
#include "cages/soundness.h"
#include "cages/tighten.h"
#include "mesh/union_find.h"

namespace viete::cages {

namespace {

// How many parts and handles a closed shell has.
struct Topology {
  std::size_t parts = 0;
  std::size_t handles = 0;
};

Topology topology_of(const Shell& shell) {
  mesh::UnionFind parts(shell.positions.size());
  for (const auto& t : shell.triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[1], t[2]);
  }
  Topology found;
  for (std::uint32_t v = 0; v < shell.positions.size(); ++v) found.parts += parts.find(v) == v ? 1 : 0;
  const std::size_t euler_and_faces = shell.positions.size();  // V = E - F + 2 parts - 2 handles, 2 E = 3 F
  found.handles = (2 * found.parts + shell.triangles.size() / 2 - euler_and_faces) / 2;
  return found;
}

// Each stage is reported as what leads up to its end: it never falls, however many attempts there are.
class Stages {
public:
  explicit Stages(base::Progress* progress) : progress_(progress) { begin(); }

  // Another attempt, in what is left.
  void begin() { from_ = progress_ ? progress_->done() : 0; }
  base::Progress* until(double end) {
    if (progress_) progress_->section(progress_->done(), from_ + end * (1 - from_));
    return progress_;
  }

private:
  base::Progress* progress_;
  double from_ = 0;
};

class Making {
public:
  Making(const Subject& subject, const Wish& wish, base::WorkerPool& pool, base::Progress* progress)
      : wish_(wish),
        mirror_(subject.mirror),
        frame_(subject.frame),
        model_(subject.model),
        tree_(subject.tree),
        pool_(pool),
        stages_(progress),
        target_(mirror_ ? wish.triangles / 2 : wish.triangles) {
    // A cell is about an eighth as wide as the triangles will be.
    const double share = is_preview() ? 0.65 : 1;
    const double cells = share * std::clamp(4 * std::sqrt(static_cast<double>(wish.triangles)), 40.0, 128.0);
    cells_ = static_cast<std::size_t>(cells);
    step_ = mesh::largest_abs(model_.box.high - model_.box.low) / cells;
  }

  Made make() {
    constexpr int attempts = 12;
    double gap = wish_.gap, margin = std::max(wish_.margin, 0.1 * step_);
    for (int attempt = 0; attempt < attempts; ++attempt) {
      stages_.begin();
      if (const auto shell = try_with(margin, gap)) return finish(*shell, mirror_.has_value(), gap);
      gap = std::max(1.6 * gap, 0.5 * step_);
    }
    made_.notes.push_back(
        "no cage of " + base::counted(wish_.triangles, "triangle") +
        " that follows the model was found: this is its convex hull; ask for more triangles");
    return hulled();
  }

  Made hulled() { return finish(simplified(hull(model_.positions, wish_.margin)), false, wish_.gap); }

private:
  bool is_preview() const { return wish_.effort == Effort::preview; }

  // Nothing if there is no sound cage of that size.
  std::optional<Shell> try_with(double margin, double gap) {
    const Closing closing{margin + 0.6 * step_, gap};
    const Grid grid = grid_around(model_.box, cells_, closing.offset + closing.gap, mirror_.has_value());
    const Clearance field = clearance({tree_, model_.closed}, grid, closing, pool_, stages_.until(0.1));
    const Shell shell = extract(field, closing.offset);
    const Topology topology = topology_of(mirror_ ? whole(shell) : shell);
    if (!first_) first_ = topology;
    last_ = topology;
    if (topology.parts > 1 + wish_.triangles / 40 || topology.handles > wish_.triangles / 30)
      return std::nullopt;
    WorkingCage cage(shell, tree_, field, margin);
    auto made = reduced(cage, field);
    return made && is_sound(*made, mirror_.has_value()) ? made : std::nullopt;
  }

  // Drawn in between, so that what is enclosed more than needed does not mislead what follows.
  std::optional<Shell> reduced(WorkingCage& cage, const Clearance& field) {
    const auto extra = [&](double share, double most) {
      return target_ + static_cast<std::size_t>(std::min(share * static_cast<double>(target_), most));
    };
    if (is_preview()) {
      collapse_to(cage, extra(1.5, 400), Accuracy::quadrics, stages_.until(0.5));
      tighten(cage, 1, stages_.until(0.6));
      if (!collapse_to(cage, target_, Accuracy::quadrics, stages_.until(0.7))) return std::nullopt;
      tighten(cage, 2, stages_.until(0.8));
      too_near_ = keep_margin(cage, wish_.margin, stages_.until(0.92));
      return cage.shell();
    }
    collapse_to(cage, extra(3, 1000), Accuracy::quadrics, stages_.until(0.3));
    tighten(cage, 1, stages_.until(0.35));
    collapse_to(cage, extra(1.5, 400), Accuracy::quadrics, stages_.until(0.4));
    tighten(cage, 1, stages_.until(0.43));
    collapse_to(cage, extra(0.5, 4000 / static_cast<double>(target_)), Accuracy::quadrics,
                stages_.until(0.46));
    tighten(cage, 2, stages_.until(0.5));
    if (!collapse_to(cage, target_, Accuracy::volume, stages_.until(0.6))) return std::nullopt;
    tighten(cage, 8, stages_.until(0.7));
    if (target_ > 150) return settled(cage);
    WorkingCage best(exchanged(cage), tree_, field, cage.margin());
    return settled(best);
  }

  // The margin was kept as far as the grid tells: now exactly, where there is room.
  Shell settled(WorkingCage& cage) {
    too_near_ = keep_margin(cage, wish_.margin, stages_.until(0.85));
    cage.be_exact(wish_.margin);
    tighten(cage, 2, stages_.until(0.92));
    return cage.shell();
  }

  // Vertices are added where they save most volume and taken where they cost least: with few triangles, where
  // they are is nearly all.
  Shell exchanged(WorkingCage& cage) {
    constexpr int cycles = 2;
    Shell best = cage.shell();
    double least = cage.volume();
    for (int i = 0; i < cycles; ++i) {
      const auto stage = [&](double end) { return stages_.until(0.7 + 0.05 * (i + end)); };
      refine_to(cage, target_ + std::max<std::size_t>(8, target_ / 5), stage(0.2));
      tighten(cage, 2, stage(0.4));
      if (!collapse_to(cage, target_, Accuracy::volume, stage(0.8))) break;
      tighten(cage, 4, stage(1));
      if (cage.volume() >= least) continue;
      least = cage.volume();
      best = cage.shell();
    }
    return best;
  }

  // A convex cage with fewer triangles: few places are in the way.
  Shell simplified(const Shell& shell) {
    const Grid grid = grid_around(model_.box, 40, 2 * wish_.margin, false);
    const Clearance field =
        clearance({tree_, model_.closed}, grid, {wish_.margin, 0}, pool_, stages_.until(0.3));
    WorkingCage cage(shell, tree_, field, 0.5 * wish_.margin);
    collapse_to(cage, wish_.triangles, Accuracy::quadrics, stages_.until(0.9));
    Shell made = cage.shell();
    return is_sound(made, false) ? made : shell;
  }

  // As it will be read: with the rounding of the way out of the frame.
  bool is_sound(const Shell& half, bool mirrored) {
    Shell shell = mirrored ? whole(half) : half;
    for (Point& p : shell.positions) p = frame_.into(frame_.out_of(p));
    const mesh::Surface cage = mesh::from_triangles(std::move(shell.positions), shell.triangles);
    return soundness(cage, model_.positions, model_.triangles, tree_, stages_.until(0.97)).sound();
  }

  Made finish(const Shell& half, bool mirrored, double gap) {
    auto pairs = wish_.quads ? quad_pairs(half) : std::vector<TrianglePair>{};
    if (mirrored) {
      const auto image = static_cast<std::uint32_t>(half.triangles.size());
      for (std::size_t i = 0, n = pairs.size(); i < n; ++i)
        pairs.push_back({pairs[i][0] + image, pairs[i][1] + image});
    }
    Shell shell = mirrored ? whole(half) : half;
    for (Point& p : shell.positions) p = frame_.out_of(p);
    made_.surface = with_quads(shell, pairs);
    made_.gap = gap;
    if (mirrored) made_.mirror = mirror_;
    tell(gap);
    return std::move(made_);
  }

  void tell(double gap) {
    if (too_near_ > 0)
      made_.notes.push_back("no room for the margin at " + base::counted(too_near_, "triangle") +
                            ", which the model is nearer to");
    if (gap > wish_.gap && first_ && (first_->handles > last_.handles || first_->parts > last_.parts)) {
      made_.notes.push_back("closed gaps up to " + percent(2 * gap) + " of the model's diagonal: of " +
                            base::counted(first_->parts, "part") + " and " +
                            base::counted(first_->handles, "handle") + " the cage keeps " +
                            std::to_string(last_.parts) + " and " + std::to_string(last_.handles) +
                            "; more triangles keep more");
    }
  }

  static std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g %%", 100 * share);
    return text;
  }

  const Wish& wish_;
  const std::optional<Plane>& mirror_;
  const Frame& frame_;
  const FramedModel& model_;
  const mesh::TriangleTree& tree_;
  base::WorkerPool& pool_;
  Stages stages_;
  Made made_;
  std::size_t target_, cells_ = 0;
  double step_ = 0;
  std::size_t too_near_ = 0;  // triangles
  std::optional<Topology> first_;
  Topology last_;
};

}  // namespace

Made make_automatic(const Subject& subject, const Wish& wish, base::WorkerPool& pool,
                    base::Progress* progress) {
  return Making(subject, wish, pool, progress).make();
}

Made make_hull(const Subject& subject, const Wish& wish, base::WorkerPool& pool, base::Progress* progress) {
  return Making(subject, wish, pool, progress).hulled();
}

}  // namespace viete::cages
