#include "scene/session.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "mesh/source.h"
#include "scene/elements.h"
#include "scene/json_file.h"

namespace viete::scene {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr const char* format_name = "viete session";
constexpr std::uint32_t newest_version = 1;
constexpr double largest_coordinate = 1e100;  // as in mesh::read

struct ViewFlag {
  const char* key;
  bool ViewOptions::*option;
};

constexpr ViewFlag view_flags[] = {{"dark", &ViewOptions::dark},           {"model", &ViewOptions::model},
                                   {"wireframe", &ViewOptions::wireframe}, {"cage", &ViewOptions::cage},
                                   {"grid", &ViewOptions::grid},           {"ghost", &ViewOptions::ghost},
                                   {"error_map", &ViewOptions::error_map}, {"panels", &ViewOptions::panels},
                                   {"hints", &ViewOptions::hints}};

// Links in the folder are resolved, so that ".." leads where it should; the file keeps the name it was given.
fs::path resolved(const fs::path& path) {
  std::error_code code;
  const fs::path absolute = fs::absolute(path, code);
  const fs::path folder = fs::weakly_canonical(absolute.parent_path(), code);
  return code ? absolute : folder / absolute.filename();
}

ordered_json stored(const fs::path& path, const fs::path& file, bool portable) {
  const fs::path target = resolved(path);
  const fs::path relative = portable ? target.lexically_relative(resolved(file).parent_path()) : fs::path();
  return path_json(relative.empty() ? target : relative);
}

// 0.3f as 0.3, not as 0.30000001192092896, where that gives the same float back.
double tidy(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double shortest = 0;
  std::from_chars(text, end, shortest);
  return static_cast<float>(shortest) == value ? shortest : value;
}

std::string hexadecimal(std::uint64_t number) {
  char text[16];
  const auto end = std::to_chars(text, text + sizeof text, number, 16).ptr;
  return std::string(16 - static_cast<std::size_t>(end - text), '0') + std::string(text, end);
}

std::uint64_t from_hexadecimal(const JsonReader& json) {
  const std::string text = json.text();
  const char* const end = text.data() + text.size();
  std::uint64_t number = 0;
  if (text.size() != 16 || std::from_chars(text.data(), end, number, 16).ptr != end)
    json.expected("16 digits");
  return number;
}

ordered_json camera_json(const CameraPose& c) {
  return {{"target", {tidy(c.target.x), tidy(c.target.y), tidy(c.target.z)}},
          {"distance", tidy(c.distance)},
          {"yaw", tidy(c.yaw)},
          {"pitch", tidy(c.pitch)},
          {"orthographic", c.orthographic}};
}

ordered_json view_json(const ViewOptions& view) {
  ordered_json json;
  for (const auto& flag : view_flags) json[flag.key] = view.*flag.option;
  return json;
}

CameraPose camera_of(const JsonReader& json) {
  const auto target = json.at("target").numbers<3>();
  const double distance = json.at("distance").number();
  if (!(distance > 0)) json.at("distance").fail("a camera needs a distance greater than 0");
  CameraPose pose;
  pose.target = {static_cast<float>(target[0]), static_cast<float>(target[1]), static_cast<float>(target[2])};
  pose.distance = static_cast<float>(std::clamp(distance, 1e-3, 1e3));
  const double yaw = json.at("yaw").number();
  pose.yaw = static_cast<float>(std::abs(yaw) < 4 ? yaw : std::remainder(yaw, 6.283185307179586));
  pose.pitch = std::clamp(static_cast<float>(json.at("pitch").number()), -1.57079633f, 1.57079633f);
  if (const auto v = json.find("orthographic")) pose.orthographic = v->boolean();
  return pose;
}

ViewOptions view_of(const JsonReader& json) {
  ViewOptions view;
  for (const auto& flag : view_flags) {
    if (const auto value = json.find(flag.key)) view.*flag.option = value->boolean();
  }
  return view;
}

std::vector<mesh::Point> points_of(const JsonReader& json, double limit) {
  std::vector<mesh::Point> points(json.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = json.item(i).numbers<3>();
    for (const double x : points[i]) {
      if (!(std::abs(x) <= limit)) json.item(i).fail("a number is too large");
    }
  }
  return points;
}

deform::Pose pose_of(const JsonReader& json) {
  deform::Pose pose{points_of(json.at("positions"), largest_coordinate), {}};
  if (const auto turns = json.find("turns")) pose.turns = points_of(*turns, 1e6);
  return pose;
}

std::vector<std::uint32_t> selection_of(const JsonReader& json) {
  std::vector<std::uint32_t> indices(json.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = json.item(i).index();
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

constexpr std::array kind_names = {"vertices", "edges", "faces"};

std::optional<ElementKind> kind_from_name(std::string_view name) {
  const auto found = std::find(kind_names.begin(), kind_names.end(), name);
  if (found == kind_names.end()) return std::nullopt;
  return static_cast<ElementKind>(found - kind_names.begin());
}

template <class Parse>
auto word_of(const JsonReader& json, Parse parse, const char* known) {
  const auto value = parse(json.text());
  if (!value) json.fail("\"" + json.text() + "\" is not known", std::string("use ") + known);
  return *value;
}

double reach_of(const JsonReader& json) {
  const double reach = json.number();
  if (!(reach >= deform::lowest_reach)) {
    json.fail("a reach must be " + deform::text_of_reach(deform::lowest_reach) + " or more",
              "leave it out for the whole cage");
  }
  return reach;
}

bool is_window(const glm::dvec2& size) {
  return size.x >= 16 && size.y >= 16 && size.x <= 8192 && size.y <= 8192;
}

glm::ivec2 window_of(const JsonReader& json) {
  const auto [width, height] = json.numbers<2>();
  if (!is_window({width, height})) json.fail("each side must be 16 to 8192");
  return {static_cast<int>(width), static_cast<int>(height)};
}

void check_version(const JsonReader& json, const fs::path& file) {
  const auto format = json.find("format");
  if (!format || format->text() != format_name) {
    throw base::Error(file.string(), "this is not a session", "choose a file that this program has saved");
  }
  const auto version = json.at("version").index();
  if (version >= 1 && version <= newest_version) return;
  json.at("version").fail(
      "the session has version " + std::to_string(version) + ", this program reads 1 to " +
          std::to_string(newest_version),
      version > newest_version ? "open it with a newer program" : "save the session again");
}

}  // namespace

Session session_of(const Workspace& w) {
  Session session;
  session.model = w.document.model.path;
  session.cage = w.document.cage_file.path;
  session.origin = w.saved.session;
  session.origin_content = w.saved.content;
  session.method = w.document.method;
  session.coordinates = w.document.coordinates;
  session.reach = w.document.reach;
  session.camera = w.camera.destination();
  session.view = w.view;
  if (is_window(w.viewport.window)) session.window = glm::ivec2(w.viewport.window);
  session.selecting = w.document.selection.kind();
  session.selection = w.document.selection.indices();
  if (w.document.has_cage()) session.pose = w.document.pose;
  return session;
}

std::string session_text(const Session& session, const fs::path& file, bool portable) {
  ordered_json json = {{"format", format_name}, {"version", newest_version}};
  json["model"] = stored(session.model, file, portable);
  if (!session.cage.empty()) json["cage"] = stored(session.cage, file, portable);
  if (!portable && !session.origin.empty()) {
    json["session"] = stored(session.origin, file, false);
    if (session.origin_content) json["session_content"] = hexadecimal(*session.origin_content);
  }
  json["method"] = sym3::name(session.method);
  json["coordinates"] = deform::name(session.coordinates);
  if (session.reach < deform::whole_cage) json["reach"] = session.reach;
  if (session.camera) json["camera"] = camera_json(*session.camera);
  json["view"] = view_json(session.view);
  if (session.window) json["window"] = {session.window->x, session.window->y};
  json["selecting"] = kind_names[static_cast<std::size_t>(session.selecting)];
  json["selection"] = session.selection;
  if (session.pose) json["pose"] = {{"turns", session.pose->turns}, {"positions", session.pose->positions}};
  return readable(json, file);
}

Session read_session(const fs::path& file) {
  const nlohmann::json whole = read_json(file);
  const JsonReader json(whole, file.string());
  check_version(json, file);
  const fs::path folder = resolved(file).parent_path();
  Session session;
  session.model = resolved(folder / json.at("model").path());
  if (const auto v = json.find("cage")) session.cage = resolved(folder / v->path());
  if (const auto v = json.find("session")) session.origin = resolved(folder / v->path());
  if (const auto v = json.find("session_content")) session.origin_content = from_hexadecimal(*v);
  if (const auto v = json.find("method"))
    session.method = word_of(*v, sym3::method_from_name, "diag, sd, improved_sd or fast");
  if (const auto v = json.find("coordinates"))
    session.coordinates = word_of(*v, deform::coordinates_from_name, "face or mvc");
  if (const auto v = json.find("reach")) session.reach = reach_of(*v);
  if (const auto v = json.find("camera")) session.camera = camera_of(*v);
  if (const auto v = json.find("view")) session.view = view_of(*v);
  if (const auto v = json.find("window")) session.window = window_of(*v);
  if (const auto v = json.find("selecting"))
    session.selecting = word_of(*v, kind_from_name, "vertices, edges or faces");
  if (const auto v = json.find("selection")) session.selection = selection_of(*v);
  if (const auto v = json.find("pose")) session.pose = pose_of(*v);
  return session;
}

void check_fits(const Session& session, const deform::Cage& cage, const fs::path& file) {
  const std::size_t vertices = cage.surface.positions.size();
  const std::string advice = "the cage has changed since the session was saved: bring back the older one";
  const std::string has = ", the cage " + session.cage.string() + " has " + std::to_string(vertices);
  if (session.pose && session.pose->positions.size() != vertices) {
    throw base::Error(file.string() + ": pose.positions",
                      "there are " + std::to_string(session.pose->positions.size()) + " vertices" + has,
                      advice);
  }
  if (session.pose && session.pose->turns.size() > cage.roots.size()) {
    throw base::Error(file.string() + ": pose.turns",
                      "there are more than the " + std::to_string(cage.roots.size()) + " parts of the cage",
                      advice);
  }
  if (!session.selection.empty() && session.selection.back() >= element_count(cage, session.selecting)) {
    const std::string last = std::to_string(session.selection.back());
    const std::string one = session.selecting == ElementKind::vertex ? "vertex "
                            : session.selecting == ElementKind::edge ? "edge "
                                                                     : "face ";
    throw base::Error(file.string() + ": selection", one + last + " is selected" + has + " vertices", advice);
  }
}

bool is_session(const fs::path& file) {
  return mesh::extension_of(file) == "viete";
}

}  // namespace viete::scene
