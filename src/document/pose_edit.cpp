#include "document/pose_edit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "base/worker_pool.h"

namespace viete::document {

namespace {

// Keeps the current pose of locked probes, so that the mix does not move them.
void keep_locked(const Document& document, WholePose& pose) {
  const auto& all = document.probes().all;
  pose.probes.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].locked) pose.probes[i] = all[i].pose;
}

SharedPose rest_of(const Document& document) {
  WholePose pose;
  if (document.has_cage()) pose.cage = pose::rest_pose(*document.cage());
  keep_locked(document, pose);
  return std::make_shared<const WholePose>(std::move(pose));
}

// Returns `base` plus the weighted poses of the library. Locked probes keep their current pose.
SharedPose mixed_upon(const Document& document, VectorCache& vectors, const SharedPose& base,
                      const PoseLibrary& library, bool linear) {
  if (!library.mixes()) return base;
  vectors.follow(document.cage());
  vectors.follow_model(document.model().surface);
  WholePose pose = document::mixed_upon(vectors, base, library.poses, linear);
  keep_locked(document, pose);
  return std::make_shared<const WholePose>(std::move(pose));
}

// The weight of a named pose in the current pose, without the weight that PoseSource::base contains.
double weight_upon_base(const Document& document, const NamedPose& named) {
  const bool keyed = document.source().kind == PoseSource::Kind::frame;
  return keyed ? weight_at(document.timeline(), named.name, document.frame()) : named.weight;
}

bool are_weights(const PoseLibrary& library) {
  return std::ranges::all_of(library.poses, [](const NamedPose& p) {
    return p.weight >= PoseLibrary::least_weight && p.weight <= PoseLibrary::largest_weight;
  });
}

// Calls `change` for a copy of the state, and applies the new mix. If a weight or the new pose is out of
// range, changes nothing and returns false. set_weight() explains `played`.
template <class Change>
bool remix(Document& document, VectorCache& vectors, const std::string& label, Change change,
           EditStep step = {}, std::span<const double> played = {}) {
  DocumentState changed = document.state();
  for (std::size_t i = 0; i < played.size(); ++i) changed.library.poses[i].weight = played[i];
  const SharedPose base = pose_without(document, vectors, changed.library);
  change(changed);
  const SharedPose pose = mixed_upon(document, vectors, base, changed.library, changed.timeline.linear);
  if (!are_weights(changed.library) || !in_range(*pose)) return false;
  const PoseSource& source = document.source();
  const bool on_keys = (source.keyed || (source.kind == PoseSource::Kind::mix && source.on_keys)) &&
                       source.pose && shows(document, *source.pose);
  const DocumentState* last = document.history().before_last();
  record_step(document, label, step, step.kind == EditKind::mix && last && last->frame == document.frame());
  document.changed_library() = std::move(changed.library);
  document.changed_timeline() = std::move(changed.timeline);
  const bool mixes = document.library().mixes();
  show_pose(document, *pose, mixes ? PoseSource::Kind::mix : PoseSource::Kind::edited, base);
  document.changed_source().on_keys = on_keys;
  return true;
}

}  // namespace

bool PoseLibrary::mixes() const {
  return std::ranges::any_of(poses, [](const NamedPose& p) { return p.weight != 0; });
}

WholePose whole_pose(const Document& document) {
  WholePose pose;
  if (document.has_cage()) {
    pose.cage = real_pose(document);
    pose.cage.turns.resize(document.cage()->roots.size());  // missing turns are 0
  }
  for (const pose::Probe& probe : document.probes().all) pose.probes.push_back(probe.pose);
  pose.shape = document.shape();
  return pose;
}

SharedPose shared_pose(const Document& document) {
  return std::make_shared<const WholePose>(whole_pose(document));
}

