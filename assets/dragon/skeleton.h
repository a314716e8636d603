// The dragon's bones, and its skin carried by them: what sculpts shapes of the model without a cage.
#pragma once

#include <vector>

#include "dragon/mesh.h"
#include "dragon/quaternion.h"
#include "dragon/tube.h"
#include "dragon/wings.h"

namespace viete::dragon {

/// Lines of joints, in the order of their stations. Those in pairs are counted from the left one; right is
/// next.
enum Limb {
  kTail,   ///< from the rump to the tip
  kTrunk,  ///< from the rump over chest and neck to the nose
  kHorn,
  kHindLeg = kHorn + 2,
  kFrontLeg = kHindLeg + 2,
  kArm = kFrontLeg + 2,  ///< of the wing, as all that follow
  kFinger = kArm + 2,    ///< kFinger + 2 i: left finger i
  kLimbs = kFinger + 2 * kFingers
};

/// Turns a limb in equal parts between two of its stations, and all that hangs on it. The axis is that of the
/// dragon at rest: the limb's earlier bends, and what it hangs on, turn it as they turn the limb.
struct Bend {
  int limb;
  double from, to;
  Vec3 axis;
  double degrees;
};

/// At rest, and constant: bends are told to it each time.
class Skeleton {
public:
  Skeleton();

  /// Moves the vertices of a closed mesh. The rump stays in its place.
  std::vector<Vec3> carried(const Mesh& skin, const std::vector<Bend>& bends) const;

private:
  struct Joint {
    Vec3 at;
    double radius;
    int before;  ///< the joint that it hangs on, or -1
  };
  struct Frame {      ///< of a joint that is bent, of a vertex that is carried
    Quaternion turn;  ///< of any length but 0
    Vec3 at;
  };
  struct Hold {    ///< of a limb on a vertex
    int joint;     ///< the vertex is nearest to the bone that ends there,
    double along;  ///< at this part of it, 0 to 1,
    double gap;    ///< so far from its flesh: 1 inside, 1 more for each kFlesh outside
  };

  void add(const std::vector<Station>& stations, int before);
  std::vector<Frame> bent(const std::vector<Bend>& bends) const;
  Hold hold(Vec3 p, int limb) const;
  Frame carried(Vec3 p, const std::vector<Frame>& frames) const;

  std::vector<Joint> joints_;
  std::vector<int> begins_{0};  ///< of each limb, and the end
};

}  // namespace viete::dragon
