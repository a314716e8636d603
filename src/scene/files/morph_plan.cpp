#include "scene/files/morph_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/memory.h"
#include "base/quantity.h"
#include "mesh/formats/printed.h"

namespace viete::scene {

namespace {

using mesh::Point;

// Of the tolerance: what straight lines between moments, and what targets that are left out, may take. The
// rest is for floats, and for the engine.
constexpr double share_of_lines = 0.45, share_of_targets = 0.35;

struct Off {
  double share = 0, distance = 0;  // of what is allowed there; in the file's unit

  void take(const Off& other) {
    share = std::max(share, other.share);
    distance = std::max(distance, other.distance);
  }
};

// How far a vertex may be off whose coordinates are so large.
double allowed(double coordinate, double tolerance) {
  return std::max(tolerance, float_noise * coordinate);
}

[[noreturn]] void refuse_frames(const std::string& found) {
  throw base::Error("", found, "allow a larger tolerance, or fewer frames, or write a point cache (.pc2)");
}

// Finds the moments, from left to right.
class Moments {
public:
  Moments(const MotionAt& at, const MorphWish& wish, const std::vector<double>& frames,
          base::Progress* progress)
      : at_(at), wish_(wish), first_(frames.front()), last_(frames.back()), progress_(progress) {
    const double range = last_ - first_;
    nearest_ = std::max(1.5 * jump_frames, range * 0x1p-20);  // floats tell their seconds apart
    most_ = 20000 + 16 * range;
    if (wish_.refines) check_number(frames);
    take(first_, at_(first_));
    for (std::size_t i = 1; i < frames.size(); ++i) go_to(frames[i]);
  }

  std::vector<double> frames;
  Off off;

private:
  // By what some of the spaces between frames need.
  void check_number(const std::vector<double>& given) {
    const std::size_t spaces = given.size() - 1, tried = std::min<std::size_t>(spaces, 24);
    double moments = 0;
    for (std::size_t i = 0; i < tried; ++i) {
      const double a = given[i * spaces / tried], b = given[i * spaces / tried + 1];
      if (b - a <= nearest_) continue;
      moments += parts_of(off_between(a, at_(a), b, at_(b), any_).share);
    }
    check_number(moments / static_cast<double>(std::max<std::size_t>(tried, 1)) *
                 static_cast<double>(spaces));
  }
  void check_number(double moments) const {
    if (moments <= most_) return;
    refuse_frames("the motion takes about " +
                  base::with_thousands(static_cast<std::size_t>(std::min(moments, 1e15))) +
                  " straight lines, more than the " + base::with_thousands(static_cast<std::size_t>(most_)) +
                  " that are made");
  }

  // From the last moment to that frame.
  void go_to(double frame) {
    std::vector<double> ahead{frame};
    while (!ahead.empty()) {
      const double to = ahead.back(), from = frames.back();
      std::vector<Point> there = at_(to);
      if (wish_.refines && to - from > nearest_) {
        const Off between = off_between(from, from_, to, there, share_of_lines);
        const double parts = std::min(parts_of(between.share), std::floor((to - from) / (0.6 * nearest_)));
        if (between.share > share_of_lines && parts >= 2) {
          for (double part = parts - 1; part >= 1; --part) ahead.push_back(from + (to - from) * part / parts);
          continue;
        }
        off.take(between);
      }
      take(to, std::move(there));
      ahead.pop_back();
    }
  }

  void take(double frame, std::vector<Point> there) {
    frames.push_back(frame);
    from_ = std::move(there);
    check_number(static_cast<double>(frames.size()));
    if (progress_ && last_ > first_) progress_->report((frame - first_) / (last_ - first_));
  }

  // Where the middle is too far off nothing else is looked at.
  Off off_between(double from, const std::vector<Point>& a, double to, const std::vector<Point>& b,
                  double enough) {
    Off worst;
    for (const double t : {0.5, 0.25, 0.75}) {
      const std::vector<Point> there = at_(from + t * (to - from));
      for (std::size_t v = 0; v < there.size(); ++v) {
        const double distance = mesh::norm(there[v] - (a[v] + t * (b[v] - a[v])));
        worst.take({distance / allowed(mesh::largest_abs(there[v]), wish_.tolerance), distance});
      }
      if (worst.share > enough) break;
    }
    return worst;
  }

