#include "cages/make.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "cages/clearance.h"
#include "cages/collapse.h"
#include "cages/extraction.h"
#include "cages/soundness.h"
#include "mesh/defects.h"
#include "mesh/triangulation.h"
#include "mesh/union_find.h"

namespace viete::cages {

namespace {

struct Topology {
  std::size_t parts = 0;
  std::size_t handles = 0;
};

Topology topology_of(const Shell& shell) {
  mesh::UnionFind parts = mesh::parts_by_triangles(shell.positions.size(), shell.triangles);
  Topology found;
  for (std::uint32_t v = 0; v < shell.positions.size(); ++v) found.parts += parts.find(v) == v ? 1 : 0;
  // Euler's formula: vertices - edges + triangles = 2 * parts - 2 * handles, with edges = 3 / 2 * triangles.
  const std::size_t spheres = 2 * found.parts + shell.triangles.size() / 2;
  found.handles = (spheres - std::min(spheres, shell.positions.size())) / 2;
  return found;
}

// Divides the progress among attempts, and an attempt's part among stages. The progress never decreases.
class Stages {
public:
  explicit Stages(base::Progress* progress) : progress_(progress) { begin(); }

  // Begins another attempt. The attempt gets the fraction `share` of the remaining progress.
  void begin(double share = 1) {
    from_ = progress_ ? progress_->done() : 0;
    to_ = from_ + share * (1 - from_);
  }
  base::Progress* until(double end) {
    if (progress_) {
      const double done = progress_->done();
      progress_->section(done, std::max(done, from_ + end * (to_ - from_)));
    }
    return progress_;
  }

private:
  base::Progress* progress_;
  double from_ = 0, to_ = 1;
};

// Makes a closed cage with the requested number of triangles: extracts an offset surface from a distance grid
// by marching cubes, simplifies it by edge collapses, and tightens it. With a mirror plane, makes one half of
// the cage and mirrors it. If the cage would need too many triangles, closes holes and gaps of the model, and
// adds a message. If no sound cage is found, make() returns nullopt.
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
        target_(mirror_ ? wish.triangles / 2 : wish.triangles) {}

  std::optional<Made> make() {
    constexpr double most_closed = 0.5;  // relative to the model's diagonal; closes every gap
    for (double gap = wish_.gap; gap <= most_closed;) {
      if (const auto shell = try_with(gap)) return finish(*shell, gap);
      if (!keeps_farther_from_passed_over()) gap = std::max(2 * gap, 0.5 * size() / cells());
    }
    return std::nullopt;
  }

private:
  bool is_preview() const { return wish_.effort == Effort::preview; }

  double size() const { return mesh::largest_abs(model_.box.high - model_.box.low); }

  // Returns the number of grid cells along the longest side of the model's box.
  double cells() const {
    return std::clamp(3.2 * std::sqrt(static_cast<double>(wish_.triangles)), 40.0, 128.0);
  }

  // An offset surface of the model, and the clearance. Must not be moved: a WorkingCage refers to `field`.
  struct Offset {
    Clearance field;
    double margin;
    Shell shell;
    Topology topology;
  };

  Offset offset(double along, double gap) {
    const double step = size() / along, margin = std::max(wish_.margin, margin_steps_ * step);
    const Closing closing{margin + 0.6 * step, gap};
    const Grid grid = grid_around(model_.box, static_cast<std::size_t>(along), closing.offset + closing.gap,
                                  mirror_.has_value());
    Clearance field = clearance({tree_, model_.closed}, grid, closing, pool_, stages_.until(0.1));
    Shell shell =
        passed_over_.empty()
            ? extract(field, closing.offset)
            : extract(with_balls(field, passed_over_, parts_margin_steps * step, closing.offset + 2 * step),
                      closing.offset);
    const Topology topology = topology_of(mirror_ ? whole(shell) : shell);
    return {std::move(field), margin, std::move(shell), topology};
  }

