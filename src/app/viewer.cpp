#include "app/viewer.h"

#include <imgui.h>

#include <ctime>
#include <utility>

#include "app/assets.h"
#include "app/child_process.h"
#include "base/atomic_file.h"
#include "base/clock.h"
#include "base/error.h"
#include "document/cage_editing.h"
#include "render/view.h"
#include "sym3/kernel.h"
#include "ui/panels.h"
#include "workspace/playing.h"
#include "workspace/saving.h"
#include "workspace/split.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

constexpr double still_seconds = 0.25;

}  // namespace

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
      files_(options.state, workspace_, options.program),
      model_(files_),
      analysis_(options.probe, options.program, options.state),
      imgui_renderer_(gl),
      framebuffer_(gl),
      renderer_(gl),
      view_(gl, {options.samples, options.still_samples}) {
  load_fonts();
  platform::InputQueue::configure();
  for (const auto& [palette, colors] : {std::pair{render::surface_palette(33), &field_colors_.even},
                                        {render::diverging_palette(33), &field_colors_.diverging}})
    for (const glm::vec3& c : palette) colors->push_back(ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 1}));
  workspace_.about = {version(), build_type(), std::string(sym3::kernel_name()), gl.renderer, gl.software};
  if (options.may_be_coarse)
    workspace_.about.moving_triangles = (gl.software ? 1 : 4) * options.moving_triangles;
  try {
    workspace_.files.example = bundled_model().loop;
  } catch (const std::exception&) {  // without the bundled model, offers no example
  }
  place_viewport();
}

void Viewer::load_fonts() {
  fonts_ = ui::add_fonts(options_.scale, options_.builtin_font, characters_);
  imgui_renderer_.upload_fonts();
  outdated_fonts_ = false;
}

// New characters are drawn from the next frame on, because fonts cannot change during a frame.
void Viewer::follow_characters() {
  const std::size_t known = characters_.size();
  characters_.merge(ui::shown_characters(workspace_));
  outdated_fonts_ |= characters_.size() > known;
  if (outdated_fonts_) settle(2);
}

glm::ivec2 Viewer::device_size() const {
  return glm::max(glm::ivec2(1), glm::ivec2(glm::vec2(options_.size) * options_.scale + 0.5f));
}

void Viewer::resize(glm::ivec2 size, float scale) {
  const bool rescaled = std::exchange(options_.scale, scale) != scale;
  outdated_fonts_ |= rescaled;
  if (std::exchange(options_.size, size) != size || rescaled)
    settle(3);  // panels need some frames to compute their sizes
  place_viewport();
}

void Viewer::drop(std::vector<fs::path> files) {
  workspace_.jobs.requests.open = files::OpenRequest{files::OpenRequest::What::dropped, std::move(files)};
}

void Viewer::place_viewport() {
  auto& view = workspace_.view;
  const document::Viewport whole =
      workspace::view_between(workspace_.preferences.layout, glm::vec2(options_.size), view.options.panels,
                              workspace_.panels.notice_height);
  view.viewport = workspace::viewport_of(view.split, whole, view.split.active);
}