bool shows(const Document& document, const WholePose& pose) {
  if (document.has_cage() && !same_pose(pose.cage, real_pose(document))) return false;
  if (!same_shape(pose.shape, document.shape())) return false;
  const auto& probes = document.probes().all;
  for (std::size_t i = 0; i < probes.size(); ++i)
    if (!probes[i].locked && !probes[i].pin && !(probes[i].pose == pose.probe(i))) return false;
  return true;
}

PoseSource::Kind source_of(const Document& document) {
  const PoseSource& source = document.source();
  if (source.kept) return PoseSource::Kind::rest;
  return source.pose && shows(document, *source.pose) ? source.kind : PoseSource::Kind::edited;
}

void show_pose(Document& document, const WholePose& pose, PoseSource::Kind kind, SharedPose base) {
  if (kind != PoseSource::Kind::mix) end_mix(document);
  document.put_shape(pose.shape);
  if (document.has_cage()) document.changed_pose() = pose.cage;
  auto& probes = document.changed_probes().all;
  for (std::size_t i = 0; i < probes.size(); ++i)
    if (!probes[i].locked) probes[i].pose = pose.probe(i);
  move_pins_to_shape(document);
  document.changed_source() = {kind};
  if (kind == PoseSource::Kind::edited) return;
  document.changed_source().pose = shared_pose(document);
  document.changed_source().base = std::move(base);
  document.changed_source().keyed = kind == PoseSource::Kind::frame;
}

void move_pins_to_shape(Document& document) {
  for (pose::Probe& probe : document.changed_probes().all)
    if (probe.pin) probe.pose = {.move = shape_of_vertex(document, probe.pin->vertex) - probe.place};
}

namespace {

// Afterwards, the pose is not known as a mix.
void forget_base(Document& document) {
  PoseSource& source = document.changed_source();
  source.base = nullptr;
  if (source.kind == PoseSource::Kind::mix)
    source.kind = source.keyed ? PoseSource::Kind::frame : PoseSource::Kind::edited;
}

}  // namespace

void end_mix(Document& document) {
  for (NamedPose& named : document.changed_library().poses) named.weight = 0;
  forget_base(document);
}

SharedPose unmixed_pose(const Document& document) {
  const PoseSource& source = document.source();
  const bool mixed = document.library().mixes() && source.kind == PoseSource::Kind::mix;
  return mixed && shows(document, *source.pose) ? source.base : nullptr;
}

namespace {

// Returns the pose upon which the weighted poses make the current pose: the rest pose, if it is exactly this
// pose. The current pose without the logs of the weighted poses is not exact, because the cage is fitted to
// sums of logs. Therefore subtracts the logs of the error as long as the error decreases.
SharedPose unknown_base(const Document& document, VectorCache& vectors, const SharedPose& now,
                        const PoseLibrary& weighted) {
  const bool linear = document.timeline().linear;
  const SharedPose rest = rest_of(document);
  if (same_pose(*mixed_upon(document, vectors, rest, weighted, linear), *now)) return rest;
  PoseLibrary change = weighted;
  for (NamedPose& named : change.poses) named.weight = -named.weight;
  SharedPose base = mixed_upon(document, vectors, now, change, linear), best = base;
  for (double least = std::numeric_limits<double>::infinity(); document.has_cage() && !now->shape;) {
    const SharedPose mixed = mixed_upon(document, vectors, base, weighted, linear);
    double error = 0;
    for (std::size_t v = 0; v < now->cage.positions.size(); ++v)
      error = std::max(error, mesh::largest_abs(now->cage.positions[v] - mixed->cage.positions[v]));
    if (!(error < 0.9 * least)) break;
    best = base;
    if (error < 1e-12 * document.cage()->diagonal) break;
    least = error;
    change.poses = {{"", now, 1}, {"", mixed, -1}};
    base = mixed_upon(document, vectors, base, change, linear);
  }
  return best;
}

}  // namespace

