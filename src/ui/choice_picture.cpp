#include "ui/choice_picture.h"

#include <algorithm>

#include "ui/picture_painter.h"
#include "ui/widgets.h"

namespace viete::ui {

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
