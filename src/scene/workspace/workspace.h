// The document and all that surrounds it while a person works on it: camera, view options, messages, what the
// pointer is doing.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "deform/maps.h"
#include "scene/document/brush.h"
#include "scene/document/cage_making.h"
#include "scene/document/camera.h"
#include "scene/document/document.h"
#include "scene/document/edit.h"
#include "scene/document/handling.h"
#include "scene/document/mirror.h"
#include "scene/document/pin_posing.h"
#include "scene/document/settings.h"
#include "scene/document/view_options.h"
#include "scene/files/open.h"
#include "scene/files/recovery.h"
#include "scene/hand/picking.h"
#include "scene/hand/transform.h"
#include "scene/hand/transform_drag.h"
#include "scene/pictures/choice_picture.h"
#include "scene/pictures/pose_picture.h"
#include "scene/workspace/check_state.h"
#include "scene/workspace/file_browser.h"
#include "scene/workspace/frame_stats.h"
#include "scene/workspace/messages.h"
#include "scene/workspace/playback.h"
#include "scene/workspace/question.h"
#include "scene/workspace/remembered.h"
#include "scene/workspace/split.h"
#include "scene/workspace/time_view.h"
#include "scene/workspace/vertex_view.h"

namespace viete::scene {

/// What the pointer is over in the view, and the drag or box that it has begun.
struct Interaction {
  std::optional<std::uint32_t> hovered;  ///< element or probe under the cursor, of the selection's kind
  std::optional<glm::vec2> cursor;       ///< over the view, logical pixels
  std::optional<Constraint> handle;      ///< of the gizmo, under the cursor
  bool over_axes = false;                ///< the cursor is over the axis widget
  std::optional<TransformDrag> drag;     ///< the selection is being moved, rotated or scaled
  std::optional<mesh::Point> brush;      ///< where it meets the model, with Tool::paint
  std::optional<MaskStroke> stroke;      ///< the mask is being painted
  struct Box {
    glm::vec2 corner, opposite;  ///< logical pixels
    SelectMode mode;
  };
  std::optional<Box> box;              ///< a selection box is being drawn
  std::optional<Lasso> lasso;          ///< or a lasso
  std::optional<SelectMode> brushing;  ///< or the brush selects
  std::optional<SelectShape> armed;    ///< the next left drag draws it, wherever it begins; the brush stays
  float select_radius = 40;            ///< of the brush, logical pixels
  bool crowded = false;           ///< elements are so close under the cursor that a drag on one draws a box
  std::optional<glm::vec2> menu;  ///< the right button was clicked here: a menu is to open
  glm::vec2 menu_at{0, 0};        ///< and that is what its commands are for
  std::optional<Link> stage;      ///< of the deformation, under the cursor
  bool placing_pivot = false;     ///< the next click says where
  struct Grab {
    Tool tool;
    Shape shape = Shape::none;
  };
  std::optional<Grab> grab;    ///< the selection is to follow the cursor, without a button
  std::string setting_key;     ///< the command that gets the next key that is pressed; empty: none
  bool show_partners = false;  ///< of the whole cage in its mirror
};

/// All that a slider or a handle of a panel changes, as it was when the mouse took hold of it.
struct BeforeHold {
  EditMark document;
  Handling handling;
  Brush brush;
  CageWish wish;
  PanelLayout layout;
  Revision opened;
};

/// What stands in a field while it is being edited.
struct TypedText {
  std::string text;
  int frame = 0;  ///< in which it was seen last
};

/// A slider that is a field for its number, until that is left.
struct TypedSlider {
  std::string name;
  int frame = 0;  ///< in which it was seen last
  int waits = 0;  ///< frames left to get the keyboard
};

/// What only the program around can do; it takes and clears these once a frame.
struct Requests {
  bool quit = false;
  bool screenshot = false;
  bool stop_work = false;  ///< reading, binding or making a cage
  bool stop_export = false;
  bool frame_finding = false;  ///< move the camera to the finding that is shown
  bool show_report = false, stop_report = false;
  std::optional<std::string> manual;  ///< the chapter to show; empty: the first page
  std::optional<OpenRequest> open;
  std::optional<std::filesystem::path> save_session, save_pose, save_named_pose, save_cage, save_model,
      save_animation;
  std::optional<Answer> answer;  ///< to the question
};

/// How far work is that is done aside and that a person waits for.
struct WorkState {
  bool running = false;
  std::string what;    ///< "Reading dragon.ply", "Binding 50,000 vertices to 148 faces, 72 MB"
  double done = 0;     ///< in [0, 1]
  double seconds = 0;  ///< since this part of the work began
  double age = 0;      ///< since all of it began
};

/// How long work will still take: as fast as it was in the latter half of its time, which knows nothing of a
/// slow beginning.
class TimeLeft {
public:
  /// Seconds; nothing while too little is known. Asked again and again while it goes on.
  std::optional<double> of(const WorkState& work);

private:
  std::string what_;
  std::vector<std::array<double, 2>> seen_;  // seconds, and what was done then
};

/// What is safe in files of the user's: edits that led away from it are unsaved.
struct Saved {
  std::filesystem::path session{};  ///< where Save writes; empty until there is one
  std::optional<std::uint64_t>
      content{};  ///< checksum of that file as it was read or written here; nothing: not known
  DocumentState
      state{};  ///< that was opened or saved last; the pose is the real one, empty for recovered work
  unsigned long edits = 0;   ///< that had been recorded then
  std::string first_edit{};  ///< since then, of recovered work
  bool nowhere = false;      ///< recovered work, which is in no file of the user's

