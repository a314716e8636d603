// A document and the state around it: view, files, running work, messages, panels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/field.h"
#include "base/background.h"
#include "document/animation.h"
#include "document/brush.h"
#include "document/cage_making.h"
#include "document/camera.h"
#include "document/checks.h"
#include "document/document.h"
#include "document/edit.h"
#include "document/handling.h"
#include "document/mirror.h"
#include "document/pin_posing.h"
#include "document/view_options.h"
#include "files/open.h"
#include "files/recovery.h"
#include "interact/picking.h"
#include "interact/transform.h"
#include "interact/transform_drag.h"
#include "pose/maps.h"
#include "workspace/file_browser.h"
#include "workspace/frame_stats.h"
#include "workspace/messages.h"
#include "workspace/pose_picture.h"
#include "workspace/preferences.h"
#include "workspace/wish.h"

namespace viete::workspace {

/// A view, and the results of its last picture. The first view has the document's settings, see
/// view_settings().
struct SplitView : document::SideView {
  FieldView shown{};
  FrameStats stats{};
  /// Error of the positions in single precision, relative to the diagonal of the cage. Does not include
  /// errors of stitching. 0 if positions are computed in double precision.
  double fused_error = 0;
  std::optional<double> exp_error{};  ///< largest relative error of sampled exponentials, if there are any
  bool binding = false;
  std::string problem{};  ///< why the view shows no model
};

/// The views of one document, each with its own deformer, method and map.
struct Split {
  static constexpr std::size_t most = document::SideViews::most + 1;

  std::vector<SplitView> views = std::vector<SplitView>(1);
  bool linked = true;                          ///< all views share one camera
  std::size_t active = 0;                      ///< the view with the gizmo and the current camera
  std::vector<document::CameraPose> cameras;   ///< if not linked: one per view; unused for the active view
  std::optional<document::CameraPose> before;  ///< the camera before the view was split

  std::size_t count() const { return views.size(); }
  bool on() const { return count() > 1; }
  /// All views except the first.
  std::span<SplitView> sides() { return std::span(views).subspan(1); }
  std::span<const SplitView> sides() const { return std::span(views).subspan(1); }
};

/// Returns `whole` with the pane of the view.
document::Viewport viewport_of(const Split& split, const document::Viewport& whole, std::size_t view);
/// The view at a position in the window.
std::size_t view_at(const Split& split, const document::Viewport& whole, const glm::vec2& place);

/// Replaces the views and activates the first view.
void put_side_views(Split& split, const document::SideViews& sides);

/// The results of the checks, and the finding shown in the view.
struct CheckState {
  bool running = false;
  double done = 0;  ///< in [0, 1]
  std::vector<document::Finding> findings;
  std::optional<std::size_t> shown;    ///< index of the finding that is highlighted in the view
  std::optional<std::size_t> element;  ///< index of the only highlighted element; nullopt: all elements
  bool fresh = false;                  ///< the findings have not been displayed yet
  std::size_t outside = 0;             ///< model vertices outside the cage that was checked last
  bool pushed_out = false;             ///< the last change of the cage has increased `outside`

