#include "deform/independent.h"

#include <map>

#include "sym3/quad_reference.h"

namespace viete::test {

namespace {

using Vector = std::array<Quad, 3>;
using Matrix = QuadMat;

const Quad whole_turn = 2 * M_PIq;

Vector quad(const std::array<double, 3>& p) {
  return {p[0], p[1], p[2]};
}
Vector plus(const Vector& a, const Vector& b, Quad times = 1) {
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}
Vector minus(const Vector& a, const Vector& b) {
  return plus(a, b, -1);
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Quad inner(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Quad length(const Vector& a) {
  return sqrtq(inner(a, a));
}
Vector times(const Matrix& m, const Vector& x) {
  return {inner({m[0], m[1], m[2]}, x), inner({m[3], m[4], m[5]}, x), inner({m[6], m[7], m[8]}, x)};
}
Matrix full(const QuadSym& s) {
  return {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz};
}
using Corners = std::array<Vector, 3>;

Corners corners(const mesh::Triangle& t, std::span<const mesh::Point> p) {
  return {quad(p[t[0]]), quad(p[t[1]]), quad(p[t[2]])};
}
Vector centroid(const Corners& t) {
  return plus({0, 0, 0}, plus(t[0], plus(t[1], t[2])), Quad(1) / 3);
}

// Returns two sides u and v of a triangle, and N / sqrt|N|, where N is the cross product of u and v.
Corners frame(const Corners& t) {
  const Vector u = minus(t[1], t[0]), v = minus(t[2], t[0]), n = cross(u, v);
  return {u, v, plus({0, 0, 0}, n, 1 / sqrtq(length(n)))};
}

// Returns the affine map [u' v' n'] * [u v n]^-1.
Matrix affine_map(const Corners& rest, const Corners& posed) {
  const auto columns = [](const Corners& c) {
    return Matrix{c[0][0], c[1][0], c[2][0], c[0][1], c[1][1], c[2][1], c[0][2], c[1][2], c[2][2]};
  };
  return quad_product(columns(posed), quad_inverse(columns(rest)));
}

// Computes the unit quaternion from its largest component, and then the log from the quaternion.
Vector log_of_rotation(const Matrix& r) {
  const Quad trace = r[0] + r[4] + r[8];
  const std::array<Quad, 4> squares = {1 + trace, 1 + 2 * r[0] - trace, 1 + 2 * r[4] - trace,
                                       1 + 2 * r[8] - trace};  // four times the squares of w, x, y, z
  const auto largest = std::max_element(squares.begin(), squares.end()) - squares.begin();
  const Quad root = sqrtq(squares[largest]), wx = r[7] - r[5], wy = r[2] - r[6], wz = r[3] - r[1];
  const Quad xy = r[1] + r[3], xz = r[2] + r[6], yz = r[5] + r[7];
  const Quad products[4][4] = {
      {squares[0], wx, wy, wz}, {wx, squares[1], xy, xz}, {wy, xy, squares[2], yz}, {wz, xz, yz, squares[3]}};
  const auto& row = products[largest];
  const Quad sign = row[0] < 0 ? -1 : 1, w = sign * row[0] / (2 * root);
  const Vector v = plus({0, 0, 0}, {row[1], row[2], row[3]}, sign / (2 * root));
  const Quad sine = length(v);
  return sine > 0 ? plus({0, 0, 0}, v, 2 * atan2q(sine, w) / sine) : v;
}

// Returns the branch of v that is nearest to `other`.
Vector nearest(const Vector& v, const Vector& other) {
  const Quad angle = length(v);
  if (angle == 0) return v;
  const Quad turns = roundq((inner(v, other) / angle - angle) / whole_turn);
  return plus(v, v, turns * whole_turn / angle);
}

constexpr Matrix identity = quad_identity;

struct Element {
  Vector rest_center, center, turn{};  // `turn` is the log of the rotation
  Matrix map = identity, rotation = identity;
  QuadSym log_of_stretch{};
};

Element element(const Matrix& m, const Vector& rest_center, const Vector& center) {
  const QuadSym squared = gram(m);
  Element e{rest_center, center};
  e.map = m;
  e.rotation = quad_product(m, full(quad_inv_sqrt(squared)));
  e.turn = log_of_rotation(e.rotation);
  e.log_of_stretch = quad_function(squared, [](Quad x) { return logq(x) / 2; });
  return e;
}

using Lists = std::vector<std::vector<std::size_t>>;

// Returns, for each member, the other members of all its groups.
Lists beside(const Lists& groups, std::size_t members) {
  Lists result(members);
  for (const auto& group : groups)
    for (const auto a : group)
      for (const auto b : group)
        if (a != b) result[a].push_back(b);
  return result;
}

using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>>;

// Returns the sides at each edge. Side 3 * t + i goes from corner i of triangle t to the next corner.
Edges sides_of_edges(const mesh::Surface& cage) {
  Edges edges;
  for (std::size_t side = 0; side < 3 * cage.triangles.size(); ++side) {
    const auto& t = cage.triangles[side / 3];
    const auto a = t[side % 3], b = t[(side + 1) % 3];
    edges[{std::min(a, b), std::max(a, b)}].push_back(side);
  }
  return edges;
}

Lists triangles_by_edge(const mesh::Surface& cage) {
  Lists groups;
  for (const auto& [edge, sides] : sides_of_edges(cage)) {
    groups.emplace_back();
    for (const auto side : sides) groups.back().push_back(side / 3);
  }
  return groups;
}

struct Maps {
  std::vector<Element> elements;
  Lists around;
};

using Points = std::span<const mesh::Point>;

Maps face_maps(const mesh::Surface& cage, Points posed) {
  Maps maps{{}, beside(triangles_by_edge(cage), cage.triangles.size())};
  for (std::size_t t = 0; t < cage.triangles.size(); ++t) {
    const Corners rest = corners(cage.triangles[t], cage.positions), to = corners(cage.triangles[t], posed);
    maps.elements.push_back(element(affine_map(frame(rest), frame(to)), centroid(rest), centroid(to)));
  }
  return maps;
}

// Returns twice the largest distance from a vertex to the area centroid.
Quad size_of(const mesh::Surface& cage) {
  Vector center{};
  Quad total = 0;
  for (const auto& t : cage.triangles) {
    const Corners c = corners(t, cage.positions);
    const Quad area = length(cross(minus(c[1], c[0]), minus(c[2], c[0])));
    center = plus(center, centroid(c), area);
    total += area;
  }
  center = plus({}, center, 1 / total);
  Quad farthest = 0;
  for (const auto& p : cage.positions) farthest = std::max(farthest, length(minus(quad(p), center)));
  return 2 * farthest;
}

// Computes logs breadth-first from the first element. Also sums the squares of (log - `reference`).
std::pair<std::vector<Vector>, Quad> follow(const std::vector<Element>& elements, const Lists& around,
                                            const Vector& first, const Vector& reference) {
  std::vector<Vector> turns(elements.size());
  std::vector<std::size_t> order = {0};
  std::vector<bool> reached(elements.size());
  turns[0] = first;
  reached[0] = true;
  Quad distance = 0;
  for (std::size_t n = 0; n < order.size(); ++n) {
    const Vector off = minus(turns[order[n]], reference);
    distance += inner(off, off);
    for (const auto next : around[order[n]]) {
      if (reached[next]) continue;
      reached[next] = true;
      turns[next] = nearest(elements[next].turn, turns[order[n]]);
      order.push_back(next);
    }
  }
  return {turns, distance};
}

void choose_turns(std::vector<Element>& elements, const Lists& around, const Vector& reference) {
  const Vector first = elements[0].turn;
  std::vector<Vector> best;
  Quad least = HUGE_VALQ;
  for (int turns = -2; turns <= 2; ++turns) {
    auto [logs, distance] =
        follow(elements, around, plus(first, first, turns * whole_turn / length(first)), reference);
    if (distance < least) {
      least = distance;
      best = std::move(logs);
    }
  }
  for (std::size_t j = 0; j < elements.size(); ++j) elements[j].turn = best[j];
}

Quad squared_distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector edge = minus(b, a);
  const Quad t = inner(minus(p, a), edge) / inner(edge, edge);
  const Vector off = minus(p, plus(a, edge, t < 0 ? 0 : t > 1 ? 1 : t));
  return inner(off, off);
}

Quad squared_distance(const Vector& p, const Corners& t) {
  const Vector n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  bool inside = true;
  Quad edges = HUGE_VALQ;
  for (int i = 0; i < 3; ++i) {
    const Vector &a = t[i], &b = t[(i + 1) % 3];
    inside = inside && inner(cross(minus(b, a), minus(p, a)), n) > 0;
    edges = std::min(edges, squared_distance_to_segment(p, a, b));
  }
  const Quad height = inner(minus(p, t[0]), n);
  return inside ? height * height / inner(n, n) : edges;
}

Quad sum_of(const std::vector<Quad>& numbers) {
  Quad sum = 0;
  for (const Quad x : numbers) sum += x;
  return sum;
}

void divide_by_sum(std::vector<Quad>& weights) {
  const Quad sum = sum_of(weights);
  for (Quad& w : weights) w /= sum;
}

std::vector<Quad> squared_distances(const Vector& p, const mesh::Surface& cage, pose::Elements elements) {
  std::vector<Quad> squares;
  const auto& x = cage.positions;
  if (elements == pose::Elements::point) {
    for (const auto& v : x) squares.push_back(inner(minus(p, quad(v)), minus(p, quad(v))));
  } else {
    for (const auto& t : cage.triangles) squares.push_back(squared_distance(p, corners(t, x)));
  }
  return squares;
}

std::vector<Quad> inverse_distance(const std::vector<Quad>& squares) {
  std::vector<Quad> weights;
  for (const Quad s : squares) weights.push_back(1 / s);
  divide_by_sum(weights);
  return weights;
}

// Returns cut-off weights. The sum of the weights is the fraction of the motion that the point follows.
std::vector<Quad> cut_off(const std::vector<Quad>& squares, Quad radius) {
  std::vector<Quad> weights;
  Quad sum = 0;
  for (const Quad s : squares) {
    const Quad left = 1 - sqrtq(s) / radius;
    weights.push_back(left > 0 ? left * left : 0);
    sum += weights.back();
  }
  if (sum > 1) divide_by_sum(weights);
  return weights;
}

// Adds the weights of one triangle, in the notation of the paper.
void add_mean_values(const Vector& p, const mesh::Triangle& t, const mesh::Surface& cage,
                     std::vector<Quad>& weights) {
  Corners u = corners(t, cage.positions);
  Vector d, theta, c, s;
  for (int i = 0; i < 3; ++i) {
    const Vector offset = minus(u[i], p);
    d[i] = length(offset);
    u[i] = plus({0, 0, 0}, offset, 1 / d[i]);
  }
  for (int i = 0; i < 3; ++i) theta[i] = 2 * asinq(length(minus(u[(i + 1) % 3], u[(i + 2) % 3])) / 2);
  const Quad h = (theta[0] + theta[1] + theta[2]) / 2;
  const Quad side = inner(u[0], cross(u[1], u[2])) < 0 ? -1 : 1;
  for (int i = 0; i < 3; ++i) {
    c[i] = 2 * sinq(h) * sinq(h - theta[i]) / (sinq(theta[(i + 1) % 3]) * sinq(theta[(i + 2) % 3])) - 1;
    s[i] = side * sqrtq(1 - c[i] * c[i]);
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    weights[t[i]] += (theta[i] - c[j] * theta[k] - c[k] * theta[j]) / (d[i] * sinq(theta[j]) * s[k]);
  }
}

std::vector<Quad> mean_value(const Vector& p, const mesh::Surface& cage) {
  std::vector<Quad> weights(cage.positions.size());
  for (const auto& t : cage.triangles) add_mean_values(p, t, cage, weights);
  divide_by_sum(weights);
  return weights;
}

std::array<Quad, 6> entries(const QuadSym& s) {
  return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
}

Vector by_logs(const Vector& x, const std::vector<Element>& elements, const std::vector<Quad>& weights) {
  Vector offset = x, turn{}, center{};
  std::array<Quad, 6> sum{};
  for (std::size_t j = 0; j < elements.size(); ++j) {
    const Element& e = elements[j];
    const Quad w = weights[j];
    const std::array<Quad, 6> log = entries(e.log_of_stretch);
    for (int i = 0; i < 6; ++i) sum[i] += w * log[i];
    offset = plus(offset, e.rest_center, -w);
    turn = plus(turn, e.turn, w);
    center = plus(center, e.center, w);
  }
  const Matrix stretch = full(quad_exp({sum[0], sum[1], sum[2], sum[3], sum[4], sum[5]}));
  return plus(times(quad_rotation(turn), times(stretch, offset)), center);
}

Vector by_maps(const Vector& x, const std::vector<Element>& elements, const std::vector<Quad>& weights) {
  Vector sum{};
  for (std::size_t j = 0; j < elements.size(); ++j) {
    const Element& e = elements[j];
    sum = plus(sum, plus(times(e.map, minus(x, e.rest_center)), e.center), weights[j]);
  }
  return sum;
}

Vector mean(const std::vector<mesh::Point>& points, const std::vector<Quad>& weights) {
  Vector sum{};
  for (std::size_t j = 0; j < points.size(); ++j) sum = plus(sum, quad(points[j]), weights[j]);
  return sum;
}

// The affine map is B * K^-1, with B = sum v * (p' - m') * (p - m)^T and K = sum v * (p - m) * (p - m)^T. The
// factors v are the positive weights; m and m' are the means of p and p'. Each point p stands for a cloud of
// points, which moves by the map of the patch at p. The rotation is B * (B^T * B)^-1/2; B must not mirror.
Vector by_least_squares(const Vector& x, const mesh::Surface& cage, const IndependentPose& pose,
                        const std::vector<Quad>& weights, pose::Blend blend) {
  const Vector from = mean(cage.positions, weights), to = mean(pose.positions, weights);
  std::vector<Quad> positive;
  for (const Quad w : weights) positive.push_back(w > 0 ? w : 0);
  divide_by_sum(positive);
  const Vector m = mean(cage.positions, positive), posed_m = mean(pose.positions, positive);
  const Quad square = Quad(pose.moment_length) * pose.moment_length;
  Matrix b{}, k{};
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const Vector p = minus(quad(cage.positions[j]), m), q = minus(quad(pose.positions[j]), posed_m);
    for (int i = 0; i < 9; ++i) {
      b[i] += positive[j] * (q[i / 3] * p[i % 3] + square * pose.patches[j].linear[i]);
      k[i] += positive[j] * (p[i / 3] * p[i % 3] + square * identity[i]);
    }
  }
  const Vector offset = minus(x, from);
  if (blend == pose::Blend::mls_affine) return plus(to, times(quad_product(b, quad_inverse(k)), offset));
  const QuadSym squared = gram(b);
  const Vector turned = times(quad_product(b, full(quad_inv_sqrt(squared))), offset);
  if (blend == pose::Blend::mls_rigid) return plus(to, turned);
  const QuadSym s = quad_function(squared, [](Quad y) { return sqrtq(y); });
  return plus(to, turned, (s.xx + s.yy + s.zz) / (k[0] + k[4] + k[8]));
}

double largest_step(const std::vector<Element>& elements, const Lists& around) {
  Quad least = 3;  // trace of A^T B = 1 + 2 cos(angle between the rotations A and B)
  for (std::size_t j = 0; j < elements.size(); ++j)
    for (const auto n : around[j]) {
      Quad trace = 0;
      for (int i = 0; i < 9; ++i) trace += elements[j].rotation[i] * elements[n].rotation[i];
      least = std::min(least, trace);
    }
  return std::acos(static_cast<double>((least - 1) / 2));
}

std::vector<Quad> weights_at(const Vector& x, const mesh::Surface& cage, const pose::Weighting& weighting) {
  if (weighting.weights == pose::Weights::mean_value) return mean_value(x, cage);
  const auto squares = squared_distances(x, cage, weighting.elements);
  if (weighting.weights == pose::Weights::cut_off) return cut_off(squares, weighting.radius * size_of(cage));
  return inverse_distance(squares);
}

// If the weights sum to less than 1, the identity about x gets the remaining weight.
Vector by_elements(const Vector& x, std::vector<Element> elements, std::vector<Quad> weights,
                   pose::Blend blend) {
  elements.push_back({x, x});
  weights.push_back(1 - sum_of(weights));
  return blend == pose::Blend::srl ? by_logs(x, elements, weights) : by_maps(x, elements, weights);
}

Vector moved_by(const Vector& x, const mesh::Surface& cage, const IndependentPose& pose,
                const std::vector<Element>& elements, const std::vector<Quad>& w,
                const pose::Deformer& deformer) {
  if (pose::fits_points(deformer.blend)) {
    const Quad share = sum_of(w);
    if (!(share > 0)) return x;
    auto whole = w;
    divide_by_sum(whole);
    return plus(x, minus(by_least_squares(x, cage, pose, whole, deformer.blend), x), share);
  }
  if (deformer.weighting.elements == pose::Elements::point)
    return plus(x, minus(mean(pose.positions, w), mean(cage.positions, w)));
  return by_elements(x, elements, w, deformer.blend);
}

}  // namespace

IndependentFrame deform_independently(std::span<const mesh::Point> points, const mesh::Surface& cage,
                                      const IndependentPose& pose, const pose::Deformer& deformer) {
  Maps maps;
  if (deformer.has_maps()) {
    maps = face_maps(cage, pose.positions);
    choose_turns(maps.elements, maps.around, quad(pose.turn));
  }
  IndependentFrame frame{{}, largest_step(maps.elements, maps.around)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector x = quad(points[i]);
    std::vector<Quad> weights;
    if (deformer.weighting.on_surface()) {
      const std::size_t handles = pose.weights.size() / points.size();
      const auto row = pose.weights.subspan(i * handles, handles);
      weights.assign(row.begin(), row.end());
    } else {
      weights = weights_at(x, cage, deformer.weighting);
    }
    const Vector moved = moved_by(x, cage, pose, maps.elements, weights, deformer);
    frame.positions.push_back(
        {static_cast<double>(moved[0]), static_cast<double>(moved[1]), static_cast<double>(moved[2])});
  }
  return frame;
}

}  // namespace viete::test
