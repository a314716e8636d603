#include "app/viewer.h"

#include <imgui.h>

#include <ctime>
#include <string_view>
#include <tuple>
#include <variant>

#include "app/assets.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "document/cage_editing.h"
#include "sym3/kernel.h"
#include "ui/panels.h"
#include "workspace/open_save.h"
#include "workspace/playing.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

constexpr double still_seconds = 0.25;

}  // namespace

Viewer::ImGuiOwner::ImGuiOwner() {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
  ImGui::GetIO().ConfigInputTextCursorBlink = false;  // an idle window draws no frames
}

Viewer::ImGuiOwner::~ImGuiOwner() {
  ImGui::DestroyContext();
}

Viewer::Viewer(const render::Gl& gl, const ViewerOptions& options)
    : gl_(gl),
      options_(options),
      files_(options.state, workspace_, options.program, options.wake),
      model_(options.wake),
      cages_(options.wake),
      sides_(options.wake),
      report_(options.program, options.state, options.wake),
      checks_(options.wake),
      measuring_(options.probe, options.wake),
      fields_(options.wake),
      imgui_renderer_(gl),
      framebuffer_(gl),
      renderer_(gl),
      view_cache_(gl, {options.samples, options.still_samples}),
      activities_(list_of_activities()) {
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
}

glm::ivec2 Viewer::device_size() const {
  return glm::max(glm::ivec2(1), glm::ivec2(glm::vec2(options_.size) * options_.scale + 0.5f));
}

void Viewer::resize(glm::ivec2 size, float scale) {
  const bool rescaled = std::exchange(options_.scale, scale) != scale;
  outdated_fonts_ |= rescaled;
  if (std::exchange(options_.size, size) != size || rescaled) settle_panels();
  place_viewport();
}

void Viewer::drop(std::vector<fs::path> files) {
  workspace_.jobs.wishes.open({files::OpenRequest::What::dropped, std::move(files)});
}

void Viewer::place_viewport() {
  auto& view = workspace_.view;
  const document::Viewport whole =
      workspace::view_between(workspace_.preferences.layout, glm::vec2(options_.size), view.options.panels,
                              workspace_.panels.notice_height);
  view.camera.viewport = workspace::viewport_of(view.split, whole, view.split.active);
}