void Viewer::frame(float seconds) {
  base::Stopwatch whole;
  last_frame_ = base::wall_seconds();
  refines_ = !changing() && wants_refinement();
  workspace::FrameTimes times;
  take_input(seconds);
  take_requests();
  workspace::follow_time(workspace_, seconds);
  workspace::follow_pins(workspace_);
  follow_document();
  scope_messages();
  deform(times);
  if (std::exchange(workspace_.jobs.requests.frame_finding, false)) workspace::frame_finding(workspace_);
  const bool new_fields = follow_fields(), inspected = analysis_.follow_vertex(workspace_, model_);
  if (new_fields || inspected) settle(2);
  const bool cage_moved =
      workspace_.document.has_cage() && cage_drawn_ != workspace_.document.revisions().pose;
  auto& view = workspace_.view;
  const std::pair shown(workspace_.panels.has_user, view.tools);
  // A screenshot without panels shows no notices and no tools.
  if (take_screenshot_ && !view.options.panels) workspace_.panels.has_user = view.tools = false;
  upload(times);
  panels(times);
  const bool camera_moved = std::exchange(camera_seen_, view.camera.pose()) != view.camera.pose();
  moves_ = camera_moved || deformed_ || cage_moved;
  draw(times);
  std::tie(workspace_.panels.has_user, view.tools) = shown;
  times.frame = whole.lap_ms();
  times.when = base::wall_seconds();
  const bool counts = deformed_ ? !model_.prepared() && !refines_ : camera_moved;
  if (counts) view.split.views[0].stats.add(times);
  files_.keep(workspace_, !pointer_.active());
  follow_notices();
  analysis_.follow_frame(workspace_, model_, moves_);
  const bool news = analysis_.shows_news(), measured = sides_.measure(workspace_);
  if (news || measured) settle(2);
  if (take_screenshot_) save_screenshot();
  if (settle_frames_ > 0) --settle_frames_;
}

void Viewer::take_input(float seconds) {
  place_viewport();
  if (theme_seen_ != workspace_.view.options.dark) ui::apply_style(workspace_.view.options.dark);
  theme_seen_ = workspace_.view.options.dark;
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(options_.size.x), static_cast<float>(options_.size.y)};
  io.DisplayFramebufferScale = {options_.scale, options_.scale};
  io.DeltaTime = std::max(seconds, 1e-4f);
  if (!input_.empty()) settle(3);
  input_.feed_frame();
  if (outdated_fonts_) load_fonts();
  ImGui::NewFrame();
  enter_view_under_cursor();
  ui::handle_input(workspace_, pointer_);
  workspace_.view.camera.animate(seconds);
  place_viewport();
}

// True if the view has been at rest for some time, but was drawn with fewer samples than possible.
bool Viewer::wants_refinement() const {
  return view_.fineness() < view_.finest() && base::wall_seconds() - last_change_ > still_seconds;
}

bool Viewer::keeping() const {
  return workspace::has_unsaved_edits(workspace_) && files_.kept();
}

bool Viewer::finish_keeping() {
  return workspace::has_unsaved_edits(workspace_) && files_.keep_now(workspace_);
}

// Messages and questions need a few frames to compute their sizes.
void Viewer::follow_notices() {
  const std::tuple now(workspace_.files.question.has_value(), workspace_.messages.revision(),
                       workspace_.panels.notice_height);
  if (std::exchange(notices_, now) != now) settle(3);
}

// Removes messages about a replaced model or cage. Hides messages whose time has ended.
void Viewer::scope_messages() {
  auto& messages = workspace_.messages;
  const auto& now = workspace_.document.revisions();
  if (now.surfaces != message_revisions_.surfaces) {
    messages.forget(workspace::Scope::model, message_revision_);
  } else if (now.cage != message_revisions_.cage) {
    messages.forget(workspace::Scope::cage, message_revision_);
  }
  message_revisions_ = now;
  message_revision_ = messages.revision();
  messages.expire(base::wall_seconds());
}

bool Viewer::wants_frame() const {
  constexpr double progress_seconds = 0.05;
  const bool reports = files_.loading() || files_.exporting() || model_.binding() ||
                       sides_.binding(workspace_) || cages_.running() || analysis_.reports();
  const double passed = base::wall_seconds() - last_frame_;
  if (reports && passed > progress_seconds) return true;
  if (workspace_.files.browser.open && passed > 1) return true;  // files on disk may have changed
  return changing() || files_.has_news() || model_.has_result() ||
         (!pointer_.active() && cages_.is_due(workspace_)) || wants_refinement() ||
         analysis_.has_news(workspace_, model_) || workspace_.messages.due(base::wall_seconds());
}

