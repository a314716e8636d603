#include "scene/workspace/time_commands.h"

#include <algorithm>

#include "base/error.h"
#include "scene/document/pose_edit.h"
#include "scene/document/time_edit.h"
#include "scene/workspace/choice_commands.h"
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/file_commands.h"
#include "scene/workspace/playing.h"
#include "scene/workspace/time_gestures.h"

namespace viete::scene {

namespace {

constexpr Condition can_pose{
    [](const Workspace& w) { return is_movable(w) && !is_editing_cage(w.document) && !in_hand(w); },
    "Open a cage, add a probe or import shapes first, and pose it rather than edit it (Tab)."};
constexpr Condition has_chosen_pose{[](const Workspace& w) { return can_pose(w) && chosen_pose(w); },
                                    "Choose a pose of the list first; Keep pose makes one of what is there."};
constexpr Condition can_export_pose{[](const Workspace& w) { return has_chosen_pose(w) && has_cage(w); },
                                    "Choose a pose of the list first."};
constexpr Condition is_not_first_pose{
    [](const Workspace& w) { return has_chosen_pose(w) && *w.chosen_pose > 0; },
    "Choose a pose below the first one."};
constexpr Condition is_not_last_pose{[](const Workspace& w) {
                                       return has_chosen_pose(w) &&
                                              *w.chosen_pose + 1 < w.document.library.poses.size();
                                     },
                                     "Choose a pose above the last one."};
constexpr Condition has_mix{[](const Workspace& w) { return can_pose(w) && w.document.library.mixes(); },
                            "Nothing is mixed: move the slider of a pose."};
constexpr Condition can_average{[](const Workspace& w) {
                                  double sum = 0;
                                  for (const NamedPose& pose : w.document.library.poses) sum += pose.weight;
                                  return has_mix(w) && sum > 0;
                                },
                                "Mix in poses first, more above than below 0 %."};
constexpr Condition has_time{[](const Workspace& w) {
                               return !w.document.timeline.empty() && !is_editing_cage(w.document) &&
                                      !in_hand(w);
                             },
                             "No keys yet: pose the model and set a key (I)."};
// Keys of the keyboard that change time do nothing where time is not seen.
constexpr Condition shows_time{[](const Workspace& w) {
                                 return has_model(w) && w.remembered.layout.timeline &&
                                        !is_editing_cage(w.document) && !in_hand(w);
                               },
                               "Show the timeline first."};
constexpr Condition shows_keys{[](const Workspace& w) { return has_time(w) && shows_time(w); },
                               "Show the timeline and set a key first (I)."};
constexpr Condition has_pose_keys{
    [](const Workspace& w) { return has_time(w) && !w.document.timeline.keys.empty(); },
    "No keys yet: pose the model and set a key (I)."};
constexpr Condition can_key_camera{[](const Workspace& w) { return has_model(w) && !in_hand(w); },
                                   "Open a model first."};
constexpr Condition has_selected_keys{
    [](const Workspace& w) { return has_time(w) && !selected_keys(w).empty(); },
    "Select keys in the timeline first."};
constexpr Condition deletes_keys{
    [](const Workspace& w) { return has_selected_keys(w) && w.time_view.hovered; },
    "Select keys in the timeline first, and leave the pointer there."};

// What cannot be done is said, and changes nothing.
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
    const std::size_t n = w.document.library.poses.size();
    w.chosen_pose = keep_pose(w.document, "Pose " + std::to_string(n + 1));
  });
}

void duplicate(Workspace& w) {
  try_edit(w, "poses", [&] {
    duplicate_pose(w.document, *w.chosen_pose);
    ++*w.chosen_pose;
  });
}

void remove(Workspace& w) {
  remove_pose(w.document, w.playback.vectors, *w.chosen_pose);
  const std::size_t left = w.document.library.poses.size();
  if (left == 0) {
    w.chosen_pose.reset();
  } else {
    w.chosen_pose = std::min(*w.chosen_pose, left - 1);
  }
}

void move_up(Workspace& w) {
  move_pose(w.document, *w.chosen_pose, *w.chosen_pose - 1);
  --*w.chosen_pose;
}

