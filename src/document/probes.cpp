#include "document/probes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "document/pose_edit.h"
#include "mesh/normals.h"
#include "mesh/point_tree.h"

namespace viete::document {

namespace {

constexpr double usual_radius = 0.2;  // relative to the model's diagonal

std::string label(const char* verb, const Document& document) {
  const std::size_t n = document.selection().size();
  return std::string(verb) + (n == 1 ? " a probe" : ' ' + std::to_string(n) + " probes");
}

// Records an edit. Returns the probes, which the caller then changes.
pose::Probes& edit(Document& document, const std::string& name) {
  record_edit(document, name);
  return document.changed_probes();
}

// Calls `change` for each selected probe that is not locked.
template <class Change>
void change_free(Document& document, const Change& change) {
  auto& all = document.changed_probes().all;
  for (const auto i : document.selection().indices())
    if (!all[i].locked) change(all[i]);
}

template <class Change>
void change_selected(Document& document, const std::string& name, const Change& change) {
  record_edit(document, name);
  change_free(document, change);
}

void select(Document& document, std::size_t first, std::size_t end) {
  std::vector<std::uint32_t> added;
  for (std::size_t i = first; i < end; ++i) added.push_back(static_cast<std::uint32_t>(i));
  document.changed_selection() = Selection(ElementKind::probe, added);
}

std::uint32_t nearest_vertex(const Document& document, const PosedModel& posed, const mesh::Point& at) {
  const mesh::Surface& model = *document.model().surface;
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = 0;
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
    const double distance = mesh::squared_norm(at - posed.at(model, v));
    if (distance < least) {
      least = distance;
      nearest = v;
    }
  }
  return nearest;
}

// Returns the rest position of a point near the displayed model: uses the offset from the nearest vertex.
mesh::Point at_rest(const Document& document, const PosedModel& posed, const mesh::Point& at) {
  const mesh::Surface& model = *document.model().surface;
  const std::uint32_t v = nearest_vertex(document, posed, at);
  return model.positions[v] + (at - posed.at(model, v));
}

pose::Probe probe_at(const Document& document, const mesh::Point& place) {
  pose::Probe probe;
  probe.place = place;
  probe.turn = probe.stretch =
      probe.move = {pose::Falloff::smooth, usual_radius * document.space().diagonal()};
  return probe;
}

pose::Probe pin_of(const Document& document, std::uint32_t vertex) {
  pose::Probe probe = probe_at(document, document.model().surface->positions[vertex]);
  probe.pin = pose::Pin{vertex};
  probe.pose.move = shape_of_vertex(document, vertex) - probe.place;
  return probe;
}

}  // namespace

bool add_probe(Document& document, const PosedModel& posed, const mesh::Point& at) {
  if (document.probes().all.size() >= most_probes) return false;
  const pose::Probe probe = probe_at(document, at_rest(document, posed, at));
  edit(document, "add probe").all.push_back(probe);
  document.put_carried({});
  select(document, document.probes().all.size() - 1, document.probes().all.size());
  return true;
}

bool add_pin(Document& document, const PosedModel& posed, const mesh::Point& at) {
  const std::uint32_t vertex = nearest_vertex(document, posed, at);
  auto& all = document.changed_probes().all;
  const auto pins_it = [&](const pose::Probe& p) { return p.pin && p.pin->vertex == vertex; };
  const auto found = static_cast<std::size_t>(std::ranges::find_if(all, pins_it) - all.begin());
  if (found == all.size()) {
    if (all.size() >= most_probes) return false;
    edit(document, "pin vertex").all.push_back(pin_of(document, vertex));
    document.put_carried({});
  }
  select(document, found, found + 1);
  return true;
}

bool has_pins(const Document& document) {
  return std::ranges::any_of(document.probes().all, [](const pose::Probe& p) { return p.pin.has_value(); });
}

void set_pulls(Document& document, bool pulls) {
  change_selected(document, pulls ? "make pins soft" : "make pins hard", [pulls](pose::Probe& p) {
    if (p.pin) p.pin->pulls = pulls;
  });
}

void remove_probes(Document& document) {
  auto& all = edit(document, label("remove", document)).all;
  const auto& selected = document.selection().indices();
  for (auto i = selected.rbegin(); i != selected.rend(); ++i) {
    if (all[*i].locked) continue;
    all.erase(all.begin() + *i);
    forget_probe(document, *i);
  }
  document.put_carried({});
  document.changed_selection().clear();
}

bool has_free_probes(const Document& document) {
  if (document.selection().kind() != ElementKind::probe) return false;
  return std::ranges::any_of(document.selection().indices(),
                             [&](auto i) { return !document.probes().all[i].locked; });
}

void rest_probes(Document& document) {
  change_selected(document, label("reset", document), [](pose::Probe& p) { p.pose = {}; });
}

int symmetry_axis(const Document& document) {
  constexpr std::size_t samples = 256;
  const auto& points = document.model().surface->positions;
  const mesh::PointTree tree(points, mesh::first_numbers(points.size()));
  const mesh::Point middle = document.model().bounds.center();
  std::array<double, 3> off{};
  for (std::size_t n = 0; n < samples; ++n) {
    const mesh::Point& p = points[n * points.size() / samples];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh::Point image = p;
      image[axis] = 2 * middle[axis] - p[axis];
      off[axis] += mesh::norm(points[tree.nearest(image)] - image);
    }
  }
  return static_cast<int>(std::ranges::min_element(off) - off.begin());
}

bool mirror_probes(Document& document, int axis) {
  const std::size_t before = document.probes().all.size();
  if (before + document.selection().size() > most_probes) return false;
  auto& all = edit(document, label("mirror", document)).all;
  const double middle = document.model().bounds.center()[static_cast<std::size_t>(axis)];
  for (const auto i : document.selection().indices()) all.push_back(pose::mirrored(all[i], axis, middle));
  for (std::size_t i = before; i < all.size(); ++i)
    if (all[i].pin) all[i] = pin_of(document, nearest_vertex(document, {}, all[i].place));
  document.put_carried({});
  select(document, before, all.size());
  return true;
}

void set_locked(Document& document, bool locked) {
  auto& all = edit(document, label(locked ? "lock" : "unlock", document)).all;
  for (const auto i : document.selection().indices()) all[i].locked = locked;
}

namespace {

std::string part_label(Part part) {
  return part == &pose::Probe::turn      ? "change rotation of probes"
         : part == &pose::Probe::stretch ? "change stretch of probes"
                                         : "change translation of probes";
}

}  // namespace

void set_falloff(Document& document, Part part, pose::Falloff falloff) {
  change_selected(document, part_label(part), [&](pose::Probe& p) { (p.*part).falloff = falloff; });
}

void set_radius(Document& document, Part part, double radius) {
  const std::string name = part_label(part) + " (radius)";
  const DocumentState* before = document.history().before_last();
  const std::size_t number = part == &pose::Probe::turn ? 0 : part == &pose::Probe::stretch ? 1 : 2;
  record_step(document, name, {EditKind::probe_radius, number},
              before && before->selection == document.selection());
  change_free(document, [&](pose::Probe& probe) { (probe.*part).radius = radius; });
}

void set_mix(Document& document, pose::ProbeMix mix) {
  if (document.probes().mix != mix) edit(document, "change combination of probes").mix = mix;
}

double least_probe_radius(const Document& document) {
  return 0.01 * document.space().diagonal();
}
double largest_probe_radius(const Document& document) {
  return 2 * document.space().diagonal();
}

}  // namespace viete::document