  // The distance of a curve from its chord goes with the square of the chord's length.
  static double parts_of(double share) {
    constexpr double aim = 1.05;
    return std::max(1.0, std::ceil(aim * std::sqrt(share / share_of_lines)));
  }

  static constexpr double any_ = std::numeric_limits<double>::infinity();
  const MotionAt& at_;
  const MorphWish& wish_;
  double first_, last_, nearest_ = 0, most_ = 0;
  std::vector<Point> from_;
  base::Progress* progress_;
};

// Poses, and directions at right angles that span the same: each pose is a sum of those up to its own. Each
// vertex is measured by what it may be off, so that one that goes far does not drown the others.
class Targets {
public:
  // reach: the largest coordinate that each vertex ever has.
  Targets(std::span<const Point> rest, std::span<const double> reach, double tolerance,
          base::WorkerPool& pool)
      : moves(rest.size(), 0), rest_(rest), pool_(pool) {
    for (const double r : reach) allowed_.push_back(allowed(r, tolerance));
  }

  // Weights of the targets that show the pose at the frame; one more where those that are there do not.
  std::vector<double> weights_of(double frame, std::span<const Point> pose) {
    std::vector<double> difference(3 * pose.size());
    for (std::size_t v = 0; v < pose.size(); ++v) {
      const mesh::Vec3 d = (1 / allowed_[v]) * (pose[v] - rest_[v]);
      std::copy(d.begin(), d.end(), difference.begin() + static_cast<std::ptrdiff_t>(3 * v));
      if (mesh::norm(d) > 0.5) moves[v] = 1;
    }
    std::vector<double> shares = shares_of(difference);
    const Off left = take_away(shares, difference);
    if (left.share <= share_of_targets) {
      off.take(left);
      return solved(std::move(shares));
    }
    add(frame, std::move(difference), std::move(shares), pose);
    std::vector<double> weights(frames.size(), 0);
    weights.back() = 1;
    return weights;
  }

  std::vector<double> frames;   // of the poses
  std::vector<double> largest;  // coordinate of a difference of each
  std::vector<char> moves;      // vertices that are not always at rest
  Off off;

private:
  using Vector = std::vector<double>;
  static constexpr std::size_t block = 3 * 4096;

  Vector shares_of(const Vector& x) const {
    const std::size_t count = directions_.size(), blocks = (x.size() + block - 1) / block;
    Vector parts(blocks * count, 0), sums(count, 0);
    pool_.for_blocks(x.size(), block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = 0; k < count; ++k)
        parts[begin / block * count + k] =
            std::inner_product(x.begin() + std::ptrdiff_t(begin), x.begin() + std::ptrdiff_t(end),
                               directions_[k].begin() + std::ptrdiff_t(begin), 0.0);
    });
    for (std::size_t i = 0; i < parts.size(); ++i) sums[i % count] += parts[i];
    return sums;
  }

  Off take_away(const Vector& shares, Vector& x) const {
    std::vector<Off> worst((x.size() + block - 1) / block);
    pool_.for_blocks(x.size(), block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = 0; k < shares.size(); ++k)
        for (std::size_t i = begin; i < end; ++i) x[i] -= shares[k] * directions_[k][i];
      for (std::size_t v = begin / 3; v < end / 3; ++v) {
        const double share = mesh::norm({x[3 * v], x[3 * v + 1], x[3 * v + 2]});
        worst[begin / block].take({share, share * allowed_[v]});
      }
    });
    Off all;
    for (const Off& part : worst) all.take(part);
    return all;
  }

  // Shares of directions as weights of poses.
  Vector solved(Vector shares) const {
    for (std::size_t k = shares.size(); k-- > 0;) {
      shares[k] /= poses_[k][k];
      for (std::size_t j = 0; j < k; ++j) shares[j] -= shares[k] * poses_[k][j];
    }
    return shares;
  }

  void add(double frame, Vector left, Vector shares, std::span<const Point> pose) {
    const double size = std::sqrt(std::inner_product(left.begin(), left.end(), left.begin(), 0.0));
    for (double& x : left) x /= size;
    base::require_memory({2 * 8.0 * static_cast<double>(left.size()),
                          base::with_thousands(frames.size() + 1) + " morph targets take",
                          "allow a larger tolerance, export fewer frames, or write a point cache (.pc2)",
                          ""});
    shares.push_back(size);
    poses_.push_back(std::move(shares));
    directions_.push_back(std::move(left));
    frames.push_back(frame);
    double farthest_difference = 0;
    for (std::size_t v = 0; v < pose.size(); ++v)
      farthest_difference = std::max(farthest_difference, mesh::largest_abs(pose[v] - rest_[v]));
    largest.push_back(farthest_difference);
  }

  std::span<const Point> rest_;
  base::WorkerPool& pool_;
  Vector allowed_;                          // of each vertex
  std::vector<Vector> directions_, poses_;  // these by shares of those
};