// The frame, from input to picture. The activities after the picture keep and measure what it shows.
std::vector<Activity> Viewer::list_of_activities() {
  workspace::Workspace& w = workspace_;
  const document::Document& document = w.document;
  const auto always = [](auto act) {
    return [act] {
      act();
      return false;
    };
  };
  return {
      {"input", [&] { return now_if(!input_.empty() || w.view.camera.moving() || outdated_fonts_); },
       [this] { return take_input(); }},
      {"wishes", [&] { return now_if(!w.jobs.wishes.empty()); }, [this] { return grant_wishes(); }},
      {"files", [&] { return now_if(files_.is_due(w, may_edit())); },
       [&] {
         const bool news = files_.follow(w, may_edit());
         take_opened_files();
         return news;
       }},
      {"cage generation", [&] { return cages_.due_in(w, may_edit()); },
       [&] { return cages_.follow(w, may_edit()); }},
      {"timeline", [&] { return now_if(workspace::time_is_due(w)); },
       always([this] { workspace::follow_time(workspace_, seconds_); })},
      {"pins", [&] { return now_if(w.frame.pins.is_due()); },
       always([this] { workspace::follow_pins(workspace_); })},
      {"cage edit", [&] { return now_if(!w.view.interaction.drag && document::has_moved_rest(document)); },
       [this] { return commit_cage_edit(); }},
      {"surfaces and binding", [&] { return now_if(model_.binding_is_due(document)); },
       [this] { return bind(); }},
      {"checks", [&] { return now_if(checks_.is_due(w)); }, [&] { return checks_.follow(w); }},
      {"report", [&] { return now_if(report_.is_due()); }, [&] { return report_.follow(w); }},
      {"messages", [&] { return base::seconds_until(w.messages.next_end()); },
       [this] { return scope_messages(); }},
      {"deformation", [&] { return now_if(model_.frame_is_due(document) && !changes_rest(w)); },
       [this] { return deform(); }},
      {"side views", [&] { return now_if(sides_.is_due(w, model_)); }, always([this] {
         deformed_ |= sides_.follow(workspace_, model_);
         workspace_.frame.posed = posed_in(workspace_.view.split.active);
       })},
      {"maps", [this] { return now_if(field_is_due()); }, [this] { return follow_fields(); }},
      {"vertex inspector", [&] { return now_if(inspector_.is_due(w, model_)); },
       [&] { return inspector_.follow(w, model_); }},
      {"buffers", [this] { return now_if(cage_moved()); }, always([this] { upload(); })},
      {"panels", [this] { return now_if(settling_.is_due() || notices_drawn_ != notices()); },
       always([this] { draw_panels(); })},
      {"picture", [this] { return refinement_in(); }, always([this] { draw(); })},
      {"times", [] { return base::never; }, always([this] {
         show_tools();
         add_times();
       })},
      {"recovery and preferences", [&] { return now_if(may_edit() && files_.keeps(w)); },
       always([this] { files_.keep(workspace_, may_edit()); })},
      {"methods", [&] { return measuring_.due_in(w, model_); },
       [&] { return measuring_.follow(w, model_, moves_); }},
      {"errors of views", [&] { return sides_.measuring_in(w); }, [&] { return sides_.measure(w); }},
      {"progress", [this] { return progress_in(); }, [] { return false; }},
      {"screenshot", [this] { return now_if(take_screenshot_); }, [this] { return save_screenshot(); }},
  };
}

std::string Viewer::due_activity() const {
  for (const Activity& activity : activities_)
    if (activity.due_in() <= 0) return activity.name;
  return "";
}

void Viewer::frame(float seconds) {
  watch_ = {};
  last_frame_ = base::wall_seconds();
  seconds_ = seconds;
  times_ = {};
  refines_ = wants_refinement();
  bool changes_panels = false;
  for (const Activity& activity : activities_) changes_panels |= activity.step();
  if (changes_panels) settle_panels();
}

bool Viewer::take_input() {
  const bool input = !input_.empty() || outdated_fonts_;
  place_viewport();
  if (theme_seen_ != workspace_.view.options.dark) ui::apply_style(workspace_.view.options.dark);
  theme_seen_ = workspace_.view.options.dark;
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(options_.size.x), static_cast<float>(options_.size.y)};
  io.DisplayFramebufferScale = {options_.scale, options_.scale};
  io.DeltaTime = std::max(seconds_, 1e-4f);
  input_.feed_frame();
  if (outdated_fonts_) load_fonts();
  ImGui::NewFrame();
  enter_view_under_cursor();
  ui::handle_input(workspace_, pointer_);
  workspace_.view.camera.animate(seconds_);
  place_viewport();
  return input;
}

// The seconds until the view has been at rest for some time. Never if it was drawn with the most samples.
double Viewer::refinement_in() const {
  return view_cache_.fineness() < view_cache_.finest() ? base::seconds_until(last_change_ + still_seconds)
                                                       : base::never;
}

// A refined picture is drawn when nothing else changes the picture.
bool Viewer::wants_refinement() const {
  const auto picture = std::ranges::find(activities_, std::string_view("picture"), &Activity::name);
  return picture->due_in() <= 0 && app::due_in({activities_.begin(), picture}) > 0;
}

bool Viewer::keeping() const {
  return workspace::has_unsaved_edits(workspace_) && files_.kept();
}

bool Viewer::finish_keeping() {
  return workspace::has_unsaved_edits(workspace_) && files_.keep_now(workspace_);
}

