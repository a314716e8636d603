#include "dragon/tube.h"

namespace viete::dragon {
namespace {

constexpr int kSegmentsPerChunk = 8;
constexpr double kThinnest = 0.002;

template <class T>
T catmull_rom(T a, T b, T c, T d, double t) {
  return 0.5 * (2.0 * b +
                t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * b - a - 3.0 * c + d))));
}

Station mix(Station a, Station b, Station c, Station d, double t) {
  const auto radius = [&](double Station::*axis) {
    return std::max(catmull_rom(a.*axis, b.*axis, c.*axis, d.*axis, t), kThinnest);
  };
  return {catmull_rom(a.at, b.at, c.at, d.at, t), radius(&Station::across), radius(&Station::above),
          radius(&Station::below)};
}

/// 0 where b > 0 and a = 0, +-1 opposite; a stand-in for the angle / pi that needs no arc tangent.
double angle_around(double a, double b) {
  const double sum = std::abs(a) + std::abs(b) + 1e-12;
  const double turned = 0.5 * (1 - b / sum);
  return a < 0 ? -turned : turned;
}

}  // namespace

std::vector<Station> sampled(const std::vector<Station>& stations) {
  std::vector<Station> samples;
  const int last = static_cast<int>(stations.size()) - 1;
  for (int span = 0; span < last; ++span) {
    const Station& before = stations[std::max(span - 1, 0)];
    const Station& after = stations[std::min(span + 2, last)];
    const int steps = span == last - 1 ? kSamplesPerSpan + 1 : kSamplesPerSpan;
    for (int step = 0; step < steps; ++step) {
      const double t = static_cast<double>(step) / kSamplesPerSpan;
      samples.push_back(mix(before, stations[span], stations[span + 1], after, t));
    }
  }
  return samples;
}

Tube::Tube(const std::vector<Station>& stations, Vec3 sideways, Relief relief) : relief_(relief) {
  for (const Station& s : sampled(stations))
    samples_.push_back({s.at, {}, {}, {}, s.across, s.above, s.below, 0, 0});
  frame(sideways);
  bound(relief != nullptr);
}

void Tube::frame(Vec3 sideways) {
  const int last = static_cast<int>(samples_.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    Sample& s = samples_[i];
    s.tangent = normalized(samples_[std::min(i + 1, last)].at - samples_[std::max(i - 1, 0)].at);
    s.side = normalized(sideways - s.tangent * dot(sideways, s.tangent));
    s.up = cross(s.side, s.tangent);
    if (i == 0) continue;
    const Sample& previous = samples_[i - 1];
    const double step = length(s.at - previous.at);
    s.length = previous.length + step;
    s.along = previous.along + step * 3 / (s.across + s.above + s.below);
  }
}

void Tube::bound(bool with_relief) {
  const double margin = with_relief ? 0.02 : 0;
  for (const Sample& s : samples_) box_.add(s.at, std::max({s.across, s.above, s.below}) + margin);
  const int segments = static_cast<int>(samples_.size()) - 1;
  for (int begin = 0; begin < segments; begin += kSegmentsPerChunk) {
    const int end = std::min(begin + kSegmentsPerChunk, segments);
    Chunk chunk{samples_[(begin + end) / 2].at, 0, begin, end};
    for (int i = begin; i <= end; ++i) {
      chunk.radius = std::max(chunk.radius, length(samples_[i].at - chunk.center));
    }
    chunks_.push_back(chunk);
  }
}

Tube::Nearest Tube::nearest(Vec3 p) const {
  Nearest best{0, 0};
  double best_square = 1e18;
  for (const Chunk& chunk : chunks_) {
    const double reach = length(p - chunk.center) - chunk.radius;
    if (reach > 0 && reach * reach > best_square) continue;
    for (int i = chunk.begin; i < chunk.end; ++i) {
      const Vec3 edge = samples_[i + 1].at - samples_[i].at;
      const Vec3 from = p - samples_[i].at;
      const double t = std::clamp(dot(from, edge) / dot(edge, edge), 0.0, 1.0);
      const Vec3 rest = from - edge * t;
      const double square = dot(rest, rest);
      if (square < best_square) best_square = square, best = {i, t};
    }
  }
  return best;
}

double Tube::distance(Vec3 p) const {
  const Nearest at = nearest(p);
  const Sample &s0 = samples_[at.segment], &s1 = samples_[at.segment + 1];
  const Vec3 offset = p - lerp(s0.at, s1.at, at.t);
  const double a = dot(offset, lerp(s0.side, s1.side, at.t));
  const double b = dot(offset, lerp(s0.up, s1.up, at.t));
  const double c = dot(offset, lerp(s0.tangent, s1.tangent, at.t));
  const double across = lerp(s0.across, s1.across, at.t);
  const double above = lerp(s0.above, s1.above, at.t), below = lerp(s0.below, s1.below, at.t);
  const double upright = b >= 0 ? above : below;
  const double lengthwise = std::min(across, upright);
  // Distance to an ellipsoid, first order: q (q - 1) / |grad q^2 / 2|.
  const Vec3 q{a / across, b / upright, c / lengthwise};
  const Vec3 slope{q.x / across, q.y / upright, q.z / lengthwise};
  const double level = length(q), steepness = length(slope);
  const double distance = steepness < 1e-9 ? -lengthwise : level * (level - 1) / steepness;
  if (relief_ == nullptr || distance > 0.05) return distance;
  const double radius = (across + above + below) / 3;
  return distance - relief_({lerp(s0.along, s1.along, at.t), angle_around(a / across, b / upright), radius,
                             lerp(s0.length, s1.length, at.t)});
}

}  // namespace viete::dragon
