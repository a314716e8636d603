// The document and its working state: camera, view options, messages, pointer interaction.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/background.h"
#include "deform/maps.h"
#include "document/brush.h"
#include "document/cage_making.h"
#include "document/camera.h"
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
#include "workspace/check_state.h"
#include "workspace/file_browser.h"
#include "workspace/frame_stats.h"
#include "workspace/messages.h"
#include "workspace/playback.h"
#include "workspace/pose_picture.h"
#include "workspace/preferences.h"
#include "workspace/question.h"
#include "workspace/split.h"
#include "workspace/time_view.h"

namespace viete::workspace {

/// The elements under the pointer in the view, and the running drag or selection.
struct Interaction {
  std::optional<std::uint32_t> hovered;         ///< element or probe of the selection's kind under the cursor
  std::optional<glm::vec2> cursor;              ///< in the view, logical pixels
  std::optional<interact::Constraint> handle;   ///< gizmo handle under the cursor
  bool over_axes = false;                       ///< the cursor is over the axis widget
  std::optional<interact::TransformDrag> drag;  ///< the running transform of the selection
  std::optional<mesh::Point> brush;             ///< brush position on the model, with Tool::paint
  std::optional<document::MaskStroke> stroke;   ///< the running mask stroke
  struct Box {
    glm::vec2 corner, opposite;  ///< logical pixels
    document::SelectMode mode;
  };
  std::optional<Box> box;                        ///< the running box selection
  std::optional<interact::Lasso> lasso;          ///< the running lasso selection
  std::optional<document::SelectMode> brushing;  ///< the running brush selection
  std::optional<interact::SelectShape> armed;  ///< the next left drag draws this shape; the brush stays armed
  float select_radius = 40;                    ///< brush radius, logical pixels
  bool crowded = false;           ///< elements under the cursor are so dense that a drag draws a box
  std::optional<glm::vec2> menu;  ///< right click position: the context menu opens there
  glm::vec2 menu_at{0, 0};        ///< the position the menu's commands act on
  std::optional<Link> stage;      ///< stage of the deformation under the cursor in the timings
  bool placing_pivot = false;     ///< the next click places the pivot
  struct Grab {
    interact::Tool tool;
    interact::Shape shape = interact::Shape::none;
  };
  std::optional<Grab> grab;  ///< the selection follows the cursor without a button
  std::string setting_key;   ///< the command that gets the next pressed key; empty: none
};

/// Everything that a slider or a panel handle can change, saved at the mouse press.
struct BeforeWidgetEdit {
  document::EditMark document;
  document::Handling handling;
  document::Brush brush;
  document::CageWish wish;
  PanelLayout layout;
  document::Revision opened;
};

/// The text of a field being edited.
struct TypedText {
  std::string text;
  int frame = 0;  ///< last drawn
};

/// A slider in text entry, until it loses the focus.
struct TypedSlider {
  std::string name;
  int frame = 0;  ///< last drawn
  int waits = 0;  ///< frames left to request the keyboard focus
};

/// Requests to the program, which handles and clears them once a frame.
struct Requests {
  bool quit = false;
  bool screenshot = false;
  bool stop_work = false;  ///< cancel reading, binding or cage generation
  bool stop_export = false;
  bool frame_finding = false;  ///< move the camera to the shown finding
  bool show_report = false, stop_report = false;
  std::optional<std::string> manual;  ///< the chapter to show; empty: the first page
  std::optional<files::OpenRequest> open;
  std::optional<std::filesystem::path> save_session, save_pose, save_cage, save_model, save_animation;
  std::optional<Answer> answer;  ///< to the open question
};

using base::WorkState;

/// The state saved in the user's files: edits since then are unsaved.
struct Saved {
  std::filesystem::path session{};  ///< target of Save; empty until there is one
  std::optional<std::uint64_t>
      content{};                    ///< checksum of that file when read or written here; nullopt: unknown
  document::DocumentState state{};  ///< last opened or saved; with the real pose; empty for recovered work
  bool recovered = false;           ///< recovered work that is in none of the user's files