// Both ends, then every 2^n-th, and those in the middle between: the first ones are far apart.
std::vector<std::size_t> from_coarse_to_fine(std::size_t count) {
  std::vector<std::size_t> order{0};
  if (count > 1) order.push_back(count - 1);
  std::size_t step = 1;
  while (2 * step < count) step *= 2;
  for (; step > 0; step /= 2)
    for (std::size_t i = step; i + 1 < count; i += 2 * step) order.push_back(i);
  return order;
}

// What floats do to a sum of targets at most, with the steady one.
double noise_of(std::span<const double> weights, std::span<const double> least, std::span<const double> most,
                std::span<const double> largest) {
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k)
    sum += (weights[k] * (most[k] - least[k]) - least[k]) * largest[k];
  return sum * 0x1p-24;
}

void check_floats(std::span<const Point> pose, double frame) {
  constexpr double most = std::numeric_limits<float>::max() / 4;
  for (std::size_t v = 0; v < pose.size(); ++v)
    if (!mesh::is_place(pose[v], most))
      throw base::Error(
          "vertex " + std::to_string(v),
          "its position at frame " + std::to_string(frame) + " does not fit into the floats of glTF",
          "write numbered models (frame_####.ply), or scale the model");
}

class Planner {
public:
  Planner(std::span<const Point> rest, const MorphWish& wish, const MotionAt& at, base::WorkerPool& pool)
      : rest_(rest), wish_(wish), pool_(pool), reach_(rest.size(), 0), at_([&](double frame) {
          std::vector<Point> pose = at(frame);
          check_floats(pose, frame);
          for (std::size_t v = 0; v < pose.size(); ++v)
            reach_[v] = std::max(reach_[v], mesh::largest_abs(pose[v]));
          return pose;
        }) {}

  MorphPlan plan(const std::vector<double>& frames, base::Progress* progress) {
    if (progress) progress->section(0.05, 0.45);
    Moments moments(at_, wish_, frames, progress);
    plan_.frames = std::move(moments.frames);
    if (progress) progress->section(0.45, 0.7);
    Targets targets(rest_, reach_, wish_.tolerance, pool_);
    choose(targets, frames, progress);
    take_weights(targets);
    check_size(targets, plan_.targets.size());
    plan_.moves = std::move(targets.moves);
    plan_.farthest = *std::ranges::max_element(reach_);
    plan_.error += moments.off.distance + targets.off.distance;
    return std::move(plan_);
  }

private:
  // Those that were asked for, keys among them, go before what is between.
  void choose(Targets& targets, const std::vector<double>& given, base::Progress* progress) {
    weights_.resize(plan_.frames.size());
    std::size_t done = 0;
    const auto show = [&](std::size_t moment) {
      if (weights_[moment]) return;
      const double frame = plan_.frames[moment];
      weights_[moment] = targets.weights_of(frame, at_(frame));
      check_size(targets, targets.frames.size());
      if (progress) progress->report(static_cast<double>(++done) / static_cast<double>(weights_.size()));
    };
    for (const std::size_t i : from_coarse_to_fine(given.size()))
      show(static_cast<std::size_t>(std::ranges::lower_bound(plan_.frames, given[i]) - plan_.frames.begin()));
    for (const std::size_t i : from_coarse_to_fine(plan_.frames.size())) show(i);
  }

