#include "scene/animation.h"

#include <algorithm>

namespace viete::scene {

namespace {

using mesh::operator+, mesh::operator*;

void add_share(deform::ProbePose& sum, const deform::ProbePose& pose, double factor) {
  sum.turn = sum.turn + factor * pose.turn;
  sum.move = sum.move + factor * pose.move;
  auto &a = sum.stretch, b = pose.stretch;
  a = {a.xx + factor * b.xx, a.xy + factor * b.xy, a.xz + factor * b.xz,
       a.yy + factor * b.yy, a.yz + factor * b.yz, a.zz + factor * b.zz};
}

}  // namespace

void KnownVectors::follow(const std::shared_ptr<const deform::Cage>& cage) {
  if (cage == cage_) {
    std::erase_if(known_, [](const auto& entry) { return entry.second.pose.use_count() == 1; });
    return;
  }
  known_.clear();
  cage_ = cage;
  space_ = cage ? std::make_shared<const deform::PoseSpace>(cage) : nullptr;
}

std::shared_ptr<const deform::PoseVector> KnownVectors::of(const SharedPose& pose,
                                                           std::span<const mesh::Vec3> turns_before) {
  if (!space_) return nullptr;
  Known& known = known_[pose.get()];
  const bool depends = pose->cage.turns.empty();
  if (known.vector && (!depends || std::ranges::equal(known.turns_before, turns_before))) return known.vector;
  known = {pose,
           {turns_before.begin(), turns_before.end()},
           std::make_shared<const deform::PoseVector>(space_->vector(pose->cage, turns_before))};
  return known.vector;
}

std::vector<deform::ProbePose> blended_probes(std::span<const ProbeTerm> terms) {
  std::size_t count = 0;
  for (const auto& [poses, factor] : terms) count = std::max(count, poses->size());
  std::vector<deform::ProbePose> sum(count);
  for (const auto& [poses, factor] : terms)
    for (std::size_t i = 0; i < poses->size(); ++i) add_share(sum[i], (*poses)[i], factor);
  return sum;
}

Animation::Animation(const Timeline& timeline, KnownVectors& vectors)
    : timeline_(timeline), space_(vectors.space()) {
  if (!space_) return;
  std::span<const mesh::Vec3> turns;
  for (const PoseKey& key : timeline_.keys) {
    vectors_.push_back(vectors.of(key.pose, turns));
    turns = vectors_.back()->turns;
  }
  for (std::size_t i = 0; i + 1 < vectors_.size(); ++i)
    held_.push_back(space_->held_between(*vectors_[i], *vectors_[i + 1]));
}

WholePose Animation::at(double frame) const {
  return at(frame, timeline_.straight);
}

WholePose Animation::at(double frame, bool straight) const {
  const auto& keys = timeline_.keys;
  const Moment moment = moment_at(timeline_, frame);
  if (moment.shares.size() == 1) {
    const std::size_t key = moment.shares.front().key;
    WholePose pose = *keys[key].pose;
    if (space_ && pose.cage.turns.empty()) pose.cage.turns = vectors_[key]->turns;
    return pose;
  }
  WholePose pose;
  std::vector<ProbeTerm> probes;
  for (const auto& [key, factor] : moment.shares) probes.push_back({&keys[key].pose->probes, factor});
  pose.probes = blended_probes(probes);
  if (!space_) return pose;
  std::vector<deform::PoseTerm> terms;
  for (const auto& [key, factor] : moment.shares) terms.push_back({vectors_[key].get(), factor});
  const deform::PoseVector sum = deform::sum(space_->cage(), terms);
  pose.cage = straight ? space_->straight(sum) : space_->pose(sum, held_[moment.from]);
  return pose;
}

}  // namespace viete::scene
