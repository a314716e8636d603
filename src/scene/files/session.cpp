#include "scene/files/session.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/encoding.h"
#include "base/error.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_cursor.h"
#include "mesh/surface.h"
#include "mesh/triangulation.h"
#include "scene/document/brush.h"
#include "scene/document/cage_editing.h"
#include "scene/document/elements.h"
#include "scene/document/range.h"
#include "scene/files/camera_json.h"
#include "scene/files/json_file.h"
#include "scene/files/pose_json.h"
#include "scene/files/session_parts.h"

namespace viete::scene {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr const char* format_name = "viete session";
constexpr std::uint32_t format_version = 1;

struct ViewFlag {
  const char* key;
  bool ViewOptions::*option;
};

constexpr ViewFlag view_flags[] = {
    {"dark", &ViewOptions::dark},           {"model", &ViewOptions::model},
    {"wireframe", &ViewOptions::wireframe}, {"cage", &ViewOptions::cage},
    {"grid", &ViewOptions::grid},           {"ghost", &ViewOptions::ghost},
    {"panels", &ViewOptions::panels},       {"hints", &ViewOptions::hints},
    {"deformed", &ViewOptions::deformed},   {"select_visible", &ViewOptions::select_visible},
    {"same_path", &ViewOptions::same_path}};

// Resolves links in the folder, so that ".." is correct; the file keeps its given name.
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
    json.fail("these are not 16 hexadecimal digits");
  return number;
}

ordered_json view_json(const ViewOptions& view) {
  ordered_json json;
  for (const auto& flag : view_flags) json[flag.key] = view.*flag.option;
  if (view.shading != Shading::file) json["shading"] = entry_of(view.shading).word;
  if (view.field != lab::Field::none) json["field"] = entry_of(view.field).word;
  return json;
}

ViewOptions view_of(const JsonReader& json, std::vector<std::string>& warnings) {
  ViewOptions view;
  (void)json.find("");  // reports a value that is not an object, once
  for (const auto& flag : view_flags) {
    take_part(json, flag.key, view.*flag.option, &JsonReader::boolean, "it stays as it is in a new window",
              warnings);
  }
  take_part(json, "shading", view.shading, choice_of<Shading>, "the shading From file is used", warnings);
  bool of_errors = false;  // as sessions said it once
  take_part(json, "error_map", of_errors, &JsonReader::boolean, "no map is shown", warnings);
  if (of_errors) view.field = lab::Field::exp_error;
  take_part(json, "field", view.field, choice_of<lab::Field>, "no map is shown", warnings);
  return view;
}

ordered_json side_json(const SideWay& side) {
  ordered_json json = {{"method", sym3::name(side.method)}};
  json.update(scheme_json(side.scheme));
  if (side.field != lab::Field::none) json["field"] = entry_of(side.field).word;
  if (side.other_blending) json["other_lines"] = true;
  return json;
}

SideWay side_of(const JsonReader& json, std::vector<std::string>& warnings) {
  SideWay side;
  const auto method = [](const JsonReader& v) { return word_of(v, sym3::method_from_name); };
  take_part(json, "method", side.method, method, "fast instead", warnings);
  side.scheme = scheme_of(json, warnings);
  take_part(json, "field", side.field, choice_of<lab::Field>, "no map is shown", warnings);
  take_part(json, "other_lines", side.other_blending, &JsonReader::boolean, "as in the first view", warnings);
  return side;
}

std::vector<SideWay> sides_of(const JsonReader& json, std::vector<std::string>& warnings) {
  if (json.size() > SideWays::most) json.fail("there are more than four views");
  std::vector<SideWay> sides;
  for (std::size_t i = 0; i < json.size(); ++i) sides.push_back(side_of(json.item(i), warnings));
  return sides;
}

std::vector<CameraPose> cameras_of(const JsonReader& json, std::size_t sides) {
  if (json.size() != sides) json.fail("their number differs from the number of additional views");
  std::vector<CameraPose> cameras;
  for (std::size_t i = 0; i < sides; ++i) cameras.push_back(camera_of(json.item(i)));
  return cameras;
}

// Content keys depend on the byte order; ignored on uncommon machines.
constexpr bool keys_are_common = std::endian::native == std::endian::little;

