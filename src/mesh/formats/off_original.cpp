#include "mesh/formats/off_original.h"

#include <array>
#include <optional>

#include "mesh/formats/off_form.h"
#include "mesh/formats/printed.h"
#include "mesh/formats/rewriter.h"
#include "mesh/normals.h"

namespace viete::mesh {

namespace {

class OffRewriter {
public:
  OffRewriter(std::string_view bytes, std::size_t body, const OffForm& form, const Surface& rest,
              std::span<const Point> positions, TextWriter& out)
      : body_{"", "off", bytes.substr(body)},
        form_(form),
        rest_(rest),
        positions_(positions),
        coordinates_(out.digits()),
        directions_(out.digits()),
        rewriter_(bytes, out) {}

  void run() {
    const bool has_normals = form_.normals;
    std::vector<Vec3> normals(has_normals ? rest_.positions.size() : 0);
    const std::size_t enough = has_normals ? rest_.positions.size() : 10'000;
    walk(std::min(enough, rest_.positions.size()), [&](std::size_t v, const Words& words) {
      for (const std::string_view word : words[0]) coordinates_.learn(word);
      if (has_normals) normals[v] = learned_normal(words[1]);
    });
    coordinates_.keep(6, bounds(rest_.positions).diagonal());
    directions_.keep(5, 1);
    std::vector<Vec3> moved = normals;
    if (has_normals) {
      moved = deformed_normals(rest_, positions_, normals, rest_.corners, every_vertex(rest_));
      keep_lengths(normals, moved);
    }
    walk(rest_.positions.size(), [&](std::size_t v, const Words& words) {
      rewriter_.replace(words[0], rest_.positions[v], positions_[v], coordinates_);
      if (has_normals) rewriter_.replace(words[1], normals[v], moved[v], directions_);
    });
    rewriter_.finish();
  }

private:
  using Words = std::array<ThreeWords, 2>;  // a position and a normal, if there are any

  template <class Vertex>
  void walk(std::size_t vertices, const Vertex& vertex) {
    TextCursor text(body_, off_rules);
    Words words;
    for (std::size_t v = 0; v < vertices && text.next_filled_line(); ++v) {
      words[0] = next_three(text);
      if (form_.colors_first) next_three(text), text.word();
      if (form_.normals) words[1] = next_three(text);
      vertex(v, words);
      if (!form_.wrapped) text.next_line();
      for (std::size_t i = form_.normals ? 3 : 0; form_.wrapped && i < form_.numbers(); ++i) next_word(text);
    }
  }

  std::string_view next_word(TextCursor& text) const {
    if (form_.wrapped) text.next_filled_line();
    return text.word();
  }
  ThreeWords next_three(TextCursor& text) const {
    return {next_word(text), next_word(text), next_word(text)};
  }

  // One that is missing is taken as 0 0 0, and stays so.
  Vec3 learned_normal(const ThreeWords& words) {
    if (words[2].empty()) return {0, 0, 0};
    const Vec3 normal = vector_in(words);
    if (is_direction(normal)) {
      for (const std::string_view word : words) directions_.learn(word);
    }
    return normal;
  }

  const Source body_;
  const OffForm form_;
  const Surface& rest_;
  std::span<const Point> positions_;
  Printed coordinates_, directions_;
  Rewriter rewriter_;
};

}  // namespace

std::vector<std::string> OffOriginal::write(const Surface& rest, std::span<const Point> positions,
                                            TextWriter& out) const {
  OffRewriter(bytes_, body_, form_, rest, positions, out).run();
  return {};
}

}  // namespace viete::mesh
