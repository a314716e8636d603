// Writes STL: any surface, and a file that was read as it was.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "mesh/formats/byte_order.h"
#include "mesh/formats/printed.h"
#include "mesh/formats/rewriter.h"
#include "mesh/formats/stl.h"
#include "mesh/formats/text_cursor.h"
#include "mesh/normals.h"

namespace viete::mesh {

namespace {

// The facet normal; zero without area.
Point unit_normal(const Point& a, const Point& b, const Point& c) {
  Point u = b - a, v = c - a;
  const double scale = std::max(largest_abs(u), largest_abs(v));
  if (scale == 0) return {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    u[i] /= scale;
    v[i] /= scale;
  }
  Point n = cross(u, v);
  const double size = stable_norm(n);
  if (size == 0) return {0, 0, 0};
  for (double& x : n) x /= size;
  return n;
}

// Each corner uses the normal of its facet.
std::vector<std::uint32_t> facet_of_corner(const Surface& rest) {
  std::vector<std::uint32_t> facets(rest.corners.size());
  for (std::size_t c = 0; c < facets.size(); ++c) facets[c] = static_cast<std::uint32_t>(c / 3);
  return facets;
}

class StlBinaryRewriter {
public:
  StlBinaryRewriter(const Source& source, const Surface& rest, std::span<const Point> positions,
                    TextWriter& out)
      : source_(source), layout_(source), rest_(rest), positions_(positions), rewriter_(source.bytes, out) {}

  void run() {
    const std::size_t triangles = layout_.count();
    std::vector<Vec3> normals(triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
      for (int i = 0; i < 3; ++i) normals[t][i] = number_of_bytes<float>(place(t, i).data());
    }
    std::vector<Vec3> moved = deformed_normals(rest_, positions_, normals, facet_of_corner(rest_));
    keep_lengths(normals, moved);
    for (std::size_t t = 0; t < triangles; ++t) {
      vector(t, 0, normals[t], moved[t]);
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t v = rest_.triangles[t][c];
        vector(t, 3 + 3 * c, rest_.positions[v], positions_[v]);
      }
    }
    rewriter_.finish();
  }

private:
  // The text of a triangle's i-th number: normal first, then corners.
  std::string_view place(std::size_t triangle, int i) const {
    return source_.bytes.substr(layout_.offset(triangle) + 4 * i, 4);
  }

  void vector(std::size_t triangle, int i, const Vec3& before, const Vec3& now) {
    if (!changed(before, now)) return;
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = static_cast<float>(now[axis]);
      if (!std::isfinite(value)) {
        throw base::Error(source_.place("triangle", triangle),
                          "a position does not fit into the float of a binary STL",
                          "write another format, or scale the model");
      }
      if (value == static_cast<float>(before[axis])) continue;
      const auto bytes = bytes_of_number(value);
      rewriter_.replace(place(triangle, i + axis), {bytes.data(), bytes.size()});
    }
  }

  const Source& source_;
  const StlTriangles layout_;
  const Surface& rest_;
  std::span<const Point> positions_;
  Rewriter rewriter_;
};

class StlOriginal final : public Original {
public:
  StlOriginal(const Source& source, bool binary) : Original("STL", source), binary_(binary) {}

  std::vector<std::string> write(const Surface& rest, std::span<const Point> positions,
                                 TextWriter& out) const override {
    const Source source = this->source();
    if (binary_) {
      StlBinaryRewriter(source, rest, positions, out).run();
    } else {
      rewrite_vectors(
          bytes_, out, rest, positions, 10'000, [&](std::size_t corner) { return rest.corners[corner]; },
          rest.triangles.size(), facet_of_corner(rest), {},
          [&](const auto& corner, const auto& normal) { walk(source, corner, normal); });
    }
    return {};
  }

private:
  template <class Corner, class Normal>
  static void walk(const Source& source, const Corner& corner, const Normal& normal) {
    TextCursor text(source, {});
    std::size_t facets = 0, corners = 0;
    for (; text.next_filled_line(); text.next_line()) {
      const std::string word = lower_stl_word(text.word());
      if (word == "facet") {
        text.word();  // normal
        normal(facets++, three_words(text));
      } else if (word == "vertex") {
        corner(corners++, three_words(text));
      }
    }
  }

  bool binary_;
};

}  // namespace

void write_stl(const Content& content, TextWriter& out) {
  const Surface& surface = content.surface;
  const auto& positions = content.positions;
  const auto& comments = content.comments;
  std::size_t done = 0;
  out.text("solid ").text(comments.empty() ? "surface" : TextWriter::one_line(comments.front())).text("\n");
  for (const Triangle& t : surface.triangles) {
    const Point &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
    out.text(" facet normal ").point(unit_normal(a, b, c)).text("\n  outer loop\n");
    for (const Point& p : {a, b, c}) {
      out.text("   vertex ");
      print_point(p, out);
      out.text("\n");
    }
    out.text("  endloop\n endfacet\n");
    out.element_done(++done, surface.triangles.size());
  }
  out.text("endsolid\n");
}

std::shared_ptr<const Original> stl_original(const Source& source, bool binary) {
  return std::make_shared<const StlOriginal>(source, binary);
}

}  // namespace viete::mesh