  WorkingCage working(const Shell& shell, const Offset& of) const {
    return {shell, tree_, of.field, of.margin, passed_over_};
  }

  bool is_too_much(const Topology& topology) const {
    return topology.parts > 1 + wish_.triangles / 40 || topology.handles > wish_.triangles / 30;
  }

  // Returns a sound cage for this gap, or nullopt. For a preview or a gap larger than requested, uses a
  // coarse grid and makes a quick cage first. If the quick cage is not sound, returns nullopt.
  std::optional<Shell> try_with(double gap) {
    const bool coarse = is_preview() || gap > wish_.gap;
    stages_.begin(coarse && !is_preview() ? 0.3 : 1);
    const Offset from = offset((coarse ? coarser : 1) * cells(), gap);
    if (!first_) first_ = from.topology;
    last_ = from.topology;
    if (is_too_much(from.topology)) return std::nullopt;
    std::optional<Shell> quick;
    if (coarse) {
      WorkingCage cage = working(from.shell, from);
      quick = sound(quickly_reduced(cage));
      if (!quick || is_preview()) return quick;
      stages_.begin();
    }
    const std::size_t too_near = too_near_;
    if (auto made = carefully_made(from, gap)) return made;
    too_near_ = too_near;
    return quick;
  }

  struct Draft {
    const Offset* of;
    Shell shell;
    double volume;
  };

  // With few triangles, the result depends on the position of the grid. In this case, makes drafts on two
  // grids. Finishes the draft with the smaller volume. If its result is not sound, finishes the other draft.
  std::optional<Shell> carefully_made(const Offset& from, double gap) {
    std::optional<Offset> other;
    if (wish_.triangles <= few_triangles) other = offset(1.1 * size() / from.field.grid().step, gap);
    std::vector<Draft> drafts;
    add_draft(from, other ? 0.5 : 1, drafts);
    if (other && !is_too_much(other->topology)) add_draft(*other, 1, drafts);
    std::ranges::stable_sort(drafts, {}, &Draft::volume);
    for (const Draft& draft : drafts) {
      if (auto made = sound(finished(draft))) {
        last_ = draft.of->topology;
        return made;
      }
    }
    return std::nullopt;
  }

  void add_draft(const Offset& of, double share, std::vector<Draft>& drafts) {
    WorkingCage cage = working(of.shell, of);
    if (reduced(cage, share)) drafts.push_back({&of, cage.shell(), cage.volume()});
  }

  Shell finished(const Draft& draft) {
    WorkingCage cage = working(draft.shell, *draft.of);
    if (wish_.triangles > few_triangles) return settled(cage);
    WorkingCage best = working(exchanged(cage), *draft.of);
    return settled(best);
  }

  std::optional<Shell> sound(std::optional<Shell> made) {
    if (made && !is_sound(*made)) made.reset();
    return made;
  }

  std::size_t target_and(double share, double most) const {
    return target_ + static_cast<std::size_t>(std::min(share * static_cast<double>(target_), most));
  }

  std::optional<Shell> quickly_reduced(WorkingCage& cage) {
    if (!collapse_to(cage, target_and(1.5, 400), Accuracy::quadrics, stages_.until(0.5))) return std::nullopt;
    tighten(cage, 1, stages_.until(0.6));
    if (!collapse_to(cage, target_, Accuracy::quadrics, stages_.until(0.7))) return std::nullopt;
    refine_to(cage, target_, stages_.until(0.7));
    tighten(cage, 2, stages_.until(0.8));
    // A preview skips this: its margin is exact only to the resolution of the grid.
    if (!is_preview()) too_near_ = keep_margin(cage, wish_.margin, stages_.until(0.92));
    return cage.shell();
  }

