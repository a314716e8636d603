#include "files/session.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/encoding.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"
#include "document/brush.h"
#include "document/elements.h"
#include "document/pose_edit.h"
#include "document/probes.h"
#include "document/range.h"
#include "files/json_codec.h"
#include "mesh/surface.h"
#include "mesh/triangulation.h"

namespace viete::files {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr const char* format_name = "viete session";
constexpr std::uint32_t format_version = 1;

constexpr Limits frames{document::Timeline::least_frame, document::Timeline::largest_frame},
    mix_weights = percent(document::PoseLibrary::least_weight, document::PoseLibrary::largest_weight);
constexpr std::size_t most_sets = 10'000;

struct ViewFlag {
  const char* key;
  bool document::ViewOptions::*option;
};

constexpr ViewFlag view_flags[] = {{"dark", &document::ViewOptions::dark},
                                   {"model", &document::ViewOptions::model},
                                   {"wireframe", &document::ViewOptions::wireframe},
                                   {"cage", &document::ViewOptions::cage},
                                   {"grid", &document::ViewOptions::grid},
                                   {"ghost", &document::ViewOptions::ghost},
                                   {"panels", &document::ViewOptions::panels},
                                   {"hints", &document::ViewOptions::hints},
                                   {"deformed", &document::ViewOptions::deformed},
                                   {"select_visible", &document::ViewOptions::select_visible}};

constexpr std::array<std::string_view, 4> kind_words = {"vertices", "edges", "faces", "probes"};
constexpr std::array<std::string_view, 3> axis_words = {"y", "z", "-y"};
constexpr std::array<std::string_view, 2> pin_words = {"holds", "pulls"};

}  // namespace

// The functions code() are not in the unnamed namespace, because templates find them by argument-dependent
// lookup. Lengths and coordinates are in the model's unit. Rotations are rotation vectors in radians.

static void code(const JsonField& f, sym3::Method& method) {
  code_word(f, method, sym3::name(method), sym3::method_from_name);
}
static void code(const JsonField& f, document::ElementKind& kind) {
  code_listed(f, kind, kind_words);
}

// Lengths of a camera are in view units: the model's diagonal is 2.
static void code(const JsonField& f, document::CameraPose& camera) {
  f.needed("target", camera.target, Reach{document::farthest_place});
  f.needed("distance", camera.distance, Limits{document::nearest_camera, document::farthest_camera});
  f.needed("yaw", camera.yaw, Limits{-1e6, 1e6});
  f.needed("pitch", camera.pitch, Limits{-1.6, 1.6});  // a quarter turn plus rounding
  f.member("orthographic", camera.orthographic);
  const auto up = f.reads() || camera.up != document::UpAxis::y ? f.child("up") : std::nullopt;
  if (up) code_listed(*up, camera.up, axis_words);
}

// Reads or writes members of the enclosing object. A missing `weights` or `blend` gets a default.
static void code(const JsonField& f, pose::Deformer& deformer) {
  pose::PartialChoice choice;
  if (!f.reads()) choice = {deformer.weighting.weights, deformer.blend};
  f.member("weights", choice.weights);
  f.member("blend", choice.blend);
  if (f.reads()) {
    try {
      deformer = pose::complete(choice);
    } catch (const base::Error& error) {
      f.in().at("blend").fail(error.problem());
    }
  }
  f.unless(0, "iterations", deformer.iterations, Limits{1, pose::most_iterations});
  pose::Deformer usual;
  for (const pose::NumberEntry& number : pose::all_numbers())
    f.unless(number.of(usual), number.word.data(), number.of(deformer),
             percent(number.least, number.largest));
  if (!f.reads()) return;
  if (const auto reason = pose::conflict(deformer)) f.in().at("iterations").fail(std::string(*reason));
}

static void code(const JsonField& f, document::ViewOptions& view) {
  for (const auto& flag : view_flags) f.member(flag.key, view.*flag.option);
  f.unless(document::Shading::file, "shading", view.shading);
  f.unless(analysis::Field::none, "field", view.field);
}

static void code(const JsonField& f, document::SideView& side) {
  f.member("method", side.method);
  code(f, side.deformer);
  f.unless(analysis::Field::none, "field", side.field);
  f.unless(false, "other_lines", side.other_blending);
}