  void show(std::optional<std::size_t> finding, std::optional<std::size_t> one = {}) {
    shown = finding;
    element = one;
    ++revision_;
  }
  /// Increases when the findings or the highlighted elements change.
  unsigned long revision() const { return revision_; }

private:
  unsigned long revision_ = 0;
};

/// Clears the findings, for example after a change of the cage.
void forget_findings(CheckState& checks);

/// The index of the finding about model vertices outside the cage; nullopt if all vertices are inside.
std::optional<std::size_t> outside_finding(const CheckState& checks);

/// Replaces the findings. Afterwards no finding is shown.
void take_findings(CheckState& checks, std::vector<document::Finding> findings);

/// Indices of highlighted elements of the shown finding: at most `most`, evenly spread.
std::vector<std::size_t> shown_elements(const CheckState& checks, std::size_t most);

/// The pose of the keys at a frame.
struct TimedPose {
  std::shared_ptr<const document::Animation> animation{};
  double frame = 0;
  document::SharedPose base{};  ///< the pose without the keyed weights; null without keyed weights
  document::SharedPose pose{};
};

/// The state of playback, see playing.h.
struct Playback {
  bool playing = false;
  bool backward = false;  ///< true while ping-pong plays backward
  bool auto_key = false;  ///< edits of the pose set a key at the current frame
  document::VectorCache vectors{};
  std::shared_ptr<const document::Animation> animation{};  ///< see animation_of(); null without keys
  document::Timeline timeline{};
  std::shared_ptr<const pose::Cage> cage{};
  std::shared_ptr<const mesh::Surface> model{};
  mutable TimedPose by_time{};         ///< the pose that was computed last
  unsigned long seen_revision = 0;     ///< the last revision of the history that playback has handled
  document::Timeline seen_timeline{};  ///< the timeline at that revision
};

/// The elements under the cursor in the view, and the current drag or selection.
struct Interaction {
  std::optional<std::uint32_t> hovered;         ///< element of the selection's kind under the cursor
  std::optional<glm::vec2> cursor;              ///< in logical pixels; nullopt outside the view
  std::optional<interact::Constraint> handle;   ///< gizmo handle under the cursor
  bool over_axes = false;                       ///< the cursor is over the axis widget
  std::optional<interact::TransformDrag> drag;  ///< the current transform of the selection
  std::optional<mesh::Point> brush;             ///< brush position on the model, with Tool::paint
  std::optional<document::MaskStroke> stroke;   ///< the current stroke on the mask
  struct Box {
    glm::vec2 corner, opposite;  ///< logical pixels
    document::SelectMode mode;
  };
  std::optional<Box> box;                        ///< the current box selection
  std::optional<interact::Lasso> lasso;          ///< the current lasso selection
  std::optional<document::SelectMode> brushing;  ///< the current brush selection
  std::optional<interact::SelectShape> armed;  ///< the next left drag draws this shape; the brush stays armed
  float select_radius = 40;                    ///< brush radius, logical pixels
  bool crowded = false;           ///< elements at the cursor are so dense that a drag draws a box
  std::optional<glm::vec2> menu;  ///< position of a right click, where the context menu must open
  glm::vec2 menu_at{0, 0};        ///< cursor position for commands of the open context menu
  std::optional<Stage> stage;     ///< the stage under the cursor in the panel of timings
  bool placing_pivot = false;     ///< the next click places the pivot
  struct Grab {
    interact::Tool tool;
    interact::Shape shape = interact::Shape::none;
  };
  std::optional<Grab> grab;  ///< if set, the selection follows the cursor without a pressed button
  std::string setting_key;   ///< the command that gets the next pressed key; empty: none
};

/// The state before a mouse press on a slider or another widget.
struct BeforeWidgetEdit {
  document::EditMark document;
  document::Handling handling;
  document::Brush brush;
  document::CageWish wish;
  PanelLayout layout;
  document::Revision opened;
};

/// The text of a field during editing.
struct TypedText {
  std::string text;
  int frame = 0;  ///< number of the picture in which the field was last drawn
};

/// The keyboard's entry of the open drop-down list. Enter chooses this entry.
struct OpenList {
  std::optional<int> entry{};
  int added = 0;       ///< number of entries of this picture so far, then of the last picture
  bool moved = false;  ///< an arrow key changed the entry in this picture
};

/// The slider that is replaced by a number field.
struct TypedSlider {
  std::string name;
  int frame = 0;  ///< number of the picture in which the field was last drawn
  int waits = 0;  ///< number of pictures in which the field still waits for the keyboard focus
};

using base::WorkState;

/// The state that the user's files contain. Later edits are unsaved.
struct Saved {
  std::filesystem::path session{};         ///< the session's file; empty: Save asks for a name
  std::optional<std::uint64_t> content{};  ///< checksum of `session` when read or written; nullopt: unknown
  document::DocumentState state{};         ///< its pose is the real_pose(); empty for recovered edits
  bool recovered = false;                  ///< the document contains recovered edits that are not saved yet

  void put_cage(std::shared_ptr<const pose::Cage> cage) {
    state.cage = std::move(cage);
    ++revision_;
  }
  void put_pose(pose::Pose pose) {
    state.pose = std::move(pose);
    recovered = false;
    ++revision_;
  }
  void reset() { revision_ = std::exchange(*this, {}).revision_ + 1; }
  /// Increases with each change.
  unsigned long revision() const { return revision_; }

private:
  unsigned long revision_ = 0;
};

/// Build and system information, for the status bar and the help.
struct About {
  std::string version;    ///< "0.2.0"
  std::string build;      ///< build type and compiler
  std::string kernel;     ///< kernel of the matrix exponential
  std::string renderer;   ///< OpenGL renderer
  bool software = false;  ///< software rendering on the CPU
  /// While the picture moves, models with more than this number of triangles are drawn simplified.
  std::size_t moving_triangles = std::numeric_limits<std::size_t>::max();
};

/// The command palette, a search for commands.
struct Palette {
  bool open = false;
  bool appearing = false;  ///< the palette was just opened and needs the keyboard focus
  std::string typed;
  std::size_t highlighted = 0;  ///< index among the matches
};

/// The list of all commands, in which the user can change keys.
struct KeyList {
  bool open = false;
  bool appearing = false;                     ///< the list was just opened and needs the keyboard focus
  std::string typed;                          ///< search text
  bool waiting = false;                       ///< in the last picture, a command was waiting for its key
  std::optional<Keymap::Changes> taken_back;  ///< the keymap changes that Reset all has removed
};

struct CopiedPose {
  std::shared_ptr<const pose::Cage> cage;
  std::vector<std::uint32_t> vertices;
  std::vector<mesh::Point> positions;  ///< one per vertex