std::vector<std::uint32_t> selection_of(const JsonReader& json) {
  std::vector<std::uint32_t> indices = json.indices();
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

constexpr std::array kind_names = {"vertices", "edges", "faces", "probes"};

std::optional<ElementKind> kind_from_name(std::string_view name) {
  const auto found = std::find(kind_names.begin(), kind_names.end(), name);
  if (found == kind_names.end()) return std::nullopt;
  return static_cast<ElementKind>(found - kind_names.begin());
}

std::vector<NamedSet> sets_of(const JsonReader& json) {
  std::vector<NamedSet> sets;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const JsonReader set = json.item(i);
    const ElementKind kind = word_of(set.at("selecting"), kind_from_name);
    if (kind == ElementKind::probe)
      set.at("selecting").fail("a selection set contains vertices, edges or faces");
    sets.push_back({set.at("name").text(), kind, selection_of(set.at("vertices"))});
  }
  return sets;
}

std::vector<MaskRun> mask_of(const JsonReader& json) {
  std::vector<MaskRun> mask;
  for (std::size_t run = 0; run + 1 < json.size(); run += 2) {
    const MaskRun read{json.item(run).index(), json.item(run + 1).index()};
    if (read.share > mask_steps) json.item(run).fail("a share must be 0 to " + std::to_string(mask_steps));
    mask.push_back(read);
  }
  if (json.size() % 2) json.fail("a share lacks the number of its vertices");
  return mask;
}

glm::ivec2 window_of(const JsonReader& json) {
  const auto [width, height] = json.numbers<2>();
  if (!is_window(width, height)) json.fail("this is not a valid window size");
  return {static_cast<int>(width), static_cast<int>(height)};
}

void check_version(const JsonReader& json, const fs::path& file) {
  const auto format = json.find("format");
  if (!format || format->text() != format_name) {
    throw base::Error(file.string(), "this is not a session", "choose a session saved by Viete");
  }
  const auto version = json.at("version").index();
  if (version == format_version) return;
  json.at("version").fail("the session has version " + std::to_string(version) +
                              ", this version of Viete reads " + std::to_string(format_version),
                          "open it with the version that saved it");
}

ordered_json mask_json(const std::vector<MaskRun>& mask) {
  ordered_json runs = ordered_json::array();
  for (const auto& [share, vertices] : mask) {
    runs.push_back(share);
    runs.push_back(vertices);
  }
  return runs;
}

ordered_json sets_json(const std::vector<NamedSet>& sets) {
  ordered_json all = ordered_json::array();
  for (const NamedSet& set : sets)
    all.push_back({{"name", set.name},
                   {"selecting", kind_names[static_cast<std::size_t>(set.kind)]},
                   {"vertices", set.vertices}});
  return all;
}

// A cage without a file.
ordered_json cage_json(const OpenedSurface& cage) {
  const mesh::Surface& surface = *cage.surface;
  ordered_json polygons = ordered_json::array();
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    polygons.push_back(std::vector<std::uint32_t>(surface.corners.begin() + surface.polygon_starts[p],
                                                  surface.corners.begin() + surface.polygon_starts[p + 1]));
  }
  return {{"name", cage.made}, {"positions", surface.positions}, {"polygons", std::move(polygons)}};
}

OpenedSurface made_cage_of(const JsonReader& json) {
  mesh::Surface surface;
  const JsonReader positions = json.at("positions"), polygons = json.at("polygons");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const auto point = positions.point(v, largest_coordinate);
    if (!point) positions.item(v).fail("this is not an [x, y, z] position");
    surface.positions.push_back(*point);
  }
  surface.polygon_starts.push_back(0);
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const JsonReader polygon = polygons.item(p);
    if (polygon.size() < 3) polygon.fail("a polygon needs at least three corners");
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      surface.corners.push_back(polygon.item(c).index());
      if (surface.corners.back() >= surface.positions.size())
        polygon.item(c).fail("the cage has " + std::to_string(surface.positions.size()) + " vertices");
    }
    surface.polygon_starts.push_back(static_cast<std::uint32_t>(surface.corners.size()));
  }
  mesh::triangulate(surface);
  const auto name = json.find("name");
  return generated_surface(std::move(surface), name ? name->text() : "made here");
}

}  // namespace

