#include "app/offscreen_viewer.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "app/inputs.h"
#include "app/options.h"
#include "base/error.h"
#include "scene/document/pose_edit.h"
#include "scene/workspace/apply_opened.h"

namespace viete::app {

OffscreenViewer::OffscreenViewer(const ViewerOptions& options,
                                 std::unique_ptr<platform::OffscreenContext> context)
    : context_(std::move(context)),
      gl_(render::load_gl([this](const char* name) { return context_->get_proc_address(name); })),
      viewer_(gl_, options) {}

void OffscreenViewer::settle() {
  constexpr float frame_seconds = 1.0f / 60;
  viewer_.frame(frame_seconds);
  viewer_.finish_loading();
  viewer_.finish_exports();
  viewer_.frame(frame_seconds);
  viewer_.finish_binding();
  if (viewer_.workspace().view.panels) viewer_.finish_checks();
  for (int i = 0; i < 200 && viewer_.wants_frame(); ++i) viewer_.frame(frame_seconds);
  viewer_.finish_views();
  if (viewer_.workspace().view.panels) viewer_.finish_measuring();
  viewer_.frame(frame_seconds);
}

namespace {

const std::map<std::string, scene::StandardView> looks = {
    {"home", scene::StandardView::home},    {"front", scene::StandardView::front},
    {"back", scene::StandardView::back},    {"left", scene::StandardView::left},
    {"right", scene::StandardView::right},  {"top", scene::StandardView::top},
    {"bottom", scene::StandardView::bottom}};

// Flags are applied on top of the session's options, or of the defaults for pictures.
scene::ViewOptions view_of(const PictureOptions& options, const std::optional<scene::Session>& session) {
  scene::ViewOptions view = session ? session->view : scene::ViewOptions{.panels = false, .hints = false};
  view.panels = options.panels || (options.panels_of_session && view.panels);
  view.hints = false;
  view.dark &= !options.light;
  view.cage = options.cage;
  view.wireframe |= options.wireframe;
  view.field = base::value_of_word<lab::Field>(options.map).value_or(view.field);
  view.grid &= !options.no_grid;
  view.shading = base::value_of_word<scene::Shading>(options.shading).value_or(view.shading);
  return view;
}

// One view per word, in order; unspecified settings are those of the document.
void split(scene::Workspace& w, const std::vector<std::string>& words) {
  if (words.empty()) return;
  std::vector<scene::SideWay> views;
  for (const std::string& word : words) {
    scene::SideWay view{w.document.scheme, w.document.method, w.view.field};
    if (const auto method = sym3::method_from_name(word)) view.method = *method;
    if (word == "log" || word == "straight")
      view.other_blending = (word == "straight") != w.document.timeline.straight;
    const auto way = std::ranges::find(deform::all_ways(), word, &deform::WayEntry::name);
    if (way != deform::all_ways().end()) view.scheme = deform::scheme_of(way->value, w.document.scheme);
    views.push_back(std::move(view));
  }
  if (views[0].other_blending) {
    scene::set_straight(w.document, w.playback.vectors, !w.document.timeline.straight);
    for (scene::SideWay& view : views) view.other_blending = !view.other_blending;
  }
  w.document.put_scheme(views[0].scheme);
  w.document.put_method(views[0].method);
  scene::put_ways(w.split, {.sides = {views.begin() + 1, views.end()}, .cameras = {}});
  w.viewport = scene::viewport_of(w.split, w.viewport, 0);
}

// The session's camera, unless --camera or --look replace it.
void aim(Viewer& viewer, bool has_camera, const PictureOptions& options) {
  viewer.frame(0);  // sets the viewport needed for framing
  if (!options.camera.empty()) {
    const auto camera = scene::read_session(options.camera).camera;
    if (!camera)
      throw base::Error(options.camera.string(), "this session has no camera", "choose another one");
    return viewer.workspace().camera.set_pose(*camera);
  }
  const bool keeps_look = has_camera && options.look.empty();
  if (keeps_look && options.compare.empty()) return;
  scene::Workspace& w = viewer.workspace();
  if (!keeps_look) w.camera.look(looks.at(options.look.empty() ? "home" : options.look));
  w.camera.animate(1);
  scene::frame_all(w, false);
}

// Warns about requested items that are not in the picture.
void print_missing(const scene::Workspace& w) {
  if (scene::shown_field(w) != w.view.field)
    print_notes({"no map of " + std::string(base::entry_of(w.view.field).word) +
                 " here: some maps need a cage and a blend in log space, others a model that can move"});
  for (const scene::View& view : w.split.views)
    for (const std::string& problem : {view.problem, view.shown.problem})
      if (!problem.empty()) throw base::Error("", problem);
}

}  // namespace

std::unique_ptr<OffscreenViewer> viewer_of(const PictureOptions& options, scene::Opened&& opened) {
  const std::optional<scene::Session> session = opened.session;
  ViewerOptions viewer = options.viewer;
  if (session && session->window) viewer.size = *session->window;
  if (options.size.x > 0) viewer.size = options.size;
  const glm::dvec2 pixels = static_cast<double>(viewer.scale) * glm::dvec2(viewer.size);
  if (pixels.x * pixels.y > static_cast<double>(most_pixels))
    throw base::Error("picture", "it has more than 268 million pixels", "use a smaller --size or --scale");
  auto offscreen = std::make_unique<OffscreenViewer>(viewer);
  scene::Workspace& w = offscreen->viewer().workspace();
  scene::apply_opened(w, std::move(opened));
  w.view = view_of(options, session);
  w.has_user = w.tools = false;
  split(w, options.compare);
  aim(offscreen->viewer(), session && session->camera, options);
  return offscreen;
}

void print_messages(const scene::Workspace& w) {
  print_missing(w);
  if (const auto& cage = w.document.cage) print_notes(cage->warnings);
  for (const auto& message : w.messages.all()) {
    if (message.severity == scene::Severity::error) throw base::Error("", message.text);
    print_notes({message.text});
  }
  print_notes(w.pose_notes);
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
  add_size_option(command, options.size);
  auto* scale = command.add_option("--scale", options.viewer.scale, "Device pixels per logical pixel");
  in_range(scale, 0.5, 4)->default_str("1");
  auto* look = command.add_option("--look", options.look, "home, front, back, left, right, top or bottom");
  one_of(look, {"home", "front", "back", "left", "right", "top", "bottom"})->default_str("home");
  add_file_option(command, "--camera", options.camera, "Camera of this session");
  auto* shading = command.add_option("--shading", options.shading,
                                     "clay, porcelain, jade, file, checker, normals or zebra");
  one_of(shading, {"clay", "porcelain", "jade", "file", "checker", "normals", "zebra"})->default_str("file");
  command.add_flag("--show-cage", options.cage, "Draw the cage");
  command.add_flag("--panels", options.panels, "Draw the panels of the window");
  command.add_flag("--light", options.light, "Light theme");
  command.add_flag("--wireframe", options.wireframe, "Draw the edges of the mesh");
  std::vector<std::string> maps;
  for (const base::Choice& choice : choices(lab::Field::none)) maps.emplace_back(choice.word);
  auto* map = command.add_option("--map", options.map, "Colour map, see 'viete help deformers'");
  one_of(map, maps)->default_str("none");
  std::vector<std::string> compared;
  for (const deform::WayEntry& entry : deform::all_ways()) compared.emplace_back(entry.name);
  for (const sym3::Method method : scene::compared_methods) compared.emplace_back(sym3::name(method));
  compared.insert(compared.end(), {"log", "straight"});
  auto* compare = command.add_option("--compare", options.compare,
                                     "Compare 2 to 4 deformers or methods, or log,straight");
  one_of(compare, compared)->delimiter(',')->expected(2, 4)->type_name("WORD,WORD");
  command.add_flag("--no-grid", options.no_grid, "Omit the ground grid");
}

}  // namespace viete::app