SharedPose pose_without(const Document& document, VectorCache& vectors, PoseLibrary weighted) {
  const SharedPose now = shared_pose(document);
  if (!weighted.mixes()) return now;
  const PoseSource& source = document.source();
  if (source.base && source.pose && shows(document, *source.pose)) {
    for (std::size_t i = 0; i < weighted.poses.size(); ++i)
      weighted.poses[i].weight =
          weight_upon_base(document, document.library().poses[i]) - weighted.poses[i].weight;
    return mixed_upon(document, vectors, source.base, weighted, document.timeline().linear);
  }
  return unknown_base(document, vectors, now, weighted);
}

std::string free_name(const PoseLibrary& library, const std::string& wish) {
  const std::string base = wish.empty() ? "pose" : base::cut(wish, PoseLibrary::longest_name);
  std::string name = base;
  for (int n = 2; std::ranges::count(library.poses, name, &NamedPose::name) > 0; ++n) {
    const std::string number = ' ' + std::to_string(n);
    name = base::cut(base, PoseLibrary::longest_name - number.size()) + number;
  }
  return name;
}

void follow_library(const PoseLibrary& library, Timeline& timeline) {
  const auto pose_of = [&](const Channel& channel) {
    const auto named = std::ranges::find(library.poses, channel.name, &NamedPose::name);
    return named == library.poses.end() ? nullptr : named->pose;
  };
  for (Channel& channel : timeline.channels) channel.pose = pose_of(channel);
  std::erase_if(timeline.channels, [](const Channel& channel) { return !channel.pose; });
}

namespace {

// Renames the pose in the mixes of all keys. If `to` is empty, removes the pose from the mixes.
void rename_in_keys(Timeline& timeline, const std::string& name, const std::string& to) {
  for (PoseKey& key : timeline.keys) {
    for (MixedPose& mixed : key.mix)
      if (mixed.name == name) mixed.name = to;
    if (to.empty()) std::erase_if(key.mix, [](const MixedPose& mixed) { return mixed.name.empty(); });
  }
}

void add_named(Document& document, std::vector<NamedPose> poses, const char* label) {
  const std::size_t count = document.library().poses.size();
  if (count + poses.size() > PoseLibrary::most_poses)
    throw base::Error("", "the pose list is full", "delete some of the " + std::to_string(count) + " poses");
  record_edit(document, label);
  for (NamedPose& pose : poses) {
    pose.name = free_name(document.library(), pose.name);
    document.changed_library().poses.push_back(std::move(pose));
  }
}

// After a change of weights that keeps the current pose: this pose is the mix upon the pose at rest.
void mix_upon_rest(Document& document) {
  PoseSource& source = document.changed_source();
  source.kind = PoseSource::Kind::mix;
  source.pose = shared_pose(document);
  source.base = rest_of(document);
  source.on_keys = false;
}

// Sets the weight of a named pose, which the document must have, to 1 and the other weights to 0.
void mix_only(Document& document, std::size_t pose) {
  end_mix(document);
  document.changed_library().poses[pose].weight = 1;
  mix_upon_rest(document);
}

}  // namespace

std::vector<MixedPose> mixed_poses(const PoseLibrary& library) {
  std::vector<MixedPose> mix;
  for (const auto& [name, pose, weight] : library.poses)
    if (weight != 0)
      mix.push_back({name, std::clamp(weight, PoseLibrary::least_weight, PoseLibrary::largest_weight)});
  return mix;
}

std::size_t keep_pose(Document& document, VectorCache& vectors, const std::string& name,
                      std::span<const double> played) {
  PoseLibrary weighted = document.library();
  for (std::size_t i = 0; i < played.size(); ++i) weighted.poses[i].weight = played[i];
  const SharedPose added = pose_without(document, vectors, weighted);
  if (!in_range(*added))
    throw base::Error("", "the current pose is too far from the weighted poses", "clear the weights first");
  add_named(document, {{name, added}}, "add pose");
  for (std::size_t i = 0; i < played.size(); ++i) document.changed_library().poses[i].weight = played[i];
  document.changed_library().poses.back().weight = 1;
  mix_upon_rest(document);
  for (PoseKey& key : document.changed_timeline().keys)
    if (!key.mix.empty() && same_pose(*key.pose, *document.source().pose))
      key.mix = mixed_poses(document.library());
  return document.library().poses.size() - 1;
}

