#include "app/offscreen_viewer.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "app/inputs.h"
#include "base/error.h"
#include "base/numbered_files.h"
#include "base/text.h"
#include "document/pose_edit.h"
#include "workspace/open_save.h"
#include "workspace/playing.h"

namespace viete::app {

OffscreenViewer::OffscreenViewer(const ViewerOptions& options,
                                 std::unique_ptr<platform::OffscreenContext> context)
    : context_(std::move(context)),
      gl_(render::load_gl([this](const char* name) { return context_->get_proc_address(name); })),
      viewer_(gl_, options) {}

void OffscreenViewer::settle() {
  constexpr float frame_seconds = 1.0f / 60;
  viewer_.settle_panels();
  viewer_.frame(frame_seconds);
  viewer_.finish_loading();
  viewer_.finish_exports();
  viewer_.frame(frame_seconds);
  viewer_.finish_binding();
  if (viewer_.workspace().view.options.panels) viewer_.finish_checks();
  for (int i = 0; i < 200 && viewer_.wants_frame(); ++i) viewer_.frame(frame_seconds);
  viewer_.finish_views();
  if (viewer_.workspace().view.options.panels) viewer_.finish_measuring();
  viewer_.frame(frame_seconds);
}

namespace {

const std::map<std::string, document::StandardView> looks = {
    {"home", document::StandardView::home},    {"front", document::StandardView::front},
    {"back", document::StandardView::back},    {"left", document::StandardView::left},
    {"right", document::StandardView::right},  {"top", document::StandardView::top},
    {"bottom", document::StandardView::bottom}};

// Applies the options to the session's view settings. Without a session, starts from defaults for pictures.
document::ViewOptions view_of(const PictureOptions& options, const std::optional<files::Session>& session) {
  document::ViewOptions view =
      session ? session->view : document::ViewOptions{.panels = false, .hints = false};
  view.panels = options.panels;  // they show times, which differ from run to run
  view.hints = false;
  view.dark &= !options.light;
  view.cage = options.cage;
  view.wireframe |= options.wireframe;
  view.field = options.map.value_or(view.field);
  view.grid &= !options.no_grid;
  view.shading = options.shading.value_or(view.shading);
  return view;
}

// Shows one view per word. A word is a deformer, a method, or an interpolation ("log" or "linear"). All
// other settings come from the document.
void split(workspace::Workspace& w, const std::vector<std::string>& words) {
  if (words.empty()) return;
  std::vector<document::SideView> views;
  for (const std::string& word : words) {
    document::SideView view{w.document.deformer(), w.document.method(), w.view.options.field};
    if (const auto method = sym3::method_from_name(word)) view.method = *method;
    if (word == "log" || word == "linear")
      view.other_blending = (word == "linear") != w.document.timeline().linear;
    if (const auto preset = base::value_of_word<pose::Preset>(word))
      view.deformer = pose::deformer_of(*preset, w.document.deformer());
    views.push_back(std::move(view));
  }
  if (views[0].other_blending) {
    document::set_linear(w.document, w.playback.vectors, !w.document.timeline().linear);
    for (document::SideView& view : views) view.other_blending = !view.other_blending;
  }
  w.document.put_deformer(views[0].deformer);
  w.document.put_method(views[0].method);
  workspace::put_side_views(w.view.split, {.sides = {views.begin() + 1, views.end()}, .cameras = {}});
  w.view.camera.viewport = workspace::viewport_of(w.view.split, w.view.camera.viewport, 0);
}

// Sets the camera from --camera, --look or the session.
void aim(Viewer& viewer, bool has_camera, const PictureOptions& options) {
  viewer.frame(0);  // sets the viewport, which frame_all() needs
  if (!options.camera.empty()) {
    const auto camera = files::read_session(options.camera).camera;
    if (!camera)
      throw base::Error(options.camera.string(), "this session has no camera", "choose another session");
    return viewer.workspace().view.camera.set_pose(*camera);
  }
  const bool keeps_look = has_camera && options.look.empty();
  if (keeps_look && options.compare.empty()) return;
  workspace::Workspace& w = viewer.workspace();
  if (!keeps_look) w.view.camera.look(looks.at(options.look.empty() ? "home" : options.look));
  w.view.camera.animate(1);
  workspace::frame_all(w, false);
}

// If the picture does not show the requested map, prints a note. If a view has a problem, throws base::Error.
void print_missing(const workspace::Workspace& w) {
  if (workspace::shown_field(w) != w.view.options.field)
    print_notes(
        {"the map " + std::string(base::entry_of(w.view.options.field).word) +
         " is not available: some maps need a cage and a blend in log space, others a cage or probes, "
         "or a model with faces"});
  for (const workspace::SplitView& view : w.view.split.views)
    for (const std::string& problem : {view.problem, view.shown.problem})
      if (!problem.empty()) throw base::Error("", problem);
}

// Quotes a word for the shell.
std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

}  // namespace

std::unique_ptr<OffscreenViewer> viewer_of(const PictureOptions& options, files::Opened&& opened) {
  const std::optional<files::Session> session = opened.session;
  ViewerOptions viewer = options.viewer;
  if (session && session->window) viewer.size = *session->window;
  if (options.size.x > 0) viewer.size = options.size;
  const glm::dvec2 pixels = static_cast<double>(viewer.scale) * glm::dvec2(viewer.size);
  if (pixels.x * pixels.y > static_cast<double>(most_pixels))
    throw base::Error("picture", "it has more than 268 million pixels", "use a smaller --size or --scale");
  auto offscreen = std::make_unique<OffscreenViewer>(viewer);
  workspace::Workspace& w = offscreen->viewer().workspace();
  w.panels.has_user = false;
  workspace::apply_opened(w, std::move(opened));
  if (options.frame) {
    if (w.document.timeline().empty())
      throw base::Error("--frame", "the timeline has no keys, so all frames are equal",
                        "omit --frame, or set keys on the timeline and save the session");
    workspace::go_to_frame(w, *options.frame);
  }
  w.view.options = view_of(options, session);
  w.view.tools = false;
  split(w, options.compare);
  aim(offscreen->viewer(), session && session->camera, options);
  return offscreen;
}

void print_messages(const workspace::Workspace& w) {
  print_missing(w);
  for (const auto& message : w.messages.all()) {
    if (message.severity == workspace::Severity::error) throw base::Error("", message.text);
    print_notes({message.text});
  }
  print_notes(w.frame.notes);
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
  add_size_option(command, options.size);
  auto* scale = command.add_option("--scale", options.viewer.scale, "Device pixels per logical pixel");
  in_range(scale, 0.5, 4)->default_str("1");
  auto* look =
      command.add_option("--look", options.look, "View: home, front, back, left, right, top or bottom");
  one_of(look, {"home", "front", "back", "left", "right", "top", "bottom"})->default_str("home");
  add_file_option(command, "--camera", options.camera, "Session whose camera to use");
  add_choice<document::Shading>(command, "--shading",
                                "Shading: clay, porcelain, jade, file, checker, normals or zebra",
                                options.shading)
      ->default_str("file");
  command.add_flag("--show-cage", options.cage, "Draw the cage");
  command.add_flag("--panels", options.panels, "Draw the panels of the window");
  command.add_flag("--light", options.light, "Use the light theme");
  command.add_flag("--wireframe", options.wireframe, "Draw the edges of the mesh");
  add_choice<analysis::Field>(command, "--map", "Colour map, see 'viete help deformers'", options.map)
      ->default_str("none");
  std::vector<std::string> compared;
  for (const base::Choice& preset : choices(pose::Preset{})) compared.emplace_back(preset.word);
  for (const sym3::Method method : analysis::compared_methods) compared.emplace_back(sym3::name(method));
  compared.insert(compared.end(), {"log", "linear"});
  auto* compare = command.add_option("--compare", options.compare,
                                     "Show 2 to 4 deformers or methods side by side, or interpolation: "
                                     "log,linear");
  one_of(compare, compared)->delimiter(',')->expected(2, 4)->type_name("WORD,WORD");
  command.add_flag("--no-grid", options.no_grid, "Omit the ground grid");
}

namespace fs = std::filesystem;

std::string ffmpeg_command(const PictureRun& run) {
  const std::string pattern = base::NumberedName(fs::absolute(run.file)).pattern();
  const std::size_t first = pattern.rfind('/') + 1, begin = pattern.find('#', first),
                    end = pattern.find_last_of('#') + 1;
  std::string film = pattern.substr(0, begin), pictures;
  film.resize(std::max(film.find_last_not_of("_-. ") + 1, first));
  if (film.size() == first) film += "film";
  for (const char c : pattern) pictures += c == '%' ? "%%" : std::string(1, c);
  const auto place = pictures.rfind(pattern.substr(begin, end - begin));
  const std::string digits = "%0" + std::to_string(end - begin);
  pictures.replace(place, end - begin, digits + "d");
  // All players support 4:2:0, which needs an even width and height.
  return "ffmpeg -framerate " + base::formatted("%.9g", run.rate) + " -start_number " +
         std::to_string(run.frames.front()) + " -i " + shell_word(pictures) +
         " -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p " + shell_word(film + ".mp4");
}

std::vector<std::string> write_pictures(OffscreenViewer& offscreen, const PictureRun& run,
                                        base::Progress& progress) {
  const base::NumberedName name(run.file);
  files::check_frames_are_new(name, run.frames, run.force);
  offscreen.settle();
  Viewer& viewer = offscreen.viewer();
  workspace::Workspace& w = viewer.workspace();
  const document::CameraPose start = w.view.camera.pose();
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(run.frames.size());
    progress.report(share);
    w.view.camera.set_pose(start);
    if (!w.document.timeline().empty()) workspace::go_to_frame(w, run.frames[i]);
    if (run.turntable) {
      document::CameraPose camera = w.view.camera.pose();
      camera.yaw += static_cast<float>(2 * std::numbers::pi * share);
      w.view.camera.set_pose(camera);
    }
    // Panels and maps need several frames to be up to date.
    if (w.view.options.panels || w.view.options.field != analysis::Field::none)
      offscreen.settle();
    else
      viewer.frame(0);
    render::write_png(name.file(run.frames[i]), viewer.picture());
  }
  progress.report(1);
  return files::other_files_note(name, run.frames);
}

}  // namespace viete::app
