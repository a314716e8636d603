#include "dragon/simplify.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

namespace viete::dragon {
namespace {

using Index = std::uint32_t;
constexpr double kLeastShapeliness = 0.05;
constexpr double kLengthCost =
    1.5e-4;  // of squared edge lengths against squared distances from planes, per area

/// The sum of squared distances to planes, weighted: x A x + 2 b x + c.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  Vec3 b;
  double c = 0;

  void add_plane(Vec3 n, double offset, double weight) {
    xx += weight * n.x * n.x, xy += weight * n.x * n.y, xz += weight * n.x * n.z;
    yy += weight * n.y * n.y, yz += weight * n.y * n.z, zz += weight * n.z * n.z;
    b = b + n * (weight * offset);
    c += weight * offset * offset;
  }

  void add(const Quadric& q) {
    xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
    b = b + q.b;
    c += q.c;
  }

  Vec3 apply(Vec3 p) const {
    return {xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z, xz * p.x + yz * p.y + zz * p.z};
  }

  double at(Vec3 p) const { return std::max(dot(p, apply(p)) + 2 * dot(b, p) + c, 0.0); }

  /// The best point near p: minimises the quadric plus pull |x - p|^2, which keeps the system regular.
  Vec3 best_near(Vec3 p, double pull) const {
    const double a00 = xx + pull, a11 = yy + pull, a22 = zz + pull;
    const Vec3 r = pull * p - b;
    const double c00 = a11 * a22 - yz * yz, c01 = xz * yz - xy * a22, c02 = xy * yz - xz * a11;
    const double c11 = a00 * a22 - xz * xz, c12 = xy * xz - a00 * yz, c22 = a00 * a11 - xy * xy;
    const double scale = 1 / (a00 * c00 + xy * c01 + xz * c02);
    return Vec3{c00 * r.x + c01 * r.y + c02 * r.z, c01 * r.x + c11 * r.y + c12 * r.z,
                c02 * r.x + c12 * r.y + c22 * r.z} *
           scale;
  }
};

struct Candidate {
  double cost;
  Index keep, drop;
  std::uint32_t stamp;  // of both ends when the cost was found
  Vec3 place;

  bool operator<(const Candidate& other) const {  // the cheapest comes out of the queue first
    return std::tie(cost, keep, drop) > std::tie(other.cost, other.keep, other.drop);
  }
};

/// Area over the sum of the squared sides: 0.29 for an equilateral triangle (with twice the area), 0 for a
/// needle.
double shapeliness(Vec3 a, Vec3 b, Vec3 c) {
  const double sides = dot(b - c, b - c) + dot(b - a, b - a) + dot(c - a, c - a);
  return length(cross(b - a, c - a)) / (2 * sides);
}

class Simplifier {
public:
  Simplifier(Mesh mesh, const Importance& importance);
  Mesh run(std::size_t vertices, double shortest);

private:
  Candidate candidate_for(Index a, Index b) const;
  bool allowed(const Candidate& candidate);
  void collapse_shorter_than(double limit);
  bool keeps_manifold(Index keep, Index drop);
  bool flips(Index vertex, Index other, Vec3 place) const;
  void collapse(const Candidate& candidate);
  const std::vector<Index>& neighbours(Index vertex, std::vector<Index>& into) const;
  Mesh compacted() const;

  Mesh mesh_;
  std::size_t left_;                        // vertices
  std::vector<std::vector<Index>> around_;  // triangles of each vertex
  std::vector<Quadric> quadrics_;
  std::vector<double> areas_;
  std::vector<std::uint32_t> stamps_;
  std::vector<char> gone_;  // triangles
  std::priority_queue<Candidate> queue_;
  std::vector<Index> ring_a_, ring_b_;
};

Simplifier::Simplifier(Mesh mesh, const Importance& importance)
    : mesh_(std::move(mesh)), left_(mesh_.positions.size()) {
  const std::size_t count = mesh_.positions.size();
  around_.resize(count), quadrics_.resize(count), areas_.resize(count), stamps_.resize(count);
  gone_.resize(mesh_.triangles.size());
  for (Index t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Vec3 normal =
        cross(mesh_.positions[b] - mesh_.positions[a], mesh_.positions[c] - mesh_.positions[a]);
    const double twice = length(normal), weight = twice / 6 * importance(mesh_.positions[a]);
    for (Index v : mesh_.triangles[t]) {
      around_[v].push_back(t);
      areas_[v] += weight;
      if (twice > 0)
        quadrics_[v].add_plane(normal * (1 / twice), -dot(normal, mesh_.positions[a]) / twice, weight);
    }
  }
}

const std::vector<Index>& Simplifier::neighbours(Index vertex, std::vector<Index>& into) const {
  into.clear();
  for (Index t : around_[vertex]) {
    for (Index v : mesh_.triangles[t]) {
      if (v != vertex) into.push_back(v);
    }
  }
  std::sort(into.begin(), into.end());
  into.erase(std::unique(into.begin(), into.end()), into.end());
  return into;
}

Candidate Simplifier::candidate_for(Index a, Index b) const {
  if (a > b) std::swap(a, b);
  Quadric both = quadrics_[a];
  both.add(quadrics_[b]);
  const double area = areas_[a] + areas_[b];
  const Vec3 middle = lerp(mesh_.positions[a], mesh_.positions[b], 0.5);
  const Vec3 place = both.best_near(middle, 1e-3 * area);
  const Vec3 edge = mesh_.positions[b] - mesh_.positions[a];
  const Vec3 moved = place - middle;
  const double cost = both.at(place) + kLengthCost * area * (dot(edge, edge) + 4 * dot(moved, moved));
  return {cost, a, b, stamps_[a] + stamps_[b], place};
}

/// The link condition: the ends share exactly the two vertices opposite their edge.
bool Simplifier::keeps_manifold(Index keep, Index drop) {
  const auto &a = neighbours(keep, ring_a_), &b = neighbours(drop, ring_b_);
  std::size_t shared = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j])
      ++shared, ++i, ++j;
    else
      a[i] < b[j] ? ++i : ++j;
  }
  const std::size_t merged = a.size() + b.size() - 4;
  return shared == 2 && merged >= 4 && merged <= 12;
}

