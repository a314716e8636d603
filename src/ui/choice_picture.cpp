#include "ui/choice_picture.h"

#include <algorithm>
#include <array>
#include <vector>

#include "ui/overlay_painter.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

ImU32 darkened(ImU32 color, float tone) {
  ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
  return ImGui::ColorConvertFloat4ToU32({tone * c.x, tone * c.y, tone * c.z, c.w});
}

}  // namespace

PicturePainter::PicturePainter(const Context& ui, ImVec2 corner)
    : ui_(ui), list_(*ImGui::GetWindowDrawList()), corner_(corner) {
  list_._FringeScale = 1 / ImGui::GetIO().DisplayFramebufferScale.x;
}

PicturePainter::~PicturePainter() {
  list_._FringeScale = 1;
}

void PicturePainter::draw(const Shape& shape) {
  const Palette& colors = ui_.colors;
  using scene::Ink;
  switch (shape.ink) {
    case Ink::model: return lit(shape);
    case Ink::lit: return fill(shape, darkened(ui_.colors.model, shape.tones[0]));
    case Ink::weight: return weighed(shape);
    case Ink::behind: return line(shape, faded(colors.accent, 0.4f), 1);
    case Ink::cage: return line(shape, colors.accent, 1.25f);
    case Ink::marked: return line(shape, colors.highlight, 2);
  }
}

std::vector<ImVec2> PicturePainter::placed(const Shape& shape) const {
  std::vector<ImVec2> points;
  for (const glm::vec2& p : shape.points) points.push_back({corner_.x + p.x, corner_.y + p.y});
  return points;
}

void PicturePainter::line(const Shape& shape, ImU32 color, float width, ImDrawFlags flags) {
  const auto points = placed(shape);
  list_.AddPolyline(points.data(), static_cast<int>(points.size()), color, flags, width);
}

void PicturePainter::fill(const Shape& shape, ImU32 color) {
  const auto points = placed(shape);
  if (!shape.triangles.empty()) return triangles(shape, std::vector(points.size(), color));
  list_.AddConvexPolyFilled(points.data(), static_cast<int>(points.size()), color);
}

void PicturePainter::lit(const Shape& shape) {
  fill(shape, darkened(ui_.colors.model, shape.tones[0]));
  line(shape, faded(darkened(ui_.colors.model, 0.5f), 0.45f), 1, ImDrawFlags_Closed);
}

ImU32 PicturePainter::color_of(float weight) const {
  const auto& colors = ui_.field_colors.even;
  if (colors.empty()) return faded(ui_.colors.highlight, weight);
  return colors[static_cast<std::size_t>(weight * static_cast<float>(colors.size() - 1) + 0.5f)];
}

void PicturePainter::weighed(const Shape& shape) {
  std::vector<ImU32> colors;
  for (const float tone : shape.tones) colors.push_back(color_of(tone));
  triangles(shape, colors);
}

// One colour per corner.
void PicturePainter::triangles(const Shape& shape, const std::vector<ImU32>& colors) {
  const auto points = placed(shape);
  const auto count = static_cast<unsigned>(points.size());
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  list_.PrimReserve(static_cast<int>(3 * (count - 2)), static_cast<int>(count));
  const unsigned first = list_._VtxCurrentIdx;
  const auto write = [&](const std::array<unsigned, 3>& t) {
    for (const unsigned corner : t) list_.PrimWriteIdx(static_cast<ImDrawIdx>(first + corner));
  };
  for (unsigned i = 2; i < count && shape.triangles.empty(); ++i) write({0u, i - 1, i});
  std::ranges::for_each(shape.triangles, write);
  for (unsigned i = 0; i < count; ++i) list_.PrimWriteVtx(points[i], white, colors[i]);
}

namespace {

constexpr float picture_rounding = 6;

void draw_picture(const Context& ui, const scene::ChoicePicture& picture) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::Dummy({scene::choice_picture_size.x, scene::choice_picture_size.y});
  record(ui, "choice_picture");
  const ImVec2 high = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, ui.colors.card, picture_rounding);
  list.PushClipRect(low, high, true);
  PicturePainter painter(ui, low);
  for (const auto& shape : picture.shapes) painter.draw(shape);
  list.PopClipRect();
}

// Aligns the tooltip with the item vertically, as far as it fits into the window.
void place_beside() {
  constexpr float gap = 4;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float width = scene::choice_picture_size.x + 2 * ImGui::GetStyle().WindowPadding.x;
  const float y = 0.5f * (ImGui::GetItemRectMin().y + ImGui::GetItemRectMax().y);
  const float left = ImGui::GetWindowPos().x, right = left + ImGui::GetWindowWidth();
  const float x = right + gap + width <= display.x ? right + gap : left - gap - width;
  ImGui::SetNextWindowPos({std::max(0.0f, std::min(x, display.x - width - gap)), y}, ImGuiCond_Always,
                          {0, y / display.y});
}

}  // namespace

void picture_hint(const Context& ui, const scene::ChoicePicture& picture, const std::string& sentence,
                  const std::string& more) {
  place_beside();
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + scene::choice_picture_size.x);
  ImGui::TextUnformatted(wrapped(sentence, scene::choice_picture_size.x).c_str());
  ImGui::Spacing();
  draw_picture(ui, picture);
  text_in(ui.colors.faint, std::string(picture.caption));
  if (!more.empty()) {
    ImGui::Spacing();
    ImGui::TextUnformatted(wrapped(more, scene::choice_picture_size.x).c_str());
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace viete::ui
