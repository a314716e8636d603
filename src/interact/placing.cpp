#include "interact/placing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "document/elements.h"
#include "document/range.h"
#include "document/record.h"
#include "document/space.h"
#include "pose/branches.h"
#include "pose/cage_state.h"
#include "pose/maps.h"
#include "sym3/affine.h"

namespace viete::interact {

namespace {

constexpr double turn_rounding = 1e-6;
constexpr double largest_step = 30;  // in degrees; small enough to count whole turns reliably

struct Motion {
  document::Document& document;
  const pose::Pose& before;
  const Grip& grip;
  Transform transform;

  void show(double degrees) {
    transform.degrees = degrees;
    move_gripped(transform, grip, before.positions, document.changed_pose().positions);
  }

  // Rotates in small steps, and updates the turns of the pose after each step.
  void follow(double from, double to) {
    const int steps = static_cast<int>(std::ceil(std::abs(to - from) / largest_step));
    pose::CageState cage(document.cage(), pose::Elements::face, pose::Blend::srl);
    for (int i = 1; i <= steps; ++i) {
      show(from + (to - from) * i / steps);
      cage.set_pose(document.pose());
      document.changed_pose().turns = cage.report().turns;
    }
  }

  // Adds `count` whole turns. Rotates only once, and multiplies the change of the pose's turns by |count|.
  void follow_whole(double from, int count) {
    if (count == 0) return;
    auto& turns = document.changed_pose().turns;
    turns.resize(document.cage()->roots.size(), {0, 0, 0});
    const auto start = turns;
    follow(from, from + std::copysign(360, count));
    for (std::size_t part = 0; part < turns.size(); ++part) {
      turns[part] = start[part] + std::abs(count) * (turns[part] - start[part]);
    }
  }
};

// Returns the rotation axis of each part of the cage; (0, 0, 0) for a part that does not rotate rigidly.
std::vector<mesh::Vec3> axes_of_parts(const pose::Cage& cage, const Grip& grip, const glm::dvec3& axis) {
  const mesh::Vec3 own{axis.x, axis.y, axis.z}, other = -1.0 * document::reflected_direction(grip.plane, own),
                                                none{};
  std::vector<mesh::Vec3> of_vertex(cage.surface.positions.size()), of_part(cage.roots.size());
  for (const Gripped& g : grip.vertices)
    if (g.share == 1 && g.side != Gripped::Side::plane)
      of_vertex[g.vertex] = g.side == Gripped::Side::own ? own : other;
  std::vector<bool> seen(cage.roots.size());
  for (std::size_t e = 0; e < cage.element_count(); ++e) {
    const auto part = cage.parts[e];
    if (part >= of_part.size()) continue;
    for (const auto v : cage.elements.triangles[e]) {
      if (v >= of_vertex.size()) continue;  // the center of a polygon
      const bool first = !seen[part];
      seen[part] = true;
      of_part[part] = first || of_part[part] == of_vertex[v] ? of_vertex[v] : none;
    }
  }
  return of_part;
}

// `rotation` is a rotation vector. Returns its angle about `axis`, in radians in [-pi, pi].
double twist(const mesh::Vec3& rotation, const mesh::Vec3& axis) {
  const double half = mesh::norm(rotation) / 2;
  return half == 0 ? 0
                   : 2 * std::atan2(std::sin(half) * mesh::dot(rotation, axis) / (2 * half), std::cos(half));
}

std::vector<mesh::Vec3> least_turns(const document::Document& document,
                                    const std::vector<mesh::Point>& positions) {
  pose::CageState state(document.cage(), pose::Elements::face, pose::Blend::srl);
  state.set_pose({positions, {}});
  return state.report().turns;
}

// `turn` is a rotation vector with whole turns; `least` is the same rotation without whole turns. If the
// whole turns are about `axis`, returns their number. Otherwise returns nullopt.
std::optional<double> turns_about(const mesh::Vec3& axis, const mesh::Vec3& turn, const mesh::Vec3& least) {
  constexpr double same_axis = 1e-6;
  const double count = pose::whole_turns(turn, least), along = mesh::dot(turn, axis);
  if (count == 0) return 0;
  if (mesh::norm(turn - along * axis) > same_axis * mesh::norm(turn)) return std::nullopt;
  return std::copysign(count, along);
}

bool is_in_range(const document::Document& document, const Grip& grip) {
  const pose::Pose& pose = document.pose();
  return mesh::bounds(pose.positions).diagonal() <= document::most_drawn &&
         std::all_of(
             grip.vertices.begin(), grip.vertices.end(),
             [&](const Gripped& g) { return is_in_reach(document.space(), pose.positions[g.vertex]); }) &&
         std::all_of(pose.turns.begin(), pose.turns.end(),
                     [](const auto& turn) { return mesh::norm(turn) <= document::largest_turn; });
}

pose::ProbePose moved(const pose::Probe& probe, const document::Carried& carried, const Transform& t) {
  pose::ProbePose result = probe.pose;
  if (!probe.pin) {
    if (t.factors != glm::dvec3(1)) result = pose::scaled(result, document::point_of(t.factors));
    if (t.degrees != 0)
      result = pose::turned(result, document::point_of(t.axis), t.degrees / 180 * std::acos(-1.0));
  }
  const mesh::Point from = carried.place + pose::times(carried.map, probe.pose.move);
  const mesh::Point to = PointMotion(t)(from, t.pivot);
  result.move = probe.pose.move + pose::times(sym3::inverse({carried.map, {}}).linear, to - from);
  return result;
}

bool in_range(const document::Document& document, std::size_t i) {
  const pose::ProbePose& pose = document.probes().all[i].pose;
  return is_in_reach(document.space(), probe_center(document, i)) &&
         mesh::norm(pose.turn) <= document::largest_turn && document::is_probe_stretch(pose.stretch);
}

}  // namespace

bool place(document::Document& document, const document::DocumentState& snapshot, const Grip& grip,
           const Transform& transform, double degrees_seen) {
  if (snapshot.selection.kind() == document::ElementKind::probe)
    return place_probes(document, snapshot, transform);
  const pose::Pose& before = snapshot.pose;
  Motion motion{document, before, grip, transform};
  const double jump = transform.degrees - degrees_seen;
  if (std::abs(jump) > largest_step) {
    const int whole = static_cast<int>(jump / 360);
    motion.follow_whole(degrees_seen, whole);
    motion.follow(degrees_seen + 360.0 * whole, transform.degrees);
  }
  motion.show(transform.degrees);
  if (is_in_range(document, grip)) return true;
  document.changed_pose() = before;
  return false;
}

// A part stores whole turns about one axis only. New turns about another axis replace the stored turns.
void count_whole_turns(document::Document& document, const document::DocumentState& before, const Grip& grip,
                       const Transform& t) {
  if (t.degrees == 0 || !document.has_cage() || grip.shaping.shape != Shape::none) return;
  const auto axes = axes_of_parts(*document.cage(), grip, t.axis);
  if (std::ranges::all_of(axes, [](const mesh::Vec3& axis) { return axis == mesh::Vec3{}; })) return;
  const auto from = least_turns(document, before.pose.positions);
  const auto to = least_turns(document, document.pose().positions);
  auto& turns = document.changed_pose().turns;
  turns.resize(axes.size(), {0, 0, 0});
  for (std::size_t part = 0; part < axes.size(); ++part) {
    const mesh::Vec3& axis = axes[part];
    if (axis == mesh::Vec3{}) continue;
    const bool known = part < before.pose.turns.size();
    const auto had = known ? turns_about(axis, before.pose.turns[part], from[part]) : 0;
    const double turned_by = twist(from[part], axis) + glm::radians(t.degrees) - twist(to[part], axis);
    const double made = std::round(turned_by / (2 * std::numbers::pi));
    if (made == 0 && (!had || *had == 0)) continue;
    const double count = had.value_or(0) + made;
    const mesh::Vec3 turned = count == 0 ? to[part] : pose::with_whole_turns(axis, count, to[part]);
    if (mesh::norm(turned - turns[part]) > turn_rounding * (1 + mesh::norm(turned))) turns[part] = turned;
  }
}

bool transform_selection(document::Document& document, Tool tool, const Grip& grip,
                         const Transform& transform) {
  const document::DocumentState before = document.state();
  Transform bounded = transform;
  bounded.degrees = std::clamp(transform.degrees, -most_degrees, most_degrees);
  if (!place(document, before, grip, bounded, 0)) return false;
  count_whole_turns(document, before, grip, bounded);
  if (moved_since(document, before) || transform.degrees != 0)
    document.changed_history().record(edit_label(tool, document.selection()), before);
  return true;
}

std::string edit_label(Tool tool, const document::Selection& selection) {
  const std::string verb = tool == Tool::rotate ? "rotate" : tool == Tool::scale ? "scale" : "move";
  return verb + ' ' + counted(selection.kind(), selection.size());
}

bool place_probes(document::Document& document, const document::DocumentState& before,
                  const Transform& transform) {
  bool fits = true;
  pose::Probes& probes = document.changed_probes();
  for (const auto i : before.selection.indices()) {
    pose::Probe& probe = probes.all[i];
    if (probe.locked) continue;
    probe.pose = moved(before.probes.all[i], carried_probe(document, i), transform);
    fits &= in_range(document, i);
  }
  if (!fits) probes = before.probes;
  return fits;
}

}  // namespace viete::interact