bool Viewer::changing() const {
  const document::Document& document = workspace_.document;
  const bool cage_moved = document.has_cage() && cage_drawn_ != document.revisions().pose;
  return settle_frames_ > 0 || !input_.empty() || workspace_.view.camera.moving() || cage_moved ||
         workspace_.playback.playing || workspace_.frame.pins.is_due() || model_.is_due(document) ||
         sides_.is_due(workspace_, model_) || field_is_due() || analysis_.vertex_is_due(workspace_, model_);
}

void Viewer::show_manual(const std::string& chapter) {
  try {
    open_in_browser(manual_page(chapter));
    workspace_.messages.succeeded("manual");
  } catch (const base::Error& error) {
    workspace_.messages.error(base::message_of(error), {"manual"});
  }
}

void Viewer::take_requests() {
  auto& requests = workspace_.jobs.requests;
  if (const auto chapter = std::exchange(requests.manual, std::nullopt)) show_manual(*chapter);
  files_.take_requests(workspace_, !pointer_.active());
  take_screenshot_ = std::exchange(requests.screenshot, false);
  if (requests.stop_work && cages_.running()) {
    cages_.stop(workspace_);
    settle(3);
  }
  cages_.follow(workspace_, !pointer_.active());
  if (std::exchange(requests.stop_work, false) && model_.binding()) {
    model_.stop_binding(workspace_, "Cancelled binding; nothing was changed.", workspace::Severity::info);
    settle(3);
  }
}

void Viewer::follow_document() {
  const document::Document& document = workspace_.document;
  commit_cage_edit();
  if (model_.is_due(document) || model_.has_result()) settle(3);
  const LiveModel::Changed changed = model_.follow(workspace_, cages_.take_bound());
  if (changed.document || changed.cage) {
    fields_.forget();
    sides_.forget();
    for (workspace::SplitView& side : workspace_.view.split.sides()) side.shown = {}, side.stats.clear();
    workspace_.view.interaction.hovered.reset();
    if (files_.shading().surface != document.model.surface)
      files_.shading() = shading_of(document.model, workspace_.about.moving_triangles);
    for (const std::string& warning : std::exchange(files_.shading().looks.warnings, {}))
      workspace_.messages.warn(warning, {.scope = workspace::Scope::model});
    if (changed.document) renderer_.set_document(document, files_.shading());
    if (changed.cage && !changed.document) {
      workspace::forget_findings(workspace_.checks);
      renderer_.set_another_cage(document, files_.shading());
    }
    cage_drawn_.reset();
  }
  analysis_.follow_document(workspace_);
  if (analysis_.shows_news()) settle(3);
}

void Viewer::commit_cage_edit() {
  if (workspace_.view.interaction.drag) return;
  try {
    if (!document::commit_cage_edit(workspace_.document)) return;
    workspace_.messages.succeeded("change the cage");
    settle(3);
  } catch (const std::exception& error) {
    workspace_.messages.error(base::message_of(error), {"change the cage", workspace::Scope::cage});
  }
}

void Viewer::finish_binding() {
  follow_document();
  model_.finish_binding(workspace_);
}

void Viewer::finish_checks() {
  follow_document();
  analysis_.finish_checks(workspace_);
}

void Viewer::deform(workspace::FrameTimes& times) {
  deformed_ = may_draft() ? model_.deform_draft(workspace_, times) : model_.deform(workspace_, times);
  deformed_ |= sides_.follow(workspace_, model_);
  workspace_.frame.posed = posed_in(workspace_.view.split.active);
}

// True if the view may show only the draft in motion, until it is refined. Maps, the vertex inspector and
// the brush need the whole model.
bool Viewer::may_draft() const {
  const auto& w = workspace_;
  return options_.may_be_coarse && !refines_ && !take_screenshot_ && w.view.options.deformed &&
         !w.view.split.on() && !w.checks.shown && !w.view.vertex.vertex && !workspace::shows_mask(w) &&
         workspace::shown_field(w) == analysis::Field::none;
}