  void check_size(const Targets& targets, std::size_t count) const {
    const auto moving = static_cast<double>(std::ranges::count(targets.moves, 1));
    const double bytes = static_cast<double>(count) *
                         (wish_.bytes_of_vertex * moving + 4 * static_cast<double>(plan_.frames.size()));
    if (bytes <= wish_.most_bytes) return;
    throw base::Error("",
                      "the motion needs more than " + base::counted(count, "morph target") + " of " +
                          base::with_thousands(static_cast<std::size_t>(moving)) +
                          " vertices: " + base::memory_size(bytes) + ", and no more than " +
                          base::memory_size(wish_.most_bytes) + " are allowed",
                      "allow a larger tolerance, " +
                          (wish_.to_allow_more.empty() ? "" : wish_.to_allow_more + ", ") +
                          "or write a point cache (.pc2)");
  }

  // A target whose weights leave 0 to 1 is stretched so that they do not, and its least one, where it is
  // below 0, is a share of the steady target. Its own frame has the weight 1, so there always is something to
  // stretch.
  void take_weights(const Targets& targets) {
    const std::size_t count = targets.frames.size();
    std::vector<double> least(count, 0), most(count, 1);
    for (auto& weights : weights_) {
      weights->resize(count, 0);
      for (std::size_t k = 0; k < count; ++k) {
        least[k] = std::min(least[k], (*weights)[k]);
        most[k] = std::max(most[k], (*weights)[k]);
      }
    }
    MorphPlan::Target steady;
    for (std::size_t k = 0; k < count; ++k) {
      plan_.targets.push_back({{targets.frames[k], most[k] - least[k]}});
      if (least[k] < 0) steady.push_back({targets.frames[k], least[k]});
    }
    for (auto& weights : weights_) {
      for (std::size_t k = 0; k < count; ++k)
        (*weights)[k] = ((*weights)[k] - least[k]) / (most[k] - least[k]);
      plan_.error = std::max(plan_.error, noise_of(*weights, least, most, targets.largest));
      plan_.weights.insert(plan_.weights.end(), weights->begin(), weights->end());
      if (!steady.empty()) plan_.weights.push_back(1);
    }
    plan_.steady = !steady.empty();
    if (plan_.steady) plan_.targets.push_back(std::move(steady));
  }

  std::span<const Point> rest_;
  const MorphWish& wish_;
  base::WorkerPool& pool_;
  std::vector<double> reach_;  // of each vertex, the largest coordinate
  MotionAt at_;
  MorphPlan plan_;
  std::vector<std::optional<std::vector<double>>> weights_;  // of each moment
};

}  // namespace

double MorphPlan::bytes(double bytes_of_vertex) const {
  return static_cast<double>(targets.size()) * bytes_of_vertex *
             static_cast<double>(std::ranges::count(moves, 1)) +
         4 * static_cast<double>(weights.size() + frames.size());
}

std::vector<Point> MorphPlan::positions(std::size_t t, std::span<const Point> rest,
                                        const MotionAt& at) const {
  const Target& target = targets[t];
  std::vector<Point> shown;
  if (target.size() == 1 && target.front().times == 1) {  // the pose itself, to the bit
    shown = at(target.front().frame);
    for (std::size_t v = 0; v < shown.size(); ++v)
      if (!moves[v]) shown[v] = rest[v];
    return shown;
  }
  shown.assign(rest.begin(), rest.end());
  for (const Share& share : target) {
    const std::vector<Point> pose = at(share.frame);
    for (std::size_t v = 0; v < shown.size(); ++v)
      if (moves[v]) shown[v] = shown[v] + share.times * (pose[v] - rest[v]);
  }
  return shown;
}

MorphPlan plan_morphs(std::span<const Point> rest, const std::vector<double>& frames, const MotionAt& at,
                      const MorphWish& wish, base::WorkerPool& pool, base::Progress* progress) {
  return Planner(rest, wish, at, pool).plan(frames, progress);
}

}  // namespace viete::scene