std::string session_text(const Session& session, const fs::path& file, bool portable) {
  ordered_json json = {{"format", format_name}, {"version", format_version}};
  ShapeTable shapes;
  json["model"] = stored(session.model, file, portable);
  if (!session.cage.empty()) json["cage"] = stored(session.cage, file, portable);
  if (session.generated_cage) json["made_cage"] = cage_json(*session.generated_cage);
  if (keys_are_common && session.model_content != 0)
    json["model_content"] = hexadecimal(session.model_content);
  if (keys_are_common && session.cage_content != 0) json["cage_content"] = hexadecimal(session.cage_content);
  if (!portable && !session.origin.empty()) {
    json["session"] = stored(session.origin, file, false);
    if (session.origin_content) json["session_content"] = hexadecimal(*session.origin_content);
  }
  if (!portable && !session.first_edit.empty()) json["first_edit"] = session.first_edit;
  json["method"] = sym3::name(session.method);
  json.update(scheme_json(session.scheme));
  if (!session.mask.empty()) json["mask"] = mask_json(session.mask);
  if (!session.probes.empty()) json["probes"] = probes_json(session.probes);
  if (session.camera) json["camera"] = camera_json(*session.camera);
  json["view"] = view_json(session.view);
  for (const SideWay& side : session.sides.sides) json["views"].push_back(side_json(side));
  if (session.sides.wipe) json["wipe"] = session.sides.line;
  for (const CameraPose& camera : session.sides.cameras) json["cameras"].push_back(camera_json(camera));
  if (session.handling != Handling{}) json["hand"] = handling_json(session.handling);
  if (session.window) json["window"] = {session.window->x, session.window->y};
  json["selecting"] = kind_names[static_cast<std::size_t>(session.selecting)];
  json["selection"] = session.selection;
  if (!session.groups.sets.empty()) json["sets"] = sets_json(session.groups.sets);
  if (!session.groups.hidden.empty()) json["hidden"] = session.groups.hidden;
  if (session.pose) json["pose"] = pose_json(*session.pose);
  if (!session.library.poses.empty()) json["poses"] = library_json(session.library, shapes);
  if (session.library.unmixed) json["unmixed"] = whole_pose_json(*session.library.unmixed, shapes);
  if (session.timeline != Timeline{}) json["time"] = timeline_json(session.timeline, session.frame, shapes);
  if (session.shape) json["shape"] = shapes.number_of(session.shape);
  ordered_json all_shapes = shapes.json();
  if (!all_shapes.empty()) json["shapes"] = std::move(all_shapes);
  return readable(json, file);
}

namespace {

void read_settings(const JsonReader& json, const fs::path& folder, Session& s) {
  const auto take = [&](const char* key, auto& part, auto read, const char* instead) {
    take_part(json, key, part, read, instead, s.warnings);
  };
  const char *unknown = "it is unknown whether it has changed", *none = "there are none instead",
             *new_window = "as in a new window instead";
  const auto read_path = [&](const JsonReader& v) { return resolved(folder / v.path()); };
  const auto read_method = [](const JsonReader& v) { return word_of(v, sym3::method_from_name); };
  std::vector<SharedShape> shapes;
  const auto read_shapes = [&](const JsonReader& v) { return shapes_of(v, s.warnings); };
  const auto read_shape = [&](const JsonReader& v) { return shape_of(v, shapes); };
  const auto read_poses = [&](const JsonReader& v) { return library_of(v, shapes, s.warnings); };
  const auto read_pose = [&](const JsonReader& v) { return whole_pose_of(v, shapes, s.warnings); };
  const auto read_time = [&](const JsonReader& v) { return timeline_of(v, s.frame, shapes, s.warnings); };
  const auto read_camera = [](const JsonReader& v) { return camera_of(v); };
  const auto read_view = [&](const JsonReader& v) { return view_of(v, s.warnings); };
  const auto read_hand = [&](const JsonReader& v) { return handling_of(v, s.warnings); };
  take("session", s.origin, read_path, "saving asks for a name");
  take("session_content", s.origin_content, from_hexadecimal, unknown);
  take("first_edit", s.first_edit, &JsonReader::text, "it stays unknown");
  if (keys_are_common) take("model_content", s.model_content, from_hexadecimal, unknown);
  if (keys_are_common) take("cage_content", s.cage_content, from_hexadecimal, unknown);
  take("method", s.method, read_method, "fast instead (choices: diag, sd, improved_sd, fast)");
  s.scheme = scheme_of(json, s.warnings);
  take("mask", s.mask, mask_of, "every vertex follows the cage instead");
  bool all_probes = false;
  const auto read_probes = [&](const JsonReader& v) {
    auto probes = probes_of(v, s.warnings);
    all_probes = probes.all.size() == v.at("all").size();
    return probes;
  };
  take("probes", s.probes, read_probes, none);
  take("sets", s.groups.sets, sets_of, none);
  take("hidden", s.groups.hidden, selection_of, "all of the cage is shown instead");
  take("shapes", shapes, read_shapes, none);
  take("shape", s.shape, read_shape, "the model is at rest instead");
  take("poses", s.library, read_poses, none);
  take("unmixed", s.library.unmixed, read_pose, "it is recomputed from the weights");
  take("time", s.timeline, read_time, "there are no keys instead");
  take("camera", s.camera, read_camera, "the whole model is shown instead");
  take("view", s.view, read_view, new_window);
  const auto read_sides = [&](const JsonReader& v) { return sides_of(v, s.warnings); };
  const auto read_line = [](const JsonReader& v) {
    return v.number(SideWays::least_part, 1 - SideWays::least_part);
  };
  take("views", s.sides.sides, read_sides, "there is one view instead");
  s.sides.wipe = json.find("wipe").has_value();
  take("wipe", s.sides.line, read_line, "it is in the middle instead");
  const auto read_cameras = [&](const JsonReader& v) { return cameras_of(v, s.sides.sides.size()); };
  take("cameras", s.sides.cameras, read_cameras, "all views have the first one's instead");
  take("hand", s.handling, read_hand, new_window);
  take("window", s.window, window_of, "the usual size instead");
  std::optional<ElementKind> kind = ElementKind::vertex;
  const auto read_kind = [&](const JsonReader& v) {
    kind.reset();  // an unknown kind selects nothing
    return word_of(v, kind_from_name);
  };
  take("selecting", kind, read_kind, "nothing is selected");
  if (!kind) return;
  s.selecting = *kind;
  if (*kind == ElementKind::probe && !all_probes) return;  // the indices of others have changed
  take("selection", s.selection, selection_of, "nothing is selected");
}

}  // namespace