  void put_cage(std::shared_ptr<const deform::Cage> cage) { state.cage = std::move(cage), ++revision_; }
  void put_pose(deform::Pose pose) { state.pose = std::move(pose), nowhere = false, ++revision_; }
  void begin_anew() { *this = Saved(revision_ + 1); }
  /// Grows with each change of these.
  unsigned long revision() const { return revision_; }

  Saved() = default;

private:
  explicit Saved(unsigned long revision) : revision_(revision) {}

  unsigned long revision_ = 0;
};

/// What runs, for the status bar and the help.
struct About {
  std::string version;    ///< "0.2.0"
  std::string build;      ///< build type and compiler
  std::string kernel;     ///< of the exponential
  std::string renderer;   ///< of OpenGL
  bool software = false;  ///< a processor draws
};

/// Every command by name, found by a few letters.
struct Palette {
  bool open = false;
  bool appearing = false;  ///< the keyboard is to go there
  std::string typed;
  std::size_t highlighted = 0;  ///< among those that are found
};

/// Every command with its keys, to give it others.
struct KeyList {
  bool open = false;
  bool appearing = false;                     ///< the keyboard is to go to its field
  std::string typed;                          ///< which commands are shown, as in the palette
  bool waiting = false;                       ///< in the last frame a command was waiting for its key
  std::optional<Keymap::Changes> taken_back;  ///< all at once, while it is open
};

/// A pose of some vertices that was copied.
struct CopiedPose {
  std::shared_ptr<const deform::Cage> cage;
  std::vector<std::uint32_t> vertices;
  std::vector<mesh::Point> positions;  ///< theirs
};

struct Workspace {
  Document document;
  Camera camera;
  Viewport viewport;
  ViewOptions view;
  Messages messages;
  Interaction interaction;
  Tool tool = Tool::move;
  Handling handling;
  KnownMirror mirror;  ///< that of the cage, as handling asks for it
  CopiedPose copied;
  Playback playback;
  PinPosing pins;
  std::optional<std::size_t> chosen_pose;  ///< of the library: what the commands of poses act on
  TimeView time_view;
  PosePictures pose_pictures;
  Brush brush;       ///< of Tool::paint
  PosedModel posed;  ///< the model as it is drawn
  Requests requests;
  FrameStats stats;
  MethodStats methods;
  MethodTimes method_times;
  FieldView field;
  VertexView vertex;
  Split split;
  double fused_error = 0;  ///< of the fused frame, or of what a stitched one follows, against double:
                           ///< measured aside, in diagonals of the cage; 0 if staged
  WorkState loading;       ///< opening files: reading them, then binding
  WorkState binding;       ///< of what is open, to other coordinates
  WorkState exporting;
  WorkState making_cage;
  TimeLeft time_left, export_left;  ///< of what is shown of these
  CageMaking making;
  bool offer_cage = true;  ///< ways to get one are shown while the model has none
  CheckState checks;
  WorkState reporting;
  Saved saved;
  Remembered remembered;
  std::vector<Leftover> leftovers;       ///< unsaved work that can be brought back, newest first
  bool offers_leftovers = false;         ///< their notice is shown, until it is answered
  float notice_height = 0;               ///< logical pixels of its row, as it was drawn last
  std::filesystem::path example;         ///< session with poses and keys of the bundled model
  std::filesystem::path recovered_from;  ///< the leftover that is open, until its work is safe elsewhere
  Revision opened = 0;                   ///< another document was opened
  std::vector<std::string> pose_notes;   ///< what the deformer had to decide in this pose, one line each
  deform::LogReport pose_report;         ///< the same, to be marked at the cage
  std::optional<Question> question;      ///< waits for an answer; nothing else is done meanwhile
  std::optional<OpenRequest> unopened;   ///< what the question is of, when it is opened in another way
  std::optional<Question::Kind> after_saving;  ///< what was answered with Save goes on when that is done
  FileBrowser browser;
  Palette palette;
  KeyList key_list;
  bool show_messages = false;  ///< all of them, in a list
  bool attended = true;        ///< somebody is there to read what is said; not so for pictures of a command
  bool tools = true;           ///< gizmo, selection, hover and handles are drawn; not so in pictures
  bool full_screen = false;    ///< the window is to fill the screen
  bool ask_keys = false;       ///< the first start asks which keys the hands know
  bool farewell = false;       ///< the window is about to close, and edits are kept
  std::map<std::string, TypedText> typed;  ///< by the name of the field
  TypedSlider typed_slider;
  std::optional<BeforeHold> before_hold;  ///< since the mouse button went down
  ChoicePictures choice_pictures;
  About about;
};

/// True if what moves in the view is to be drawn at half the resolution: as was chosen, or where a processor
/// draws.
inline bool draws_coarsely(const Workspace& workspace) {
  return workspace.remembered.coarse_motion.value_or(workspace.about.software);
}

/// True if its frames are made link by link, in double.
bool shows_links(const Workspace& workspace);

/// True if the mesh is coloured by its mask.
inline bool shows_mask(const Workspace& workspace) {
  return workspace.tool == Tool::paint && workspace.document.is_movable();
}

/// The pose of the list that commands act on; null: none is chosen.
inline const NamedPose* chosen_pose(const Workspace& w) {
  const auto& poses = w.document.library.poses;
  return w.chosen_pose && *w.chosen_pose < poses.size() ? &poses[*w.chosen_pose] : nullptr;
}

/// That of the open cage, in which the hand moves both sides; null: none.
inline const Mirror* mirror_of(const Workspace& w) {
  return w.mirror.cage == w.document.cage ? w.mirror.get() : nullptr;
}

/// True if what can be selected is there to be seen: probes, or the cage.
inline bool shows_selectable(const Workspace& w) {
  const bool probes = w.document.selection.kind() == ElementKind::probe;
  return w.view.cage && (probes ? !w.document.probes.empty() : w.document.has_cage());
}

/// What the mesh is coloured by: what was asked for, or none where that does not exist.
lab::Field shown_field(const Workspace& workspace);
/// The same of a view that asks for `field` and is blended so.
lab::Field shown_field(const Workspace& workspace, lab::Field field, const deform::Scheme& scheme);

/// The mouse takes hold of a widget, maybe; and what it has done since never was.
void take_hold(Workspace& workspace);
void call_off_hold(Workspace& workspace);

/// Logical pixels at the bottom of the view in which the offer of a cage stands; 0 where there is none.
float offer_height(const Workspace& workspace);

/// Moves the camera to see the model and its posed cage, above the offer of one, or the selected vertices.
void frame_all(Workspace& workspace, bool eased);
void frame_selection(Workspace& workspace, bool eased);
/// The vertex that is the worst of the map.
void frame_worst(Workspace& workspace);
/// Of the model, nearest to what is drawn at this place of the window; nothing where it is not.
std::optional<std::uint32_t> pointed_vertex(const Workspace& workspace, const glm::vec2& at);

/// Shows the sum at this vertex of the model, in its section, which is opened and scrolled to.
void show_sum_at(Workspace& workspace, std::optional<std::uint32_t> vertex);

/// What the deformer had to decide in the frame of this pose: its turns become the pose's, and its notes are
/// shown.
void take_report(Workspace& workspace, const deform::LogReport& report);

}  // namespace viete::scene