void add_poses(Document& document, std::vector<NamedPose> poses) {
  add_named(document, std::move(poses), "import poses");
}

void add_shapes(Document& document, std::vector<NamedShape> shapes) {
  const pose::Pose cage = document.has_cage() ? pose::rest_pose(*document.cage()) : pose::Pose();
  std::vector<NamedPose> poses;
  for (NamedShape& shape : shapes)
    poses.push_back({std::move(shape.name),
                     std::make_shared<const WholePose>(WholePose{cage, {}, std::move(shape.shape)})});
  add_named(document, std::move(poses), "import shapes");
}

void update_pose(Document& document, std::size_t pose) {
  record_edit(document, "update pose");
  document.changed_library().poses[pose].pose = shared_pose(document);
  mix_only(document, pose);
  rename_in_keys(document.changed_timeline(), document.library().poses[pose].name, "");
  follow_library(document.library(), document.changed_timeline());
}

void apply_pose(Document& document, std::size_t pose) {
  record_edit(document, "apply pose");
  show_pose(document, *document.library().poses[pose].pose, PoseSource::Kind::edited);
  mix_only(document, pose);
}

void rename_pose(Document& document, std::size_t pose, const std::string& name) {
  if (document.library().poses[pose].name == name || name.empty()) return;
  record_edit(document, "rename pose");
  const std::string before = std::exchange(document.changed_library().poses[pose].name, "");
  document.changed_library().poses[pose].name = free_name(document.library(), name);
  rename_in_keys(document.changed_timeline(), before, document.library().poses[pose].name);
  for (Channel& channel : document.changed_timeline().channels)
    if (channel.name == before) channel.name = document.library().poses[pose].name;
}

void move_pose(Document& document, std::size_t pose, std::size_t to) {
  auto& poses = document.changed_library().poses;
  if (to == pose || to == pose + 1) return;
  record_edit(document, "move pose");
  NamedPose moved = std::move(poses[pose]);
  poses.erase(poses.begin() + static_cast<std::ptrdiff_t>(pose));
  poses.insert(poses.begin() + static_cast<std::ptrdiff_t>(to > pose ? to - 1 : to), std::move(moved));
}

void remove_pose(Document& document, VectorCache& vectors, std::size_t pose) {
  constexpr const char* label = "delete pose";
  const auto erase = [pose](DocumentState& state) {
    auto& poses = state.library.poses;
    rename_in_keys(state.timeline, poses[pose].name, "");
    poses.erase(poses.begin() + static_cast<std::ptrdiff_t>(pose));
    follow_library(state.library, state.timeline);
  };
  if (document.library().poses[pose].weight != 0 && remix(document, vectors, label, erase)) return;
  record_edit(document, label);
  if (document.library().poses[pose].weight != 0) end_mix(document);
  DocumentState erased = document.state();
  erase(erased);
  document.changed_library() = std::move(erased.library);
  document.changed_timeline() = std::move(erased.timeline);
}

bool set_weight(Document& document, VectorCache& vectors, std::size_t pose, double weight,
                std::span<const double> played) {
  if (std::isnan(weight)) return false;
  weight = std::clamp(weight, PoseLibrary::least_weight, PoseLibrary::largest_weight);
  const NamedPose& named = document.library().poses[pose];
  if ((played.empty() ? named.weight : played[pose]) == weight) return true;
  const std::string label = "change weight of " + named.name;
  const auto change = [&](DocumentState& state) { state.library.poses[pose].weight = weight; };
  return remix(document, vectors, label, change, {EditKind::mix, pose}, played);
}

