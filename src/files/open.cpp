#include "files/open.h"

#include <algorithm>
#include <utility>

#include "base/numbered_files.h"
#include "base/text.h"
#include "cages/edit.h"
#include "document/cage_making.h"
#include "document/elements.h"
#include "document/pose_edit.h"
#include "files/animation_import.h"
#include "files/output.h"
#include "files/shape_import.h"
#include "formats/format_table.h"
#include "formats/point_cache.h"
#include "mesh/repair.h"
#include "mesh/triangle_tree.h"
#include "mesh/triangulation.h"
#include "mesh/vertex_order.h"
#include "pose/pose_file.h"

namespace viete::files {

namespace fs = std::filesystem;
using What = OpenRequest::What;

namespace {

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// Number of sampled vertices: `count` outside, and `of` in total.
struct Outside {
  std::size_t count, of;
};

Outside outside(const mesh::Surface& outer, const mesh::Surface& inner) {
  constexpr std::size_t samples = 100;
  const auto& points = inner.positions;
  std::vector<mesh::Point> sample;
  const std::size_t n = std::min(samples, points.size());
  for (std::size_t i = 0; i < n; ++i) sample.push_back(points[i * points.size() / n]);
  return {mesh::points_outside(mesh::split_at_centers(outer).surface, sample).size(), n};
}

bool box_contains(const mesh::Bounds& outer, const mesh::Bounds& inner) {
  for (int k = 0; k < 3; ++k) {
    if (outer.low[k] > inner.low[k] || outer.high[k] < inner.high[k]) return false;
  }
  return true;
}

// Allows 10 % of the sampled vertices to be outside.
bool encloses(const mesh::Surface& outer, const mesh::Surface& inner) {
  if (inner.positions.empty() || outer.triangles.empty()) return false;
  if (!box_contains(mesh::used_bounds(outer), mesh::used_bounds(inner))) return false;
  const Outside found = outside(outer, inner);
  return 10 * found.count <= found.of;
}

// Adds the cage's warnings. If most of the model is outside the cage, warns that the cage may not fit.
void take_cage_warnings(Opened& opened) {
  const document::Document& document = *opened.document;
  append(opened.warnings, document.cage_file().warnings);
  if (!document.has_cage()) return;
  if (!document.cage()->closed) return;
  const Outside found = outside(document.cage()->surface, *document.model().surface);
  if (2 * found.count <= found.of) return;
  opened.warnings.push_back(place_of(document.cage_file()) + ": " +
                            (found.count == found.of ? "all" : "most") + " of " +
                            document.model().path.filename().string() +
                            " is outside this cage; check that both have the same scale and position");
}

void take_warnings(Opened& opened) {
  append(opened.warnings, opened.document->model().warnings);
  take_cage_warnings(opened);
}

document::OpenedSurface cage_without_fins(document::OpenedSurface cage) {
  mesh::Surface rest = cages::without_fins(*cage.surface);
  const std::size_t removed = cage.surface->polygon_count() - rest.polygon_count();
  if (removed == 0) return cage;
  document::OpenedSurface made =
      document::generated_surface(std::move(rest), name_of(cage) + ", without its fins");
  made.warnings = std::move(cage.warnings);
  made.warnings.push_back("removed " + base::counted(removed, "protruding face") + " of " + name_of(cage) +
                          "; save the cage to keep this change");
  return made;
}

Opened open_model(const std::vector<fs::path>& files, bool without_fins, base::Progress* progress) {
  const auto named = [&](std::size_t i) { return i < files.size() ? files[i] : fs::path(); };
  Opened opened;
  opened.document = document::open_document(named(0), without_fins ? "" : named(1), progress);
  if (without_fins) set_cage(*opened.document, cage_without_fins(document::open_surface(named(1))));
  take_warnings(opened);
  if (named(2).empty()) return opened;
  if (!opened.document->has_cage())
    throw base::Error(named(2).string(), "a pose needs a cage, and no cage was opened", "open the cage too");
  opened.document->changed_pose() = pose::read_pose(named(2), *opened.document->cage(), opened.warnings);
  opened.document->changed_also_read().push_back({named(2), document::the_pose});
  return opened;
}

Opened open_cage(document::OpenedSurface cage, const document::Document& current) {
  Opened opened;
  opened.document = document::Document(current.model());
  opened.document->put_mask(current.mask());
  opened.document->changed_probes() = current.probes();
  set_cage(*opened.document, std::move(cage));
  opened.lost = keep_shapes(*opened.document, current);
  take_cage_warnings(opened);
  return opened;
}

Opened open_cage(const fs::path& file, const document::Document& current, bool without_fins,
                 base::Progress* progress) {
  if (!current.model().surface)
    throw base::Error(file.string(), "a cage needs a model, and no model is open", "open the model first");
  document::OpenedSurface cage = document::open_surface(file, progress);
  return open_cage(without_fins ? cage_without_fins(std::move(cage)) : std::move(cage), current);
}

Opened of_open_cage(const fs::path& file, const document::Document& current) {
  if (!current.has_cage())
    throw base::Error(file.string(), "a pose needs a cage, and no cage is open", "open the cage first");
  Opened opened;
  opened.file = file;
  opened.pose_of = current.cage();
  return opened;
}

Opened open_pose(const fs::path& file, const document::Document& current) {
  Opened opened = of_open_cage(file, current);
  opened.pose = pose::read_pose(file, *current.cage(), opened.warnings);
  opened.also_read.push_back({file, document::the_pose});
  document::Document posed;
  posed.replace_cage(current.cage_file(), current.cage(), *opened.pose);
  check_drawable(posed);
  return opened;
}

void check_imported(const Opened& imported) {
  document::Document checked;
  checked.changed_library().poses = imported.poses;
  checked.changed_timeline().keys = imported.keys;
  check_drawable(checked);
}

Opened open_poses(const std::vector<fs::path>& files, const document::Document& current,
                  base::Progress* progress) {
  Opened opened = of_open_cage(files.front(), current);
  ImportedPoses read = read_poses(files, *current.cage(), progress);
  opened.poses = std::move(read.poses);
  check_imported(opened);
  opened.warnings = std::move(read.warnings);
  for (auto& path : read.files) opened.also_read.push_back({std::move(path), document::an_imported_pose});
  return opened;
}

// Computes the log vectors of the shapes now, because this function runs in the background.
void add_shape_vectors(Opened& opened, const std::shared_ptr<const mesh::Surface>& model,
                       std::span<const document::SharedShape> shapes, base::Progress* progress) {
  base::WorkerPool pool;
  opened.shapes_of = model;
  opened.vectors.follow_model(model);
  (void)opened.vectors.shapes(pool);
  std::vector<shapes::ShapeReport> reports(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    (void)opened.vectors.of(shapes[i], nullptr, pool, reports[i]);
    if (progress) progress->report(static_cast<double>(i + 1) / static_cast<double>(shapes.size()));
  }
  append(opened.warnings, document::shape_notes(reports));
}

void take_shapes(Opened& opened, std::vector<fs::path> files, const document::Document& current,
                 base::Progress* progress) {
  sort_by_numbers(files);
  check_shape_rest("", *current.model().surface);
  ImportedShapes read = read_shapes(files, *current.model().surface, progress);
  document::Document checked;
  for (const document::NamedShape& shape : read.shapes) {
    checked.put_shape(shape.shape);
    check_drawable(checked);
  }
  opened.shapes = std::move(read.shapes);
  append(opened.warnings, read.warnings);
  for (auto& path : read.files) opened.also_read.push_back({std::move(path), "a shape"});
}

Opened open_shapes(const std::vector<fs::path>& files, const document::Document& current,
                   base::Progress* progress) {
  if (!current.model().surface)
    throw base::Error(files.front().string(), "a shape needs a model, and no model is open",
                      "open the model first");
  Opened opened;
  opened.file = files.front();
  if (progress) progress->section(0, 0.3);
  take_shapes(opened, files, current, progress);
  std::vector<document::SharedShape> shapes;
  for (const document::NamedShape& shape : opened.shapes) shapes.push_back(shape.shape);
  if (progress) progress->section(0.3, 0.8);
  add_shape_vectors(opened, current.model().surface, shapes, progress);
  return opened;
}

// Reads shapes and makes a key from each shape. The keys are one frame apart.
Opened open_shape_keys(const fs::path& file, const document::Document& current, base::Progress* progress) {
  const bool is_model = formats::is_a(formats::keeps_order, file);  // the file may belong to a sequence
  const auto sequence = is_model ? base::NumberedName::of_file(file) : std::nullopt;
  Opened opened = open_shapes({sequence ? fs::path(sequence->pattern()) : file}, current, progress);
  const pose::Pose cage = current.has_cage() ? pose::rest_pose(*current.cage()) : pose::Pose();
  int frame = current.timeline().first;
  for (document::NamedShape& shape : std::exchange(opened.shapes, {}))
    opened.keys.push_back(
        {frame++,
         std::make_shared<const document::WholePose>(document::WholePose{cage, {}, std::move(shape.shape)}),
         document::Easing::constant_speed});
  opened.pose_of = current.cage();
  return opened;
}

// Returns true for a point cache whose number of points matches the model but not the cage.
bool is_cache_of(const fs::path& file, const document::Document& current) {
  if (!current.model().surface || !formats::point_cache_format(file)) return false;
  const std::size_t points = formats::PointCache(file).head().points;
  return points == current.model().surface->positions.size() &&
         !(current.has_cage() && points == current.cage()->surface.positions.size());
}

Opened open_animation(const fs::path& file, const document::Document& current, base::Progress* progress) {
  if (current.model().surface && (!current.has_cage() || is_cache_of(file, current)))
    return open_shape_keys(file, current, progress);
  Opened opened = of_open_cage(file, current);
  const ImportTimes times{current.timeline().first, current.timeline().rate};
  ImportedKeys read = read_keys(file, *current.cage(), times, progress);
  opened.keys = std::move(read.keys);
  check_imported(opened);
  opened.warnings = std::move(read.warnings);
  for (auto& path : read.files) opened.also_read.push_back({std::move(path), document::the_keys});
  return opened;
}

// Replaces the session's file names by the names in `located`. If the session's cage does not exist, also
// looks for a cage of the same name in the folder of the new model.
void locate(Session& session, const LocatedFiles& located) {
  std::error_code ignored;
  if (!located.model.empty()) {
    session.model.path = fs::absolute(located.model).lexically_normal();
    fs::path& cage = session.cage_file.path;
    const fs::path beside = located.model.parent_path() / cage.filename();
    if (!cage.empty() && !fs::exists(cage, ignored) && fs::exists(beside, ignored)) cage = beside;
  }
  if (located.cage.empty()) return;
  session.cage_file.path = fs::absolute(located.cage).lexically_normal();
  session.cage_file.surface = nullptr;
}

// Opens the session's model and cage. Errors also contain the session's name.
document::Document document_of_session(const Session& session, const fs::path& file,
                                       base::Progress* progress) {
  const auto open = [&](const char* key, const fs::path& named, base::Progress* told) {
    std::error_code ignored;
    if (!fs::exists(named, ignored)) throw SessionFileError(file, key, named);
    return document::open_surface(named, told);
  };
  const char* key = "model";
  try {
    document::Document document(open(key, session.model.path, progress));
    key = "cage";
    if (!session.cage_file.path.empty()) set_cage(document, open(key, session.cage_file.path, nullptr));
    key = "made_cage";
    if (session.cage_file.surface) set_cage(document, session.cage_file);
    document::DocumentState state = session;
    state.cage = document.cage();
    state.cage_file = document.cage_file();
    if (!document.has_cage() || state.pose.positions.empty()) state.pose = document.pose();
    document.restore(std::move(state));
    return document;
  } catch (const SessionFileError&) {
    throw;
  } catch (const base::Error& error) {
    throw base::Error(file.string() + ": " + key + ": " + error.place(), error.problem(), error.advice());
  }
}

void set_pose_from_keys(document::Document& document) {
  if (!document.timeline().has_poses()) return;
  document::VectorCache vectors;
  vectors.follow(document.cage());
  vectors.follow_model(document.model().surface);
  show_pose(document, document::Animation(document.timeline(), vectors).at(document.frame()),
            document::PoseSource::Kind::frame);
}

void add_shape_vectors(Opened& opened, const document::Document& document, base::Progress* progress) {
  std::vector<document::SharedShape> shapes;
  const auto add = [&](const auto& keyed) {
    if (keyed.pose->shape) shapes.push_back(keyed.pose->shape);
  };
  std::ranges::for_each(document.library().poses, add);
  if (!document.has_shapes()) return;
  add_shape_vectors(opened, document.model().surface, shapes, progress);
  if (!document.timeline().has_poses()) return;
  opened.vectors.follow(document.cage());
  (void)document::Animation(document.timeline(), opened.vectors);
}

Opened open_session(const fs::path& file, bool recovered, const LocatedFiles& located,
                    base::Progress* progress) {
  Opened opened;
  opened.file = file;
  opened.recovered = recovered;
  opened.has_settings = true;
  opened.content = content_of(file);  // taken before reading, so that later changes are detected
  Session& session = opened.session.emplace(read_session(file));
  locate(session, located);
  document::Document document = document_of_session(session, file, progress);
  document.put_method(session.method);
  check_fits(document, session, file);
  for (pose::Probe& probe : document.changed_probes().all)
    if (probe.pin) probe.place = document.model().surface->positions[probe.pin->vertex];
  const document::SharedPose base = std::exchange(document.changed_source(), {}).base;
  if (base && document.library().mixes())
    document.changed_source() = {document::PoseSource::Kind::mix, shared_pose(document), base};
  add_shape_vectors(opened, document, progress);
  if (document.has_cage() && session.pose.positions.empty() && !session.shape) set_pose_from_keys(document);
  document.changed_selection() = without_hidden(document, document.selection());
  opened.warnings = changes_since(session, document, file);
  append(opened.warnings, session.notes);
  opened.document = std::move(document);
  take_warnings(opened);
  return opened;
}

bool matches(const mesh::Surface& found, const mesh::Surface& wanted) {
  return mesh::vertex_order(found, wanted, true).has_value();
}

bool is_shape_of(const document::Document& current, const mesh::Surface& s) {
  return current.model().surface && matches(s, *current.model().surface);
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return a == b || fs::equivalent(a, b, ignored);
}

Opened open_dropped_surface(document::OpenedSurface surface, const document::Document& current) {
  const mesh::Surface& s = *surface.surface;
  const std::string name = name_of(surface);
  if (current.has_cage() && matches(s, current.cage()->surface)) {
    Opened opened = open_pose(surface.path, current);
    opened.taken_as = "Imported " + name + " as a pose: it has the cage's vertices and faces";
    return opened;
  }
  if (is_shape_of(current, s) && !same_file(surface.path, current.model().path)) {
    Opened opened = open_shapes({surface.path}, current, nullptr);
    opened.taken_as = "Imported " + name + " as a shape: it has the model's vertices and faces";
    return opened;
  }
  const bool cage = current.model().surface && !current.has_cage() &&
                    s.positions.size() < current.model().surface->positions.size() &&
                    encloses(s, *current.model().surface);
  if (cage) {
    Opened opened = open_cage(std::move(surface), current);
    opened.taken_as = "Imported " + name + " as the cage: it encloses the model";
    return opened;
  }
  Opened opened;
  opened.document = document::Document(std::move(surface));
  opened.taken_as = "Imported " + name + " as a new model";
  take_warnings(opened);
  return opened;
}

Opened open_dropped_pair(document::OpenedSurface model, document::OpenedSurface cage) {
  if (cage.surface->positions.size() > model.surface->positions.size()) std::swap(model, cage);
  std::string reason = "has fewer vertices and encloses the model";
  if (!encloses(*cage.surface, *model.surface)) {
    const bool other = encloses(*model.surface, *cage.surface);
    if (other) std::swap(model, cage);
    reason = other ? "encloses the model" : "has fewer vertices but does not enclose the model";
  }
  Opened opened;
  opened.taken_as =
      "Imported " + name_of(model) + " as the model and " + name_of(cage) + " as its cage, which " + reason;
  opened.document = document::Document(std::move(model));
  set_cage(*opened.document, std::move(cage));
  take_warnings(opened);
  return opened;
}

Opened open_dropped_shapes(const std::vector<fs::path>& files, const document::Document& current,
                           base::Progress* progress) {
  Opened opened = open_shapes(files, current, progress);
  opened.taken_as = "Imported " + base::counted(opened.shapes.size(), "shape") + " of the model";
  return opened;
}

Opened open_dropped(const std::vector<fs::path>& files, const document::Document& current,
                    base::Progress* progress) {
  const std::string dropped = base::counted(files.size(), "file") + " dropped";
  const char* advice =
      "drop one session, one model, one pose, a model and its cage, or shapes of the open model";
  const bool several = files.size() > 1;
  if (files.empty() || (several && std::any_of(files.begin(), files.end(), is_session)) ||
      (files.size() > 2 && !current.model().surface))
    throw base::Error("", dropped, advice);
  if (files.size() > 2) {
    try {
      return open_dropped_shapes(files, current, progress);
    } catch (const base::Error& error) {
      throw base::Error(error.place(),
                        dropped + ", and this file is not a shape of the model: " + error.problem(), advice);
    }
  }
  if (files.size() == 1 && formats::point_cache_format(files[0]))
    return is_cache_of(files[0], current) ? open_dropped_shapes(files, current, progress)
                                          : open_animation(files[0], current, progress);
  const double middle = files.size() == 2 ? 0.4 : 0.8;
  if (progress) progress->section(0, middle);
  document::OpenedSurface first = document::open_surface(files[0], progress);
  if (files.size() == 1) return open_dropped_surface(std::move(first), current);
  if (progress) progress->section(middle, 0.8);
  document::OpenedSurface second = document::open_surface(files[1], progress);
  if (is_shape_of(current, *first.surface) && is_shape_of(current, *second.surface))
    return open_dropped_shapes(files, current, progress);
  return open_dropped_pair(std::move(first), std::move(second));
}

bool names_session(const OpenRequest& request) {
  if (request.what == What::recovery) return true;
  const bool alone =
      request.what == What::model || (request.what == What::dropped && request.files.size() == 1);
  return alone && !request.files.empty() && is_session(request.files.front());
}

Opened read(const OpenRequest& request, const document::Document& current, base::Progress* progress) {
  const auto& files = request.files;
  const fs::path first = files.empty() ? fs::path() : files.front();
  if (names_session(request))
    return open_session(first, request.what == What::recovery, request.located, progress);
  switch (request.what) {
    case What::cage: return open_cage(first, current, request.without_fins, progress);
    case What::pose: return open_pose(first, current);
    case What::poses: return open_poses(files, current, progress);
    case What::animation: return open_animation(first, current, progress);
    case What::shapes: return open_shapes(files, current, progress);
    case What::dropped: return open_dropped(files, current, progress);
    default: return open_model(files, request.without_fins, progress);
  }
}

void check(const Opened& opened, void (*check_document)(const document::Document&)) {
  if (!opened.document) return;
  try {
    check_document(*opened.document);
  } catch (const base::Error& error) {
    if (!opened.session) throw;
    throw base::Error(opened.file.string() + ": " + error.place(), error.problem(), error.advice());
  }
}

}  // namespace

SessionFileError::SessionFileError(const fs::path& session, std::string_view of, const fs::path& named)
    : base::Error(session.string() + ": " + std::string(of), named.string() + ": there is no such file",
                  "open the session in the window and choose the file there"),
      key(of),
      file(named) {}

Opened open_files(const OpenRequest& request, const document::Document& current, base::Progress* progress) {
  if (progress) progress->section(0, 0.8);
  Opened opened = read(request, current, progress);
  if (!opened.document) return opened;
  document::Document& document = *opened.document;
  if (!opened.has_settings) {
    document.put_method(current.method());
    document.put_deformer(current.deformer());
  }
  if (!document.has_cage() && !opened.session)
    document.put_cage_beside(document::cage_beside(document.model().path));
  put_settings(document, request.settings, opened.has_settings);
  opened.has_settings |= request.settings.any();
  return opened;
}

void check_drawable(const Opened& opened) {
  check(opened, document::check_drawable);
}
void check_deformable(const Opened& opened) {
  check(opened, document::check_deformable);
}

document::FilesInUse files_of(const Opened& opened) {
  document::FilesInUse files;
  if (opened.document) add_document(files, *opened.document, document::no_own);
  for (const document::FileInUse& file : opened.also_read) files.add(file.path, file.what);
  if (opened.session) files.add(opened.file, document::the_session);
  return files;
}

}  // namespace viete::files
