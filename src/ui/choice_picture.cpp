#include "ui/choice_picture.h"

#include <algorithm>
#include <vector>

#include "ui/overlay_painter.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

constexpr float picture_rounding = 6;

ImU32 darkened(ImU32 color, float tone) {
  ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
  return ImGui::ColorConvertFloat4ToU32({tone * c.x, tone * c.y, tone * c.z, c.w});
}

// Into the window that is being built, from a corner on.
class PicturePainter {
public:
  PicturePainter(const Context& ui, ImVec2 corner)
      : ui_(ui), list_(*ImGui::GetWindowDrawList()), corner_(corner) {
    list_._FringeScale = 1 / ImGui::GetIO().DisplayFramebufferScale.x;
  }
  ~PicturePainter() { list_._FringeScale = 1; }
  PicturePainter(const PicturePainter&) = delete;
  PicturePainter& operator=(const PicturePainter&) = delete;

  void draw(const scene::PictureShape& shape) {
    const Palette& colors = ui_.colors;
    using scene::Ink;
    switch (shape.ink) {
      case Ink::model: return lit(shape);
      case Ink::weight: return weighed(shape);
      case Ink::behind: return line(shape, faded(colors.accent, 0.4f), 1);
      case Ink::cage: return line(shape, colors.accent, 1.25f);
      case Ink::map: return square(shape);
      case Ink::spot: return fill(shape, faded(colors.highlight, 0.4f));
      case Ink::marked: return line(shape, colors.highlight, 2);
    }
  }

private:
  using Shape = scene::PictureShape;

  std::vector<ImVec2> placed(const Shape& shape) const {
    std::vector<ImVec2> points;
    for (const glm::vec2& p : shape.points) points.push_back({corner_.x + p.x, corner_.y + p.y});
    return points;
  }

  void line(const Shape& shape, ImU32 color, float width, ImDrawFlags flags = 0) {
    const auto points = placed(shape);
    list_.AddPolyline(points.data(), static_cast<int>(points.size()), color, flags, width);
  }

  void fill(const Shape& shape, ImU32 color) {
    const auto points = placed(shape);
    list_.AddConvexPolyFilled(points.data(), static_cast<int>(points.size()), color);
  }

  void lit(const Shape& shape) {
    fill(shape, darkened(ui_.colors.model, shape.tones[0]));
    line(shape, faded(darkened(ui_.colors.model, 0.5f), 0.45f), 1, ImDrawFlags_Closed);
  }

  void square(const Shape& shape) {
    fill(shape, IM_COL32(255, 255, 255, 90));
    line(shape, ui_.colors.text, 1.25f, ImDrawFlags_Closed);
  }

  ImU32 color_of(float weight) const {
    const auto colors = ui_.error_colors;
    if (colors.empty()) return faded(ui_.colors.highlight, weight);
    return colors[static_cast<std::size_t>(weight * static_cast<float>(colors.size() - 1) + 0.5f)];
  }

  // A fan with a colour a corner.
  void weighed(const Shape& shape) {
    const auto points = placed(shape);
    const auto count = static_cast<unsigned>(points.size());
    const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
    list_.PrimReserve(static_cast<int>(3 * (count - 2)), static_cast<int>(count));
    const unsigned first = list_._VtxCurrentIdx;
    for (unsigned i = 2; i < count; ++i) {
      for (const unsigned corner : {0u, i - 1, i}) list_.PrimWriteIdx(static_cast<ImDrawIdx>(first + corner));
    }
    for (unsigned i = 0; i < count; ++i) list_.PrimWriteVtx(points[i], white, color_of(shape.tones[i]));
  }

  const Context& ui_;
  ImDrawList& list_;
  ImVec2 corner_;
};

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

// As far down in the tooltip as the item is in the program's window: so it is within that, however high it
// is itself.
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
  ImGui::TextUnformatted(sentence.c_str());
  ImGui::Spacing();
  draw_picture(ui, picture);
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.faint);
  ImGui::TextUnformatted(picture.caption.data(), picture.caption.data() + picture.caption.size());
  ImGui::PopStyleColor();
  if (!more.empty()) {
    ImGui::Spacing();
    ImGui::TextUnformatted(more.c_str());
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace viete::ui
