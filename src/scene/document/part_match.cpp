#include "scene/document/part_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "deform/polar.h"
#include "scene/document/vectors.h"

namespace viete::scene {

namespace {

constexpr std::uint32_t no_image = std::numeric_limits<std::uint32_t>::max();

// The faces of a part, by their corners: a corner is also the side that leads from it to the next one.
class PartFaces {
public:
  PartFaces(const mesh::Surface& surface, std::span<const std::uint32_t> part) : surface_(surface) {
    std::vector<std::uint8_t> within(surface.positions.size(), 0);
    for (const auto v : part) within[v] = 1;
    face_of_.assign(surface.corners.size(), no_image);
    degrees_.assign(surface.positions.size(), 0);
    hangs_.assign(surface.positions.size(), 0);
    for (std::uint32_t f = 0; f < surface.polygon_count(); ++f) {
      const auto first = surface.polygon_starts[f], end = surface.polygon_starts[f + 1];
      const bool whole = std::all_of(surface.corners.begin() + first, surface.corners.begin() + end,
                                     [&](auto v) { return within[v]; });
      if (whole) add(f, first, end);
      if (!whole) meet(first, end, within);
    }
  }

  /// One corner after the other, of all faces.
  const std::vector<std::uint32_t>& corners() const { return corners_; }
  std::size_t face_count() const { return faces_; }
  std::uint32_t vertex(std::uint32_t corner) const { return surface_.corners[corner]; }
  std::uint32_t face(std::uint32_t corner) const { return face_of_[corner]; }
  /// True if a face leads from the vertex to the rest of the cage.
  bool hangs(std::uint32_t v) const { return hangs_[v] != 0; }
  /// The middle of what these faces have beyond the part; nothing where it hangs on nothing.
  std::optional<mesh::Point> hinge() const {
    if (beyond_ == 0) return std::nullopt;
    const glm::dvec3 middle = sum_beyond_ / static_cast<double>(beyond_);
    return point_of(middle);
  }
  /// Faces at a vertex.
  std::uint32_t degree(std::uint32_t v) const { return degrees_[v]; }
  std::uint32_t size(std::uint32_t corner) const {
    const auto f = face_of_[corner];
    return surface_.polygon_starts[f + 1] - surface_.polygon_starts[f];
  }
  /// Around its face; steps may be negative.
  std::uint32_t around(std::uint32_t corner, std::int64_t steps) const {
    const std::int64_t first = surface_.polygon_starts[face_of_[corner]], n = size(corner);
    return static_cast<std::uint32_t>(first + ((corner - first + steps) % n + n) % n);
  }
  /// The same side of the neighbour; nothing at a rim.
  std::optional<std::uint32_t> twin(std::uint32_t corner) const {
    const auto found = sides_.find(side(vertex(around(corner, 1)), vertex(corner)));
    return found == sides_.end() ? std::nullopt : std::optional(found->second);
  }

private:
  static std::uint64_t side(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; }
  // A face of which a part at most is of this one.
  void meet(std::uint32_t first, std::uint32_t end, const std::vector<std::uint8_t>& within) {
    const auto is_within = [&](std::uint32_t c) { return within[vertex(c)] != 0; };
    bool touches = false;
    for (auto c = first; c < end; ++c) touches |= is_within(c);
    for (auto c = first; c < end && touches; ++c) {
      if (is_within(c)) {
        hangs_[vertex(c)] = 1;
      } else {
        sum_beyond_ += vector_of(surface_.positions[vertex(c)]), ++beyond_;
      }
    }
  }
  void add(std::uint32_t f, std::uint32_t first, std::uint32_t end) {
    ++faces_;
    for (auto c = first; c < end; ++c) face_of_[c] = f, corners_.push_back(c), ++degrees_[vertex(c)];
    for (auto c = first; c < end; ++c) sides_.emplace(side(vertex(c), vertex(around(c, 1))), c);
  }

  const mesh::Surface& surface_;
  std::vector<std::uint32_t> face_of_, corners_, degrees_;
  std::unordered_map<std::uint64_t, std::uint32_t> sides_;
  std::vector<std::uint8_t> hangs_;
  glm::dvec3 sum_beyond_{0, 0, 0};
  std::size_t beyond_ = 0, faces_ = 0;
};

// Walks over both parts at once, from a side of each that is to be the same; in a mirror the other one is run
// round backwards.
class PartWalk {
public:
  PartWalk(const PartFaces& one, const PartFaces& other, std::size_t vertices, bool mirrored)
      : one_(one),
        other_(other),
        mirrored_(mirrored),
        images_(vertices, no_image),
        originals_(vertices, no_image) {}

  /// False where they are not the same.
  bool run(std::uint32_t side, std::uint32_t image) {
    std::vector<std::array<std::uint32_t, 2>> open;
    if (!take(side, image, open)) return false;
    while (!open.empty()) {
      const auto [c, d] = open.back();
      open.pop_back();
      const auto next = one_.twin(c), next_image = other_.twin(d);
      if (next.has_value() != next_image.has_value()) return false;
      if (!next) continue;
      if (const auto known = faces_.find(one_.face(*next)); known != faces_.end()) {
        if (known->second != other_.face(*next_image)) return false;
      } else if (!take(*next, *next_image, open)) {
        return false;
      }
    }
    return faces_.size() == one_.face_count();
  }
  std::uint32_t image(std::uint32_t v) const { return images_[v]; }

private:
  // The face at one side, with all its corners and sides.
  bool take(std::uint32_t c, std::uint32_t d, std::vector<std::array<std::uint32_t, 2>>& open) {
    const auto n = static_cast<std::int64_t>(one_.size(c));
    if (other_.size(d) != one_.size(c)) return false;
    faces_[one_.face(c)] = other_.face(d);
    for (std::int64_t k = 0; k < n; ++k) {
      const auto corner = other_.around(d, mirrored_ ? 1 - k : k);
      if (!pair(one_.vertex(one_.around(c, k)), other_.vertex(corner))) return false;
      open.push_back({one_.around(c, k), other_.around(d, mirrored_ ? -k : k)});
    }
    return true;
  }
  bool pair(std::uint32_t v, std::uint32_t image) {
    if (images_[v] == no_image && originals_[image] == no_image) images_[v] = image, originals_[image] = v;
    return images_[v] == image && originals_[image] == v && one_.hangs(v) == other_.hangs(image);
  }

