#include "mesh/formats/stl_original.h"

#include <array>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "mesh/formats/printed.h"
#include "mesh/formats/rewriter.h"
#include "mesh/formats/stl_layout.h"
#include "mesh/formats/text_cursor.h"
#include "mesh/normals.h"

namespace viete::mesh {

namespace {

// The normal of each facet: each of its corners has it.
std::vector<Vec3> moved_facet_normals(const Surface& rest, std::span<const Point> positions,
                                      const std::vector<Vec3>& normals) {
  std::vector<std::uint32_t> of_corner(rest.corners.size());
  for (std::size_t c = 0; c < of_corner.size(); ++c) of_corner[c] = static_cast<std::uint32_t>(c / 3);
  std::vector<Vec3> moved = deformed_normals(rest, positions, normals, of_corner);
  keep_lengths(normals, moved);
  return moved;
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
      for (int i = 0; i < 3; ++i) normals[t][i] = stl_float(place(t, i).data());
    }
    const std::vector<Vec3> moved = moved_facet_normals(rest_, positions_, normals);
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
  // Of the i-th of a triangle's numbers: the normal's, then the corners'.
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
      const auto bits = std::bit_cast<std::uint32_t>(value);
      std::array<char, 4> bytes;
      for (int b = 0; b < 4; ++b) bytes[b] = static_cast<char>(bits >> 8 * b & 0xFF);
      rewriter_.replace(place(triangle, i + axis), {bytes.data(), bytes.size()});
    }
  }

  const Source& source_;
  const StlTriangles layout_;
  const Surface& rest_;
  std::span<const Point> positions_;
  Rewriter rewriter_;
};

class StlTextRewriter {
public:
  StlTextRewriter(const Source& source, const Surface& rest, std::span<const Point> positions,
                  TextWriter& out)
      : source_(source),
        rest_(rest),
        positions_(positions),
        coordinates_(out.digits()),
        directions_(out.digits()),
        rewriter_(source.bytes, out) {}

  void run() {
    std::vector<Vec3> normals(rest_.triangles.size());
    walk([&](std::size_t t, const ThreeWords& words) { learn_normal(words, normals[t]); },
         [&](std::size_t corner, const ThreeWords& words) {
           if (corner < enough_)
             for (const std::string_view word : words) coordinates_.learn(word);
         });
    coordinates_.keep(6, bounds(rest_.positions).diagonal());
    directions_.keep(5, 1);
    const std::vector<Vec3> moved = moved_facet_normals(rest_, positions_, normals);
    walk([&](std::size_t t,
             const ThreeWords& words) { rewriter_.replace(words, normals[t], moved[t], directions_); },
         [&](std::size_t corner, const ThreeWords& words) {
           const std::uint32_t v = rest_.corners[corner];
           rewriter_.replace(words, rest_.positions[v], positions_[v], coordinates_);
         });
    rewriter_.finish();
  }

private:
  static constexpr std::size_t enough_ = 10'000;

  template <class Normal, class Corner>
  void walk(const Normal& normal, const Corner& corner) {
    TextCursor text(source_, {});
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

  // One that is missing is taken as 0 0 0, and stays so.
  void learn_normal(const ThreeWords& words, Vec3& normal) {
    if (words[2].empty()) return;
    normal = vector_in(words);
    if (is_direction(normal)) {
      for (const std::string_view word : words) directions_.learn(word);
    }
  }

  const Source& source_;
  const Surface& rest_;
  std::span<const Point> positions_;
  Printed coordinates_, directions_;
  Rewriter rewriter_;
};

}  // namespace

std::vector<std::string> StlOriginal::write(const Surface& rest, std::span<const Point> positions,
                                            TextWriter& out) const {
  const Source source{name_, "stl", bytes_};
  if (binary_) {
    StlBinaryRewriter(source, rest, positions, out).run();
  } else {
    StlTextRewriter(source, rest, positions, out).run();
  }
  return {};
}

}  // namespace viete::mesh