// Removes messages about a replaced model or cage. Hides messages whose time has ended.
bool Viewer::scope_messages() {
  auto& messages = workspace_.messages;
  const bool ends = messages.next_end() <= base::wall_seconds();
  const auto& now = workspace_.document.revisions();
  if (now.surfaces != message_revisions_.surfaces) {
    messages.forget(workspace::Scope::model, message_revision_);
  } else if (now.cage != message_revisions_.cage) {
    messages.forget(workspace::Scope::cage, message_revision_);
  }
  message_revisions_ = now;
  message_revision_ = messages.revision();
  messages.expire(base::wall_seconds());
  return ends;
}

bool Viewer::grant_wishes() {
  workspace::Wishes& wishes = workspace_.jobs.wishes;
  const bool any = !wishes.empty();
  while (!wishes.empty()) grant(wishes.take());
  return any;
}

void Viewer::grant(const workspace::Wish& wish) {
  static_assert(std::variant_size_v<workspace::Wish> == 9, "grant() must handle each wish");
  if (const auto* open = std::get_if<workspace::OpenFiles>(&wish)) files_.open(workspace_, open->request);
  if (const auto* save = std::get_if<workspace::SaveFile>(&wish)) files_.save(workspace_, *save);
  if (const auto* given = std::get_if<workspace::AnswerQuestion>(&wish))
    files_.answer(workspace_, given->answer);
  if (const auto* cancel = std::get_if<workspace::CancelWork>(&wish)) cancel_work(cancel->work);
  if (const auto* manual = std::get_if<workspace::ShowManual>(&wish)) show_manual(manual->chapter);
  if (std::holds_alternative<workspace::ShowReport>(wish)) report_.start();
  if (std::holds_alternative<workspace::SaveScreenshot>(wish)) take_screenshot_ = true;
  if (std::holds_alternative<workspace::FrameFinding>(wish)) workspace::frame_finding(workspace_);
  if (std::holds_alternative<workspace::CloseProgram>(wish)) files_.close(workspace_);
}

void Viewer::show_manual(const std::string& chapter) {
  try {
    base::os::open_page(manual_page(chapter));
    workspace_.messages.succeeded("manual");
  } catch (const base::Error& error) {
    workspace_.messages.error(base::message_of(error), {"manual"});
  }
}

void Viewer::cancel_work(workspace::CancelWork::Work work) {
  using Work = workspace::CancelWork::Work;
  switch (work) {
    case Work::exporting: return files_.cancel_export();
    case Work::report: return report_.cancel();
    case Work::opening: break;
  }
  files_.cancel_opening();
  cages_.stop(workspace_);
  if (model_.binding())
    model_.stop_binding(workspace_,
                        model_.deformer() ? "Cancelled binding; nothing was changed."
                                          : "Cancelled binding. It starts again when the pose changes.",
                        workspace::Severity::info);
}

// Gives each part of opened files to its owner.
void Viewer::take_opened_files() {
  auto loaded = files_.take_opened();
  if (!loaded) return;
  if (loaded->shading.surface) shading_ = std::move(loaded->shading);
  if (loaded->bound.binding) opened_bound_ = std::move(loaded->bound);
  workspace::apply_opened(workspace_, std::move(loaded->opened));
}

bool Viewer::bind() {
  const document::Document& document = workspace_.document;
  const bool due = model_.binding_is_due(document);
  Bound known = std::exchange(opened_bound_, {});
  if (!known.binding) known = cages_.take_bound();
  const auto draft = shading_.surface == document.model().surface ? shading_.draft : nullptr;
  const LiveModel::Changed changed = model_.follow(workspace_, draft, std::move(known));
  if (changed.document || changed.cage) show_new_surfaces(changed);
  return due;
}