  const PartFaces &one_, &other_;
  bool mirrored_;
  std::vector<std::uint32_t> images_, originals_;
  std::unordered_map<std::uint32_t, std::uint32_t> faces_;
};

// Where walks begin: at the vertex that is known, or at one of a kind of which there are fewest.
std::optional<std::uint32_t> start_of(const PartFaces& faces, std::optional<KnownImage> known) {
  std::unordered_map<std::uint32_t, std::size_t> count;
  for (const auto c : faces.corners()) ++count[faces.degree(faces.vertex(c))];
  std::optional<std::uint32_t> start;
  for (const auto c : faces.corners()) {
    const auto v = faces.vertex(c);
    if (known ? v == known->vertex
              : !start || count[faces.degree(v)] < count[faces.degree(faces.vertex(*start))])
      start = c;
  }
  return start;
}

// How far a fit turns, in radians; a reflection the same, which has no angle: as a half turn and more.
double turn_of(const PartFit& fit) {
  const double scale = std::cbrt(std::abs(glm::determinant(fit.linear)));
  const double trace = scale > 0 ? (fit.linear[0][0] + fit.linear[1][1] + fit.linear[2][2]) / scale : 3;
  return std::acos(std::clamp((std::min(trace, 3.0) - 1) / 2, -1.0, 1.0));
}

// Clearly better at rest, or as good and turned less.
bool is_better(const PartFit& a, const PartFit& b) {
  constexpr double same = 1e-6;
  if (std::abs(a.miss - b.miss) > same) return a.miss < b.miss;
  return turn_of(a) < turn_of(b) - same;
}

}  // namespace

PartFit fit_of(std::span<const mesh::Point> points, std::span<const mesh::Point> images, bool mirrored) {
  PartFit fit;
  const double share = 1 / static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    fit.from += share * vector_of(points[i]), fit.to += share * vector_of(images[i]);
  glm::dmat3 sum(0);
  double size = 0, image_size = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 a = vector_of(points[i]) - fit.from, b = vector_of(images[i]) - fit.to;
    sum += glm::outerProduct(b, a);
    size += glm::dot(a, a), image_size += glm::dot(b, b);
  }
  if (!(size > 0) || !(image_size > 0)) return fit;
  const double sign = mirrored ? -1 : 1;
  sym3::Mat3<double> rows{};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      rows[static_cast<std::size_t>(3 * r + c)] = sign * sum[c][r] / std::sqrt(size * image_size);
  }
  const auto rotation = deform::polar(rows).rotation;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      fit.linear[c][r] = sign * std::sqrt(image_size / size) * rotation[static_cast<std::size_t>(3 * r + c)];
  }
  double left = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 off = fit.linear * (vector_of(points[i]) - fit.from) - (vector_of(images[i]) - fit.to);
    left += glm::dot(off, off);
  }
  fit.miss = std::sqrt(left / image_size);
  return fit;
}

std::optional<PartMatch> match_parts(const deform::Cage& cage, std::span<const std::uint32_t> part,
                                     std::span<const std::uint32_t> other, std::optional<KnownImage> known,
                                     std::string& why) {
  if (part.size() != other.size()) {
    why = "the parts have " + std::to_string(part.size()) + " and " + std::to_string(other.size()) +
          " vertices";
    return std::nullopt;
  }
  const PartFaces one(cage.surface, part), two(cage.surface, other);
  why = "their faces do not go together one by one";
  if (one.face_count() != two.face_count() || one.face_count() == 0) return std::nullopt;
  const auto start = start_of(one, known);
  if (!start) return std::nullopt;
  std::optional<PartMatch> best;
  for (const bool mirrored : {false, true}) {
    for (const auto side : two.corners()) {
      const auto image = two.vertex(mirrored ? two.around(side, 1) : side);
      if (known ? image != known->image : two.degree(image) != one.degree(one.vertex(*start))) continue;
      PartWalk walk(one, two, cage.surface.positions.size(), mirrored);
      if (!walk.run(*start, side)) continue;
      PartMatch match;
      std::vector<mesh::Point> from, to;
      for (const auto v : part) {
        if (walk.image(v) == no_image) {
          why = "some vertices have no face that lies in the part as a whole";
          return std::nullopt;
        }
        match.images.push_back(walk.image(v));
        from.push_back(cage.surface.positions[v]), to.push_back(cage.surface.positions[walk.image(v)]);
      }
      if (one.hinge() && two.hinge()) from.push_back(*one.hinge()), to.push_back(*two.hinge());
      match.fit = fit_of(from, to, mirrored);
      if (!best || is_better(match.fit, best->fit)) best = std::move(match);
    }
  }
  return best;
}

}  // namespace viete::scene