// If "cameras" is missing, all views share one camera.
static void code(const JsonField& f, document::SideViews& sides) {
  f.unless({}, "views", sides.sides, document::SideViews::most);
  f.unless({}, "cameras", sides.cameras, document::SideViews::most);
  if (f.reads() && !sides.cameras.empty() && sides.cameras.size() != sides.sides.size())
    f.in().at("cameras").fail("there must be one camera for each additional view");
}

static void code(const JsonField& f, document::Handling& handling) {
  const document::Handling usual;
  document::SoftSelection& soft = handling.soft;
  f.unless(usual.pivot, "pivot", handling.pivot);
  f.unless(usual.point, "point", handling.point, Reach{mesh::largest_coordinate});
  f.unless(usual.axes, "axes", handling.axes);
  f.unless(usual.mirror, "mirror", handling.mirror);
  f.unless(usual.soft.on, "soft", soft.on);
  f.unless(usual.soft.radius, "radius", soft.radius,
           percent(document::SoftSelection::least_radius, document::SoftSelection::largest_radius));
  f.unless(usual.soft.curve, "curve", soft.curve);
  f.unless(usual.soft.distance, "distance", soft.distance);
  f.unless(usual.freedom, "freedom", handling.freedom, percent(0, 1));
}

// Reads or writes members of the enclosing object. "stretched" is the matrix logarithm of the stretch.
static void code(const JsonField& f, pose::ProbePose& pose) {
  f.unless({}, "turned", pose.turn, Reach{document::largest_turn});
  if (f.reads() ? f.in().find("stretched").has_value() : pose.stretch != sym3::Sym3<double>{}) {
    const JsonField stretched = *f.child("stretched");
    if (f.reads()) {
      const auto x = stretched.in().numbers<6>();
      pose.stretch = {x[0], x[1], x[2], x[3], x[4], x[5]};
    } else {
      const auto& [xx, xy, xz, yy, yz, zz] = pose.stretch;
      stretched.out() = {xx, xy, xz, yy, yz, zz};
    }
  }
  f.unless({}, "moved", pose.move, Reach{document::most_drawn});
  if (f.reads() && !in_range(document::WholePose{{}, {pose}}))
    f.in().fail("the motion of this probe is too large");
}

static void code(const JsonField& f, pose::Influence& influence) {
  f.needed("falloff", influence.falloff);
  f.needed("radius", influence.radius, Limits{0, document::most_drawn});
  if (!(influence.radius > 0)) f.in().at("radius").fail("the radius must be above 0");
}

static void code(const JsonField& f, pose::Probe& probe) {
  f.needed("place", probe.place, Reach{document::most_drawn});
  f.needed("rotation", probe.turn);
  f.needed("stretch", probe.stretch);
  f.needed("move", probe.move);
  f.unless(false, "locked", probe.locked);
  if (f.reads() && f.in().find("pin")) probe.pin.emplace();
  if (probe.pin) {
    code_listed(*f.child("pin"), probe.pin->pulls, pin_words);
    f.needed("vertex", probe.pin->vertex);
  }
  code(f, probe.pose);
}

static void code(const JsonField& f, pose::Probes& probes) {
  f.member("mix", probes.mix);
  f.needed("all", probes.all, document::most_probes);
}

// The file has pairs [share, count, ...]: the next `count` vertices have the mask value share / mask_steps.
static void code(const JsonField& f, weights::Mask& mask) {
  if (!f.reads()) {
    std::uint32_t share = 0, count = 0;
    const auto put_run = [&] {
      if (count > 0) f.out().insert(f.out().end(), {share, count});
    };
    f.out() = ordered_json::array();
    for (const float s : *mask) {
      const auto now = static_cast<std::uint32_t>(std::lround(s * document::mask_steps));
      if (now != share) {
        put_run();
        share = now;
        count = 0;
      }
      ++count;
    }
    return put_run();
  }
  constexpr std::size_t most = 1 << 27;
  if (f.in().size() % 2) f.in().fail("the number of vertices is missing after the last share");
  std::vector<float> shares;
  for (std::size_t run = 0; run < f.in().size(); run += 2) {
    const JsonReader share = f.in().item(run), count = f.in().item(run + 1);
    if (share.index() > document::mask_steps)
      share.fail("a share must be 0 to " + std::to_string(document::mask_steps));
    if (shares.size() + count.index() > most)
      count.fail("the mask has more than " + std::to_string(most) + " vertices");
    shares.insert(shares.end(), count.index(), static_cast<float>(share.index()) / document::mask_steps);
  }
  mask = std::make_shared<const std::vector<float>>(std::move(shares));
}

