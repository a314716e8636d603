#include "workspace/playing.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "document/edit.h"
#include "document/pose_edit.h"
#include "document/time_edit.h"

namespace viete::workspace {

namespace {

constexpr const char* leave_label = "go to frame";

bool is_current(const Workspace& w) {
  return w.playback.cage == w.document.cage() && w.playback.model == w.document.model().surface &&
         w.playback.timeline == w.document.timeline();
}

// The pose of the keys at the document's frame, cached because blending shapes is slow.
const TimedPose& timed_pose(const Workspace& w) {
  TimedPose& known = w.playback.by_time;
  const auto& animation = w.playback.animation;
  const double frame = w.document.frame();
  if (known.animation == animation && known.frame == frame) return known;
  known = {animation, frame};
  const bool linear = w.playback.timeline.linear;
  known.pose = std::make_shared<const document::WholePose>(animation->at(frame, linear, &known.base));
  return known;
}

// True if the keys have given the shown pose, and no edit has changed the pose later.
bool is_shown(const Workspace& w) {
  const document::PoseSource& source = w.document.source();
  return source.keyed && source.pose && shows(w.document, *source.pose);
}

bool has_keyed_pose(const Workspace& w) {
  return shows(w.document, *timed_pose(w).pose);
}

// Goes to a frame without storing an unkeyed pose.
void show_frame(Workspace& w, double frame) {
  w.document.put_frame(frame);
  if (const auto camera = camera_at(w.document.timeline(), frame)) w.view.camera.set_pose(*camera);
  show_keys(w);
}

void see(Workspace& w) {
  w.playback.seen_revision = w.document.history().revision();
  w.playback.seen_timeline = w.document.timeline();
}

bool leaves_unkeyed(Workspace& w) {
  animation_of(w);
  return has_unkeyed_pose(w) && differs_from_rest(w.document);
}

void leave_for(Workspace& w, double frame) {
  if (leaves_unkeyed(w)) {
    replace_pose(w, [&] { record_edit(w.document, leave_label); });
    w.messages.info("The previous pose was not keyed; undo restores it.");
  }
  show_frame(w, frame);
  see(w);
}

// True if there are edits that follow_edits() has not seen. Waits for the end of a drag, except of keys.
bool has_unseen_edits(const Workspace& w) {
  const bool moves_keys = w.view.time.drag.has_value();  // show dragged keys immediately
  return w.document.history().revision() != w.playback.seen_revision && (!is_dragging(w) || moves_keys);
}

// The keys give the shown pose. A mix is still known as a mix.
void take_as_keyed(Workspace& w) {
  document::Document& document = w.document;
  document::PoseSource& source = document.changed_source();
  using Kind = document::PoseSource::Kind;
  if (source_of(document) != Kind::mix && !source.kept) {
    source.kind = Kind::frame;
    source.base = timed_pose(w).base;
  }
  source.pose = shared_pose(document);
  source.keyed = true;
}

// Adds `factor` times the weights of the named poses in a key. A key without a mix has the weight 1 of the
// first equal pose: of several equal poses, only one makes the key.
void add_weights(const document::PoseKey& key, double factor, const std::vector<document::NamedPose>& poses,
                 std::vector<double>& weights) {
  const auto add = [&](const auto& pose, double weight) {
    if (pose != poses.end()) weights[static_cast<std::size_t>(pose - poses.begin())] += factor * weight;
  };
  for (const document::MixedPose& mixed : key.mix)
    add(std::ranges::find(poses, mixed.name, &document::NamedPose::name), mixed.weight);
  if (key.mix.empty())
    add(std::ranges::find_if(poses, [&](const auto& p) { return same_pose(*key.pose, *p.pose); }), 1);
}

// The weight of each named pose in the keys of the document's frame.
std::vector<double> key_mix(const Workspace& w) {
  const auto& poses = w.document.library().poses;
  const document::Timeline& timeline = w.document.timeline();
  std::vector<double> weights(poses.size());
  if (timeline.keys.empty()) return weights;
  for (const document::KeyShare& share : moment_at(timeline, w.document.frame()).shares)
    add_weights(timeline.keys[share.key], share.factor, poses, weights);
  return weights;
}

// The weight of each named pose in the pose of the keys at this frame.
std::vector<double> keyed_weights(const Workspace& w) {
  std::vector<double> weights = key_mix(w);
  const auto& poses = w.document.library().poses;
  for (std::size_t i = 0; i < poses.size(); ++i)
    weights[i] += weight_at(w.document.timeline(), poses[i].name, w.document.frame());
  return weights;
}

// True if the shown pose is the mix of the keyed weights.
bool is_keyed_mix(const Workspace& w) {
  const document::PoseSource& source = w.document.source();
  if (source_of(w.document) != document::PoseSource::Kind::mix || !source.on_keys) return false;
  const auto same = [](const document::NamedPose& named, double weight) {
    return std::abs(named.weight - weight) < 1e-9;
  };
  return std::ranges::equal(w.document.library().poses, keyed_weights(w), same);
}

// Sets a key after an edit: of the weight if a slider was moved, otherwise of the pose. Returns true if it
// has set a key of the pose.
bool set_auto_key(Workspace& w) {
  document::Document& document = w.document;
  const int frame = current_frame(document);
  const auto step = document.history().last_step();
  const bool slid = step && step->kind == document::EditKind::mix;
  try {
    document.changed_timeline() =
        slid ? with_weight_key(document.timeline(), document.library().poses[step->of], frame,
                               weight_upon_keys(w, step->of))
             : with_key(document, frame, shown_weights(w), &w.playback.vectors);
    document.changed_history().extend_last();
    see(w);
    animation_of(w);
    return !slid;
  } catch (const base::Error& error) {
    w.messages.error(error.what(), {"key"});
    return false;
  }
}

// Handles edits since the last call: sets an automatic key, or shows the frame of an edited timeline.
void follow_edits(Workspace& w) {
  Playback& p = w.playback;
  if (!has_unseen_edits(w)) return;
  const bool retimed = p.seen_timeline != w.document.timeline();
  see(w);
  if (!animation_of(w)) {
    w.document.changed_source().keyed = false;
    return;
  }
  const bool edited = !retimed && !is_shown(w) && !has_keyed_pose(w);
  const bool keyed = p.auto_key && edited && set_auto_key(w);
  if (has_keyed_pose(w)) {
    take_as_keyed(w);
  } else if (keyed || is_keyed_mix(w)) {
    show_keys(w);
  } else if (retimed && is_shown(w)) {
    show_frame(w, w.document.frame());
  } else {
    p.playing = false;
  }
}

void play(Workspace& w, double seconds) {
  const auto frame = played(w.document.timeline(), w.document.frame(), seconds, w.playback.backward);
  if (frame) return show_frame(w, *frame);
  show_frame(w, w.playback.backward ? w.document.timeline().first : w.document.timeline().last);
  stop_playing(w);
}

}  // namespace

std::shared_ptr<const document::Animation> animation_of(Workspace& w) {
  Playback& p = w.playback;
  const document::Document& document = w.document;
  if (is_editing_cage(document)) return nullptr;
  if (is_current(w) && (p.animation || !p.timeline.has_poses())) return p.animation;
  p.by_time = {};
  p.animation = nullptr;  // owns poses, whose vectors would stay in the cache
  p.vectors.follow(document.cage());
  p.vectors.follow_model(document.model().surface);
  p.cage = document.cage();
  p.model = document.model().surface;
  p.timeline = document.timeline();
  p.animation =
      p.timeline.has_poses() ? std::make_shared<const document::Animation>(p.timeline, p.vectors) : nullptr;
  return p.animation;
}

bool has_unkeyed_pose(const Workspace& w) {
  if (!w.document.timeline().has_poses() || is_editing_cage(w.document) || is_shown(w)) return false;
  const bool known = w.playback.animation && is_current(w);
  return !known || !has_keyed_pose(w);
}

void go_to_frame(Workspace& w, double frame) {
  if (is_dragging(w) || is_editing_cage(w.document) || std::isnan(frame)) return;
  leave_for(w, std::clamp<double>(frame, document::Timeline::least_frame, document::Timeline::largest_frame));
}

std::vector<double> shown_weights(const Workspace& w) {
  const auto& poses = w.document.library().poses;
  const document::Timeline& timeline = w.document.timeline();
  std::vector<double> weights(poses.size());
  std::ranges::transform(poses, weights.begin(), &document::NamedPose::weight);
  if (w.document.library().mixes() || !timeline.has_poses()) return weights;
  const bool edits_frame =
      !timeline.channels.empty() && w.document.source().kind == document::PoseSource::Kind::frame;
  return edits_frame || !has_unkeyed_pose(w) ? keyed_weights(w) : weights;
}

double weight_upon_keys(const Workspace& w, std::size_t pose) {
  return shown_weights(w)[pose] - key_mix(w)[pose];
}

void show_keys(Workspace& w) {
  if (animation_of(w))
    show_pose(w.document, *timed_pose(w).pose, document::PoseSource::Kind::frame, timed_pose(w).base);
}

void replace_pose(Workspace& w, const std::function<void()>& edit) {
  const bool unkeyed = leaves_unkeyed(w);
  document::PoseKey left{current_frame(w.document), unkeyed ? shared_pose(w.document) : nullptr};
  edit();
  const auto has_it = [&](const auto& kept) { return *kept.pose == *left.pose; };
  document::Timeline& t = w.document.changed_timeline();
  if (unkeyed && std::ranges::none_of(t.keys, has_it) &&
      std::ranges::none_of(w.document.library().poses, has_it))
    t.unkeyed.push_back(std::move(left));
}

void apply_pose(Workspace& w, std::size_t pose) {
  stop_playing(w);
  replace_pose(w, [&] { apply_pose(w.document, pose); });
}

void change_mix(Workspace& w, const std::function<bool()>& change) {
  stop_playing(w);
  if (change()) return w.messages.succeeded("mix");
  w.messages.error("these weights move the model too far to draw; nothing was changed", {"mix"});
}

void go_to_key(Workspace& w, bool forward) {
  const std::vector<int> frames = key_frames(w.document.timeline());
  if (frames.empty()) return;
  const double now = w.document.frame();
  if (forward) {
    const auto next = std::ranges::upper_bound(frames, now);
    return go_to_frame(w, next == frames.end() ? frames.front() : *next);
  }
  const auto here = std::ranges::lower_bound(frames, now);
  go_to_frame(w, here == frames.begin() ? frames.back() : *(here - 1));
}

void add_unkeyed_to_undo(Workspace& w, bool show) {
  document::Document& document = w.document;
  const std::size_t count = document.timeline().unkeyed.size();
  const bool shows_keys = animation_of(w) && has_keyed_pose(w);
  if (shows_keys) take_as_keyed(w);  // files do not contain the source of the pose
  if (count == 0) return;
  document::Document then = document.without_history();
  end_mix(then);
  then.changed_timeline().unkeyed.clear();
  for (const document::PoseKey& left : document.timeline().unkeyed) {
    show_pose(then, *left.pose, document::PoseSource::Kind::edited);
    then.put_frame(left.frame);
    document.changed_history().record(leave_label, then.state());
    then.changed_timeline().unkeyed.push_back(left);
  }
  const bool shown = show && shows_keys;
  if (shown) undo(document);
  see(w);
  w.messages.info(shown ? "The pose at this frame is not keyed; set a key (I) to keep it."
                        : "Undo restores " + base::counted(count, "unkeyed pose") + ".");
}

void start_playing(Workspace& w) {
  Playback& p = w.playback;
  const document::Timeline& t = w.document.timeline();
  if (t.empty() || is_editing_cage(w.document) || is_dragging(w)) return;
  p.playing = true;
  p.backward = false;
  const bool at_end = t.repeat == document::Repeat::once && w.document.frame() >= t.last;
  const bool outside = w.document.frame() < t.first || w.document.frame() > t.last;
  go_to_frame(w, at_end || outside ? t.first : w.document.frame());
}

void stop_playing(Workspace& w) {
  if (!w.playback.playing) return;
  w.playback.playing = false;
  leave_for(w, std::round(w.document.frame()));
}

bool time_is_due(const Workspace& w) {
  return w.playback.playing || has_unseen_edits(w);
}

void follow_time(Workspace& w, double seconds) {
  if (w.playback.playing && (is_dragging(w) || is_editing_cage(w.document) || w.document.timeline().empty()))
    w.playback.playing = false;
  follow_edits(w);
  if (w.playback.playing) play(w, seconds);
}

document::SharedPose pose_by_other_blending(Workspace& w) {
  const bool linear = !w.document.timeline().linear;
  const auto animation = animation_of(w);
  if (animation && is_shown(w))
    return std::make_shared<const document::WholePose>(animation->at(w.document.frame(), linear));
  return mixed_by(w.document, w.playback.vectors, linear);
}

bool has_blended_pose(const Workspace& w) {
  return w.document.timeline().has_poses() || w.document.library().mixes();
}

void follow_pins(Workspace& w) {
  try {
    const document::PinPosing::Hand hand{w.view.handling.freedom, w.view.interaction.drag.has_value()};
    if (w.frame.pins.follow(w.document, w.playback.vectors, hand)) w.messages.succeeded("pins");
  } catch (const base::Error& error) {
    w.messages.error(error.what(), {"pins"});
  }
}

}  // namespace viete::workspace