Session read_session(const fs::path& file) {
  const nlohmann::json whole = read_json(file);
  const JsonReader json(whole, file.string());
  check_version(json, file);
  const fs::path folder = resolved(file).parent_path();
  Session session;
  session.model = resolved(folder / json.at("model").path());
  if (const auto v = json.find("cage")) session.cage = resolved(folder / v->path());
  if (const auto v = json.find("made_cage"); v && session.cage.empty())
    session.generated_cage = made_cage_of(*v);
  if (const auto v = json.find("pose")) session.pose = pose_of(*v, session.warnings);
  read_settings(json, folder, session);
  return session;
}

// Removes nonexistent elements from the ascending list.
void fit_selection(Session& session, const Document& document, const fs::path& file) {
  const std::size_t count = element_count(document, session.selecting);
  if (session.selection.empty() || session.selection.back() < count) return;
  const std::string last = std::to_string(session.selection.back());
  const std::string where = session.selecting == ElementKind::probe
                                ? "it has "
                                : "the cage " + place_of(document.cage_file) + " has ";
  session.warnings.emplace_back(base::Error(file.string() + ": selection",
                                            element_name(session.selecting) + ' ' + last + " is selected, " +
                                                where + counted(session.selecting, count),
                                            "nothing is selected instead")
                                    .what());
  session.selection.clear();
}

CageGroups fit_groups(Session& session, const Document& document, const fs::path& file) {
  const std::size_t count = element_count(document, ElementKind::vertex);
  const auto fits = [&](const std::vector<std::uint32_t>& vertices) {
    return vertices.empty() || vertices.back() < count;
  };
  CageGroups groups = std::move(session.groups);
  std::erase_if(groups.sets, [&](const NamedSet& set) {
    if (fits(set.vertices)) return false;
    session.warnings.push_back(file.string() + ": sets: \"" + set.name + "\" is of vertex " +
                               std::to_string(set.vertices.back()) + ", the cage has " +
                               counted(ElementKind::vertex, count) + "; this set is dropped");
    return true;
  });
  if (!fits(groups.hidden)) {
    session.warnings.push_back(file.string() +
                               ": hidden: there are no such vertices; all of the cage is shown");
    groups.hidden.clear();
  }
  return groups;
}