// The drawn model; empty if the model is at rest. A side view without a frame shows the first view's frame.
document::PosedModel Viewer::posed_in(std::size_t view) const {
  const ViewModel& model = model_of(view).ran() ? model_of(view) : model_;
  if (!workspace_.view.options.deformed || !model.ran()) return {};
  return {model.deformer()->vertices(), model.deformer()->origin(), model.frames()};
}

const ViewModel& Viewer::model_of(std::size_t view) const {
  return view == 0 ? static_cast<const ViewModel&>(model_) : sides_[view - 1];
}

FieldSubject Viewer::field_subject(std::size_t view) const {
  return {workspace_.document, workspace::shown_field(workspace_, view),
          model_of(view),      workspace::shown_way(workspace_, view).method,
          posed_in(view),      posed_in(0)};
}

bool Viewer::field_is_due() const {
  for (std::size_t view = 0; view < workspace_.view.split.count(); ++view)
    if (fields_.is_due(view, field_subject(view), workspace_.view.split.views[view].shown)) return true;
  return false;
}

bool Viewer::follow_fields() {
  bool news = false;
  if (!workspace_.document.model.surface) return news;
  for (std::size_t view = 0; view < workspace_.view.split.count(); ++view)
    news |= fields_.follow(view, field_subject(view), workspace_.view.split.views[view].shown);
  const std::size_t views = workspace_.view.split.count();
  const bool closed = views < std::exchange(views_seen_, views);
  if ((news && views > 1) || closed) share_ranges();
  return news;
}

// If several views show the same field, gives these views a common range of colours.
void Viewer::share_ranges() {
  for (workspace::SplitView& view : workspace_.view.split.views)
    if (view.shown.values) std::tie(view.shown.stats.low, view.shown.stats.high) = view.shown.own_range;
  for (std::size_t view = 0; view < workspace_.view.split.count(); ++view) {
    workspace::FieldView& shown = workspace_.view.split.views[view].shown;
    analysis::FieldStats& stats = shown.stats;
    if (!shown.values) continue;
    for (std::size_t other = 0; other < workspace_.view.split.count(); ++other) {
      const workspace::FieldView& beside = workspace_.view.split.views[other].shown;
      if (!beside.values || beside.stats.field != stats.field || shown.holds_range) continue;
      stats.low = std::min(stats.low, beside.stats.low), stats.high = std::max(stats.high, beside.stats.high);
    }
    analysis::fit_counts(*shown.values, stats);
  }
}

void Viewer::finish_views() {
  if (!workspace_.document.model.surface) return;
  sides_.finish(workspace_, model_);
  frame(0);
  for (std::size_t view = 0; view < workspace_.view.split.count(); ++view)
    fields_.finish(view, field_subject(view), workspace_.view.split.views[view].shown);
  share_ranges();
}

// Activates the view under the cursor, except during a drag or a motion of the camera.
void Viewer::enter_view_under_cursor() {
  auto& view = workspace_.view;
  if (view.split.active >= view.split.count()) workspace::enter_view(workspace_, 0);
  if (!view.split.on() || pointer_.active() || view.camera.moving()) return;
  const ImVec2 at = ImGui::GetIO().MousePos;
  if (ImGui::IsMousePosValid(&at))
    workspace::enter_view(workspace_, workspace::view_at(view.split, view.viewport, {at.x, at.y}));
}

