// The viewer without a window: one frame from input to picture; shared by window, tests and command line.
#pragma once

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "app/analysis.h"
#include "app/cage_maker.h"
#include "app/field_maker.h"
#include "app/file_desk.h"
#include "app/view_model.h"
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
  int still_samples = 0;       ///< samples of a refined picture after a quarter of a second at rest; 0 none
  bool may_be_coarse = false;  ///< draw motion at half the resolution if the workspace says so
  bool transparent = false;    ///< pictures without background
  bool builtin_font = false;   ///< identical text on every machine, for picture tests
  bool probe = true;           ///< measure the methods in the background
  std::filesystem::path state{};  ///< folder for preferences and recovery, see FileDesk; empty: none
  std::filesystem::path program =
      "/proc/self/exe";  ///< `viete`, for rendering animations and reports in a child process
  std::size_t moving_triangles = 2'000'000;  ///< most triangles that software rendering draws in motion
};

/// Needs a current GL context, which must outlive it; use only in that context's thread. Owns ImGui's
/// context.
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
  /// Opens files dropped on the window.
  void drop(std::vector<std::filesystem::path> files);
  glm::ivec2 device_size() const;

  /// Renders one frame into the framebuffer: input, commands, deformation, drawing, panels. `seconds` since
  /// the last one.
  void frame(float seconds);
  /// True if a new frame would differ: after a change, or to refine the view at rest.
  bool wants_frame() const;
  /// True if the last frame produced a new picture.
  bool has_drawn() const { return has_drawn_; }
  /// How often the view was drawn, and its last fineness. Redrawing panels does not redraw the view.
  unsigned long views_drawn() const { return view_.count(); }
  Fineness view_fineness() const { return view_.fineness(); }
  /// Redraws the last frame without cached pictures.
  void redraw();
  /// Measures every method in this pose and waits for the results.
  void finish_measuring() { analysis_.finish_measuring(workspace_, model_); }
  /// True while unsaved edits are backed up.
  bool keeping() const;
  /// Waits for the backup of unsaved edits; false if there are none or it fails.
  bool finish_keeping();
  /// True once a requested close may proceed.
  bool closed() const { return files_.closed(); }
  /// True while files are read and bound in the background.
  bool loading() const { return files_.loading(); }
  /// True while exports are running.
  bool exporting() const {
    return files_.exporting() || workspace_.requests.save_model || workspace_.requests.save_animation;
  }
  /// True while background work that the user waits for is running.
  bool working() const {
    return loading() || exporting() || model_.binding() || sides_.binding(workspace_) || cages_.running();
  }
  /// Waits for the files being read.
  void finish_loading() { files_.finish_loading(workspace_); }
  /// Waits for running exports.
  void finish_exports() { files_.finish_exports(workspace_); }
  /// Waits for the binding without drawing: the next frame deforms the model.
  void finish_binding();
  /// True while model and cage are being checked in the background.
  bool checking() const { return analysis_.checking(); }
  /// Waits for the checks.
  void finish_checks();
  /// Waits until all views and their maps show this pose.
  void finish_views();

  render::Framebuffer& framebuffer() { return framebuffer_; }
  render::Image picture();
  /// The current drawing of the view.
  ViewDrawing drawing() const;
  /// The deformer of the open document; null without one.
  const deform::Deformer* deformer() const { return model_.deformer(); }

private:
  bool changing() const;
  bool wants_refinement() const;
  void settle(unsigned frames) { settle_frames_ = std::max(settle_frames_, frames); }
  void take_input(float seconds);
  void take_requests();
  void show_manual(const std::string& chapter);
  void follow_document();
  void commit_cage_edit();
  void scope_messages();
  void follow_notices();
  void deform(scene::FrameTimes& times);
  void enter_view_under_cursor();
  const ViewModel& model_of(std::size_t view) const;
  scene::PosedModel posed_in(std::size_t view) const;
  FieldSubject field_subject(std::size_t view) const;
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
  scene::Pointer pointer_;
  platform::InputQueue input_{ui::imgui_key};
  ui::Recorder recorder_;
  ui::Fonts fonts_;
  platform::ImGuiRenderer imgui_renderer_;
  render::Framebuffer framebuffer_;
  WorkspaceRenderer renderer_;
  ViewCache view_;
  ui::FieldColors field_colors_;

  std::tuple<bool, unsigned, float> notices_;  ///< in the last frame: a question, messages, height of the row
  scene::Revisions message_revisions_;         ///< the document's, when messages were at message_revision_
  unsigned message_revision_ = 0;
  std::optional<scene::Revision> cage_drawn_;  ///< the drawn pose; nullopt: this cage has not been drawn
  bool deformed_ = false, take_screenshot_ = false, has_drawn_ = false;
  double last_change_ = 0, last_frame_ = 0;  ///< wall time in seconds; of the view alone, and of all
  double last_motion_ = 0;                   ///< time of the last picture with motion
  bool refines_ = false, moves_ = false;     ///< in this frame: refining the view at rest; the view is moving
  unsigned settle_frames_ = 3;               ///< ImGui needs a few frames after a change to settle sizes
  std::optional<bool> theme_seen_;
  scene::CameraPose camera_seen_;
  bool at_rest_ = false;  // the drawn model is at rest, although something could move it
};

}  // namespace viete::app