bool clear_mix(Document& document, VectorCache& vectors, std::span<const double> played) {
  if (played.empty() && !document.library().mixes()) return true;
  const auto change = [](DocumentState& state) {
    for (NamedPose& named : state.library.poses) named.weight = 0;
  };
  return remix(document, vectors, "clear weights", change, {}, played);
}

SharedPose mixed_by(const Document& document, VectorCache& vectors, bool linear) {
  const SharedPose base = unmixed_pose(document);
  if (!base) return nullptr;
  const SharedPose pose = mixed_upon(document, vectors, base, document.library(), linear);
  return in_range(*pose) ? pose : nullptr;
}

bool set_linear(Document& document, VectorCache& vectors, bool linear) {
  if (document.timeline().linear == linear) return true;
  const char* const label = linear ? "interpolate linearly" : "interpolate in log space";
  const auto change = [linear](DocumentState& state) { state.timeline.linear = linear; };
  if (document.library().mixes()) return remix(document, vectors, label, change);
  record_edit(document, label);
  document.changed_timeline().linear = linear;
  return true;
}

namespace {

template <class Change>
void change_poses(Document& document, const Change& change) {
  const auto put = [&](SharedPose& pose) {
    WholePose changed = *pose;
    change(changed);
    pose = std::make_shared<const WholePose>(std::move(changed));
  };
  for (NamedPose& named : document.changed_library().poses) put(named.pose);
  for (auto* keys : {&document.changed_timeline().keys, &document.changed_timeline().unkeyed})
    for (PoseKey& key : *keys) put(key.pose);
  follow_library(document.library(), document.changed_timeline());
}

}  // namespace

void carry_poses(Document& document, const std::function<pose::Pose(const pose::Pose&)>& carried) {
  end_mix(document);
  change_poses(document, [&](WholePose& pose) { pose.cage = carried(pose.cage); });
}

namespace {

std::string counted_poses(std::size_t poses, std::size_t keys) {
  const std::string some = poses == 0 ? "" : base::counted(poses, "pose");
  const std::string others = keys == 0 ? "" : base::counted(keys, "key");
  return some.empty() || others.empty() ? some + others : some + " and " + others;
}

// Removes poses without a shape; puts `cage` into the other poses. Returns the number of removed poses.
template <class Keyed>
std::size_t keep_shapes(std::vector<Keyed>& all, const pose::Pose& cage) {
  const std::size_t lost = std::erase_if(all, [](const Keyed& keyed) { return !keyed.pose->shape; });
  for (Keyed& keyed : all)
    keyed.pose = std::make_shared<const WholePose>(WholePose{cage, keyed.pose->probes, keyed.pose->shape});
  return lost;
}

}  // namespace

std::string drop_poses(Document& document, const pose::Cage& by) {
  const pose::Pose rest = pose::rest_pose(by);
  end_mix(document);
  const std::size_t poses = keep_shapes(document.changed_library().poses, rest);
  const std::size_t keys = keep_shapes(document.changed_timeline().keys, rest);
  keep_shapes(document.changed_timeline().unkeyed, rest);
  follow_library(document.library(), document.changed_timeline());
  return counted_poses(poses, keys);
}

std::string keep_shapes(Document& to, const Document& from) {
  to.put_shape(from.shape());
  to.changed_library() = from.library();
  to.changed_timeline() = from.timeline();
  to.put_frame(from.frame());
  return drop_poses(to, *to.cage());
}

void forget_probe(Document& document, std::size_t probe) {
  change_poses(document, [probe](WholePose& pose) {
    if (probe < pose.probes.size())
      pose.probes.erase(pose.probes.begin() + static_cast<std::ptrdiff_t>(probe));
  });
  forget_base(document);
}

void set_pose(Document& document, pose::Pose pose) {
  record_edit(document, "open pose");
  end_mix(document);
  document.changed_source() = {};
  document.changed_pose() = std::move(pose);
}

}  // namespace viete::document