void warn_of_changes(Session& session, const Document& document, const fs::path& file) {
  const auto tell = [&](const char* key, std::uint64_t then, const OpenedSurface& now, const char* advice) {
    if (then == 0 || now.content == 0 || then == now.content) return;
    session.warnings.emplace_back(base::Error(file.string() + ": " + key,
                                              place_of(now) + " has changed since the session was saved",
                                              advice)
                                      .what());
  };
  tell("model", session.model_content, document.model, "if the result looks wrong, restore the older file");
  tell("cage", session.cage_content, document.cage_file,
       "the pose may not match it: if the result looks wrong, restore the older file");
}

void fit_to_cage(Session& session, const deform::Cage& cage, const fs::path& file) {
  if (!session.pose) return;
  const bool same = session.cage_content != 0 && session.cage_content == mesh::content_key(cage.surface);
  const std::string advice = same
                                 ? "the session is damaged: use an older copy"
                                 : "the cage has changed since the session was saved: restore the older file";
  auto& [positions, turns] = *session.pose;
  const auto& rest = cage.surface.positions;
  if (positions.size() != rest.size()) {
    throw base::Error(
        file.string() + ": pose.positions",
        "this is a pose of " + counted(ElementKind::vertex, positions.size()) + ", the cage " +
            (session.generated_cage ? place_of(*session.generated_cage) : session.cage.string()) + " has " +
            std::to_string(rest.size()),
        advice);
  }
  if (turns.size() > cage.roots.size()) {
    throw base::Error(file.string() + ": pose.turns",
                      "there are more than the " + std::to_string(cage.roots.size()) + " parts of the cage",
                      advice);
  }
  for (std::size_t v = 0; v < rest.size(); ++v) {
    if (std::isnan(positions[v][0])) positions[v] = rest[v];
  }
}

void fit_pins(Session& session, const mesh::Surface& model, const fs::path& file) {
  auto& all = session.probes.all;
  const auto is_lost = [&](const deform::Probe& p) {
    return p.pin && p.pin->vertex >= model.positions.size();
  };
  for (deform::Probe& probe : all)
    if (probe.pin && !is_lost(probe)) probe.place = model.positions[probe.pin->vertex];
  if (std::ranges::none_of(all, is_lost)) return;
  session.warnings.push_back(
      file.string() +
      ": probes: pins refer to vertices that the model does not have; all probes are dropped");
  session.probes = {};
  if (session.selecting == ElementKind::probe) session.selection.clear();
}

SharedShape fit_shape(Session& session, const mesh::Surface& model, const fs::path& file) {
  if (!session.shape || session.shape->size() == model.positions.size()) return session.shape;
  session.warnings.push_back(file.string() + ": shape: it is of " +
                             counted(ElementKind::vertex, session.shape->size()) + ", the model has " +
                             std::to_string(model.positions.size()) + "; the model is at rest instead");
  return nullptr;
}

deform::Mask fit_to_model(Session& session, const mesh::Surface& model, const fs::path& file) {
  if (session.mask.empty()) return nullptr;
  std::uint64_t shares = 0;
  for (const MaskRun& run : session.mask) shares += run.vertices;
  if (shares != model.positions.size()) {
    session.warnings.push_back(file.string() + ": mask: it is of " + counted(ElementKind::vertex, shares) +
                               ", the model has " + std::to_string(model.positions.size()) +
                               "; every vertex follows the cage instead");
    return nullptr;
  }
  std::vector<float> mask;
  mask.reserve(model.positions.size());
  for (const MaskRun& run : session.mask)
    mask.insert(mask.end(), run.vertices, static_cast<float>(run.share) / mask_steps);
  return std::make_shared<const std::vector<float>>(std::move(mask));
}

bool is_session(const fs::path& file) {
  return mesh::extension_of(file) == session_extension + 1;
}

std::vector<MaskRun> runs_of(const deform::Mask& mask) {
  std::vector<MaskRun> runs;
  if (!mask) return runs;
  for (const float s : *mask) {
    const auto share = static_cast<std::uint32_t>(std::lround(s * mask_steps));
    if (runs.empty() || runs.back().share != share) runs.push_back({share, 0});
    ++runs.back().vertices;
  }
  return runs;
}

std::uint64_t content_of_bytes(std::string_view bytes) {
  base::Checksum sum;
  sum.add(bytes.data(), bytes.size());
  return sum.value();
}

std::optional<std::uint64_t> content_of(const fs::path& file) {
  try {
    return content_of_bytes(mesh::FileBytes(file, nullptr).view());
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace viete::scene
