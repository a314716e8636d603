// The viewer without a window: one frame from input to picture, the same in a window, in a test and for the
// command line.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "app/analysis.h"
#include "app/cage_maker.h"
#include "app/field_maker.h"
#include "app/file_desk.h"
#include "app/live_model.h"
#include "app/side_views.h"
#include "app/vertex_inspector.h"
#include "app/workspace_renderer.h"
#include "platform/imgui_renderer.h"
#include "platform/input_queue.h"
#include "render/framebuffer.h"
#include "scene/workspace/pointer.h"
#include "scene/workspace/workspace.h"
#include "ui/context.h"
#include "ui/input.h"

namespace viete::app {

struct ViewerOptions {
  glm::ivec2 size{1280, 800};  ///< logical pixels
  float scale = 1;             ///< device pixels per logical pixel
  int samples = 0;             ///< multisampling; 0 none
  int still_samples = 0;  ///< of one more picture once the view has rested for a quarter of a second; 0 none
  bool may_be_coarse = false;  ///< what moves is drawn at half the resolution, as the workspace says
  bool transparent = false;    ///< pictures have no background
  float cage_width = 1.25f;    ///< of the cage's lines, logical pixels
  float wire_width = 1;        ///< of edges of the mesh
  bool builtin_font = false;   ///< the same text on every machine, for picture tests
  bool probe = true;           ///< measure the methods aside
  std::filesystem::path
      state{};  ///< where to remember files and keep unsaved work, see FileDesk; empty: nowhere
  std::filesystem::path program =
      "/proc/self/exe";  ///< `viete`, which draws animations and makes reports aside
};

/// Needs a current GL context, which must outlive it; use in that context's thread. Owns ImGui's context.
class Viewer {
public:
  Viewer(const render::Gl& gl, const ViewerOptions& options);
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  scene::Workspace& workspace() { return workspace_; }
  const scene::Workspace& workspace() const { return workspace_; }
  platform::InputQueue& input() { return input_; }
  ui::Recorder& recorder() { return recorder_; }

  void resize(glm::ivec2 logical_size);
  /// Opens files that were dropped on the window.
  void drop(std::vector<std::filesystem::path> files);
  glm::ivec2 device_size() const;

  /// One frame: input, commands, deformation, drawing, panels, into the framebuffer. seconds since the last
  /// one.
  void frame(float seconds);
  /// True if a frame now would show something new: a change, or the picture at rest, refined.
  bool wants_frame() const;
  /// True if the last frame has made another picture than the one before it.
  bool has_drawn() const { return has_drawn_; }
  /// How often model, cage and ground were drawn, and how finely at last: panels change without them.
  unsigned long views_drawn() const { return view_.count(); }
  Fineness view_fineness() const { return view_.fineness(); }
  /// The last frame once more, without what is kept from frame to frame.
  void draw_anew();
  /// Measures every method in this pose, and waits for the results.
  void finish_measuring() { analysis_.finish_measuring(workspace_, model_); }
  /// True while edits are unsaved and kept for the next start.
  bool keeping() const;
  /// Waits until unsaved edits are; false if there are none, or if they cannot be.
  bool finish_keeping();
  /// True once the program may end, as was requested.
  bool closed() const { return files_.closed(); }
  /// True while files are being read, and what they hold is bound, aside.
  bool loading() const { return files_.loading(); }
  /// True while deformed models are written aside.
  bool exporting() const {
    return files_.exporting() || workspace_.requests.save_model || workspace_.requests.save_animation;
  }
  /// True while something is read, bound or written aside that a person waits for.
  bool working() const {
    return loading() || exporting() || model_.binding() || sides_.binding(workspace_) || cages_.running();
  }
  /// Waits for the files that are being read.
  void finish_loading() { files_.finish_loading(workspace_); }
  /// Waits for the deformed models that are being written.
  void finish_exports() { files_.finish_exports(workspace_); }
  /// Waits until the model is bound, without drawing: the next frame deforms it.
  void finish_binding();
  /// True while model and cage are being checked aside.
  bool checking() const { return analysis_.checking(); }
  /// Waits until they are.
  void finish_checks();
  /// Waits until all views, and the maps that they show, are those of this pose.
  void finish_views();

  render::Framebuffer& framebuffer() { return framebuffer_; }
  render::Image picture();
  /// The most that the driver draws, in device pixels.
  int longest_side() const { return render::longest_side(gl_); }
  /// As the view is drawn.
  ViewDrawing drawing() const;
  /// The deformer of the open document; null while there is none.
  const deform::Deformer* deformer() const { return model_.deformer(); }

private:
  bool changing() const;
  bool wants_refinement() const;
  void settle(unsigned frames) { settle_frames_ = std::max(settle_frames_, frames); }
  void take_input(float seconds);
  void take_requests();
  void show_manual(const std::string& chapter);
  void follow_document();
  void settle_cage_edit();
  void settle_messages();
  void frame_finding();
  mesh::Point vertex(std::size_t index) const;  // of the model, as it is drawn
  void settle_notices();
  void deform(scene::FrameTimes& times);
  void enter_view_under_cursor();
  scene::PosedModel posed_in(std::size_t view) const;
  FieldSubject field_subject(std::size_t view) const;
  scene::FieldView& field_view(std::size_t view);
  bool follow_fields();
  bool field_is_due() const;
  void share_ranges();
  void upload(scene::FrameTimes& times);
  void draw(scene::FrameTimes& times);
  Fineness fineness(const ViewDrawing& wanted);
  void draw_whole();
  void panels(scene::FrameTimes& times);
  void place_viewport();
  void save_screenshot();

  const render::Gl& gl_;
  ViewerOptions options_;
  struct ImGuiOwner {
    ImGuiOwner();
    ~ImGuiOwner();
  } imgui_;
  scene::Workspace workspace_;
  FileDesk files_;
  LiveModel model_;
  CageMaker cages_;
  SideViews sides_;
  Analysis analysis_;
  FieldMaker fields_;
  VertexInspector inspector_;
  scene::Pointer pointer_;
  platform::InputQueue input_{ui::imgui_key};
  ui::Recorder recorder_;
  ui::Fonts fonts_;
  platform::ImGuiRenderer imgui_renderer_;
  render::Framebuffer framebuffer_;
  WorkspaceRenderer renderer_;
  KeptView view_;
  ui::FieldColors field_colors_;

  struct Notices {
    bool question = false, farewell = false;
    unsigned messages = 0;
    float row = 0;  ///< its height
    bool operator==(const Notices&) const = default;
  };
  Notices notices_;           ///< of the last frame
  scene::Revisions said_of_;  ///< what the messages up to this revision may be of
  unsigned said_ = 0;
  std::optional<scene::Revision> cage_drawn_;  ///< which pose; nothing: none of this cage
  bool deformed_ = false, first_deformed_ = false, take_screenshot_ = false, has_drawn_ = false;
  double last_change_ = 0, last_frame_ = 0;  ///< seconds of wall time; of the view alone, and of all
  double last_motion_ = 0;                   ///< when the last picture of something that moves was there
  bool refines_ = false, moves_ = false;     ///< in this frame: the view at rest, what is seen in it
  unsigned settle_frames_ = 3;               ///< ImGui needs a few frames after a change until sizes rest
  std::optional<bool> theme_seen_;
  scene::CameraPose camera_seen_;
  bool at_rest_ = false;  // the model that is drawn, whatever moves it
};

}  // namespace viete::app
