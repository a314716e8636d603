#include "mesh/obj_original.h"

#include <array>

#include "mesh/obj_words.h"
#include "mesh/printed.h"
#include "mesh/rewriter.h"

namespace viete::mesh {

namespace {

// The words of the next three numbers of a line.
std::array<std::string_view, 3> three_words(TextCursor& text) {
  return {text.word(), text.word(), text.word()};
}

class ObjRewriter {
public:
  ObjRewriter(const Source& source, const Surface& rest, std::span<const Point> positions, TextWriter& out)
      : source_(source),
        rest_(rest),
        positions_(positions),
        coordinates_(printed_like(source, ObjWord::vertex, out.digits())),
        text_(source, obj_rules),
        rewriter_(source.bytes, out) {
    coordinates_.keep(6, bounds(rest.positions).diagonal());
  }

  void run() {
    for (; text_.next_filled_line(); text_.next_line()) {
      if (obj_word(text_.word()) == ObjWord::vertex) position();
    }
    rewriter_.finish();
  }

private:
  // Learned from the first lines of this kind.
  static Printed printed_like(const Source& source, ObjWord kind, Digits digits) {
    constexpr std::size_t enough = 10'000;
    Printed printed(digits);
    TextCursor text(source, obj_rules);
    for (std::size_t lines = 0; lines < enough && text.next_filled_line(); text.next_line()) {
      if (obj_word(text.word()) != kind) continue;
      for (const std::string_view word : three_words(text)) printed.learn(word);
      ++lines;
    }
    return printed;
  }

  void position() {
    const Point &before = rest_.positions[vertices_], &now = positions_[vertices_];
    ++vertices_;
    if (before == now) return;
    const auto words = three_words(text_);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!coordinates_.same(before[i], now[i]))
        rewriter_.replace(words[i], coordinates_.print(now[i], room_));
    }
  }

  const Source& source_;
  const Surface& rest_;
  std::span<const Point> positions_;
  Printed coordinates_;
  TextCursor text_;
  Rewriter rewriter_;
  std::size_t vertices_ = 0;
  std::array<char, 400> room_;
};

}  // namespace

std::vector<std::string> ObjOriginal::write(const Surface& rest, std::span<const Point> positions,
                                            TextWriter& out) const {
  const Source source{"", "obj", bytes_};
  ObjRewriter(source, rest, positions, out).run();
  return {};
}

}  // namespace viete::mesh