static void code(const JsonField& f, document::NamedSet& set) {
  f.needed("name", set.name);
  f.needed("selecting", set.kind);
  f.needed("vertices", set.vertices);
  if (set.kind == document::ElementKind::probe)
    f.in().at("selecting").fail("a selection set must contain vertices, edges or faces");
}

// "turns" has one rotation vector for each part of the cage.
static void code(const JsonField& f, pose::Pose& pose) {
  f.unless({}, "turns", pose.turns, Reach{document::largest_turn});
  f.unless({}, "positions", pose.positions, Reach{mesh::largest_coordinate});
}

// Reads or writes members of the enclosing object. After reading, the pose is not null.
static void code(const JsonField& f, document::SharedPose& pose) {
  document::WholePose whole;
  if (pose) whole = *pose;
  f.unless(nullptr, "shape", whole.shape);
  code(f, whole.cage);
  f.unless({}, "probes", whole.probes, document::most_probes);
  pose = std::make_shared<const document::WholePose>(std::move(whole));
}

static void code(const JsonField& f, document::NamedPose& named) {
  f.needed("name", named.name);
  if (named.name.size() > document::PoseLibrary::longest_name)
    f.in().at("name").fail("the name has more than " + std::to_string(document::PoseLibrary::longest_name) +
                           " bytes");
  f.unless(0, "weight", named.weight, mix_weights);
  code(f, named.pose);
}

static void code(const JsonField& f, document::MixedPose& mixed) {
  f.needed("name", mixed.name);
  f.needed("weight", mixed.weight, mix_weights);
}

static void code(const JsonField& f, document::PoseKey& key) {
  f.needed("frame", key.frame, frames);
  f.unless(document::Easing::smooth, "easing", key.easing);
  f.unless({}, "mix", key.mix, document::PoseLibrary::most_poses);
  code(f, key.pose);
}

static void code(const JsonField& f, document::CameraKey& key) {
  f.needed("frame", key.frame, frames);
  code(f, key.camera);
}

// The weight is not in percent, so that reading gives exactly the same weight.
static void code(const JsonField& f, document::WeightKey& key) {
  f.needed("frame", key.frame, frames);
  f.needed("weight", key.weight,
           Limits{-document::Channel::largest_weight, document::Channel::largest_weight});
  f.unless(document::Easing::smooth, "easing", key.easing);
}

template <class Keys>
static void check_order(const JsonField& f, const char* key, const Keys& keys) {
  const auto not_later = [](const auto& a, const auto& b) { return a.frame >= b.frame; };
  if (std::ranges::adjacent_find(keys, not_later) != keys.end())
    f.in().at(key).fail("the keys must be sorted by frame, with one key per frame");
}

static void code(const JsonField& f, document::Channel& channel) {
  f.needed("pose", channel.name);
  f.needed("keys", channel.keys, document::Timeline::most_keys);
  if (channel.keys.empty()) f.in().at("keys").fail("there must be a key");
  check_order(f, "keys", channel.keys);
}

static void code(const JsonField& f, document::Timeline& t) {
  f.member("first", t.first, frames);
  f.member("last", t.last, frames);
  f.member("rate", t.rate, Limits{document::Timeline::least_rate, document::Timeline::largest_rate});
  f.member("repeat", t.repeat);
  f.unless(false, "linear", t.linear);
  f.unless({}, "keys", t.keys, document::Timeline::most_keys);
  f.unless({}, "unkeyed", t.unkeyed, document::Timeline::most_keys);
  f.unless({}, "cameras", t.cameras, document::Timeline::most_keys);
  f.unless({}, "weights", t.channels, document::PoseLibrary::most_poses);
  if (t.first >= t.last) f.in().fail("the last frame must be after the first frame");
  check_order(f, "keys", t.keys);
  check_order(f, "cameras", t.cameras);
}

