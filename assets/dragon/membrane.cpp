#include "dragon/membrane.h"

#include <utility>

namespace viete::dragon {
namespace {

PlanePoint operator-(PlanePoint a, PlanePoint b) {
  return {a.back - b.back, a.out - b.out};
}
double dot(PlanePoint a, PlanePoint b) {
  return a.back * b.back + a.out * b.out;
}

double squared_distance(PlanePoint p, PlanePoint a, PlanePoint b) {
  const PlanePoint edge = b - a, from = p - a;
  const double t = std::clamp(dot(from, edge) / dot(edge, edge), 0.0, 1.0);
  const PlanePoint rest{from.back - edge.back * t, from.out - edge.out * t};
  return dot(rest, rest);
}

/// Negative inside.
double signed_distance(PlanePoint p, const std::vector<PlanePoint>& polygon) {
  double square = 1e18;
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const PlanePoint a = polygon[i], b = polygon[j];
    square = std::min(square, squared_distance(p, a, b));
    if ((a.out > p.out) != (b.out > p.out) &&
        p.back < (b.back - a.back) * (p.out - a.out) / (b.out - a.out) + a.back) {
      inside = !inside;
    }
  }
  return inside ? -std::sqrt(square) : std::sqrt(square);
}

double distance_to_bones(PlanePoint p, const std::vector<std::vector<PlanePoint>>& bones) {
  double square = 1e18;
  for (const auto& bone : bones) {
    for (std::size_t i = 1; i < bone.size(); ++i)
      square = std::min(square, squared_distance(p, bone[i - 1], bone[i]));
  }
  return std::sqrt(square);
}

}  // namespace

Membrane::Membrane(const WingFrame& frame, std::vector<PlanePoint> outline,
                   std::vector<std::vector<PlanePoint>> bones, double half_thickness, double sag)
    : frame_(frame),
      outline_(std::move(outline)),
      bones_(std::move(bones)),
      half_thickness_(half_thickness),
      sag_(sag) {}

double Membrane::distance(Vec3 p) const {
  const Vec3 offset = p - frame_.shoulder;
  const PlanePoint q{dot(offset, frame_.back), dot(offset, frame_.out)};
  double height = dot(offset, frame_.normal) - frame_.bend(q);
  if (std::abs(height) > 0.15) return std::abs(height) - 0.08;
  const double outside = signed_distance(q, outline_);
  if (outside > 0.1) return outside;
  const double apart = distance_to_bones(q, bones_) / 0.1;
  height -= sag_ * apart * apart / (1 + apart * apart);
  const double beyond = std::max(outside, 0.0);
  return std::sqrt(beyond * beyond + height * height) - half_thickness_;
}

Box Membrane::box() const {
  Box box;
  for (const PlanePoint& p : outline_) box.add(frame_.place(p), half_thickness_ + std::abs(sag_));
  return box;
}

void append_arc(std::vector<PlanePoint>& points, PlanePoint a, PlanePoint control, PlanePoint b, int steps) {
  for (int i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i) / steps, u = 1 - t;
    points.push_back({u * u * a.back + 2 * u * t * control.back + t * t * b.back,
                      u * u * a.out + 2 * u * t * control.out + t * t * b.out});
  }
}

}  // namespace viete::dragon