  void put_cage(std::shared_ptr<const deform::Cage> cage) { state.cage = std::move(cage), ++revision_; }
  void put_pose(deform::Pose pose) { state.pose = std::move(pose), recovered = false, ++revision_; }
  void reset() { *this = Saved(revision_ + 1); }
  /// Increases with each change.
  unsigned long revision() const { return revision_; }

  Saved() = default;

private:
  explicit Saved(unsigned long revision) : revision_(revision) {}

  unsigned long revision_ = 0;
};

/// Build and system information, for the status bar and the help.
struct About {
  std::string version;    ///< "0.2.0"
  std::string build;      ///< build type and compiler
  std::string kernel;     ///< kernel of the matrix exponential
  std::string renderer;   ///< OpenGL renderer
  bool software = false;  ///< software rendering on the CPU
  /// A model with more triangles is drawn with fewer in motion.
  std::size_t moving_triangles = std::numeric_limits<std::size_t>::max();
};

/// The command palette: search among all commands.
struct Palette {
  bool open = false;
  bool appearing = false;  ///< request the keyboard focus
  std::string typed;
  std::size_t highlighted = 0;  ///< index among the matches
};

/// The list of commands for changing their keys.
struct KeyList {
  bool open = false;
  bool appearing = false;                     ///< request the keyboard focus for its field
  std::string typed;                          ///< search text, as in the palette
  bool waiting = false;                       ///< a command was waiting for its key in the last frame
  std::optional<Keymap::Changes> taken_back;  ///< changes before "reset all", for undo while it is open
};

/// A copied pose of some vertices.
struct CopiedPose {
  std::shared_ptr<const deform::Cage> cage;
  std::vector<std::uint32_t> vertices;
  std::vector<mesh::Point> positions;  ///< one per vertex
};

struct Workspace {
  document::Document document;
  document::Camera camera;
  document::Viewport viewport;
  document::ViewOptions view;
  Messages messages;
  Interaction interaction;
  interact::Tool tool = interact::Tool::move;
  document::Handling handling;
  document::MirrorCache mirror;  ///< cached mirror of the cage for `handling`
  CopiedPose copied;
  Playback playback;
  document::PinPosing pins;
  std::optional<std::size_t> chosen_pose;  ///< index in the library: target of the pose commands
  TimeView time_view;
  PosePictures pose_pictures;
  document::Brush brush;       ///< used by Tool::paint
  document::PosedModel posed;  ///< the model as drawn
  Requests requests;
  MethodStats methods;
  MethodTimes method_times;
  VertexView vertex;
  Split split;
  WorkState loading;  ///< opening files: reading, then binding
  WorkState binding;  ///< rebinding the open document with other weights
  WorkState exporting;
  WorkState making_cage;
  document::CageMaking making;
  bool offer_cage = true;  ///< offer ways to get a cage while the model has none
  CheckState checks;
  WorkState reporting;
  Saved saved;
  Preferences preferences;
  std::vector<files::RecoveryFile> recovery_files;  ///< recoverable unsaved work, newest first
  bool offers_recovery = false;                     ///< their notice is shown until it is answered
  float notice_height = 0;                          ///< last height of the notice row in logical pixels
  std::filesystem::path example;                    ///< session with poses and keys for the bundled model
  std::filesystem::path recovered_from;  ///< the open recovery file, until its work is saved elsewhere
  document::Revision opened = 0;         ///< increases when another document is opened
  std::vector<std::string> pose_notes;   ///< ambiguous decisions of the deformer in this pose, one line each
  deform::LogReport pose_report;         ///< the same, for marking the cage
  std::optional<Question> question;      ///< a modal question; blocks other actions
  std::optional<files::OpenRequest> unopened;  ///< the request that the question is about
  std::optional<Question::Kind> after_saving;  ///< the action to continue after saving
  FileBrowser browser;
  Palette palette;
  KeyList key_list;
  bool show_messages = false;  ///< show the message list
  bool has_user = true;        ///< a user can see messages; false for pictures rendered by a command
  bool tools = true;           ///< draw gizmo, selection, hover and handles; false in pictures
  bool full_screen = false;    ///< the window is to fill the screen
  bool ask_keys = false;       ///< the first start asks for the keymap
  std::map<std::string, TypedText> typed;  ///< by field name
  TypedSlider typed_slider;
  std::optional<BeforeWidgetEdit> before_widget_edit;  ///< since the mouse press
  About about;
};

/// True if motion in the view is drawn at half the resolution: as chosen, or with software rendering.
inline bool draws_coarsely(const Workspace& workspace) {
  return workspace.preferences.coarse_motion.value_or(workspace.about.software);
}

/// True if its frames are computed step by step, in double.
bool shows_links(const Workspace& workspace);

/// True if the mesh is coloured by its mask.
inline bool shows_mask(const Workspace& workspace) {
  return workspace.tool == interact::Tool::paint && workspace.document.is_movable();
}

/// The pose that pose commands act on; null: none is chosen.
inline const document::NamedPose* chosen_pose(const Workspace& w) {
  const auto& poses = w.document.library.poses;
  return w.chosen_pose && *w.chosen_pose < poses.size() ? &poses[*w.chosen_pose] : nullptr;
}

/// The mirror of the open cage if edits act on both sides; null: none.
inline const document::Mirror* mirror_of(const Workspace& w) {
  return w.mirror.cage == w.document.cage ? w.mirror.get() : nullptr;
}

/// True if the selectable elements are displayed: probes, or the cage.
inline bool shows_selectable(const Workspace& w) {
  const bool probes = w.document.selection.kind() == document::ElementKind::probe;
  return w.view.cage && (probes ? !w.document.probes.empty() : w.document.has_cage());
}

/// The settings of a view: the first one follows the document.
document::SideWay shown_way(const Workspace& workspace, std::size_t view);
/// The field shown as colours in a view; none if the chosen one is not available.
analysis::Field shown_field(const Workspace& workspace, std::size_t view = 0);

/// Sets the number of views, 1 to 4. New ones use deformers that are not shown yet.
void split_view(Workspace& workspace, std::size_t count);
/// Activates that view and its camera.
void enter_view(Workspace& workspace, std::size_t view);
/// The camera of a view.
document::CameraPose camera_of(const Workspace& workspace, std::size_t view);
/// The same at the end of a running animation.
document::CameraPose last_camera_of(const Workspace& workspace, std::size_t view);
/// The split as stored in a session.
document::SideWays ways_of(const Workspace& workspace);

/// Starts a cancellable edit on mouse press; cancel_widget_edit() restores the state before it.
void begin_widget_edit(Workspace& workspace);
void cancel_widget_edit(Workspace& workspace);

/// Height in logical pixels of the cage offer at the bottom of the view; 0 without one.
float offer_height(const Workspace& workspace);

/// Frames the model and its posed cage, above the cage offer, or the selected vertices.
void frame_all(Workspace& workspace, bool eased);
void frame_selection(Workspace& workspace, bool eased);
/// Frames the vertex with the largest value of the map.
void frame_worst(Workspace& workspace);
/// Highlights a finding and requests the camera to frame it; hides it if it is shown already.
void toggle_finding(Workspace& workspace, std::size_t index);
/// Shows only the next (1) or previous (-1) element of the shown finding; wraps around.
void step_element(Workspace& workspace, int step);
/// Frames the shown elements, as drawn.
void frame_finding(Workspace& workspace);
/// Applies the deformer's report for the current pose: stores its turns in the pose and shows its notes.
void take_report(Workspace& workspace, const deform::LogReport& report);

}  // namespace viete::workspace