  bool is_of(const document::Document& document) const { return cage && cage == document.cage(); }
};

/// The range of visible frames.
struct FrameWindow {
  static constexpr double least_length = 4;

  double first = 0, last = 64;
  double length() const { return last - first; }
  double frame_at(double share) const { return first + share * length(); }
  double share_of(double frame) const { return (frame - first) / length(); }

  friend bool operator==(const FrameWindow&, const FrameWindow&) = default;
};

using document::KeyPlaces;

/// State of the timeline panel: visible frames, selected keys, the running drag. See time_view.h.
struct TimeView {
  enum class What { scrub, keys, box, pan };
  struct Drag {
    What what;
    double pressed;               ///< the frame at the press
    document::Timeline before{};  ///< for What::keys: the timeline at the press
    KeyPlaces keys{};             ///< for What::keys: the dragged keys
    bool moved = false;
    FrameWindow seen{};    ///< for What::pan: the visible frames at the press
    KeyPlaces selected{};  ///< for What::box: the selection at the press
  };
  FrameWindow seen;
  KeyPlaces selected;  ///< ascending
  std::optional<Drag> drag;
  bool hovered = false;  ///< the pointer is over the timeline
  bool fitted = false;   ///< `seen` fits the document's timeline
};

/// The display of the document, and the tools. Written by commands, panels and the pointer.
struct View {
  document::ViewOptions options;
  document::Camera camera;
  Split split;
  TimeView time;
  VertexView vertex;
  interact::Tool tool = interact::Tool::move;
  Interaction interaction;
  document::Handling handling;
  document::MirrorCache mirror;            ///< the cage's symmetry about the plane handling.mirror
  document::Brush brush;                   ///< used by Tool::paint
  std::optional<std::size_t> chosen_pose;  ///< index of the named pose that pose commands act on
  bool tools = true;                       ///< draw gizmo, selection, hover and handles; false in pictures
  bool full_screen = false;                ///< the window must fill the screen
};

/// Running work. Commands and panels add wishes. The program grants them, and writes the other members.
struct Jobs {
  Wishes wishes;
  WorkState loading;  ///< opening files: reading, then binding
  WorkState binding;  ///< binding the open document with other weights
  WorkState exporting, making_cage, reporting;

  /// True during a task that Cancel stops.
  bool working() const { return loading.running || binding.running || making_cage.running; }
};

/// The user's files, and questions about files. Written by opening, saving and the file browser.
struct Files {
  Saved saved;
  document::Revision opened = 0;               ///< increases when another document is opened
  std::filesystem::path example;               ///< session with poses and keys for the bundled model
  std::optional<Question> question;            ///< a modal question, which blocks other actions
  std::optional<files::OpenRequest> unopened;  ///< the request that caused the question
  std::optional<Question::Kind> after_saving;  ///< the action to continue after saving
  FileBrowser browser;
};

/// Unsaved edits of earlier documents and runs. Written by autosave and the recovery commands.
struct Recovery {
  std::vector<files::RecoveryFile> files;  ///< files with recovered edits, newest first
  bool offered = false;                    ///< show the notice about offers()
  std::filesystem::path from;              ///< the open recovery file, until its edits are saved elsewhere