void Viewer::upload(workspace::FrameTimes& times) {
  const document::Document& document = workspace_.document;
  if (!document.model.surface) return;
  base::Stopwatch watch;
  const bool cage_moved = cage_drawn_ != document.revisions().pose;
  const bool at_rest = !workspace_.view.options.deformed,
             switched = std::exchange(at_rest_, at_rest) != at_rest;
  renderer_.set_findings(workspace_, posed_in(0), deformed_ || cage_moved || switched);
  if (document.has_cage()) {
    if (cage_moved) renderer_.set_cage(workspace_);
    renderer_.set_hand(workspace_);
    cage_drawn_ = document.revisions().pose;
  }
  if (switched && at_rest) renderer_.set_rest(document, files_.shading());
  renderer_.set_views(workspace_.view.split.count(), document, files_.shading());
  for (std::size_t view = 0; view < workspace_.view.split.count(); ++view) {
    const bool news = view == 0 ? model_.take_news() : sides_[view - 1].take_news();
    const document::PosedModel posed = posed_in(view);
    if ((news || switched) && !posed.vertices.empty())
      renderer_.set_model(view, posed.vertices, posed.origin);
  }
  if (const deform::Deformer* draft = model_.take_draft())
    renderer_.set_draft(draft->vertices(), draft->origin());
  renderer_.set_colors(workspace_);
  times.upload = watch.lap_ms();
}

void Viewer::panels(workspace::FrameTimes& times) {
  base::Stopwatch watch;
  const double begun = base::thread_seconds();
  recorder_.begin_frame();
  ui::draw_panels({workspace_, fonts_, ui::palette(workspace_.view.options.dark), &recorder_, field_colors_});
  follow_characters();
  ImGui::Render();
  times.panels = watch.lap_ms();
  times.cost.longest += base::thread_seconds() - begun;
  times.cost.wall += 1e-3 * times.panels;
}

// Continuous motion may be drawn coarsely. A single step of a model without a draft is drawn completely.
Fineness Viewer::fineness(const ViewDrawing& wanted) {
  if (take_screenshot_ || refines_) return view_.finest();
  if (view_.shows(wanted)) return view_.fineness();
  last_change_ = base::wall_seconds();
  if (model_.shows_draft(workspace_.document)) return Fineness::coarse;
  const bool drafted = files_.shading().draft != nullptr;
  const bool coarse =
      drafted || (last_frame_ - last_motion_ < still_seconds && workspace::draws_coarsely(workspace_));
  return options_.may_be_coarse && moves_ && coarse ? Fineness::coarse : Fineness::plain;
}

ViewDrawing Viewer::drawing() const {
  ViewDrawing wanted = renderer_.drawing(workspace_, device_size(), options_.scale);
  wanted.transparent = options_.transparent;
  return wanted;
}

render::Image Viewer::picture() {
  render::Image image = framebuffer_.read(!options_.transparent);
  if (options_.transparent) render::divide_by_opacity(image);
  return image;
}

void Viewer::draw(workspace::FrameTimes& times) {
  base::Stopwatch watch;
  has_drawn_ = false;
  const ViewDrawing wanted = drawing();
  has_drawn_ = view_.draw(renderer_, wanted, fineness(wanted), workspace::draws_coarsely(workspace_)) ||
               !imgui_renderer_.has_drawn(*ImGui::GetDrawData());
  if (has_drawn_) draw_whole();
  if (moves_) last_motion_ = base::wall_seconds();
  times.draw = watch.lap_ms();
}

void Viewer::draw_whole() {
  framebuffer_.begin_with(view_.picture(), device_size());
  imgui_renderer_.draw(*ImGui::GetDrawData());
  if (gl_.software)
    gl_.Finish();  // software rendering is asynchronous; waiting makes the measured time correct
}

void Viewer::redraw() {
  renderer_.forget();
  view_.forget();
  cage_drawn_.reset();
  workspace::FrameTimes ignored;
  upload(ignored);
  view_.draw(renderer_, drawing(), view_.fineness(), workspace::draws_coarsely(workspace_));
  draw_whole();
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
    workspace_.messages.succeeded("screenshot");
    workspace_.messages.info("Saved " + path.string());
  } catch (const std::exception& error) {
    workspace_.messages.error(base::message_of(error), {"screenshot"});
  }
  settle(2);
}

}  // namespace viete::app
