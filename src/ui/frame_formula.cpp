#include <algorithm>
#include <string>
#include <vector>

#include "ui/overlay_painter.h"
#include "ui/panel_timings.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

using scene::Link;

constexpr float script_size = 0.72f;  // relative size of indices and exponents

// Letters of one size; sum signs and bars over letters are drawn.
struct Piece {
  std::string text;
  int script = 0;  // 1 superscript, -1 subscript
  std::optional<Link> stage{};
  bool sum = false, bar = false;
  bool may_break = false;  // allow a line break before it
};

// Assembles formulas: the stage of each term depends on the engine.
class Formula {
public:
  Formula(bool fused, bool stitched) : fused_(fused), stitched_(stitched) {}

  std::vector<Piece> of(scene::Blend blend) {
    symbol("x", stitched_ ? Link::solve : apply());
    raised("'", stitched_ ? Link::solve : apply());
    word(stitched_ ? " follows " : " = ");
    blended(blend);
    return std::move(pieces_);
  }

private:
  using B = scene::Blend;

  void blended(scene::Blend blend) {
    switch (blend) {
      case B::srl: exp_of("Y"), exp_of("X"), offset_from_center(); break;
      case B::linear: linear(); break;
      case B::mls_affine:
      case B::mls_similarity:
      case B::mls_rigid: operator_of("M"), offset_from_center(); break;
    }
    translation(blend);
  }

  Link sums() const { return fused_ ? Link::fused : Link::blend; }
  Link exponential() const { return fused_ ? Link::fused : Link::exp; }
  Link apply() const { return fused_ ? Link::fused : Link::apply; }

  void add(Piece piece) { pieces_.push_back(std::move(piece)); }
  void word(const char* text) { add({text}); }
  void symbol(const char* text, Link link) { add({text, 0, link}); }
  void raised(const char* text, Link link) { add({text, 1, link}); }
  void lowered(const char* text, Link link) { add({text, -1, link}); }
  void break_here() { add({.text = "", .may_break = true}); }

  void weighted(const char* of, Link link) {
    add({"", 0, sums(), true});
    symbol(" w", sums());
    lowered("j", sums());
    symbol(of, link);
    lowered("j", link);
  }
  void exp_of(const char* of) {
    break_here();
    symbol("exp", exponential());
    symbol("(", exponential());
    weighted(of, Link::log_maps);
    symbol(")", exponential());
    word(" ");
  }
  void operator_of(const char* name) {
    break_here();
    symbol(name, apply());
    word(" ");
  }
  void center(bool posed) {
    add({"c", 0, sums(), false, true});
    if (posed) raised("'", sums());
  }
  void rest() { word("x"); }
  void offset_from_center() {
    break_here();
    symbol("(", apply());
    rest();
    symbol(" - ", apply());
    center(false);
    symbol(")", apply());
  }
  void linear() {
    break_here();
    add({"", 0, sums(), true});
    symbol(" w", sums());
    lowered("j", sums());
    word(" (");
    symbol("M", Link::maps);
    lowered("j", Link::maps);
    word(" x + ");
    symbol("l", Link::maps);
    lowered("j", Link::maps);
    word(")");
  }
  void translation(scene::Blend blend) {
    if (blend == B::linear) return;
    break_here();
    symbol(" + ", apply());
    center(true);
  }

  bool fused_, stitched_;
  std::vector<Piece> pieces_;
};

// Adjusts a bar's colour for text: darker on light background, lighter on dark.
ImU32 legible(ImU32 color, bool dark) {
  ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
  for (float* part : {&c.x, &c.y, &c.z}) *part = dark ? *part + 0.25f * (1 - *part) : 0.68f * *part;
  return ImGui::ColorConvertFloat4ToU32(c);
}

// Lays out pieces in lines.
class Setting {
public:
  Setting(const Context& ui, float width)
      : ui_(ui),
        draw_(*ImGui::GetWindowDrawList()),
        font_(ImGui::GetFont()),
        size_(1.1f * ImGui::GetFontSize()),
        start_(ImGui::GetCursorScreenPos()),
        width_(width),
        pen_(start_) {}