/// Would a triangle of vertex that does not hold other turn over, or become a needle, if vertex went to
/// place?
bool Simplifier::flips(Index vertex, Index other, Vec3 place) const {
  for (Index t : around_[vertex]) {
    auto corner = mesh_.triangles[t];
    if (std::find(corner.begin(), corner.end(), other) != corner.end()) continue;
    while (corner[0] != vertex) std::rotate(corner.begin(), corner.begin() + 1, corner.end());
    const Vec3 b = mesh_.positions[corner[1]], c = mesh_.positions[corner[2]];
    const Vec3 before = cross(b - mesh_.positions[vertex], c - mesh_.positions[vertex]);
    const Vec3 after = cross(b - place, c - place);
    if (dot(before, after) < 0.2 * length(before) * length(after)) return true;
    if (shapeliness(place, b, c) < std::min(kLeastShapeliness, shapeliness(mesh_.positions[vertex], b, c)))
      return true;
  }
  return false;
}

bool Simplifier::allowed(const Candidate& c) {
  return keeps_manifold(c.keep, c.drop) && !flips(c.keep, c.drop, c.place) && !flips(c.drop, c.keep, c.place);
}

void Simplifier::collapse(const Candidate& candidate) {
  const auto [cost, keep, drop, stamp, place] = candidate;
  mesh_.positions[keep] = place;
  quadrics_[keep].add(quadrics_[drop]);
  areas_[keep] += areas_[drop];
  for (Index t : around_[drop]) {
    auto& corner = mesh_.triangles[t];
    if (std::find(corner.begin(), corner.end(), keep) != corner.end()) {
      gone_[t] = 1;
      for (Index v : corner) {
        if (v != drop) std::erase(around_[v], t);
      }
    } else {
      std::replace(corner.begin(), corner.end(), drop, keep);
      around_[keep].push_back(t);
    }
  }
  around_[drop].clear();
  stamps_[keep] = std::max(stamps_[keep], stamps_[drop]) + 1;
  --left_;
}

Mesh Simplifier::compacted() const {
  Mesh mesh;
  std::vector<Index> renamed(mesh_.positions.size());
  for (Index v = 0; v < renamed.size(); ++v) {
    if (around_[v].empty()) continue;
    renamed[v] = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back(mesh_.positions[v]);
  }
  for (Index t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& corner = mesh_.triangles[t];
    if (!gone_[t]) mesh.triangles.push_back({renamed[corner[0]], renamed[corner[1]], renamed[corner[2]]});
  }
  return mesh;
}

/// A first, quick pass without a queue: marching tetrahedra leave many edges of next to no length.
void Simplifier::collapse_shorter_than(double limit) {
  for (Index v = 0; v < mesh_.positions.size(); ++v) {
    for (Index n : std::vector<Index>(neighbours(v, ring_a_))) {
      const Vec3 edge = mesh_.positions[n] - mesh_.positions[v];
      if (dot(edge, edge) > limit * limit) continue;
      const Candidate candidate = candidate_for(v, n);
      if (!allowed(candidate)) continue;
      collapse(candidate);
      if (around_[v].empty()) break;
    }
  }
}

Mesh Simplifier::run(std::size_t vertices, double shortest) {
  collapse_shorter_than(shortest);
  for (Index t = 0; t < mesh_.triangles.size(); ++t) {
    if (gone_[t]) continue;
    const auto& corner = mesh_.triangles[t];
    for (int i = 0; i < 3; ++i) {
      if (corner[i] < corner[(i + 1) % 3]) queue_.push(candidate_for(corner[i], corner[(i + 1) % 3]));
    }
  }
  while (left_ > vertices && !queue_.empty()) {
    const Candidate candidate = queue_.top();
    queue_.pop();
    const auto [cost, keep, drop, stamp, place] = candidate;
    if (stamp != stamps_[keep] + stamps_[drop] || around_[keep].empty() || around_[drop].empty()) continue;
    if (!allowed(candidate)) continue;
    collapse(candidate);
    for (Index v : neighbours(keep, ring_a_)) queue_.push(candidate_for(keep, v));
  }
  return compacted();
}

}  // namespace

Mesh simplify(Mesh mesh, std::size_t vertices, double shortest, const Importance& importance) {
  return Simplifier(std::move(mesh), importance).run(vertices, shortest);
}

}  // namespace viete::dragon