void move_down(Workspace& w) {
  move_pose(w.document, *w.chosen_pose, *w.chosen_pose + 2);
  ++*w.chosen_pose;
}

// Opens the timeline, in which all keys are in sight if it was closed.
void set_keys(Workspace& w, const auto& set, const std::string& done) {
  try_edit(w, "key", [&] {
    const bool shown = w.remembered.layout.timeline && !w.document.timeline.empty();
    stop_playing(w);
    set();
    if (!shown) show_timeline(w);
    w.messages.info(done);
  });
}

template <class Key>
std::string key_message(const std::vector<Key>& keys, const char* what, int frame) {
  const bool replaces = std::ranges::find(keys, frame, &Key::frame) != keys.end();
  const std::string at = std::to_string(frame);
  return replaces ? std::string(what) + " at frame " + at + " replaced; undo brings the old one back."
                  : std::string(what) + " set at frame " + at + '.';
}

void key_pose(Workspace& w) {
  const int frame = current_frame(w.document);
  const std::vector<double> weights = shown_weights(w);
  const auto set = [&] {
    set_key(w.document, frame, weights);
    w.time_view.selected = {frame};
  };
  set_keys(w, set, key_message(w.document.timeline.keys, "Key", frame));
}

void key_camera(Workspace& w) {
  const int frame = current_frame(w.document);
  const auto set = [&] {
    set_camera_key(w.document, frame, w.camera.pose());
    w.time_view.selected = {frame};
  };
  set_keys(w, set, key_message(w.document.timeline.cameras, "Camera key", frame));
}

void key_turntable(Workspace& w) {
  const Timeline& t = w.document.timeline;
  set_keys(
      w, [&] { set_turntable(w.document, w.camera.pose()); },
      "Camera keys set from frame " + std::to_string(t.first) + " to " + std::to_string(t.last) + '.');
}

void delete_keys(Workspace& w) {
  remove_keys(w.document, selected_keys(w));
  w.time_view.selected.clear();
}

void play_or_stop(Workspace& w) {
  w.playback.playing ? stop_playing(w) : start_playing(w);
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

template <int Timeline::*Frame>
void to_end(Workspace& w) {
  stop_playing(w);
  go_to_frame(w, w.document.timeline.*Frame);
}

void change_play(Workspace& w, const auto& change) {
  Play play = play_of(w.document.timeline);
  change(play);
  set_play(w.document, play);
}

// What plays begins at the first key and ends at the last one.
void fit_range(Workspace& w) {
  const std::vector<int> frames = key_frames(w.document.timeline);
  change_play(w, [&](Play& play) { play.first = frames.front(), play.last = frames.back(); });
  w.time_view.seen = fitting(w.document.timeline);
}

void choose_easing(Workspace& w, Easing easing) {
  set_easing(w.document, eased_keys(w), easing);
}

void choose_repeat(Workspace& w, Repeat repeat) {
  change_play(w, [&](Play& play) { play.repeat = repeat; });
}

}  // namespace

void change_mix(Workspace& w, const std::function<bool()>& change) {
  stop_playing(w);
  if (change()) return w.messages.succeeded("mix");
  w.messages.error("the mix would leave what can be drawn; nothing was changed", {"mix"});
}

