#include "cages/hull.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "mesh/orientation.h"

namespace viete::cages {

namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

struct Face {
  mesh::Triangle corners;
  std::array<std::uint32_t, 3> beyond{nobody, nobody, nobody};  // across the edge from corner i to i + 1
  std::vector<std::uint32_t> outside;                           // points that see it, each in one face's list
  bool gone = false;
};

class Quickhull {
public:
  explicit Quickhull(std::span<const Point> points)
      : points_(points), starting_(points.size()), ending_(points.size()) {}

  // False if all points lie in one plane.
  bool run() {
    if (!begin()) return false;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      while (!faces_[f].gone && !faces_[f].outside.empty()) add_farthest_of(f);
    }
    return true;
  }

  Shell shell() const {
    Shell made;
    std::vector<std::uint32_t> numbers(points_.size(), nobody);
    for (const Face& face : faces_) {
      if (face.gone) continue;
      mesh::Triangle t;
      for (std::size_t i = 0; i < 3; ++i) {
        auto& number = numbers[face.corners[i]];
        if (number == nobody) {
          number = static_cast<std::uint32_t>(made.positions.size());
          made.positions.push_back(points_[face.corners[i]]);
        }
        t[i] = number;
      }
      made.triangles.push_back(t);
    }
    return made;
  }

private:
  bool sees(std::uint32_t point, const Face& face) const {
    const auto& [a, b, c] = face.corners;
    return mesh::orientation(points_[a], points_[b], points_[c], points_[point]) > 0;
  }

  double height(std::uint32_t point, const Face& face) const {
    const Point &a = points_[face.corners[0]], &b = points_[face.corners[1]], &c = points_[face.corners[2]];
    return mesh::dot(mesh::cross(b - a, c - a), points_[point] - a);
  }

  template <class Measure>
  std::uint32_t largest(Measure&& measure) const {
    std::uint32_t best = 0;
    double most = -1;
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      const double m = measure(points_[p]);
      if (m > most) {
        most = m;
        best = p;
      }
    }
    return best;
  }

  // A tetrahedron of points that lie far apart.
  bool begin() {
    const std::uint32_t a = largest([&](const Point& p) { return mesh::squared_norm(p - points_[0]); });
    const std::uint32_t b = largest([&](const Point& p) { return mesh::squared_norm(p - points_[a]); });
    const Vec3 ab = points_[b] - points_[a];
    const std::uint32_t c =
        largest([&](const Point& p) { return mesh::squared_norm(mesh::cross(ab, p - points_[a])); });
    const Vec3 n = mesh::cross(ab, points_[c] - points_[a]);
    const std::uint32_t d = largest([&](const Point& p) { return std::abs(mesh::dot(n, p - points_[a])); });
    const int side = mesh::orientation(points_[a], points_[b], points_[c], points_[d]);
    if (side == 0) return false;
    std::array<std::uint32_t, 4> v = {a, b, c, d};
    if (side > 0) std::swap(v[0], v[1]);  // d sees abc from within
    faces_.push_back({{v[0], v[1], v[2]}, {1, 2, 3}, {}, false});
    faces_.push_back({{v[1], v[0], v[3]}, {0, 3, 2}, {}, false});
    faces_.push_back({{v[2], v[1], v[3]}, {0, 1, 3}, {}, false});
    faces_.push_back({{v[0], v[2], v[3]}, {0, 2, 1}, {}, false});
    std::vector<std::uint32_t> all(points_.size());
    for (std::uint32_t p = 0; p < all.size(); ++p) all[p] = p;
    hand_out(all, 0);
    return true;
  }

  void hand_out(std::span<const std::uint32_t> points, std::size_t first_face) {
    for (const auto p : points) {
      for (std::size_t f = first_face; f < faces_.size(); ++f) {
        if (!sees(p, faces_[f])) continue;
        faces_[f].outside.push_back(p);
        break;
      }
    }
  }

  // What the point sees goes; its border and the point make new faces.
  void add_farthest_of(std::uint32_t f) {
    const auto& outside = faces_[f].outside;
    const std::uint32_t point =
        *std::ranges::max_element(outside, {}, [&](std::uint32_t p) { return height(p, faces_[f]); });
    std::vector<std::uint32_t> visible = {f};
    faces_[f].gone = true;
    std::vector<std::uint32_t> orphans;
    struct Border {
      std::uint32_t from, to, beyond;
    };
    std::vector<Border> border;
    for (std::size_t i = 0; i < visible.size(); ++i) {
      const Face face = faces_[visible[i]];
      for (const auto p : face.outside) {
        if (p != point) orphans.push_back(p);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        Face& other = faces_[face.beyond[k]];
        if (other.gone) continue;
        if (sees(point, other)) {
          other.gone = true;
          visible.push_back(face.beyond[k]);
        }
      }
    }
    for (const auto v : visible) {
      const Face& face = faces_[v];
      for (std::size_t k = 0; k < 3; ++k) {
        if (!faces_[face.beyond[k]].gone)
          border.push_back({face.corners[k], face.corners[(k + 1) % 3], face.beyond[k]});
      }
    }
    const auto first = static_cast<std::uint32_t>(faces_.size());
    for (std::uint32_t i = 0; i < border.size(); ++i) {
      starting_[border[i].from] = first + i;
      ending_[border[i].to] = first + i;
    }
    for (const auto& edge : border) {
      const auto self = static_cast<std::uint32_t>(faces_.size());
      const Face face{
          {edge.from, edge.to, point}, {edge.beyond, starting_[edge.to], ending_[edge.from]}, {}, false};
      for (std::size_t k = 0; k < 3; ++k) {
        Face& other = faces_[edge.beyond];
        if (other.corners[k] == edge.to && other.corners[(k + 1) % 3] == edge.from) other.beyond[k] = self;
      }
      faces_.push_back(face);
    }
    for (const auto v : visible) faces_[v].outside.clear();
    hand_out(orphans, first);
  }

  std::span<const Point> points_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> starting_,
      ending_;  // the new face whose border starts at a point, or ends there
};

std::vector<Point> boxes_about(std::span<const Point> points, double margin) {
  std::vector<Point> all;
  all.reserve(8 * points.size());
  for (const Point& p : points) {
    for (unsigned c = 0; c < 8; ++c)
      all.push_back(p + margin * Vec3{c & 1U ? 1.0 : -1.0, c & 2U ? 1.0 : -1.0, c & 4U ? 1.0 : -1.0});
  }
  return all;
}

}  // namespace

Shell convex(std::span<const Point> points) {
  Quickhull hull(points);
  hull.run();
  return hull.shell();
}

Shell hull(std::span<const Point> points, double margin) {
  Quickhull bare(points);
  const std::vector<Point> all =
      bare.run() ? boxes_about(bare.shell().positions, margin) : boxes_about(points, margin);
  Quickhull with_margin(all);
  with_margin.run();
  return with_margin.shell();
}

}  // namespace viete::cages
