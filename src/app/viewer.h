// The viewer: computes one frame, from input to picture, as a list of activities. The window, tests and
// command line use it.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/cage_maker.h"
#include "app/field_maker.h"
#include "app/file_desk.h"
#include "app/method_measuring.h"
#include "app/panel_results.h"
#include "app/view_model.h"
#include "app/workspace_renderer.h"
#include "base/clock.h"
#include "platform/imgui_renderer.h"
#include "platform/input_queue.h"
#include "render/framebuffer.h"
#include "ui/context.h"
#include "ui/imgui_bridge.h"
#include "workspace/pointer.h"
#include "workspace/workspace.h"

namespace viete::app {

/// A part of the frame that reacts to changes of its input.
struct Activity {
  const char* name;
  /// Returns the seconds until step() has something to do: 0 means now, base::never means only after input or
  /// after another activity.
  std::function<double()> due_in;
  /// Reacts to all changes since the last step. Returns true if panels must be drawn until their sizes
  /// settle.
  std::function<bool()> step;
};

/// Converts a condition to a result of Activity::due_in.
inline double now_if(bool due) {
  return due ? 0 : base::never;
}

/// Returns the seconds until the first of the activities is due.
inline double due_in(std::span<const Activity> activities) {
  double first = base::never;
  for (const Activity& activity : activities) first = std::min(first, activity.due_in());
  return first;
}

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
  std::filesystem::path program = base::os::program_file();  ///< `viete`, which runs as a child process
  std::size_t moving_triangles = 2'000'000;  ///< larger models have drafts; GPUs have four times this limit
  base::Wake wake{};  ///< called by other threads when background work has ended; may be null
};

/// ImGui needs several frames to compute the sizes of changed panels. Frames are drawn until two in a row
/// have the same panels as the frame before.
class Settling {
public:
  bool is_due() const { return left_ > 0; }
  /// Begins again, after a change of panels.
  void begin() { *this = {}; }
  /// Call in each frame. `equal`: the frame has the same panels as the frame before.
  void add(bool equal) {
    constexpr int enough = 2;
    equal_ = equal ? equal_ + 1 : 0;
    if (!equal && left_ == 0 && !gave_up_) left_ = most;
    if (left_ == 0) return;
    left_ = equal_ < enough ? left_ - 1 : 0;
    gave_up_ = left_ == 0 && equal_ < enough;
  }

private:
  static constexpr int most = 16;  // the background of a dialog fades in for 10 frames
  int left_ = most;                // frames still to draw
  int equal_ = 0;                  // number of last frames with equal panels
  bool gave_up_ = false;           // the panels changed in all frames
};

/// A frame runs a list of activities in a fixed order; a new frame is wanted when an activity is due. Needs a
/// current OpenGL context, which must outlive the viewer. Use only in the context's thread.
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
  /// The seconds until a new frame would differ from the last frame; base::never without further input.
  double due_in() const { return app::due_in(activities_); }
  /// True if a new frame would differ from the last frame.
  bool wants_frame() const { return due_in() <= 0; }
  /// The name of an activity that is due, or an empty string.
  std::string due_activity() const;
  /// True if the last frame produced a new picture.
  bool has_drawn() const { return has_drawn_; }
  /// The number of frames that drew the view, not only the panels.
  unsigned long views_drawn() const { return view_cache_.count(); }
  Fineness view_fineness() const { return view_cache_.fineness(); }
  /// Draws the next frames until the sizes of panels settle. Call after a change of the workspace without
  /// input.
  void settle_panels() { settling_.begin(); }
  /// Draws the last frame again without cached pictures.
  void redraw();
  /// Measures every method in this pose and waits for the results.
  void finish_measuring() { measuring_.finish(workspace_, model_); }
  /// True if there are unsaved edits and their backup has finished.
  bool keeping() const;
  /// Waits for the backup of unsaved edits. Returns false if there are no unsaved edits or the backup fails.
  bool finish_keeping();
  /// True if the user asked to close and nothing prevents it.
  bool closed() const { return files_.closed(); }
  /// True while files are read and bound in the background.
  bool loading() const { return files_.loading(); }
  bool exporting() const { return files_.exporting() || workspace_.jobs.wishes.find<workspace::SaveFile>(); }
  /// True while work for which the user waits is running in the background.
  bool working() const {
    return loading() || exporting() || model_.binding() || sides_.binding(workspace_) || cages_.running();
  }
  /// Waits until files are read, and applies the result.
  void finish_loading() {
    files_.finish_loading(workspace_);
    take_opened_files();
  }
  void finish_exports() { files_.finish_exports(workspace_); }
  /// Waits for the binding. The next frame deforms the model.
  void finish_binding();
  /// True while model and cage are being checked in the background.
  bool checking() const { return checks_.running(); }
  void finish_checks();
  /// Waits until all views and their maps show the current pose.
  void finish_views();

  render::Framebuffer& framebuffer() { return framebuffer_; }
  render::Image picture();
  ViewDrawing drawing() const;
  /// The FrameDeformer of the first view, or null.
  const deform::FrameDeformer* deformer() const { return model_.deformer(); }

