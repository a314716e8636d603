#include "app/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <ctime>
#include <utility>

#include "app/build_facts.h"
#include "base/atomic_file.h"
#include "base/clock.h"
#include "deform/vertex_sample.h"
#include "render/palette.h"
#include "scene/binding_plan.h"
#include "scene/edit.h"
#include "scene/pose_notes.h"
#include "scene/saving.h"
#include "sym3/kernel.h"
#include "ui/input.h"
#include "ui/panels.h"
#include "ui/style.h"

namespace viete::app {

namespace fs = std::filesystem;

constexpr std::size_t benchmark_count = 1 << 18;  // some seconds, and more than caches hold
constexpr std::size_t probed_matrices = 2048;

Viewer::ImGuiOwner::ImGuiOwner() {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
}

Viewer::ImGuiOwner::~ImGuiOwner() {
  ImGui::DestroyContext();
}

Viewer::Viewer(const render::Gl& gl, const ViewerOptions& options)
    : gl_(gl),
      options_(options),
      files_(options.state, options.bindings, workspace_),
      imgui_renderer_(gl),
      framebuffer_(gl),
      stage_(gl) {
  fonts_ = ui::add_fonts(options.scale, options.builtin_font);
  imgui_renderer_.upload_fonts();
  platform::InputQueue::configure();
  for (const glm::vec3& c : render::surface_palette(33)) {
    error_colors_.push_back(ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 1}));
  }
  workspace_.about = {version(), build_type(), std::string(sym3::kernel_name()), gl.renderer};
  place_viewport();
}

Viewer::~Viewer() = default;

glm::ivec2 Viewer::device_size() const {
  return glm::max(glm::ivec2(1), glm::ivec2(glm::vec2(options_.size) * options_.scale + 0.5f));
}

void Viewer::resize(glm::ivec2 logical_size) {
  options_.size = logical_size;
  place_viewport();
}

void Viewer::place_viewport() {
  const glm::vec2 window(options_.size);
  const glm::vec2 covered =
      workspace_.view.panels ? glm::vec2(ui::column_width, ui::status_height) : glm::vec2(0);
  workspace_.viewport = {window, {covered.x, 0}, glm::max(glm::vec2(1), window - covered)};
}

void Viewer::frame(float seconds) {
  base::Stopwatch whole;
  last_frame_ = base::wall_seconds();
  refined_ = !changing() && wants_refinement();
  if (!refined_) last_change_ = base::wall_seconds();
  scene::FrameTimes times;
  place_viewport();
  if (theme_seen_ != workspace_.view.dark) ui::apply_style(workspace_.view.dark);
  theme_seen_ = workspace_.view.dark;

  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(options_.size.x), static_cast<float>(options_.size.y)};
  io.DisplayFramebufferScale = {options_.scale, options_.scale};
  io.DeltaTime = std::max(seconds, 1e-4f);
  if (!input_.empty()) settle_frames_ = 3;
  input_.feed_frame();
  ImGui::NewFrame();
  ui::handle_input(workspace_, pointer_);
  workspace_.camera.animate(seconds);
  place_viewport();
  take_requests();
  follow_benchmark();
  follow_document();
  deform(times);
  upload(times);
  panels(times);
  draw(times);
  times.frame = whole.lap_ms();
  times.when = base::wall_seconds();
  count(times);
  keep_files();
  if (options_.probe) probe();
  follow_error_map(false);
  if (take_screenshot_) save_screenshot();
  if (settle_frames_ > 0) --settle_frames_;
}

// The first frame after a binding fills caches and compiles shaders: it says nothing of the frames to come,
// so it is made once more.
void Viewer::count(const scene::FrameTimes& times) {
  if (!deformed_) return;
  if (std::exchange(warming_up_, false)) {
    pose_deformed_.reset();
  } else {
    workspace_.stats.add(times);
  }
}

// A software rasteriser draws moving pictures without multisampling and the picture at rest with it.
bool Viewer::wants_refinement() const {
  constexpr double rest_seconds = 0.25;
  return options_.still_samples > 0 && !refined_ && base::wall_seconds() - last_change_ > rest_seconds;
}

bool Viewer::keeping() const {
  return scene::has_unsaved_edits(workspace_) && files_.kept();
}

bool Viewer::finish_keeping() {
  return scene::has_unsaved_edits(workspace_) && files_.keep_now(workspace_);
}