// A cage without a file. "polygons" has the vertex indices of each polygon, counted from 0.
static void code(const JsonField& f, document::OpenedSurface& cage) {
  mesh::Surface surface;
  if (!f.reads()) surface = *cage.surface;
  f.member("name", cage.made);
  f.needed("positions", surface.positions, Reach{mesh::largest_coordinate});
  const JsonField polygons = *f.child("polygons", true);
  if (!f.reads()) polygons.list(0, 0);
  const auto& starts = surface.polygon_starts;
  for (std::size_t p = 0; !f.reads() && p < surface.polygon_count(); ++p)
    polygons.out().push_back(
        std::vector(surface.corners.begin() + starts[p], surface.corners.begin() + starts[p + 1]));
  if (!f.reads()) return;
  surface.polygon_starts.push_back(0);
  for (std::size_t p = 0; p < polygons.in().size(); ++p) {
    const JsonReader polygon = polygons.in().item(p);
    if (polygon.size() < 3) polygon.fail("a polygon needs at least three corners");
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      surface.corners.push_back(polygon.item(c).index());
      if (surface.corners.back() >= surface.positions.size())
        polygon.item(c).fail("the cage has only " + std::to_string(surface.positions.size()) +
                             " vertices, counted from 0");
    }
    surface.polygon_starts.push_back(static_cast<std::uint32_t>(surface.corners.size()));
  }
  mesh::triangulate(surface);
  cage = document::generated_surface(std::move(surface), cage.made.empty() ? "made here" : cage.made);
}

namespace {

// Resolves symbolic links in the folder, so that ".." is the real parent folder. Keeps the file name.
fs::path resolved(const fs::path& path) {
  std::error_code code;
  const fs::path absolute = fs::absolute(path, code);
  const fs::path folder = fs::weakly_canonical(absolute.parent_path(), code);
  return code ? absolute : folder / absolute.filename();
}

// The folder of a session, and whether file names are relative to this folder.
struct Place {
  fs::path folder;
  bool relative;

  fs::path name_of(const fs::path& file) const {
    const fs::path target = resolved(file);
    const fs::path name = relative ? target.lexically_relative(folder) : fs::path();
    return name.empty() ? target : name;
  }
};

// When reading, a missing key leaves `file` unchanged. When writing, an empty `file` is not written.
void code_path(const JsonField& f, const char* key, fs::path& file, const Place& place) {
  if (f.reads()) {
    if (const auto name = f.in().find(key)) file = resolved(place.folder / name->path());
  } else if (!file.empty()) {
    f.out()[key] = path_json(place.name_of(file));
  }
}

// Checksums depend on the byte order. Only little-endian machines read and write checksums.
constexpr bool has_checksums = std::endian::native == std::endian::little;

// Each channel must have its own named pose.
void check_channels(const JsonReader& time, const document::DocumentState& state) {
  const auto& channels = state.timeline.channels;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string& name = channels[i].name;
    const bool exists =
        !name.empty() && std::ranges::count(state.library.poses, name, &document::NamedPose::name) > 0;
    if (exists && channel_of(state.timeline, name) == &channels[i]) continue;
    const char* problem = exists ? "there are already keys for the pose " : "there is no pose with the name ";
    time.at("weights").item(i).at("pose").fail(problem + formats::in_quotes(name));
  }
}