  // If the cage still has too many triangles, returns false. `share` scales the reported progress.
  bool reduced(WorkingCage& cage, double share) {
    const auto until = [&](double end) { return stages_.until(0.1 + share * (end - 0.1)); };
    collapse_to(cage, target_and(3, 1000), Accuracy::quadrics, until(0.3));
    tighten(cage, 1, until(0.35));
    if (!collapse_to(cage, target_and(1.5, 400), Accuracy::quadrics, until(0.4))) return false;
    tighten(cage, 1, until(0.43));
    collapse_to(cage, target_and(0.5, 4000 / static_cast<double>(target_)), Accuracy::quadrics, until(0.46));
    tighten(cage, 2, until(0.5));
    if (!collapse_to(cage, target_, Accuracy::volume, until(0.6))) return false;
    refine_to(cage, target_, until(0.6));
    tighten(cage, 8, until(0.7));
    return true;
  }

  // Before this step, the margin is exact only to the resolution of the grid.
  Shell settled(WorkingCage& cage) {
    too_near_ = keep_margin(cage, wish_.margin, stages_.until(0.85));
    cage.be_exact(wish_.margin);
    tighten(cage, 2, stages_.until(0.92));
    return cage.shell();
  }

  // Repeats two steps: splits the edges whose split reduces the volume most, and collapses the edges whose
  // collapse increases the volume least. Returns the cage with the smallest volume.
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

  // Converts the cage to file coordinates and back, so that the check includes rounding errors.
  bool is_sound(const Shell& half) {
    Shell shell = mirror_ ? whole(half) : half;
    for (Point& p : shell.positions) p = frame_.into(frame_.out_of(p));
    const mesh::Surface cage = mesh::from_triangles(std::move(shell.positions), shell.triangles);
    const Soundness found =
        soundness(cage, model_.positions, model_.triangles, tree_, pool_, stages_.until(0.97));
    note_passed_over(found.outside);
    return found.sound();
  }

  // Stores all vertices of the components outside the cage. `outside` has one vertex per component.
  void note_passed_over(const std::vector<std::uint32_t>& outside) {
    if (outside.empty()) return;
    mesh::UnionFind parts = mesh::parts_by_triangles(model_.positions.size(), model_.triangles);
    std::vector<std::uint8_t> is_outside(model_.positions.size(), 0);
    for (const auto v : outside) is_outside[parts.find(v)] = 1;
    for (std::uint32_t v = 0; v < is_outside.size(); ++v) {
      if (is_outside[parts.find(v)]) passed_over_.push_back(model_.positions[v]);
    }
  }

  // If the last cage left further components of the model outside, prepares another attempt with this gap.
  // All attempts add balls around these components. The last attempt also increases the margin. If there are
  // no further components, or after the last attempt, returns false.
  bool keeps_farther_from_passed_over() {
    constexpr int rounds = 3;
    const std::size_t known = std::exchange(known_passed_over_, passed_over_.size());
    if (passed_over_.size() == known || margin_steps_ >= parts_margin_steps) return false;
    if (++passed_over_rounds_ > rounds) margin_steps_ = parts_margin_steps;
    return true;
  }

  // Returns pairs whose quads, split as in mesh::CenterSplit, intersect neither the model nor the cage.
  std::vector<TrianglePair> sound_pairs(const Shell& half) const {
    auto pairs = quad_pairs(half, [&](const mesh::Corners& t) { return !tree_.is_near(t); });
    const mesh::Surface split = mesh::split_at_centers(with_quads(half, pairs)).surface;
    auto crossing = mesh::self_intersecting_triangles(split);
    for (auto& t : crossing) t = split.triangle_polygon[t];
    std::erase_if(pairs,
                  [&, i = 0u](const TrianglePair&) mutable { return std::ranges::count(crossing, i++) > 0; });
    return pairs;
  }

