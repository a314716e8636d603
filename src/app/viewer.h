// The viewer without a window: one frame from input to picture, the same in a window, in a test and for the
// command line.
#pragma once

#include <memory>
#include <optional>

#include "app/bound.h"
#include "app/error_map.h"
#include "app/file_desk.h"
#include "app/method_probe.h"
#include "app/saved_bindings.h"
#include "app/stage.h"
#include "base/background.h"
#include "base/worker_pool.h"
#include "bench/exp.h"
#include "deform/deformer.h"
#include "platform/imgui_renderer.h"
#include "platform/input_queue.h"
#include "render/framebuffer.h"
#include "scene/pointer.h"
#include "scene/workspace.h"
#include "ui/context.h"
#include "ui/imgui_bridge.h"

namespace viete::app {

struct ViewerOptions {
  glm::ivec2 size{1280, 800};  ///< logical pixels
  float scale = 1;             ///< device pixels per logical pixel
  int samples = 0;             ///< multisampling; 0 none
  int still_samples = 0;  ///< of one more frame once nothing has changed for a quarter of a second; 0 none
  bool builtin_font = false;  ///< the same text on every machine, for picture tests
  bool probe = true;          ///< measure the methods aside
  std::filesystem::path
      state{};               ///< where to remember files and keep unsaved work, see FileDesk; empty: nowhere
  SavedBindings bindings{};  ///< where to find bindings, and to keep those that took long
};

/// Needs a current GL context, which must outlive it; use in that context's thread. Owns ImGui's context.
class Viewer {
public:
  Viewer(const render::Gl& gl, const ViewerOptions& options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  scene::Workspace& workspace() { return workspace_; }
  const scene::Workspace& workspace() const { return workspace_; }
  platform::InputQueue& input() { return input_; }
  ui::Recorder& recorder() { return recorder_; }

  void resize(glm::ivec2 logical_size);
  glm::ivec2 device_size() const;

  /// One frame: input, commands, deformation, drawing, panels, into the framebuffer. seconds since the last
  /// one.
  void frame(float seconds);
  /// True if a frame now would show something new: a change, or the picture at rest, refined.
  bool wants_frame() const;
  /// True while the methods are being measured aside.
  bool measuring() const { return method_probe_.busy(); }
  /// True while edits are unsaved and kept for the next start.
  bool keeping() const;
  /// Waits until unsaved edits are; false if there are none, or if they cannot be.
  bool finish_keeping();
  /// True once the program may end, as was requested.
  bool closed() const { return files_.closed(); }
  /// True while files are being read, and what they hold is bound, aside.
  bool loading() const { return files_.loading(); }
  /// True while deformed models are written aside.
  bool exporting() const { return files_.exporting() || workspace_.requests.save_model.has_value(); }
  /// True while something is read, bound or written aside that a person waits for.
  bool working() const { return loading() || exporting() || binder_.running(); }
  /// Waits for the files that are being read.
  void finish_loading() { files_.finish_loading(workspace_); }
  /// Waits for the deformed models that are being written.
  void finish_exports() { files_.finish_exports(workspace_); }
  /// Waits until the model is bound, without drawing: the next frame deforms it.
  void finish_binding();
  /// True while model and cage are being checked aside.
  bool checking() const { return checks_.running(); }
  /// Waits until they are.
  void finish_checks();
  /// Waits until the error map, if it is shown, is the one of this pose.
  void finish_error_map();

  render::Framebuffer& framebuffer() { return framebuffer_; }
  render::Image picture() { return framebuffer_.read(); }
  /// The deformer of the open document; null while there is none.
  const deform::Deformer* deformer() const { return deformer_.get(); }

private:
  bool changing() const;
  bool wants_refinement() const;
  void take_requests();
  void follow_document();
  void follow_surfaces();
  void follow_weights();
  void follow_method();
  void make_deformer();
  void start_binding();
  void take_binding(bool wait);
  void install(Bound bound);
  void stop_binding(const std::string& why, scene::Severity severity);
  void start_checks();
  void take_checks(bool wait);
  std::vector<mesh::Point> model_positions() const;
  void frame_finding();
  void deform(scene::FrameTimes& times);
  void keep_files();
  void count(const scene::FrameTimes& times);
  void upload(scene::FrameTimes& times);
  void draw(scene::FrameTimes& times);
  void panels(scene::FrameTimes& times);
  bool takes_exponentials() const;
  bool probe_is_due() const;
  void probe();
  void follow_benchmark();
  bool error_map_is_due() const;
  void follow_error_map(bool wait);
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
  scene::Pointer pointer_;
  platform::InputQueue input_{ui::imgui_key};
  ui::Recorder recorder_;
  ui::Fonts fonts_;
  platform::ImGuiRenderer imgui_renderer_;
  render::Framebuffer framebuffer_;
  Stage stage_;
  base::WorkerPool pool_;
  base::BackgroundJob<Bound> binder_;
  std::string binding_text_;
  MethodProbe method_probe_;
  base::BackgroundJob<bench::ExpBench> bench_;
  base::BackgroundJob<std::vector<scene::Finding>> checks_;
  std::shared_ptr<const mesh::Surface> checked_model_, checked_cage_;
  base::BackgroundJob<ErrorMap> error_map_;
  std::vector<ImU32> error_colors_;
  Bound bound_;  // what the deformer is made of; nothing while there is none
  std::unique_ptr<deform::Deformer> deformer_;

  // What the derived state was derived from; compared once a frame. Nothing: it is to be derived anew.
  scene::Revision surfaces_seen_ = 0, weights_seen_ = 0, method_seen_ = 0;
  std::optional<scene::Revision> pose_deformed_, cage_drawn_;
  unsigned long frames_deformed_ = 0, probed_ = 0, mapped_ = 0;  ///< counted, and which of them was measured
  bool deformed_ = false, warming_up_ = false, dragging_ = false, take_screenshot_ = false;
  double last_change_ = 0, last_frame_ = 0;  ///< seconds of wall time
  bool refined_ = false;
  unsigned settle_frames_ = 3;  ///< ImGui needs a few frames after a change until sizes rest
  std::optional<bool> theme_seen_;
};

}  // namespace viete::app