// What there is to say of it is to be seen.
void Viewer::keep_files() {
  const unsigned said = workspace_.messages.revision();
  files_.keep(workspace_);
  if (workspace_.messages.revision() != said) settle_frames_ = std::max(settle_frames_, 3u);
}

bool Viewer::wants_frame() const {
  constexpr double progress_seconds = 0.05;
  const bool reports =
      files_.loading() || files_.exporting() || binder_.running() || checks_.running() || bench_.running();
  if (reports && base::wall_seconds() - last_frame_ > progress_seconds) return true;
  return changing() || files_.has_news() || wants_refinement() || method_probe_.has_result() ||
         probe_is_due() || binder_.has_result() || checks_.has_result() || bench_.has_result() ||
         error_map_.has_result() || error_map_is_due();
}

bool Viewer::changing() const {
  const scene::Document& document = workspace_.document;
  const scene::Revisions& now = document.revisions;
  const bool cage_moved = document.has_cage() && cage_drawn_ != now.pose;
  const bool model_waits = deformer_ && (pose_deformed_ != now.pose || method_seen_ != now.method);
  return settle_frames_ > 0 || !input_.empty() || workspace_.camera.moving() || cage_moved || model_waits ||
         surfaces_seen_ != now.surfaces || weights_seen_ != now.weights;
}

void Viewer::take_requests() {
  files_.take_requests(workspace_, !pointer_.active());
  if (std::exchange(workspace_.requests.run_benchmark, false)) {
    bench_.start(
        [](base::Progress& progress) { return bench::measure_exp(benchmark_count, false, progress); });
  }
  if (std::exchange(workspace_.requests.stop_benchmark, false)) bench_.cancel();
  take_screenshot_ = std::exchange(workspace_.requests.screenshot, false);
  const bool stop = std::exchange(workspace_.requests.stop_work, false);
  if (stop && binder_.running())
    stop_binding("Stopped binding; everything is as it was.", scene::Severity::info);
  if (std::exchange(workspace_.requests.frame_finding, false)) frame_finding();
}

void Viewer::follow_benchmark() {
  scene::Benchmark& shown = workspace_.benchmark;
  if (const auto result = bench_.poll()) {
    if (result->value) shown = bench::shown_benchmark(*result->value);
    if (!result->problem.empty()) workspace_.messages.error("The benchmark failed: " + result->problem);
    settle_frames_ = 3;
  }
  shown.running = bench_.running();
  shown.done = bench_.done();
}

void Viewer::follow_document() {
  const scene::Document& document = workspace_.document;
  const scene::Revisions& now = document.revisions;
  const bool new_surfaces = std::exchange(surfaces_seen_, now.surfaces) != now.surfaces;
  const bool new_weights = std::exchange(weights_seen_, now.weights) != now.weights;
  if (new_surfaces) follow_surfaces();
  if (new_surfaces || new_weights) follow_weights();
  if (method_seen_ != now.method) follow_method();
  if (checked_model_ != document.model.surface || checked_cage_ != document.cage_file.surface) start_checks();
  take_checks(false);
  // The staged frame's weights are made when a method asks for them; until then method `fast` serves.
  if (deformer_ && !binder_.running() && !deformer_->engine(document.method)) start_binding();
  take_binding(false);
  workspace_.binding = {binder_.running(), binding_text_, binder_.done(), binder_.seconds(),
                        binder_.seconds()};
}

// Everything that was derived from the old ones goes.
void Viewer::follow_surfaces() {
  const scene::Document& document = workspace_.document;
  settle_frames_ = 3;
  binder_.cancel();
  deformer_.reset();
  bound_ = {};
  error_map_.cancel();
  workspace_.pose_notes.clear();
  if (files_.look().surface != document.model.surface) files_.look() = look_of(document.model.surface);
  stage_.set_document(document, files_.look());
  cage_drawn_.reset();
  pose_deformed_.reset();
  if (Bound bound = files_.take_bound(); bound.binds(document)) install(std::move(bound));
}

// The old ones serve until the new ones are there.
void Viewer::follow_weights() {
  const scene::Document& document = workspace_.document;
  settle_frames_ = 3;
  binder_.cancel();
  if (document.has_cage() && !(deformer_ && bound_.binding->weighting == document.scheme.weighting))
    start_binding();
}

