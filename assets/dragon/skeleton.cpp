#include "dragon/skeleton.h"

#include "dragon/spine.h"

namespace viete::dragon {
namespace {

constexpr int kRump = 7, kNape = 10, kShoulders = 2;  // of the spine's stations; of the trunk's
constexpr double kSpade = 0.185;                      // length of the tail's tip, beyond the spine
constexpr double kFlesh = 0.045;                      // so far outside of a limb its hold is a sixteenth
constexpr double kReach = 8;  // times the gap of a wing's nearest bone: where other bones of it hold no more
constexpr int kEasing = 24;   // steps: more lose volume, fewer leave folds

std::vector<Station> tail() {
  std::vector<Station> stations{spine().rend() - 1 - kRump, spine().rend()};
  const Vec3 tip = stations.back().at;
  stations.push_back(round(tip + normalized(tip - spine()[1].at) * kSpade, 0.05));
  return stations;
}

std::vector<Station> trunk() {
  std::vector<Station> stations{spine().begin() + kRump, spine().end()};
  stations.push_back(muzzle());
  return stations;
}

struct Edge {
  std::uint32_t from, to;
  Vec3 way;  ///< as both ends turn it
};

/// Every vertex to where its neighbours want it: what is crushed where limbs meet spreads.
std::vector<Vec3> eased(const std::vector<Vec3>& places, const std::vector<Edge>& edges) {
  std::vector<Vec3> sums(places.size());
  std::vector<int> counts(places.size());
  for (const Edge& edge : edges) {
    sums[edge.to] = sums[edge.to] + places[edge.from] + edge.way;
    ++counts[edge.to];
  }
  for (std::size_t v = 0; v < sums.size(); ++v) sums[v] = sums[v] * (1.0 / counts[v]);
  return sums;
}

}  // namespace

Skeleton::Skeleton() {
  add(tail(), -1);
  add(trunk(), 0);
  const int nape = begins_[kTrunk] + kNape * kSamplesPerSpan;
  const int shoulders = begins_[kTrunk] + kShoulders * kSamplesPerSpan;
  const double sides[] = {1, -1};
  for (double side : sides) add(horn(side), nape);
  for (double side : sides) add(leg(true, side), 0);
  for (double side : sides) add(leg(false, side), shoulders);
  for (double side : sides) add(wing_arm(wing_frame(side)), shoulders);
  for (int i = 0; i < kFingers; ++i) {
    for (int k : {0, 1}) add(wing_finger(wing_frame(sides[k]), i), begins_[kArm + k + 1] - 1);
  }
}

void Skeleton::add(const std::vector<Station>& stations, int before) {
  for (const Station& s : sampled(stations)) {
    joints_.push_back({s.at, (s.across + s.above + s.below) / 3, before});
    before = static_cast<int>(joints_.size()) - 1;
  }
  begins_.push_back(static_cast<int>(joints_.size()));
}

std::vector<Skeleton::Frame> Skeleton::bent(const std::vector<Bend>& bends) const {
  std::vector<Frame> frames;
  for (int limb = 0; limb < kLimbs; ++limb) {
    const int begin = begins_[limb], hung = joints_[begin].before;
    for (int i = begin; i < begins_[limb + 1]; ++i) {
      Frame frame{hung < 0 ? Quaternion{} : frames[hung].turn, joints_[i].at};
      for (const Bend& bend : bends) {
        if (bend.limb != limb) continue;
        const double station = static_cast<double>(i - begin) / kSamplesPerSpan;
        const double share = std::clamp((station - bend.from) / (bend.to - bend.from), 0.0, 1.0);
        frame.turn = frame.turn * about(bend.axis, bend.degrees * share);
      }
      // A bone turns halfway between its ends, so that many of them are an arc.
      if (const int before = joints_[i].before; before >= 0)
        frame.at =
            frames[before].at + turned(joints_[i].at - joints_[before].at, frames[before].turn + frame.turn);
      frames.push_back(frame);
    }
  }
  return frames;
}

Skeleton::Hold Skeleton::hold(Vec3 p, int limb) const {
  Hold hold{0, 0, 0};
  double least = 1e18;
  for (int i = begins_[limb] + 1; i < begins_[limb + 1]; ++i) {
    const Vec3 bone = joints_[i].at - joints_[i - 1].at, from = p - joints_[i - 1].at;
    const double along = std::clamp(dot(from, bone) / dot(bone, bone), 0.0, 1.0);
    const Vec3 rest = from - bone * along;
    if (dot(rest, rest) < least) least = dot(rest, rest), hold.joint = i, hold.along = along;
  }
  const double radius = lerp(joints_[hold.joint - 1].radius, joints_[hold.joint].radius, hold.along);
  hold.gap = 1 + std::max(std::sqrt(least) - radius, 0.0) / kFlesh;
  return hold;
}

// As the viewer does: one turn about the blended place. Body and wings hold by the fourth power of their
// gaps; the bones of a wing share its hold in proportion, so that skin between two of them folds evenly.
Skeleton::Frame Skeleton::carried(Vec3 p, const std::vector<Frame>& frames) const {
  Hold holds[kLimbs];
  double wings[2] = {1e18, 1e18};
  for (int limb = 0; limb < kLimbs; ++limb) {
    holds[limb] = hold(p, limb);
    if (limb >= kArm) wings[limb % 2] = std::min(wings[limb % 2], holds[limb].gap);
  }
  Quaternion turn{0, {}};
  Vec3 from, to;
  double sum = 0;
  for (int limb = 0; limb < kLimbs; ++limb) {
    const auto [joint, along, gap] = holds[limb];
    const double wing = wings[limb % 2], near = std::max(1 - gap / (kReach * wing), 0.0);
    const double weight =
        limb < kArm ? 1 / (gap * gap * gap * gap) : near * near / (wing * wing * wing * gap);
    const Frame &a = frames[joint - 1], &b = frames[joint];
    turn = turn + (a.turn * (1 - along) + b.turn * along) * weight;
    from = from + lerp(joints_[joint - 1].at, joints_[joint].at, along) * weight;
    to = to + lerp(a.at, b.at, along) * weight;
    sum += weight;
  }
  return {turn * (1 / sum), to * (1 / sum) + turned(p - from * (1 / sum), turn)};
}

std::vector<Vec3> Skeleton::carried(const Mesh& skin, const std::vector<Bend>& bends) const {
  const std::vector<Frame> frames = bent(bends);
  std::vector<Vec3> places;
  std::vector<Quaternion> turns;
  for (Vec3 p : skin.positions) {
    const Frame vertex = carried(p, frames);
    places.push_back(vertex.at), turns.push_back(vertex.turn);
  }
  std::vector<Edge> edges;
  for (const auto& corner : skin.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = corner[k], b = corner[(k + 1) % 3];
      edges.push_back({a, b, turned(skin.positions[b] - skin.positions[a], turns[a] + turns[b])});
    }
  }
  for (int step = 0; step < kEasing; ++step) places = eased(places, edges);
  return places;
}

}  // namespace viete::dragon
