// Commands for named poses and the timeline.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "document/pose_edit.h"
#include "document/time_edit.h"
#include "workspace/command_tables.h"
#include "workspace/playing.h"
#include "workspace/time_view.h"

namespace viete::workspace {

namespace {

constexpr Condition can_pose{
    "Open a cage, add a probe or import shapes first. Leave cage editing.",
    [](const Workspace& w) { return is_movable(w) && !is_editing_cage(w.document) && !is_dragging(w); }};
constexpr Condition has_chosen_pose{"Choose a pose in the list first. Add pose adds the current pose.",
                                    [](const Workspace& w) { return can_pose(w) && chosen_pose(w); }};
constexpr Condition has_mix{"All weights are 0 %: move the slider of a pose first.", [](const Workspace& w) {
                              const auto is_set = [](double weight) { return weight != 0; };
                              return can_pose(w) && std::ranges::any_of(shown_weights(w), is_set);
                            }};
constexpr Condition has_time{"No keys yet: pose the model and set a key (I).", [](const Workspace& w) {
                               return !w.document.timeline().empty() && !is_editing_cage(w.document) &&
                                      !is_dragging(w);
                             }};
// Shortcuts that change the frame work only while the timeline is shown.
constexpr Condition shows_time{"Show the timeline first.", [](const Workspace& w) {
                                 return has_model(w) && w.preferences.layout.timeline &&
                                        !is_editing_cage(w.document) && !is_dragging(w);
                               }};
constexpr Condition shows_keys{"Show the timeline and set a key first (I).",
                               [](const Workspace& w) { return has_time(w) && shows_time(w); }};
constexpr Condition has_pose_keys{"No keys yet: pose the model and set a key (I).", [](const Workspace& w) {
                                    return has_time(w) && w.document.timeline().has_poses();
                                  }};
constexpr Condition can_key_camera{"Open a model first.",
                                   [](const Workspace& w) { return has_model(w) && !is_dragging(w); }};
constexpr Condition has_selected_keys{"Select keys in the timeline first.", [](const Workspace& w) {
                                        return has_time(w) && !selected_keys(w).empty();
                                      }};
constexpr Condition deletes_keys{
    "Select keys in the timeline first and keep the pointer over the timeline.",
    [](const Workspace& w) { return has_selected_keys(w) && w.view.time.hovered; }};

template <class Edit>
void try_edit(Workspace& w, const char* what, Edit edit) {
  try {
    edit();
    w.messages.succeeded(what);
  } catch (const base::Error& error) {
    w.messages.error(error.what(), {what});
  }
}

void keep(Workspace& w) {
  try_edit(w, "poses", [&] {
    const auto& poses = w.document.library().poses;
    const std::string name = "Pose " + std::to_string(poses.size() + 1);
    w.view.chosen_pose = keep_pose(w.document, w.playback.vectors, name, shown_weights(w));
    const document::SharedPose& added = poses.back().pose;
    if (poses.size() > 1 && !document::same_pose(*added, *w.document.source().pose) &&
        document::same_pose(*added, *w.document.source().base))
      w.messages.info("The weighted poses already make the current pose, so " + poses.back().name +
                      " adds nothing to them. Update pose stores the whole pose in it.");
  });
}

void remove(Workspace& w) {
  remove_pose(w.document, w.playback.vectors, *w.view.chosen_pose);
  const std::size_t left = w.document.library().poses.size();
  w.view.chosen_pose = left == 0 ? std::nullopt : std::optional(std::min(*w.view.chosen_pose, left - 1));
}

// Sets keys. If the timeline is closed or has no keys yet, opens the timeline and shows all keys.
void set_keys(Workspace& w, const auto& set, const std::string& done) {
  try_edit(w, "key", [&] {
    const bool shown = w.preferences.layout.timeline && !w.document.timeline().empty();
    stop_playing(w);
    set();
    if (!shown) show_timeline(w);
    w.messages.info(done);
  });
}

std::string key_message(bool replaces, const std::string& what, int frame) {
  const std::string at = std::to_string(frame);
  return replaces ? what + " at frame " + at + " replaced; undo restores the old one."
                  : what + " set at frame " + at + '.';
}

// Sets a key of the weight of a named pose. If the key has this weight already, deletes the key.
void key_weight(Workspace& w, std::size_t pose) {
  stop_playing(w);
  const int frame = current_frame(w.document);
  const std::string name = w.document.library().poses[pose].name;
  const document::KeyPlace place(frame, name);
  const double weight = weight_upon_keys(w, pose);
  const document::Channel* channel = channel_of(w.document.timeline(), name);
  const document::WeightKey* key = channel ? key_at(channel->keys, frame) : nullptr;
  if (key && std::abs(key->weight - weight) < 1e-9) return remove_keys(w.document, std::vector{place});
  const auto set = [&] {
    set_weight_key(w.document, pose, frame, weight);
    w.view.time.selected = {place};
  };
  set_keys(w, set, key_message(key, "Key of " + name, frame));
}

void key_pose(Workspace& w) {
  const auto hovered = w.panels.hovered_weight;
  if (hovered && *hovered < w.document.library().poses.size()) return key_weight(w, *hovered);
  const int frame = current_frame(w.document);
  const auto set = [&] {
    set_key(w.document, frame, shown_weights(w), &w.playback.vectors);
    if (!w.document.timeline().channels.empty()) show_keys(w);
    w.view.time.selected = {frame};
  };
  set_keys(w, set, key_message(key_at(w.document.timeline(), frame), "Key", frame));
}

void key_camera(Workspace& w) {
  const int frame = current_frame(w.document);
  const auto set = [&] {
    set_camera_key(w.document, frame, w.view.camera.pose());
    w.view.time.selected = {frame};
  };
  set_keys(w, set, key_message(key_at(w.document.timeline().cameras, frame), "Camera key", frame));
}

void key_turntable(Workspace& w) {
  const document::Timeline& t = w.document.timeline();
  set_keys(
      w, [&] { set_turntable(w.document, w.view.camera.pose()); },
      "Camera keys set from frame " + std::to_string(t.first) + " to " + std::to_string(t.last) + '.');
}

void delete_keys(Workspace& w) {
  remove_keys(w.document, selected_keys(w));
  w.view.time.selected.clear();
}

template <int Steps>
void step(Workspace& w) {
  stop_playing(w);
  go_to_frame(w, current_frame(w.document) + Steps);
}

template <bool Forward>
void to_key(Workspace& w) {
  stop_playing(w);
  go_to_key(w, Forward);
}

template <int document::Playing::*Frame>
void to_end(Workspace& w) {
  stop_playing(w);
  go_to_frame(w, w.document.timeline().*Frame);
}

void change_play(Workspace& w, const auto& change) {
  document::Playing play = w.document.timeline();
  change(play);
  set_play(w.document, play);
}

void fit_range(Workspace& w) {
  const std::vector<int> frames = key_frames(w.document.timeline());
  change_play(w, [&](document::Playing& play) {
    play.first = frames.front();
    play.last = frames.back();
  });
  w.view.time.seen = fitting(w.document.timeline());
}

void add_pose_commands(CommandTable& table) {
  table.heading("Poses");
  table.add("keep_pose", "Add pose",
            "Add the current pose, without the weighted poses, to the list with the weight 100 %.", can_pose,
            keep);
  table.add("apply_pose", {"Apply pose", "Apply"}, "Set model, cage and probes to the chosen pose.",
            has_chosen_pose, [](Workspace& w) { apply_pose(w, *w.view.chosen_pose); });
  table.add("update_pose", {"Update pose", "Update"},
            "Replace the chosen pose by the whole current pose and clear the other weights.", has_chosen_pose,
            [](Workspace& w) { update_pose(w.document, *w.view.chosen_pose); });
  table.add("remove_pose", {"Delete pose", "Delete"}, "Delete the chosen pose from the list.",
            has_chosen_pose, remove);
  table.add("clear_mix", "Clear weights", "Set the weights of all poses to 0 %. Other edits are kept.",
            has_mix, [](Workspace& w) {
              change_mix(w, [&] { return clear_mix(w.document, w.playback.vectors, shown_weights(w)); });
            });
  table.add("key_weight", "Key weight",
            "Set a key of the chosen pose's weight at this frame, or delete it. The pose is then animated on "
            "its own row.",
            has_chosen_pose, [](Workspace& w) { key_weight(w, *w.view.chosen_pose); });
}

}  // namespace

void add_time_commands(CommandTable& table) {
  add_pose_commands(table);
  table.heading("Time");
  table.add("play", "Play", "Play or stop the animation.", {Key::space}, has_time,
            {[](Workspace& w) { w.playback.playing ? stop_playing(w) : start_playing(w); },
             [](const Workspace& w) { return w.playback.playing; }});
  table.add(
      "set_key", "Set key",
      "Set a key for the current pose at this frame. Over the slider of a pose, set or delete a key of its "
      "weight.",
      {key('I')}, can_pose, key_pose);
  table.add("set_camera_key", {"Set camera key", "Camera key"},
            "Set a key for the current camera at this frame.", {key('I'), false, true}, can_key_camera,
            key_camera);
  table.add("turntable", {"Create turntable", "Turntable"},
            "Add camera keys that orbit the model once in the playback range. Replaces other camera keys.",
            can_key_camera, key_turntable);
  table.add("delete_keys", {"Delete selected keys", "Delete keys"},
            "Delete the selected keys. The shortcut works while the pointer is over the timeline.",
            {Key::delete_key}, deletes_keys, delete_keys);
  table.add("previous_frame", "Previous frame", "Go to the previous frame.", {Key::left}, shows_time,
            step<-1>);
  table.add("next_frame", "Next frame", "Go to the next frame.", {Key::right}, shows_time, step<1>);
  table.add("previous_key", "Previous key", "Go to the previous key.", {Key::down}, shows_keys,
            to_key<false>);
  table.add("next_key", "Next key", "Go to the next key.", {Key::up}, shows_keys, to_key<true>);
  table.add("first_frame", "First frame", "Go to the first frame of the playback range.",
            {Key::left, false, true}, shows_time, to_end<&document::Playing::first>);
  table.add("last_frame", "Last frame", "Go to the last frame of the playback range.",
            {Key::right, false, true}, shows_time, to_end<&document::Playing::last>);
  table.add("fit_range", {"Fit range to keys", "Fit to keys"},
            "Set the playback range from the first to the last key.", has_time, fit_range);
  add_choices<document::Easing>(table, "Easing", has_pose_keys, [](Workspace& w, document::Easing easing) {
    set_easing(w.document, eased_keys(w), easing);
  });
  add_choices<document::Repeat>(table, "After the last frame", has_model,
                                [](Workspace& w, document::Repeat repeat) {
                                  change_play(w, [&](document::Playing& play) { play.repeat = repeat; });
                                });
  table.add(
      "toggle_auto_key", "Auto key",
      "Set a key at this frame after each edit, for a slider a key of its weight. Works only if there is a "
      "key already.",
      always,
      {[](Workspace& w) { w.playback.auto_key ^= true; },
       [](const Workspace& w) { return w.playback.auto_key; }});
  table.add("toggle_linear", {"Linear interpolation", "Linear"},
            "Interpolate vertex positions linearly between keys and in weighted poses. When off, rotations "
            "and stretches are interpolated in log space.",
            has_model,
            {[](Workspace& w) {
               change_mix(w, [&] {
                 return set_linear(w.document, w.playback.vectors, !w.document.timeline().linear);
               });
             },
             [](const Workspace& w) { return w.document.timeline().linear; }});
  table.add("toggle_timeline", {"Show timeline", "Timeline"}, "Show or hide the timeline.",
            {key('T'), false, true}, always,
            {[](Workspace& w) { w.preferences.layout.timeline = !w.preferences.layout.timeline; },
             [](const Workspace& w) { return w.preferences.layout.timeline; }});
}

}  // namespace viete::workspace