// Another blend sums other rows over the same weights.
void Viewer::follow_method() {
  const scene::Document& document = workspace_.document;
  method_seen_ = document.revisions.method;
  pose_deformed_.reset();
  const bool other_blend = deformer_ && deformer_->scheme().blend != document.scheme.blend;
  if (other_blend && bound_.binding->weighting == document.scheme.weighting) make_deformer();
}

void Viewer::start_binding() {
  const scene::Document& document = workspace_.document;
  binding_text_ = scene::text(scene::binding_plan(document, document.scheme.weighting.elements));
  binder_.start([model = document.model.surface, cage = document.cage, scheme = document.scheme,
                 method = document.method, known = bound_,
                 saved = files_.take_saved()](base::Progress& progress) {
    return bind(model, cage, scheme, method, known, saved, progress);
  });
}

void Viewer::take_binding(bool wait) {
  auto result = binder_.poll(wait);
  if (!result) return;
  if (!result->value) return stop_binding(result->problem, scene::Severity::error);
  install(*std::move(result->value));
}

void Viewer::install(Bound bound) {
  for (const auto& warning : bound.binding->warnings) workspace_.messages.warn(warning);
  if (!bound.problem.empty()) workspace_.messages.error(bound.problem);
  files_.keep_binding(bound);
  bound_ = std::move(bound);
  make_deformer();
}

void Viewer::make_deformer() {
  deformer_ = std::make_unique<deform::Deformer>(bound_.cage, bound_.binding,
                                                 workspace_.document.scheme.blend, pool_);
  warming_up_ = true;
  pose_deformed_.reset();
}

// Blending and method are again those that the deformer has.
void Viewer::stop_binding(const std::string& why, scene::Severity severity) {
  binder_.cancel();
  scene::Document& document = workspace_.document;
  if (deformer_) {
    scene::give_up_scheme(document, deformer_->scheme());
    if (!deformer_->engine(document.method)) scene::set_method(document, sym3::Method::fast);
  }
  workspace_.messages.say(severity, why);
  settle_frames_ = 3;
}

// Of the surfaces as they were read: poses do not matter, nor what they are bound by.
void Viewer::start_checks() {
  const scene::Document& document = workspace_.document;
  checked_model_ = document.model.surface;
  checked_cage_ = document.cage_file.surface;
  checks_.start([model = document.model, cage = document.cage_file](base::Progress& progress) {
    return scene::check(model, cage, &progress);
  });
}

void Viewer::take_checks(bool wait) {
  auto result = checks_.poll(wait);
  workspace_.checks.running = checks_.running();
  workspace_.checks.done = checks_.done();
  if (!result) return;
  settle_frames_ = std::max(settle_frames_, 3u);
  if (!result->value) return workspace_.messages.error("The checks came to no end: " + result->problem);
  scene::take_findings(workspace_.checks, *std::move(result->value));
}

void Viewer::finish_checks() {
  follow_document();
  if (checks_.running()) take_checks(true);
}

std::vector<mesh::Point> Viewer::model_positions() const {
  if (deformer_ && deformer_->ran()) return deformer_->positions();
  return workspace_.document.model.surface->positions;
}

void Viewer::frame_finding() {
  const auto& checks = workspace_.checks;
  if (!checks.shown) return;
  const bool of_cage = checks.findings[*checks.shown].subject == scene::Subject::cage;
  scene::frame_finding(workspace_, of_cage ? workspace_.document.pose.positions : model_positions());
}

void Viewer::finish_binding() {
  follow_document();
  take_binding(true);
}

void Viewer::deform(scene::FrameTimes& times) {
  scene::Document& document = workspace_.document;
  const bool dragging = workspace_.hand.drag.has_value();
  const bool pressed = dragging && !dragging_, let_go = dragging_ && !dragging;
  dragging_ = dragging;
  if (let_go && deformer_) deformer_->end_drag();
  // The frame at rest depends on the pose alone.
  deformed_ = deformer_ && (pose_deformed_ != document.revisions.pose || let_go);
  if (deformed_) {
    deformer_->deform(document.pose,
                      deformer_->engine(document.method) ? document.method : sym3::Method::fast);
    scene::take_report(workspace_, deformer_->state().report());
    pose_deformed_ = document.revisions.pose;
    ++frames_deformed_;
    times.links = deformer_->times();
  }
  if (pressed && deformer_) deformer_->begin_drag(workspace_.hand.drag->vertices());
}