void Viewer::show_new_surfaces(LiveModel::Changed changed) {
  const document::Document& document = workspace_.document;
  fields_.forget();
  sides_.forget();
  for (workspace::SplitView& side : workspace_.view.split.sides()) {
    side.shown = {};
    side.stats.clear();
  }
  workspace_.view.interaction.hovered.reset();
  if (shading_.surface != document.model().surface)
    shading_ = shading_of(document.model(), workspace_.about.moving_triangles);
  for (const std::string& warning : std::exchange(shading_.looks.warnings, {}))
    workspace_.messages.warn(warning, {.scope = workspace::Scope::model});
  if (changed.document) {
    renderer_.set_document(document, shading_);
  } else {
    workspace::forget_findings(workspace_.checks);
    renderer_.set_another_cage(document, shading_);
  }
  cage_drawn_.reset();
}

bool Viewer::commit_cage_edit() {
  if (workspace_.view.interaction.drag || !document::has_moved_rest(workspace_.document)) return false;
  try {
    document::commit_cage_edit(workspace_.document);
    workspace_.messages.succeeded("change the cage");
  } catch (const std::exception& error) {
    workspace_.messages.error(base::message_of(error), {"change the cage", workspace::Scope::cage});
  }
  return true;
}

void Viewer::finish_binding() {
  bind();
  model_.finish_binding(workspace_);
}

void Viewer::finish_checks() {
  bind();
  checks_.finish(workspace_);
}

bool Viewer::deform() {
  deformed_ = may_draft() ? model_.deform_draft(workspace_, times_) : model_.deform(workspace_, times_);
  return deformed_;
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
          model_of(view),      workspace::view_settings(workspace_, view).method,
          posed_in(view),      posed_in(0)};
}

bool Viewer::field_is_due() const {
  for (std::size_t view = 0; view < workspace_.view.split.count(); ++view)
    if (fields_.is_due(view, field_subject(view), workspace_.view.split.views[view].shown)) return true;
  return false;
}

bool Viewer::follow_fields() {
  bool news = false;
  if (!workspace_.document.model().surface) return news;
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
      stats.low = std::min(stats.low, beside.stats.low);
      stats.high = std::max(stats.high, beside.stats.high);
    }
    analysis::fit_counts(*shown.values, stats);
  }
}

void Viewer::finish_views() {
  if (!workspace_.document.model().surface) return;
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
    workspace::enter_view(workspace_, workspace::view_at(view.split, view.camera.viewport, {at.x, at.y}));
}

void Viewer::upload() {
  const document::Document& document = workspace_.document;
  moves_ = deformed_ || cage_moved();
  if (take_screenshot_ && !workspace_.view.options.panels) hide_tools();
  if (!document.model().surface) return;
  base::Stopwatch watch;
  const bool moved = cage_drawn_ != document.revisions().pose;
  const bool at_rest = !workspace_.view.options.deformed,
             switched = std::exchange(at_rest_, at_rest) != at_rest;
  renderer_.set_findings(workspace_, posed_in(0), deformed_ || moved || switched);
  if (document.has_cage()) {
    if (moved) renderer_.set_cage(workspace_);
    renderer_.set_hand(workspace_);
    cage_drawn_ = document.revisions().pose;
  }
  if (switched && at_rest) renderer_.set_rest(document, shading_);
  renderer_.set_views(workspace_.view.split.count(), document, shading_);
  for (std::size_t view = 0; view < workspace_.view.split.count(); ++view) {
    const bool news = view == 0 ? model_.take_news() : sides_[view - 1].take_news();
    const document::PosedModel posed = posed_in(view);
    if (!(news || switched) || posed.vertices.empty()) continue;
    const deform::FrameDeformer& deformer = *(model_of(view).ran() ? model_of(view) : model_).deformer();
    if (const auto& splats = deformer.splats())
      renderer_.changed_model(view).set_splats(posed.vertices, posed.origin, splats->shapes(),
                                               splats->turns());
    else
      renderer_.changed_model(view).set_model(posed.vertices, posed.origin);
  }
  if (const deform::FrameDeformer* draft = model_.take_draft())
    renderer_.changed_model(0).set_draft(draft->vertices(), draft->origin());
  renderer_.set_colors(workspace_);
  times_.upload = watch.lap_ms();
}

