#include "scene/animation_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/memory.h"

namespace viete::scene {

namespace {

using mesh::operator-, mesh::operator+, mesh::operator*;

constexpr double any_error = std::numeric_limits<double>::infinity();

double distance_from_line(const MotionSample& a, const MotionSample& b, double t,
                          const std::vector<mesh::Point>& there) {
  double worst = 0;
  for (std::size_t v = 0; v < there.size(); ++v) {
    const mesh::Point line = a.positions[v] + t * (b.positions[v] - a.positions[v]);
    worst = std::max(worst, mesh::squared_norm(there[v] - line));
  }
  return std::sqrt(worst);
}

// Makes samples from left to right; those that are ahead wait.
class MotionSampler {
public:
  MotionSampler(const MotionAt& at, double tolerance, double first, double last, base::Progress* progress)
      : at_(at), tolerance_(tolerance), first_(first), last_(last), progress_(progress) {}

  void begin(double frame) { take(made(frame)); }

  // From the last sample to that frame.
  void go_to(double frame) {
    std::vector<MotionSample> ahead;
    ahead.push_back(made(frame));
    while (!ahead.empty()) {
      const MotionSample &from = result_.samples.back(), &to = ahead.back();
      const double error = to.frame - from.frame > 1.5 * jump_frames ? error_between(from, to) : 0;
      if (error > tolerance_) {
        split(from, error, ahead);
        continue;
      }
      result_.error = std::max(result_.error, error);
      take(std::move(ahead.back()));
      ahead.pop_back();
    }
  }

  MotionSamples take_result() { return std::move(result_); }

private:
  // Where the middle is too far off nothing else is looked at.
  double error_between(const MotionSample& a, const MotionSample& b) {
    double worst = 0;
    for (const double t : {0.5, 0.25, 0.75}) {
      worst = std::max(worst, distance_from_line(a, b, t, at_(a.frame + t * (b.frame - a.frame))));
      if (worst > tolerance_) break;
    }
    return worst;
  }

  // The distance of a curve from its chord goes with the square of the chord's length.
  void split(const MotionSample& from, double error, std::vector<MotionSample>& ahead) {
    constexpr double most_parts = 32, aim = 1.05;
    const double parts = std::clamp(std::ceil(aim * std::sqrt(error / tolerance_)), 2.0, most_parts);
    const double begin = from.frame, length = ahead.back().frame - begin;
    for (double part = parts - 1; part >= 1; --part) ahead.push_back(made(begin + length * part / parts));
  }

  MotionSample made(double frame) {
    if (progress_) {
      const double done = result_.samples.empty() ? first_ : result_.samples.back().frame;
      progress_->report(last_ > first_ ? (done - first_) / (last_ - first_) : 1);
    }
    MotionSample sample{frame, at_(frame)};
    constexpr double and_as_floats_twice = 2;
    base::require_memory({and_as_floats_twice * 24 * static_cast<double>(sample.positions.size()),
                          std::to_string(result_.samples.size() + 1) + " morph targets take",
                          "allow a larger error, export fewer frames, or write a point cache (.pc2)", ""});
    return sample;
  }

  void take(MotionSample sample) { result_.samples.push_back(std::move(sample)); }

  const MotionAt& at_;
  double tolerance_, first_, last_;
  base::Progress* progress_;
  MotionSamples result_;
};

}  // namespace

MotionSamples sample_motion(const std::vector<double>& frames, const MotionAt& at, double tolerance,
                            base::Progress* progress) {
  MotionSampler sampler(at, tolerance, frames.front(), frames.back(), progress);
  sampler.begin(frames.front());
  for (std::size_t i = 1; i < frames.size(); ++i) sampler.go_to(frames[i]);
  return sampler.take_result();
}

MotionSamples sample_at(const std::vector<double>& frames, const MotionAt& at, base::Progress* progress) {
  return sample_motion(frames, at, any_error, progress);
}

}  // namespace viete::scene