void Viewer::upload(scene::FrameTimes& times) {
  const scene::Document& document = workspace_.document;
  if (!document.model.surface) return;
  base::Stopwatch watch;
  const bool cage_moved = cage_drawn_ != document.revisions.pose;
  const bool shows = workspace_.checks.shown.has_value();
  stage_.set_findings(workspace_, shows ? model_positions() : std::vector<mesh::Point>(),
                      deformed_ || cage_moved);
  if (document.has_cage()) {
    if (cage_moved) stage_.set_cage(workspace_);
    stage_.set_hand(workspace_);
    cage_drawn_ = document.revisions.pose;
  }
  if (deformed_) stage_.set_model(deformer_->positions(), deformer_->normals());
  times.upload = watch.lap_ms();
}

void Viewer::panels(scene::FrameTimes& times) {
  base::Stopwatch watch;
  recorder_.begin_frame();
  const bool dark = workspace_.view.dark;
  ui::draw_panels({workspace_, fonts_, ui::palette(dark), &recorder_, error_colors_});
  ImGui::Render();
  times.panels = watch.lap_ms();
}

void Viewer::draw(scene::FrameTimes& times) {
  base::Stopwatch watch;
  framebuffer_.begin(device_size(), refined_ ? options_.still_samples : options_.samples);
  stage_.draw(workspace_, device_size(), options_.scale);
  framebuffer_.resolve();
  imgui_renderer_.draw(*ImGui::GetDrawData());
  if (gl_.software)
    gl_.Finish();  // a software rasteriser works in the background: count its work where it belongs
  times.draw = watch.lap_ms();
}

bool Viewer::takes_exponentials() const {
  return deformer_ && deformer_->ran() && deformer_->scheme().exponential();
}

bool Viewer::probe_is_due() const {
  const bool fresh = probed_ != frames_deformed_ || workspace_.methods.matrices == 0;
  return options_.probe && fresh && takes_exponentials() && method_probe_.ready();
}

void Viewer::probe() {
  if (auto stats = method_probe_.poll()) {
    workspace_.methods = *stats;
    settle_frames_ = std::max(settle_frames_, 1u);
  }
  if (!probe_is_due()) return;
  probed_ = frames_deformed_;
  method_probe_.offer(deformer_->sample_matrices(probed_matrices));
  workspace_.fused_error = deformer_->sampled_error();
}

bool Viewer::error_map_is_due() const {
  return scene::shows_error_map(workspace_) && takes_exponentials() && !error_map_.running() &&
         mapped_ != frames_deformed_;
}

// The newest map that is there, and the next one begun; a map may be of a pose a moment ago.
void Viewer::follow_error_map(bool wait) {
  if (auto result = error_map_.poll(wait)) {
    const bool fits =
        result->value && deformer_ && result->value->log10.size() == deformer_->binding().vertices;
    if (fits) {
      workspace_.error_map = result->value->stats;
      stage_.set_errors(result->value->log10);
      stage_.set_model(deformer_->positions(), deformer_->normals());
      settle_frames_ = std::max(settle_frames_, 2u);
    }
  }
  if (!error_map_is_due()) return;
  mapped_ = frames_deformed_;
  const auto logs = deformer_->state().logs();
  error_map_.start([bound = bound_, logs = std::vector(logs.begin(), logs.end()),
                    method = workspace_.document.method](base::Progress& progress) {
    const deform::Weigher weigher(*bound.cage, bound.binding->weighting);
    const auto matrices =
        deform::sample_stretches(weigher, *bound.binding, logs, bound.binding->vertices, &progress);
    return error_map(matrices, method, &progress);
  });
}

void Viewer::finish_error_map() {
  while (error_map_is_due() || (error_map_.running() && scene::shows_error_map(workspace_)))
    follow_error_map(true);
}

void Viewer::save_screenshot() {
  char name[64];
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::strftime(name, sizeof name, "viete-%Y%m%d-%H%M%S.png", &local);
  try {
    std::error_code ignored;
    const fs::path path = base::unused_name(fs::current_path(ignored) / name);
    render::write_png(path, framebuffer_.read());
    workspace_.messages.info("Saved " + path.string());
  } catch (const std::exception& error) {
    workspace_.messages.error(error.what());
  }
  settle_frames_ = std::max(settle_frames_, 2u);
}

}  // namespace viete::app
