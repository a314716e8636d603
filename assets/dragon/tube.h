// A tube of elliptic section swept along a smooth curve, with optional relief: body, legs, horns, claws,
// bones.
#pragma once

#include <vector>

#include "dragon/field.h"

namespace viete::dragon {

/// A place on the curve with the half axes of the section there: across, above and below the curve.
struct Station {
  Vec3 at;
  double across, above, below;
};

/// A round station.
inline Station round(Vec3 at, double radius) {
  return {at, radius, radius, radius};
}

/// The Catmull-Rom spline through the stations, kSamplesPerSpan samples from each to the next, and the last
/// one.
inline constexpr int kSamplesPerSpan = 8;
std::vector<Station> sampled(const std::vector<Station>& stations);

/// The place of a point on a tube.
struct TubePoint {
  double along;   ///< length along the curve divided by the local radius, summed up: grows by 1 per radius
  double around;  ///< 0 above (on the back), +-1 below (on the belly), its sign is the side
  double radius;  ///< of the section, the mean of its half axes
  double length;  ///< along the curve from its first station
};

/// How far the surface rises above the smooth tube.
using Relief = double (*)(const TubePoint&);

class Tube : public Part {
public:
  /// The curve is a Catmull-Rom spline through the stations; sideways gives the direction of the half axis
  /// across.
  Tube(const std::vector<Station>& stations, Vec3 sideways, Relief relief = nullptr);

  double distance(Vec3 p) const override;
  Box box() const override { return box_; }

private:
  struct Sample {
    Vec3 at, tangent, side, up;
    double across, above, below, along, length;
  };
  struct Chunk {  // a sphere about a run of segments, to pass over them at once
    Vec3 center;
    double radius;
    int begin, end;
  };

  struct Nearest {
    int segment;
    double t;
  };

  void frame(Vec3 sideways);
  void bound(bool with_relief);
  Nearest nearest(Vec3 p) const;

  std::vector<Sample> samples_;
  std::vector<Chunk> chunks_;
  Box box_;
  Relief relief_;
};

}  // namespace viete::dragon