void Viewer::draw_panels() {
  base::Stopwatch watch;
  const double begun = base::thread_seconds();
  recorder_.begin_frame();
  ui::draw_panels({workspace_, fonts_, ui::palette(workspace_.view.options.dark), &recorder_, field_colors_});
  follow_characters();
  ImGui::Render();
  settling_.add(imgui_renderer_.has_drawn(*ImGui::GetDrawData()));
  notices_drawn_ = notices();
  times_.panels = watch.lap_ms();
  times_.cost.longest += base::thread_seconds() - begun;
  times_.cost.wall += 1e-3 * times_.panels;
}

// Continuous motion may be drawn coarsely. A single step of a model without a draft is drawn completely.
Fineness Viewer::fineness(const ViewDrawing& wanted) {
  if (take_screenshot_ || refines_) return view_cache_.finest();
  if (view_cache_.shows(wanted)) return view_cache_.fineness();
  last_change_ = base::wall_seconds();
  if (model_.shows_draft(workspace_.document)) return Fineness::coarse;
  const bool drafted = shading_.has_draft();
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

void Viewer::draw() {
  base::Stopwatch watch;
  camera_moved_ = std::exchange(camera_seen_, workspace_.view.camera.pose()) != workspace_.view.camera.pose();
  moves_ |= camera_moved_;
  has_drawn_ = false;
  const ViewDrawing wanted = drawing();
  has_drawn_ = view_cache_.draw(renderer_, wanted, fineness(wanted), workspace::draws_coarsely(workspace_)) ||
               !imgui_renderer_.has_drawn(*ImGui::GetDrawData());
  if (has_drawn_) draw_whole();
  if (moves_) last_motion_ = base::wall_seconds();
  times_.draw = watch.lap_ms();
}

void Viewer::draw_whole() {
  framebuffer_.begin_with(view_cache_.picture(), device_size());
  imgui_renderer_.draw(*ImGui::GetDrawData());
  if (gl_.software)
    gl_.Finish();  // software rendering is asynchronous; waiting makes the measured time correct
}

void Viewer::redraw() {
  renderer_.forget();
  view_cache_.forget();
  cage_drawn_.reset();
  upload();
  view_cache_.draw(renderer_, drawing(), view_cache_.fineness(), workspace::draws_coarsely(workspace_));
  draw_whole();
}

bool Viewer::save_screenshot() {
  if (!std::exchange(take_screenshot_, false)) return false;
  char name[64];
  const std::time_t now = std::time(nullptr);
  const std::tm local = base::os::local_time(now);
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
  return true;
}

// A screenshot without panels shows no notices and no tools.
void Viewer::hide_tools() {
  tools_hidden_from_ = {workspace_.panels.has_user, workspace_.view.tools};
  workspace_.panels.has_user = workspace_.view.tools = false;
}

void Viewer::show_tools() {
  if (const auto before = std::exchange(tools_hidden_from_, std::nullopt))
    std::tie(workspace_.panels.has_user, workspace_.view.tools) = *before;
}

void Viewer::add_times() {
  times_.frame = watch_.lap_ms();
  times_.when = base::wall_seconds();
  const bool counts = deformed_ ? !model_.prepared() && !refines_ : camera_moved_;
  if (counts) workspace_.view.split.views[0].stats.add(times_);
}

// Running work shows its progress. A file dialog shows files that other programs have changed.
double Viewer::progress_in() const {
  constexpr double progress_seconds = 0.05, folder_seconds = 1;
  if (working() || checks_.running() || report_.running())
    return base::seconds_until(last_frame_ + progress_seconds);
  return workspace_.files.browser.open ? base::seconds_until(last_frame_ + folder_seconds) : base::never;
}

}  // namespace viete::app