void code_session(const JsonField& f, Session& s, const Place& place) {
  if (f.reads()) (void)f.in().at("model");
  code_path(f, "model", s.model.path, place);
  code_path(f, "cage", s.cage_file.path, place);
  if (s.cage_file.path.empty() && (f.reads() || s.cage_file.surface)) f.member("made_cage", s.cage_file);
  if (has_checksums) f.unless(0, "model_content", s.model.content);
  if (has_checksums) f.unless(0, "cage_content", s.cage_file.content);
  if (f.reads() || !place.relative) {
    code_path(f, "session", s.origin, place);
    f.unless(std::nullopt, "session_content", s.origin_content);
  }
  f.member("method", s.method);
  code(f, s.deformer);
  f.unless(nullptr, "mask", s.mask);
  f.unless({}, "probes", s.probes);
  f.unless(std::nullopt, "camera", s.camera);
  f.member("view", s.view);
  code(f, s.sides);
  f.unless({}, "hand", s.handling);
  f.unless(std::nullopt, "window", s.window);
  document::ElementKind kind = s.selection.kind();
  std::vector<std::uint32_t> selected = s.selection.indices();
  f.member("selecting", kind);
  f.member("selection", selected);
  s.selection = document::Selection(kind, selected);
  f.unless({}, "sets", s.groups.sets, most_sets);
  f.unless({}, "hidden", s.groups.hidden);
  if (f.reads() || !s.pose.positions.empty()) f.member("pose", s.pose);
  f.unless(nullptr, "shape", s.shape);
  f.unless({}, "poses", s.library.poses, document::PoseLibrary::most_poses);
  f.unless(nullptr, "unmixed", s.source.base);
  const auto time = f.reads() || s.timeline != document::Timeline{} ? f.child("time") : std::nullopt;
  if (!time) return;
  code(*time, s.timeline);
  if (f.reads()) {
    s.frame = s.timeline.first;
    check_channels(time->in(), s);
    follow_library(s.library, s.timeline);
  }
  time->member("frame", s.frame, frames);
}

void check_version(const JsonReader& json, const fs::path& file) {
  const auto format = json.find("format");
  if (!format || format->text() != format_name)
    throw base::Error(file.string(), "this file is not a session", "choose a session saved by Viete");
  const auto version = json.at("version").index();
  if (version == format_version) return;
  json.at("version").fail("the session has version " + std::to_string(version) +
                              ", this version of Viete reads version " + std::to_string(format_version),
                          "open it with the version of Viete that saved it");
}

}  // namespace

std::string session_text(const Session& session, const fs::path& file, bool portable) {
  ordered_json json = {{"format", format_name}, {"version", format_version}};
  ShapeTable shapes;
  Session copy = session;  // code() needs a value that is not const
  code_session(JsonField(json, &shapes), copy, {resolved(file).parent_path(), portable});
  if (!shapes.all.empty()) code(JsonField(json["shapes"], &shapes), shapes);
  return readable(json, file);
}

Session read_session(const fs::path& file) {
  const nlohmann::json whole = read_json(file);
  const JsonReader json(whole, file.string());
  check_version(json, file);
  ShapeTable shapes;
  if (const auto found = json.find("shapes")) code(JsonField(*found, &shapes), shapes);
  Session session;
  code_session(JsonField(json, &shapes), session, {resolved(file).parent_path(), true});
  constexpr std::size_t most_notes = 8;
  for (const std::string& key : json.ignored_keys())
    if (session.notes.size() < most_notes)
      session.notes.push_back(file.string() + ": unknown key ignored: " + formats::in_quotes(key));
  document::PoseLibrary named;  // the same poses with unique names
  for (document::NamedPose& pose : std::exchange(session.library.poses, {})) {
    pose.name = free_name(named, pose.name);
    named.poses.push_back(std::move(pose));
  }
  session.library.poses = std::move(named.poses);
  return session;
}