  /// The files that were not restored yet, newest first. If all were restored, all files.
  std::vector<files::RecoveryFile> offers() const;
};

/// State that panels keep between drawn pictures. Written by panels and their commands.
struct Panels {
  Palette palette;
  KeyList key_list;
  PosePictures pose_pictures;
  std::map<std::filesystem::path, std::vector<PictureShape>> recovery_pictures;  ///< by recovery file
  CopiedPose copied;
  std::map<std::string, TypedText> typed;  ///< by field name
  TypedSlider typed_slider;
  OpenList open_list;
  std::optional<BeforeWidgetEdit> before_edit;
  std::optional<std::size_t> hovered_weight;  ///< index of the pose whose slider is under the pointer
  float notice_height = 0;                    ///< last height of the recovery notice in logical pixels
  bool offer_cage = true;                     ///< false: the user has dismissed the suggestion to get a cage
  bool show_messages = false;                 ///< show the message list
  bool show_preferences = false;
  bool ask_keys = false;  ///< show the choice of a keymap
  bool has_user = true;   ///< false while a command renders a picture without messages
};

/// Results of the last drawn picture. Written by the program.
struct FrameResults {
  document::PosedModel posed;      ///< the model as drawn
  std::vector<std::string> notes;  ///< problems of the current pose, one line each
  pose::LogReport report;          ///< the elements with these problems
  document::PinPosing pins;
  MethodStats methods;
  MethodTimes method_times;
};

struct Workspace {
  document::Document document;  ///< saved in files; changed by edits and undo
  View view;
  Playback playback;            ///< written by the functions of playing.h
  document::CageMaking making;  ///< written by the panel of cage generation and the program
  CheckState checks;            ///< written by the program; the panel chooses the shown finding
  Files files;
  Recovery recovery;
  Jobs jobs;
  Messages messages;        ///< every part of the program adds messages
  Preferences preferences;  ///< remembered between runs; written by commands and panels
  Panels panels;
  FrameResults frame;
  About about;  ///< written by the program at the start
};

/// True during a drag of elements or keys, a mask stroke or a brush selection. Other edits must wait.
inline bool is_dragging(const Workspace& w) {
  const auto& time = w.view.time.drag;
  return w.view.interaction.drag || w.view.interaction.stroke || w.view.interaction.brushing ||
         (time && time->what == TimeView::What::keys);
}

/// True if motion in the view is drawn at half the resolution. The default is true for software rendering.
inline bool draws_coarsely(const Workspace& workspace) {
  return workspace.preferences.coarse_motion.value_or(workspace.about.software);
}

/// The index in MethodTimes::stages of the document's method and engine.
std::size_t running_times(const Workspace& workspace);

/// True if the model is coloured by its mask.
inline bool shows_mask(const Workspace& workspace) {
  return workspace.view.tool == interact::Tool::paint && workspace.document.is_movable();
}

/// The pose that pose commands act on; null if no pose is chosen.
inline const document::NamedPose* chosen_pose(const Workspace& w) {
  const auto& poses = w.document.library().poses;
  return w.view.chosen_pose && *w.view.chosen_pose < poses.size() ? &poses[*w.view.chosen_pose] : nullptr;
}

/// The mirror of the cage if edits act on both sides, otherwise null.
inline const document::Mirror* mirror_of(const Workspace& w) {
  return w.view.mirror.cage == w.document.cage() ? w.view.mirror.get() : nullptr;
}

/// True if the elements of the selection's kind are displayed.
inline bool shows_selectable(const Workspace& w) {
  const bool probes = w.document.selection().kind() == document::ElementKind::probe;
  return w.view.options.cage && (probes ? !w.document.probes().empty() : w.document.has_cage());
}

/// The settings of a view. The first view has the document's settings.
document::SideView view_settings(const Workspace& workspace, std::size_t view);
/// The map that colours a view; Field::none if the chosen map is not available.
analysis::Field shown_field(const Workspace& workspace, std::size_t view = 0);

/// Sets the number of views, 1 to 4. New views use deformers that are not shown yet.
void split_view(Workspace& workspace, std::size_t count);
/// Activates a view and its camera.
void enter_view(Workspace& workspace, std::size_t view);
document::CameraPose camera_of(const Workspace& workspace, std::size_t view);
/// The camera of a view at the end of its current motion.
document::CameraPose last_camera_of(const Workspace& workspace, std::size_t view);
/// The views as stored in a session.
document::SideViews side_views(const Workspace& workspace);

/// Stores the state before a mouse press, so that cancel_widget_edit() can restore this state.
void begin_widget_edit(Workspace& workspace);
void cancel_widget_edit(Workspace& workspace);

/// True if the view suggests to get a cage, or to enclose the model.
bool offers_next_step(const Workspace& workspace);
/// The vertices outside the cage, if the view may suggest to enclose them. Null during the checks, and after
/// the first edit unless a change of the cage has pushed vertices out.
const document::Finding* offered_finding(const Workspace& workspace);
/// The height in logical pixels of the suggestion to get a cage; 0 if it is not shown.
float offer_height(const Workspace& workspace);

/// Moves the camera so that the model and posed cage, or the selection, fill the view; gradually if `eased`.
void frame_all(Workspace& workspace, bool eased);
/// Shows model and cage if the cage is not close around the model, as another model's cage.
void frame_other_cage(Workspace& workspace);
void frame_selection(Workspace& workspace, bool eased);
/// Moves the camera to the vertex with the largest value of the map.
void frame_worst(Workspace& workspace);
/// Highlights a finding and moves the camera there. If the finding is already highlighted, hides the finding.
void toggle_finding(Workspace& workspace, std::size_t index);
/// Highlights only the next (step 1) or previous (step -1) element. After the last element comes the first.
void step_element(Workspace& workspace, int step);
/// Moves the camera to the highlighted elements.
void frame_finding(Workspace& workspace);
/// Stores the report's turns in the pose, see Pose::turns. Stores the report and its notes in the workspace.
void take_report(Workspace& workspace, const pose::LogReport& report);

}  // namespace viete::workspace