  void set(const std::vector<Piece>& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].may_break && pen_.x + extent(pieces, i + 1) > start_.x + width_) next_line();
      set(pieces[i]);
    }
  }
  float height() const { return pen_.y + line_height() - start_.y; }
  std::optional<Link> under_cursor() const { return under_cursor_; }

private:
  float size_of(const Piece& piece) const { return piece.script == 0 ? size_ : script_size * size_; }
  float line_height() const { return 1.5f * size_; }

  float advance(const Piece& piece) const {
    if (piece.sum) return 0.62f * size_;
    return font_->CalcTextSizeA(size_of(piece), 1e6f, 0, piece.text.c_str()).x;
  }
  // The width from a piece up to the next possible break.
  float extent(const std::vector<Piece>& pieces, std::size_t i) const {
    float sum = 0;
    for (; i < pieces.size() && !pieces[i].may_break; ++i) sum += advance(pieces[i]);
    return sum;
  }
  void next_line() { pen_ = {start_.x + 1.6f * size_, pen_.y + line_height()}; }

  ImU32 color(const Piece& piece) const {
    if (!piece.stage) return faded(ui_.colors.text, ui_.workspace.interaction.stage ? 0.4f : 1.0f);
    return legible(lit_stage_color(ui_, *piece.stage), ui_.workspace.view.dark);
  }

  void set(const Piece& piece) {
    const float wide = advance(piece), size = size_of(piece);
    const float y = pen_.y + 0.25f * size_ +
                    (piece.script > 0   ? -0.1f * size_
                     : piece.script < 0 ? 0.48f * size_
                                        : 0);
    const ImU32 c = color(piece);
    if (piece.sum) {
      sum_sign(c);
    } else {
      draw_.AddText(font_, size, {pen_.x, y}, c, piece.text.c_str());
    }
    if (piece.bar) {
      const float over = y + 0.22f * size_;
      draw_.AddLine({pen_.x + 0.5f, over}, {pen_.x + wide - 0.5f, over}, c, 1.25f);
    }
    const ImVec2 low{pen_.x, pen_.y}, high{pen_.x + wide, pen_.y + line_height()};
    if (piece.stage && ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high))
      under_cursor_ = piece.stage;
    pen_.x += wide;
  }

  void sum_sign(ImU32 c) {
    const float low = pen_.y + 1.18f * size_, high = pen_.y + 0.36f * size_, x = pen_.x + 1;
    const float w = 0.5f * size_;
    const ImVec2 line[] = {{x + w, high + 0.1f * size_},         {x + w, high}, {x, high},
                           {x + 0.55f * w, 0.5f * (low + high)}, {x, low},      {x + w, low},
                           {x + w, low - 0.1f * size_}};
    draw_.AddPolyline(line, std::size(line), c, 0, 1.4f);
  }

  const Context& ui_;
  ImDrawList& draw_;
  ImFont* font_;
  float size_;
  ImVec2 start_;
  float width_;
  ImVec2 pen_;
  std::optional<Link> under_cursor_;
};

// Opens the vertex inspector at the picked vertex, or at the one in the middle of the view.
void show_sum(scene::Workspace& w) {
  scene::show_sum_at(w, w.vertex.vertex ? w.vertex.vertex : scene::pointed_vertex(w, w.viewport.middle()));
}

}  // namespace

std::optional<Link> frame_formula(const Context& ui) {
  const scene::Scheme& scheme = ui.workspace.document.scheme;
  const bool fused = !scene::shows_links(ui.workspace);
  const float width = ImGui::GetContentRegionAvail().x;
  Setting setting(ui, width);
  setting.set(Formula(fused, scheme.stitched()).of(scheme.blend));
  ImGui::Dummy({width, setting.height()});
  record(ui, "formula");
  if (setting.under_cursor()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    if (ImGui::IsMouseClicked(0)) show_sum(ui.workspace);
  }
  return setting.under_cursor();
}

}  // namespace viete::ui