void add_time_commands(CommandTable& table) {
  table.heading("Poses");
  table.add("keep_pose", {"Keep this pose", "Keep pose"}, "Keep what is there now as a pose with a name.",
            can_pose, keep);
  table.add("apply_pose", {"Apply the chosen pose", "Apply"},
            "Put shape, cage and probes into the chosen pose.", has_chosen_pose,
            [](Workspace& w) { apply_pose(w, *w.chosen_pose); });
  table.add("update_pose", {"Update the chosen pose", "Update"}, "The chosen pose becomes what is there now.",
            has_chosen_pose, [](Workspace& w) { update_pose(w.document, *w.chosen_pose); });
  table.add("duplicate_pose", {"Duplicate the chosen pose", "Duplicate"}, "Another pose like the chosen one.",
            has_chosen_pose, duplicate);
  table.add("remove_pose", {"Delete the chosen pose", "Delete"},
            "Take the chosen pose out of the list; undo brings it back.", has_chosen_pose, remove);
  table.add("pose_up", {"Move the chosen pose up", "Move up"}, "Move the chosen pose up in the list.",
            is_not_first_pose, move_up);
  table.add("pose_down", {"Move the chosen pose down", "Move down"}, "Move the chosen pose down in the list.",
            is_not_last_pose, move_down);
  table.add("export_pose", {"Export the chosen pose", "Export pose"},
            "Write the cage in the chosen pose to a mesh file.", can_export_pose, browse_to_save_named_pose);
  table.add("clear_mix", "Clear mix", "All sliders back to 0 %: what was made by hand stays.", has_mix,
            [](Workspace& w) { change_mix(w, [&] { return clear_mix(w.document, w.playback.vectors); }); });
  table.add("average_mix", {"Average the mix", "Average"},
            "Divide all sliders by their sum: the mean of the poses that are mixed, in log space.",
            can_average,
            [](Workspace& w) { change_mix(w, [&] { return average_mix(w.document, w.playback.vectors); }); });
  table.add("toggle_mix_selected", {"Mix only into what is selected", "Only what is selected"},
            "The slider of a pose moves only what is selected when it leaves 0 %; else, or where nothing is "
            "selected, all of the cage.",
            has_cage, switches(&Handling::mix_selected, &Workspace::handling));
  table.heading("Time");
  table.add("play", "Play", "Play what is keyed, or stop.", {Key::space}, has_time,
            {play_or_stop, [](const Workspace& w) { return w.playback.playing; }});
  table.add("set_key", "Set a key", "Keep what is there now as the key of this frame.", {key('I')}, can_pose,
            key_pose);
  table.add("set_camera_key", {"Set a camera key", "Camera key"},
            "Keep where one looks from as a key of this frame.", {key('I'), false, true}, can_key_camera,
            key_camera);
  table.add("turntable", {"Turn the camera round", "Turntable"},
            "The camera goes once round the model over what plays; its other keys give way.", can_key_camera,
            key_turntable);
  table.add("delete_keys", {"Delete selected keys", "Delete keys"},
            "Delete the selected keys; by its key while the pointer is over the timeline.", {Key::delete_key},
            deletes_keys, delete_keys);
  table.add("previous_frame", "Previous frame", "One frame back.", {Key::left}, shows_time, step<-1>);
  table.add("next_frame", "Next frame", "One frame on.", {Key::right}, shows_time, step<1>);
  table.add("previous_key", "Previous key", "Back to the last key before this frame.", {Key::down},
            shows_keys, to_key<false>);
  table.add("next_key", "Next key", "On to the next key.", {Key::up}, shows_keys, to_key<true>);
  table.add("first_frame", "First frame", "To where playing begins.", {Key::left, false, true}, shows_time,
            to_end<&Timeline::first>);
  table.add("last_frame", "Last frame", "To where playing ends.", {Key::right, false, true}, shows_time,
            to_end<&Timeline::last>);
  table.add("fit_range", {"Play from first to last key", "Range of keys"},
            "Play from the first key to the last one.", has_time, fit_range);
  add_choices<Easing>(table, "Easing", has_pose_keys, choose_easing);
  add_choices<Repeat>(table, "After the last frame", has_model, choose_repeat);
  table.add("toggle_auto_key", {"Set keys automatically", "Auto key"},
            "Whatever the hand changes becomes a key of this frame, once there is a key.", always,
            switches(&Playback::auto_key, &Workspace::playback));
  table.add(
      "toggle_straight", {"Straight lines between poses", "Straight lines"},
      "Vertices of cage and model go straight from key to key, and in mixes, as in other programs; else the "
      "logs of their maps are blended.",
      has_model,
      {[](Workspace& w) {
         change_mix(
             w, [&] { return set_straight(w.document, w.playback.vectors, !w.document.timeline.straight); });
       },
       [](const Workspace& w) { return w.document.timeline.straight; }});
  table.add("toggle_timeline", {"Show the timeline", "Timeline"}, "Show or hide the timeline.",
            {key('T'), false, true}, always,
            {[](Workspace& w) { w.remembered.layout.timeline = !w.remembered.layout.timeline; },
             [](const Workspace& w) { return w.remembered.layout.timeline; }});
}

}  // namespace viete::scene
