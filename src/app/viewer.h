// The viewer: computes one frame, from input to picture. The window, tests and command line use it.
#pragma once

#include <algorithm>
#include <optional>
#include <set>
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
#include "ui/context.h"
#include "ui/imgui_bridge.h"
#include "workspace/pointer.h"
#include "workspace/workspace.h"

namespace viete::app {

struct ViewerOptions {
  glm::ivec2 size{1280, 800};  ///< in logical pixels
  float scale = 1;             ///< device pixels per logical pixel
  int samples = 0;             ///< samples per pixel; 0: no multisampling
  int still_samples = 0;       ///< samples per pixel after a quarter of a second at rest; 0: no refinement
  bool may_be_coarse = false;  ///< true: may draw motion at half the resolution, and drafts of large models
  bool transparent = false;    ///< true: pictures have a transparent background
  bool builtin_font = false;   ///< true: text looks the same on every machine, for picture tests
  bool probe = true;           ///< true: measures the methods in the background
  std::filesystem::path state{};  ///< folder for preferences and backups, see FileDesk; may be empty
  std::filesystem::path program = "/proc/self/exe";  ///< `viete`, which runs as a child process
  std::size_t moving_triangles = 2'000'000;  ///< larger models have drafts; GPUs have four times this limit
};

/// Needs a current OpenGL context, which must outlive the viewer. Use only in the context's thread.
class Viewer {
public:
  Viewer(const render::Gl& gl, const ViewerOptions& options);
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  workspace::Workspace& workspace() { return workspace_; }
  const workspace::Workspace& workspace() const { return workspace_; }
  platform::InputQueue& input() { return input_; }
  ui::Recorder& recorder() { return recorder_; }

  /// See ViewerOptions.
  void resize(glm::ivec2 size, float scale);
  void drop(std::vector<std::filesystem::path> files);
  glm::ivec2 device_size() const;

  /// Handles input and commands, deforms the model, and draws the view and the panels into the framebuffer.
  /// `seconds` is the time since the last frame.
  void frame(float seconds);
  /// True if a new frame would differ from the last frame.
  bool wants_frame() const;
  /// True if the last frame produced a new picture.
  bool has_drawn() const { return has_drawn_; }
  /// The number of frames that drew the view, not only the panels.
  unsigned long views_drawn() const { return view_.count(); }
  Fineness view_fineness() const { return view_.fineness(); }
  /// Draws the last frame again without cached pictures.
  void redraw();
  /// Measures every method in this pose and waits for the results.
  void finish_measuring() { analysis_.finish_measuring(workspace_, model_); }
  /// True if there are unsaved edits and their backup has finished.
  bool keeping() const;
  /// Waits for the backup of unsaved edits. Returns false if there are no unsaved edits or the backup fails.
  bool finish_keeping();
  /// True if the user asked to close and nothing prevents it.
  bool closed() const { return files_.closed(); }
  /// True while files are read and bound in the background.
  bool loading() const { return files_.loading(); }
  bool exporting() const {
    return files_.exporting() || workspace_.jobs.requests.save_model ||
           workspace_.jobs.requests.save_animation;
  }
  /// True while work for which the user waits is running in the background.
  bool working() const {
    return loading() || exporting() || model_.binding() || sides_.binding(workspace_) || cages_.running();
  }
  /// Waits until files are read, and applies the result.
  void finish_loading() { files_.finish_loading(workspace_); }
  void finish_exports() { files_.finish_exports(workspace_); }
  /// Waits for the binding. The next frame deforms the model.
  void finish_binding();
  /// True while model and cage are being checked in the background.
  bool checking() const { return analysis_.checking(); }
  void finish_checks();
  /// Waits until all views and their maps show the current pose.
  void finish_views();

  render::Framebuffer& framebuffer() { return framebuffer_; }
  render::Image picture();
  ViewDrawing drawing() const;
  /// The deformer of the first view, or null.
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
  void deform(workspace::FrameTimes& times);
  bool may_draft() const;
  void enter_view_under_cursor();
  const ViewModel& model_of(std::size_t view) const;
  document::PosedModel posed_in(std::size_t view) const;
  FieldSubject field_subject(std::size_t view) const;
  bool follow_fields();
  bool field_is_due() const;
  void share_ranges();
  void upload(workspace::FrameTimes& times);
  void draw(workspace::FrameTimes& times);
  Fineness fineness(const ViewDrawing& wanted);
  void draw_whole();
  void panels(workspace::FrameTimes& times);
  void load_fonts();
  void follow_characters();
  void place_viewport();
  void save_screenshot();

  const render::Gl& gl_;
  ViewerOptions options_;
  struct ImGuiOwner {
    ImGuiOwner();
    ~ImGuiOwner();
  } imgui_;
  workspace::Workspace workspace_;
  FileDesk files_;
  LiveModel model_;
  CageMaker cages_;
  SideViews sides_;
  Analysis analysis_;
  FieldMaker fields_;
  workspace::Pointer pointer_;
  platform::InputQueue input_{ui::imgui_key};
  ui::Recorder recorder_;
  ui::Fonts fonts_;
  std::set<char32_t> characters_;  // all characters after Latin-1 that were shown until now
  bool outdated_fonts_ = false;    // true: the next frame needs other characters or sizes
  platform::ImGuiRenderer imgui_renderer_;
  render::Framebuffer framebuffer_;
  WorkspaceRenderer renderer_;
  ViewCache view_;
  ui::FieldColors field_colors_;

  std::tuple<bool, unsigned, float> notices_;  ///< the values that follow_notices() found in the last frame
  document::Revisions message_revisions_;      ///< revisions of the document in the last frame
  unsigned message_revision_ = 0;
  std::optional<document::Revision> cage_drawn_;  ///< revision of the uploaded pose; nullopt: upload again
  bool deformed_ = false, take_screenshot_ = false, has_drawn_ = false;
  double last_change_ = 0, last_frame_ = 0;  ///< clock times in seconds: last change, last frame
  double last_motion_ = 0;                   ///< clock time in seconds of the last picture with motion
  bool refines_ = false, moves_ = false;     ///< this frame: refines the view, shows motion
  unsigned settle_frames_ = 3;               ///< frames still to draw, until ImGui has computed all sizes
  std::size_t views_seen_ = 1;
  std::optional<bool> theme_seen_;
  document::CameraPose camera_seen_;
  bool at_rest_ = false;  ///< true: the view shows the model at rest
};

}  // namespace viete::app