private:
  std::vector<Activity> list_of_activities();
  bool take_input();
  bool grant_wishes();
  void grant(const workspace::Wish& wish);
  void show_manual(const std::string& chapter);
  void cancel_work(workspace::CancelWork::Work work);
  bool may_edit() const { return !pointer_.active(); }
  void take_opened_files();
  bool bind();
  void show_new_surfaces(LiveModel::Changed changed);
  bool commit_cage_edit();
  bool scope_messages();
  bool deform();
  bool may_draft() const;
  void enter_view_under_cursor();
  const ViewModel& model_of(std::size_t view) const;
  document::PosedModel posed_in(std::size_t view) const;
  FieldSubject field_subject(std::size_t view) const;
  bool follow_fields();
  bool field_is_due() const;
  void share_ranges();
  bool cage_moved() const {
    return workspace_.document.has_cage() && cage_drawn_ != workspace_.document.revisions().pose;
  }
  void upload();
  void draw_panels();
  void draw();
  Fineness fineness(const ViewDrawing& wanted);
  void draw_whole();
  void hide_tools();
  void show_tools();
  void add_times();
  double refinement_in() const;
  bool wants_refinement() const;
  void load_fonts();
  void follow_characters();
  void place_viewport();
  bool save_screenshot();
  double progress_in() const;

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
  SideModels sides_;
  ReportMaker report_;
  SurfaceChecks checks_;
  MethodMeasuring measuring_;
  VertexInspector inspector_;
  FieldMaker fields_;
  ModelShading shading_;  // of the open model
  Bound opened_bound_;    // the binding of the last opened files, until the next frame
  workspace::Pointer pointer_;
  platform::InputQueue input_{ui::imgui_key};
  ui::Recorder recorder_;
  ui::Fonts fonts_;
  std::set<char32_t> characters_;  // all characters after Latin-1 that were shown until now
  bool outdated_fonts_ = false;    // true: the next frame needs other characters or sizes
  platform::ImGuiRenderer imgui_renderer_;
  render::Framebuffer framebuffer_;
  WorkspaceRenderer renderer_;
  ViewCache view_cache_;
  ui::FieldColors field_colors_;

  std::vector<Activity> activities_;
  Settling settling_;

  // Panels that changes between two frames can affect.
  struct Notices {
    bool question = false;
    unsigned messages = 0;
    float height = 0;
    friend bool operator==(const Notices&, const Notices&) = default;
  };
  Notices notices() const {
    return {workspace_.files.question.has_value(), workspace_.messages.revision(),
            workspace_.panels.notice_height};
  }
  Notices notices_drawn_;

  document::Revisions message_revisions_;  // revisions of the document in the last frame
  unsigned message_revision_ = 0;
  std::optional<document::Revision> cage_drawn_;  // revision of the uploaded pose; nullopt: upload again
  double last_change_ = 0, last_frame_ = 0;       // clock times in seconds: last change, last frame
  double last_motion_ = 0;                        // clock time in seconds of the last picture with motion
  std::size_t views_seen_ = 1;
  std::optional<bool> theme_seen_;
  document::CameraPose camera_seen_;
  bool at_rest_ = false;  // true: the view shows the model at rest

  // During a screenshot without panels, the values of Panels::has_user and View::tools to restore.
  std::optional<std::pair<bool, bool>> tools_hidden_from_;

  // The state of the current frame.
  base::Stopwatch watch_;
  float seconds_ = 0;  // time since the last frame
  workspace::FrameTimes times_;
  bool deformed_ = false, take_screenshot_ = false, has_drawn_ = false;
  bool refines_ = false;                       // the frame refines the view
  bool camera_moved_ = false, moves_ = false;  // the frame shows a motion of the camera; any motion
};

}  // namespace viete::app