  Made finish(const Shell& half, double gap) {
    auto pairs = wish_.quads ? sound_pairs(half) : std::vector<TrianglePair>{};
    if (mirror_) {
      const auto image = static_cast<std::uint32_t>(half.triangles.size());
      for (std::size_t i = 0, n = pairs.size(); i < n; ++i)
        pairs.push_back({pairs[i][0] + image, pairs[i][1] + image});
    }
    Shell shell = mirror_ ? whole(half) : half;
    for (Point& p : shell.positions) p = frame_.out_of(p);
    made_.surface = with_quads(shell, pairs);
    made_.gap = gap;
    made_.mirror = mirror_;
    if (shell.triangles.size() > wish_.triangles)
      made_.notes.push_back("the cage needs " + base::counted(shell.triangles.size(), "triangle") +
                            " to enclose the model with these settings");
    if (wish_.kind == Kind::automatic && 10 * shell.triangles.size() < 9 * wish_.triangles)
      made_.notes.push_back("the cage has " + base::counted(shell.triangles.size(), "triangle") +
                            " instead of " + base::with_thousands(wish_.triangles) +
                            ": more would not make it tighter");
    tell(gap);
    return std::move(made_);
  }

  void tell(double gap) {
    if (too_near_ > 0)
      made_.notes.push_back("the margin could not be kept at " + base::counted(too_near_, "triangle") +
                            "; use a smaller margin or more triangles");
    if (gap > wish_.gap && first_ && (first_->handles > last_.handles || first_->parts > last_.parts)) {
      made_.notes.push_back("closed gaps up to " + base::formatted("%.2g %%", 200 * gap) +
                            " of the model's diagonal: the cage has " + std::to_string(last_.parts) + " of " +
                            base::counted(first_->parts, "separate part") + " and " +
                            std::to_string(last_.handles) + " of " + base::counted(first_->handles, "hole") +
                            "; use more triangles to keep gaps open");
    }
  }

  const Wish& wish_;
  const std::optional<Plane>& mirror_;
  const Frame& frame_;
  const FramedModel& model_;
  const mesh::TriangleTree& tree_;
  base::WorkerPool& pool_;
  Stages stages_;
  Made made_;
  std::size_t target_;
  std::size_t too_near_ = 0;  // the number of triangles that are nearer to the model than the margin
  static constexpr double parts_margin_steps = 1.25;  // radius of balls around components outside the cage
  static constexpr std::size_t few_triangles = 150;   // up to this number, uses a slower, more careful method
  static constexpr double coarser = 0.62;             // the relative resolution of the coarse grid
  double margin_steps_ = 0.1;                         // the last attempt's margin, in grid steps
  std::vector<Point> passed_over_;
  std::size_t known_passed_over_ = 0;
  int passed_over_rounds_ = 0;
  std::optional<Topology> first_;
  Topology last_;
};

using Cell = std::array<std::size_t, 3>;

// Makes the surface of a box. Divides each side of the box into quads.
class Lattice {
public:
  Lattice(const Frame& frame, const mesh::Bounds& box, const Cell& cells)
      : frame_(frame), box_(box), cells_(cells) {
    surface_.polygon_starts.push_back(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side(axis, 0);
      side(axis, cells[axis]);
    }
    mesh::triangulate(surface_);
  }

  mesh::Surface take() { return std::move(surface_); }

private:
  void side(std::size_t axis, std::size_t at) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::size_t i = 0; i < cells_[u]; ++i)
      for (std::size_t j = 0; j < cells_[v]; ++j) {
        Cell corner{};
        corner[axis] = at;
        const auto add = [&](std::size_t du, std::size_t dv) {
          corner[u] = i + du;
          corner[v] = j + dv;
          surface_.corners.push_back(vertex(corner));
        };
        const bool high = at > 0;  // if true, u to v is counter-clockwise as seen from outside
        add(0, 0);
        add(high ? 1 : 0, high ? 0 : 1);
        add(1, 1);
        add(high ? 0 : 1, high ? 1 : 0);
        surface_.polygon_starts.push_back(static_cast<std::uint32_t>(surface_.corners.size()));
      }
  }

  std::uint32_t vertex(const Cell& corner) {
    const auto [found, is_new] = numbers_.try_emplace(corner, static_cast<std::uint32_t>(numbers_.size()));
    if (is_new) {
      Point p;
      for (std::size_t k = 0; k < 3; ++k) {
        const double t = static_cast<double>(corner[k]) / static_cast<double>(cells_[k]);
        p[k] = (1 - t) * box_.low[k] + t * box_.high[k];
      }
      surface_.positions.push_back(frame_.out_of(p));
    }
    return found->second;
  }

  const Frame& frame_;
  mesh::Bounds box_;
  Cell cells_;
  std::map<Cell, std::uint32_t> numbers_;
  mesh::Surface surface_;
};