namespace {

constexpr const char* changed_advice = "restore the model and cage with which the session was saved";

[[noreturn]] void refuse(const fs::path& file, const char* key, const std::string& problem,
                         const std::string& advice = changed_advice) {
  throw base::Error(file.string() + ": " + key, problem, advice);
}

void check_pose(const document::Document& document, const Session& session, const fs::path& file) {
  const pose::Cage& cage = *document.cage();
  const bool same =
      session.cage_file.content != 0 && session.cage_file.content == document.cage_file().content;
  const std::string advice = same
                                 ? "the session is damaged: use an older copy"
                                 : "the cage has changed since the session was saved: restore the older file";
  const auto& [positions, turns] = document.pose();
  const std::size_t wanted = cage.surface.positions.size();
  if (positions.size() != wanted)
    refuse(file, "pose.positions",
           "the pose is for " + counted(document::ElementKind::vertex, positions.size()) + ", the cage " +
               place_of(document.cage_file()) + " has " + counted(document::ElementKind::vertex, wanted),
           advice);
  if (turns.size() > cage.roots.size())
    refuse(file, "pose.turns",
           "the pose is for " + base::counted(turns.size(), "part") + ", the cage has " +
               base::counted(cage.roots.size(), "part"),
           advice);
}

// `indices` must be in ascending order.
void check_indices(const fs::path& file, const char* key, const std::vector<std::uint32_t>& indices,
                   document::ElementKind kind, std::size_t count) {
  if (indices.empty() || indices.back() < count) return;
  refuse(file, key,
         element_name(kind) + ' ' + std::to_string(indices.back()) + " does not exist, there are only " +
             counted(kind, count) + ", counted from 0");
}

void check_poses(const document::DocumentState& state, const pose::Cage* cage, const mesh::Surface& model,
                 const fs::path& file) {
  const std::size_t vertices = cage ? cage->surface.positions.size() : 0,
                    parts = cage ? cage->roots.size() : 0;
  const auto check = [&](const char* key, const std::string& what, const document::SharedPose& pose) {
    if ((pose->shape && pose->shape->size() != model.positions.size()) ||
        pose->cage.positions.size() != vertices || pose->cage.turns.size() > parts)
      refuse(file, key, what + " belongs to another cage or model");
  };
  for (const document::NamedPose& named : state.library.poses)
    check("poses", "the pose " + formats::in_quotes(named.name), named.pose);
  if (state.source.base) check("unmixed", "this pose", state.source.base);
  for (const auto* keys : {&state.timeline.keys, &state.timeline.unkeyed})
    for (const document::PoseKey& key : *keys)
      check("time", "the pose of frame " + std::to_string(key.frame), key.pose);
}

}  // namespace

void check_fits(const document::Document& document, const Session& session, const fs::path& file) {
  const mesh::Surface& model = *document.model().surface;
  const std::size_t vertices = model.positions.size();
  if (document.has_cage()) check_pose(document, session, file);
  const auto check_count = [&](const char* key, std::size_t count) {
    if (count == vertices) return;
    refuse(file, key,
           "the " + std::string(key) + " is for " + counted(document::ElementKind::vertex, count) +
               ", the model has " + counted(document::ElementKind::vertex, vertices));
  };
  if (document.mask()) check_count("mask", document.mask()->size());
  if (document.shape()) check_count("shape", document.shape()->size());
  for (const pose::Probe& probe : document.probes().all)
    if (probe.pin)
      check_indices(file, "probes", {probe.pin->vertex}, document::ElementKind::vertex, vertices);
  check_poses(document.state(), document.cage().get(), model, file);
  const document::Selection& selection = document.selection();
  check_indices(file, "selection", selection.indices(), selection.kind(),
                element_count(document, selection.kind()));
  const std::size_t of_cage = element_count(document, document::ElementKind::vertex);
  for (const document::NamedSet& set : document.groups().sets)
    check_indices(file, "sets", set.vertices, document::ElementKind::vertex, of_cage);
  check_indices(file, "hidden", document.groups().hidden, document::ElementKind::vertex, of_cage);
}

std::vector<std::string> changes_since(const Session& session, const document::Document& document,
                                       const fs::path& file) {
  std::vector<std::string> warnings;
  const auto compare = [&](const char* key, std::uint64_t then, const document::OpenedSurface& now,
                           const char* advice) {
    if (then == 0 || now.content == 0 || then == now.content) return;
    warnings.emplace_back(base::Error(file.string() + ": " + key,
                                      place_of(now) + " has changed since the session was saved", advice)
                              .what());
  };
  compare("model", session.model.content, document.model(),
          "if the result looks wrong, restore the older file");
  compare("cage", session.cage_file.content, document.cage_file(),
          "if the pose looks wrong, restore the older file");
  return warnings;
}

bool is_session(const fs::path& file) {
  return base::extension_of(file) == session_extension + 1;
}

std::uint64_t content_of_bytes(std::string_view bytes) {
  base::Checksum sum;
  sum.add(bytes.data(), bytes.size());
  return sum.value();
}

std::optional<std::uint64_t> content_of(const fs::path& file) {
  try {
    return content_of_bytes(base::FileBytes(file).view());
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace viete::files
