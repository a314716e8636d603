#include "document/document.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/worker_pool.h"
#include "document/range.h"
#include "foreign/read.h"
#include "formats/format_table.h"
#include "formats/text_cursor.h"
#include "formats/write.h"
#include "mesh/triangle.h"
#include "mesh/vector.h"
#include "pose/cage_state.h"
#include "pose/maps.h"
#include "weights/tiled_binding.h"

namespace viete::document {

namespace {

struct SizeRange {
  double least, most;
  const char* use;
};

// Checks the size and position of a box. A single point has no size, so only its position is checked.
void check_size(const std::string& place, const mesh::Bounds& box, const SizeRange& range) {
  double size = box.diagonal();
  for (int k = 0; k < 3; ++k) size = std::max({size, std::abs(box.low[k]), std::abs(box.high[k])});
  if (size <= range.most) size = box.diagonal();
  if (size == 0 || (size >= range.least && size <= range.most)) return;
  throw base::Error(place, base::formatted("a size of %.2g cannot be %s", size, range.use),
                    base::formatted("scale it to a size between %g and %g", range.least, range.most));
}

void check_pose(const std::string& place, const std::vector<mesh::Point>& positions, const SizeRange& range) {
  if (!positions.empty()) check_size(place, mesh::bounds(positions), {0, range.most, range.use});
}

void check_pose(const std::string& place, const WholePose& pose, const SizeRange& range) {
  check_pose(place, pose.cage.positions, range);
  if (pose.shape) check_pose(place, *pose.shape, range);
}

void check_sizes(const Document& document, const SizeRange& range) {
  for (const OpenedSurface* opened : {&document.model(), &document.cage_file()}) {
    if (opened->surface) check_size(place_of(*opened), opened->bounds, range);
  }
  const auto check_keys = [&](const char* what, const std::vector<PoseKey>& keys) {
    for (const PoseKey& key : keys) check_pose(what + std::to_string(key.frame), *key.pose, range);
  };
  for (const NamedPose& named : document.library().poses)
    check_pose("the pose " + formats::in_quotes(named.name), *named.pose, range);
  check_keys("the key at frame ", document.timeline().keys);
  check_keys("the unkeyed pose at frame ", document.timeline().unkeyed);
  if (document.source().base) check_pose("the pose without weighted poses", *document.source().base, range);
  if (document.shape()) check_pose("the shape of the model", *document.shape(), range);
  if (document.cage_file().surface)
    check_pose("the pose of " + place_of(document.cage_file()), document.pose().positions, range);
}

void put_surface(OpenedSurface& opened, mesh::Surface surface) {
  opened.summary = mesh::summarize(surface);
  opened.bounds = mesh::used_bounds(surface);
  opened.content = mesh::content_key(surface);
  opened.surface = std::make_shared<const mesh::Surface>(std::move(surface));
}

mesh::Point centroid(const mesh::Surface& surface) {
  struct Sum {
    mesh::Point moment{0, 0, 0};
    double area = 0;
    Sum operator+(const Sum& other) const { return {moment + other.moment, area + other.area}; }
  };
  const Sum sum = base::sum_of_blocks(surface.triangles.size(), [&](std::size_t begin, std::size_t end) {
    Sum sum;
    for (std::size_t t = begin; t < end; ++t) {
      const auto [a, b, c] = mesh::corners_of(surface.positions, surface.triangles[t]);
      const double area = mesh::norm(mesh::cross(b - a, c - a));
      sum = sum + Sum{(area / 3) * (a + b + c), area};
    }
    return sum;
  });
  return sum.area > 0 ? (1 / sum.area) * sum.moment : sum.moment;
}

// Returns the relative size of the base on which the model stands if `axis` is up: area of the box around the
// lowest points / area of the model's box, both seen from above. If the model would fall over, returns 0.
double standing(const mesh::Surface& surface, const mesh::Bounds& box, const mesh::Point& middle,
                std::size_t axis) {
  const double lowest = box.low[axis] + 0.02 * (box.high[axis] - box.low[axis]);
  std::size_t feet = 0;
  mesh::Bounds base{box.high, box.low};
  for (const mesh::Point& p : surface.positions)
    if (p[axis] <= lowest) {
      mesh::extend(base, p);
      ++feet;
    }
  if (feet < 3) return 0;
  double share = 1;
  for (const std::size_t k : {(axis + 1) % 3, (axis + 2) % 3}) {
    if (middle[k] < base.low[k] || middle[k] > base.high[k] || !(box.high[k] > box.low[k])) return 0;
    share *= (base.high[k] - base.low[k]) / (box.high[k] - box.low[k]);
  }
  return share;
}

}  // namespace

OpenedSurface generated_surface(mesh::Surface surface, std::string made) {
  OpenedSurface opened;
  opened.made = std::move(made);
  opened.format = "not saved";
  put_surface(opened, std::move(surface));
  return opened;
}

OpenedSurface open_surface(const std::filesystem::path& path, base::Progress* progress) {
  formats::ReadResult read = foreign::read(path, progress);
  OpenedSurface opened;
  opened.path = path;
  opened.format = std::move(read.format);
  opened.warnings = std::move(read.warnings);
  opened.attributes = std::move(read.attributes);
  opened.splats = std::move(read.splats);
  opened.original = std::move(read.original);
  put_surface(opened, std::move(read.surface));
  return opened;
}

Document::Document(OpenedSurface model) {
  put_model(std::move(model));
}

void Document::put_model(OpenedSurface model) {
  opened_.space = space_for(model.bounds);
  opened_.model = std::move(model);
  ++revisions_.surfaces;
}

Document Document::without_history() const {
  Document copy;
  copy.state_ = state_;
  copy.opened_ = opened_;
  copy.carried_ = carried_;
  copy.revisions_ = revisions_;
  return copy;
}

void check_drawable(const Document& document) {
  check_sizes(document, {least_drawn, most_drawn, "drawn"});
}

// The deformation computes squares of areas. Tests with one model gave identical results for sizes from 1e-75
// to 1e76. The limits are narrower, because triangles are smaller than the model.
void check_deformable(const Document& document) {
  check_sizes(document, {1e-60, 1e60, "deformed"});
  formats::check_deformable(document.model().path, document.model().original.get());
}

void set_cage(Document& document, OpenedSurface surface) {
  std::shared_ptr<const pose::Cage> cage;
  try {
    cage = std::make_shared<const pose::Cage>(pose::make_cage(*surface.surface));
  } catch (const pose::FinError& error) {
    throw pose::FinError(place_of(surface), error.problem(), error.advice());
  } catch (const base::Error& error) {
    throw base::Error(place_of(surface), error.problem(), error.advice());
  }
  if (!surface.path.empty()) document.changed_also_read().push_back({surface.path, the_cage});
  pose::Pose rest = pose::rest_pose(*cage);
  document.replace_cage(std::move(surface), std::move(cage), std::move(rest));
  document.changed_selection().clear();
  document.changed_history() = {};
}

Document open_document(const std::filesystem::path& model, const std::filesystem::path& cage,
                       base::Progress* progress) {
  Document document(open_surface(model, progress));
  if (!cage.empty()) set_cage(document, open_surface(cage));
  return document;
}

bool Document::has_shapes() const {
  const auto has_one = [](const auto& keyed) { return keyed.pose->shape != nullptr; };
  return shape() || std::ranges::any_of(library().poses, has_one) ||
         std::ranges::any_of(timeline().keys, has_one);
}

void Document::mark_replacing(const Document& other) {
  const Revisions& before = other.revisions_;
  revisions_ = {before.surfaces + 1, before.cage + 1,   before.weights + 1,
                before.pose + 1,     before.method + 1, before.whole + 1};
}

void Document::replace_cage(OpenedSurface file, std::shared_ptr<const pose::Cage> by, pose::Pose posed) {
  state_.cage_file = std::move(file);
  state_.cage = std::move(by);
  changed_pose() = std::move(posed);
  if (selection().kind() != ElementKind::probe) state_.selection.clear();
  state_.groups = {};
  carried_.clear();
  ++revisions_.cage;
}

void Document::put_saved_cage(const std::filesystem::path& file) {
  state_.cage_file.path = file;
  state_.cage_file.made.clear();
  state_.cage_file.format = "saved here";
}

void Document::put_deformer(const pose::Deformer& other) {
  const pose::Deformer old = std::exchange(state_.deformer, other);
  if (old.weighting != other.weighting) ++revisions_.weights;
  if (old.blend != other.blend || old.weighting.elements != other.weighting.elements ||
      old.amounts != other.amounts || old.iterations != other.iterations || old.holding != other.holding)
    ++revisions_.method;
}

void Document::put_method(sym3::Method other) {
  if (std::exchange(opened_.method, other) != other) ++revisions_.method;
}

void Document::restore(DocumentState&& state) {
  if (cage() != state.cage) ++revisions_.cage;
  const pose::Deformer restored = std::exchange(state.deformer, deformer());
  state_ = std::move(state);
  ++revisions_.pose;
  ++revisions_.whole;
  carried_.clear();
  put_deformer(restored);
}

void put_settings(Document& document, const RequestedSettings& asked, bool chosen) {
  const pose::Deformer deformer = pose::deformer_of(asked, document.deformer(), chosen);
  if (asked.method) document.put_method(*asked.method);
  document.put_deformer(deformer);
}

mesh::Point shape_of_vertex(const Document& document, std::uint32_t vertex) {
  return document.shape() ? (*document.shape())[vertex] : document.model().surface->positions[vertex];
}

Carried carried_probe(const Document& document, std::size_t i) {
  return i < document.carried().size() ? document.carried()[i] : Carried{document.probes().all[i].place};
}

mesh::Point probe_center(const Document& document, std::size_t i) {
  const Carried carried = carried_probe(document, i);
  return carried.place + pose::times(carried.map, document.probes().all[i].pose.move);
}

mesh::Point pinned_vertex(const Document& document, std::size_t i) {
  const Carried carried = carried_probe(document, i);
  const pose::Probe& probe = document.probes().all[i];
  return carried.place + pose::times(carried.map, shape_of_vertex(document, probe.pin->vertex) - probe.place);
}

std::vector<mesh::Point> probe_centers(const Document& document) {
  std::vector<mesh::Point> centers;
  for (std::size_t i = 0; i < document.probes().all.size(); ++i) centers.push_back(probe_center(document, i));
  return centers;
}

std::string binding_plan(const Document& document, const pose::Weighting& weighting) {
  const std::size_t vertices = document.model().surface->positions.size();
  const std::size_t handles = pose::handle_count(*document.cage(), weighting.elements);
  const std::size_t bytes = weights::binding_bytes(vertices, handles, pose::EngineKind::fused, weighting);
  // A face with four or more corners has more handles than triangles. The panel Cage counts triangles.
  const std::size_t triangles = document.cage()->surface.triangles.size();
  const std::size_t shown = weighting.elements == pose::Elements::face ? triangles : handles;
  return "Binding " + base::with_thousands(vertices) + " vertices to " + base::with_thousands(shown) + ' ' +
         std::string(pose::name(weighting.elements)) + ", " + base::memory_size(static_cast<double>(bytes));
}

UpAxis guessed_up(const OpenedSurface& model) {
  constexpr double matters = 0.05;
  const formats::Format* format = formats::format_of_description(model.format);
  if (format && format->up) return format->up == 'z' ? UpAxis::z : UpAxis::y;
  if (model.surface->triangles.empty()) return UpAxis::y;
  const mesh::Point middle = centroid(*model.surface);
  const double y = standing(*model.surface, model.bounds, middle, 1),
               z = standing(*model.surface, model.bounds, middle, 2);
  return z > matters && z > 3 * y ? UpAxis::z : UpAxis::y;
}

void record_edit(Document& document, const std::string& label, EditStep step) {
  document.changed_history().record(label, document.state(), step);
}

void record_step(Document& document, const std::string& label, EditStep step, bool merge) {
  if (!merge || document.history().last_step() != step) return record_edit(document, label, step);
  document.changed_history().extend_last();
}

EditMark mark_of(const Document& document) {
  return {document.state(), document.history().revision(), document.history().recorded()};
}

void take_back(Document& document, EditMark&& mark) {
  if (document.history().revision() == mark.revision) return;
  while (document.history().recorded() > mark.recorded && document.history().can_undo())
    (void)document.changed_history().drop_last();
  document.restore(std::move(mark.state));
}

bool moved_since(const Document& document, const DocumentState& before) {
  return document.pose().positions != before.pose.positions || document.probes() != before.probes ||
         !same_shape(document.shape(), before.shape);
}

void undo(Document& document) {
  document.restore(document.changed_history().undo(document.state()));
}

void redo(Document& document) {
  document.restore(document.changed_history().redo(document.state()));
}

void go_to_edit(Document& document, std::size_t edits) {
  const History& history = document.history();
  while (history.position() > edits && history.can_undo()) undo(document);
  while (history.position() < edits && history.can_redo()) redo(document);
}

void record_selection(Document& document, const Selection& before) {
  if (before == document.selection() || (before.empty() && document.selection().empty())) return;
  DocumentState state = document.state();
  state.selection = before;
  document.changed_history().record_selection(std::move(state));
}

}  // namespace viete::document