Wish in_range(Wish wish) {
  wish.triangles = std::clamp(wish.triangles, least_triangles, most_triangles);
  wish.margin = std::clamp(wish.margin, least_margin, most_margin);
  wish.gap = std::clamp(wish.gap, 0.0, most_gap);
  for (auto& n : wish.cells) n = std::clamp<std::size_t>(n, 1, most_cells);
  return wish;
}

Made box_instead(const mesh::Surface& model, Wish wish) {
  wish.cells = {1, 1, 1};
  wish.own_axes = false;
  Made made = make_box(model, wish);
  made.notes.push_back("the model does not fit into a cage of " + base::counted(wish.triangles, "triangle") +
                       ", so a box was made; use more triangles");
  return made;
}

void section(base::Progress* progress, double from, double to) {
  if (progress) progress->section(from, to);
}

}  // namespace

Made make_box(const mesh::Surface& model, const Wish& wish) {
  const Frame frame = wish.own_axes ? own_frame(model) : frame_of(model, std::nullopt);
  mesh::Bounds box = model_in(frame, model).box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= wish.margin;
    box.high[k] += wish.margin;
  }
  Made made;
  made.surface = Lattice(frame, box, wish.cells).take();
  return made;
}

std::optional<Plane> Maker::plane_of(Symmetry symmetry, base::Progress* progress) {
  if (symmetry == Symmetry::none) return std::nullopt;
  if (symmetry == Symmetry::automatic) {
    if (!own_plane_) own_plane_ = symmetry_plane(*model_, progress);
    return *own_plane_;
  }
  const auto axis = static_cast<std::size_t>(symmetry) - static_cast<std::size_t>(Symmetry::x);
  Plane plane{{0, 0, 0}, box_.center()[axis]};
  plane.normal[axis] = 1;
  return plane;
}

const Subject& Maker::subject_with(const std::optional<Plane>& mirror, base::Progress* progress) {
  if (!subject_ || subject_->mirror != mirror) {
    subject_.reset();
    subject_ = std::make_unique<const Subject>(*model_, mirror, progress);
  }
  return *subject_;
}

Maker::Maker(std::shared_ptr<const mesh::Surface> model)
    : model_(std::move(model)), box_(extent_of(*model_)) {
  if (!(box_.diagonal() > 0))
    throw base::Error("", "the model is a single point, so no cage can be made",
                      "open a model with more than one point");
}

Made Maker::make(const Wish& asked, base::WorkerPool& pool, base::Progress* progress) {
  const Wish wish = in_range(asked);
  if (wish.kind == Kind::box) return make_box(*model_, wish);
  section(progress, 0, 0.05);
  const auto mirror = plane_of(wish.symmetry, progress);
  section(progress, 0.05, 0.1);
  const Subject& subject = subject_with(mirror, progress);
  section(progress, 0.1, 1);
  std::optional<Made> made = Making(subject, wish, pool, progress).make();
  section(progress, 1, 1);
  return made ? *std::move(made) : box_instead(*model_, wish);
}

Made make(const mesh::Surface& model, const Wish& wish, base::WorkerPool& pool, base::Progress* progress) {
  return Maker(mesh::lent(model)).make(wish, pool, progress);
}

}  // namespace viete::cages
