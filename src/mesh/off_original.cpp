#include "mesh/off_original.h"

#include <array>
#include <optional>

#include "mesh/normals.h"
#include "mesh/off.h"
#include "mesh/printed.h"
#include "mesh/rewriter.h"

namespace viete::mesh {

namespace {

class OffRewriter {
public:
  OffRewriter(std::string_view bytes, std::size_t body, const Surface& rest, std::span<const Point> positions,
              TextWriter& out)
      : body_{"", "off", bytes.substr(body)},
        rest_(rest),
        positions_(positions),
        coordinates_(out.digits()),
        directions_(out.digits()),
        rewriter_(bytes, out) {}

  void run(bool has_normals) {
    std::vector<Vec3> normals(has_normals ? rest_.positions.size() : 0);
    const std::size_t enough = has_normals ? rest_.positions.size() : 10'000;
    walk(std::min(enough, rest_.positions.size()), has_normals, [&](std::size_t v, const Words& words) {
      for (const std::string_view word : words[0]) coordinates_.learn(word);
      if (has_normals) normals[v] = learned_normal(words[1]);
    });
    coordinates_.keep(6, bounds(rest_.positions).diagonal());
    directions_.keep(5, 1);
    std::vector<Vec3> moved = normals;
    if (has_normals) {
      moved = deformed_normals(rest_, positions_, normals, rest_.corners);
      keep_lengths(normals, moved);
    }
    walk(rest_.positions.size(), has_normals, [&](std::size_t v, const Words& words) {
      rewriter_.replace(words[0], rest_.positions[v], positions_[v], coordinates_);
      if (has_normals) rewriter_.replace(words[1], normals[v], moved[v], directions_);
    });
    rewriter_.finish();
  }

private:
  using Words = std::array<ThreeWords, 2>;  // a position and a normal, if there are any

  template <class Vertex>
  void walk(std::size_t vertices, bool has_normals, const Vertex& vertex) {
    TextCursor text(body_, off_rules);
    Words words;
    for (std::size_t v = 0; v < vertices && text.next_filled_line(); ++v, text.next_line()) {
      words[0] = three_words(text);
      if (has_normals) words[1] = three_words(text);
      vertex(v, words);
    }
  }

  // One that cannot be read is taken as 0 0 0, and stays as it is.
  Vec3 learned_normal(const ThreeWords& words) {
    Vec3 normal{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = number_in(words[i]);
      if (!value) return {0, 0, 0};
      normal[i] = *value;
      directions_.learn(words[i]);
    }
    return normal;
  }

  const Source body_;
  const Surface& rest_;
  std::span<const Point> positions_;
  Printed coordinates_, directions_;
  Rewriter rewriter_;
};

}  // namespace

std::vector<std::string> OffOriginal::write(const Surface& rest, std::span<const Point> positions,
                                            TextWriter& out) const {
  OffRewriter(bytes_, body_, rest, positions, out).run(normals_);
  return {};
}

}  // namespace viete::mesh
