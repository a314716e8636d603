// Ruler, keys and playhead of the timeline.
#include <algorithm>
#include <cmath>
#include <string>

#include "ui/imgui_bridge.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/playing.h"
#include "workspace/time_gestures.h"
#include "workspace/time_view.h"

namespace viete::ui {

namespace {

constexpr float ruler_height = 18, key_radius = 5.5f, near_key = 7;

// Maps frames to the screen.
struct Track {
  const Context& ui;
  ImVec2 low, high;

  const workspace::FrameWindow& seen() const { return ui.workspace.view.time.seen; }
  float width() const { return high.x - low.x; }
  float x_of(double frame) const { return low.x + static_cast<float>(seen().share_of(frame)) * width(); }
  double share_at(float x) const { return static_cast<double>((x - low.x) / width()); }
  double frame_at(float x) const { return seen().frame_at(share_at(x)); }
  float key_y() const { return low.y + ruler_height + 0.36f * (high.y - low.y - ruler_height); }
  float camera_y() const { return low.y + ruler_height + 0.78f * (high.y - low.y - ruler_height); }
};

void ruler(const Track& t, ImDrawList& draw) {
  const auto& colors = t.ui.colors;
  const int step = workspace::ruler_step(t.seen(), t.width() / 52);
  const auto first = static_cast<long>(std::ceil(t.seen().first / step));
  const auto last = static_cast<long>(std::floor(t.seen().last / step));
  ImGui::PushFont(t.ui.fonts.numbers);
  const float size = 0.82f * ImGui::GetFontSize();
  for (long i = first; i <= last; ++i) {
    const float x = std::round(t.x_of(static_cast<double>(i * step)));
    draw.AddLine({x, t.low.y + ruler_height - 4}, {x, t.high.y}, faded(colors.line, 0.8f));
    const std::string text = std::to_string(i * step);
    const float half = 0.5f * ImGui::GetFont()->CalcTextSizeA(size, 1000, 0, text.c_str()).x;
    if (x - half > t.low.x && x + half < t.high.x)
      draw.AddText(ImGui::GetFont(), size, {x - half, t.low.y + 1}, colors.faint, text.c_str());
  }
  ImGui::PopFont();
}

// Darkens frames outside the playback range.
void outside(const Track& t, ImDrawList& draw) {
  const document::Timeline& timeline = t.ui.workspace.document.timeline();
  const ImU32 shade = faded(t.ui.colors.halo, 0.55f);
  const float first = std::clamp(t.x_of(timeline.first), t.low.x, t.high.x);
  const float last = std::clamp(t.x_of(timeline.last), t.low.x, t.high.x);
  draw.AddRectFilled({t.low.x, t.low.y + ruler_height}, {first, t.high.y}, shade);
  draw.AddRectFilled({last, t.low.y + ruler_height}, t.high, shade);
}

bool is_selected(const workspace::Workspace& w, int frame) {
  return std::ranges::binary_search(w.view.time.selected, frame);
}

void key_mark(const Track& t, ImDrawList& draw, const document::PoseKey& key, bool next) {
  const float x = t.x_of(key.frame), y = t.key_y(), r = key_radius;
  const ImU32 color = is_selected(t.ui.workspace, key.frame) ? t.ui.colors.highlight : t.ui.colors.accent;
  if (next) {
    // The line to the next key is thin for the easing `hold`.
    const auto& keys = t.ui.workspace.document.timeline().keys;
    const auto after = std::ranges::upper_bound(keys, key.frame, {}, &document::PoseKey::frame);
    const ImU32 line_color = faded(t.ui.colors.accent, key.easing == document::Easing::hold ? 0.15f : 0.5f);
    draw.AddLine({x, y}, {t.x_of(after->frame), y}, line_color,
                 key.easing == document::Easing::hold ? 1.0f : 2.0f);
  }
  draw.AddQuadFilled({x, y - r}, {x + r, y}, {x, y + r}, {x - r, y}, color);
  draw.AddQuad({x, y - r}, {x + r, y}, {x, y + r}, {x - r, y}, t.ui.colors.halo, 1);
}

void keys(const Track& t, ImDrawList& draw) {
  const document::Timeline& timeline = t.ui.workspace.document.timeline();
  for (const auto& key : timeline.keys) key_mark(t, draw, key, &key != &timeline.keys.back());
  for (const auto& key : timeline.cameras) {
    const float x = t.x_of(key.frame), y = t.camera_y(), r = key_radius - 1;
    const ImU32 color = is_selected(t.ui.workspace, key.frame) ? t.ui.colors.highlight : t.ui.colors.neutral;
    draw.AddRectFilled({x - r, y - 0.8f * r}, {x + r, y + 0.8f * r}, color, 1.5f);
  }
}

void playhead(const Track& t, ImDrawList& draw) {
  const float x = t.x_of(t.ui.workspace.document.frame());
  if (x < t.low.x - 1 || x > t.high.x + 1) return;
  const ImU32 color = t.ui.colors.highlight;
  draw.AddLine({x, t.low.y + ruler_height - 5}, {x, t.high.y}, color, 1.5f);
  draw.AddTriangleFilled({x - 5, t.low.y + ruler_height - 8}, {x + 5, t.low.y + ruler_height - 8},
                         {x, t.low.y + ruler_height - 1}, color);
}

void box(const Track& t, ImDrawList& draw) {
  const auto& drag = t.ui.workspace.view.time.drag;
  if (!drag || drag->what != workspace::TimeView::What::box) return;
  const float pressed = t.x_of(drag->pressed), now = ImGui::GetIO().MousePos.x;
  draw.AddRectFilled({std::min(pressed, now), t.low.y + ruler_height}, {std::max(pressed, now), t.high.y},
                     faded(t.ui.colors.highlight, 0.15f));
}

std::optional<int> key_near(const Track& t, ImVec2 mouse) {
  std::optional<int> found;
  float nearest = near_key;
  const bool upper = mouse.y < 0.5f * (t.key_y() + t.camera_y());
  const auto look = [&](int frame) {
    const float distance = std::abs(t.x_of(frame) - mouse.x);
    if (distance < nearest) {
      nearest = distance;
      found = frame;
    }
  };
  const document::Timeline& timeline = t.ui.workspace.document.timeline();
  if (upper) {
    for (const auto& key : timeline.keys) look(key.frame);
  } else {
    for (const auto& key : timeline.cameras) look(key.frame);
  }
  return found;
}

void press(const Track& t, ImVec2 mouse) {
  workspace::Workspace& w = t.ui.workspace;
  const double frame = t.frame_at(mouse.x);
  if (ImGui::IsMouseClicked(2)) return workspace::press_pan(w, frame);
  if (mouse.y < t.low.y + ruler_height) return workspace::press_ruler(w, frame);
  workspace::press_keys(w, frame, key_near(t, mouse), ImGui::GetIO().KeyShift || ImGui::GetIO().KeyCtrl);
}

// A pan uses the visible frames at the start of the drag.
void follow_mouse(const Track& t) {
  workspace::Workspace& w = t.ui.workspace;
  const auto& drag = w.view.time.drag;
  if (!drag) return;
  if (key_pressed(workspace::Key::escape)) return workspace::cancel_time(w);
  const bool pans = drag->what == workspace::TimeView::What::pan;
  const workspace::FrameWindow& seen = pans ? drag->seen : t.seen();
  const double frame = seen.frame_at(t.share_at(ImGui::GetIO().MousePos.x));
  const bool down = ImGui::IsMouseDown(pans ? 2 : 0);
  workspace::drag_time(w, frame);
  if (!down) workspace::release_time(w);
}

void key_menu(const Context& ui) {
  if (!ImGui::BeginPopup("Keys of time")) return;
  for (const char* name : {"easing_smooth", "easing_constant_speed", "easing_hold", "delete_keys"}) {
    const workspace::Command& command = *workspace::find_command(name);
    const bool deletes = std::string_view(name) == "delete_keys";
    if (deletes) ImGui::Separator();
    if (ImGui::MenuItem(command.brief.data(), "", false, deletes || command.enabled(ui.workspace)))
      command.run(ui.workspace);
    record(ui, std::string("key_menu/") + name);
    hint(std::string(command.hint));
  }
  ImGui::EndPopup();
}

void take_mouse(const Track& t) {
  workspace::Workspace& w = t.ui.workspace;
  ImGui::SetCursorScreenPos(t.low);
  ImGui::InvisibleButton("track", {t.width(), t.high.y - t.low.y},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  record(t.ui, "time/track");
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool hovered = ImGui::IsItemHovered();
  const std::optional<int> key = hovered ? key_near(t, mouse) : std::nullopt;
  if (ImGui::IsItemActivated()) press(t, mouse);
  follow_mouse(t);
  if (hovered && ImGui::GetIO().MouseWheel != 0) {
    const double factor = std::pow(0.85, static_cast<double>(ImGui::GetIO().MouseWheel));
    w.view.time.seen = workspace::zoomed(t.seen(), t.share_at(mouse.x), factor);
  }
  if (hovered && key && ImGui::IsMouseDoubleClicked(0)) workspace::go_to_frame(w, *key);
  if (hovered && key && ImGui::IsMouseClicked(1)) {
    if (!is_selected(w, *key)) w.view.time.selected = {*key};
    ImGui::OpenPopup("Keys of time");
  }
  key_menu(t.ui);
  if (hovered && key && !w.view.time.drag) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

void hint_on_empty_track(const Track& t, ImDrawList& draw) {
  const workspace::Workspace& w = t.ui.workspace;
  if (!w.document.timeline().empty()) return;
  const char* text =
      w.document.is_movable()
          ? "Pose the model and press I to set a key. Go to another frame, pose and press I again."
          : "Open a cage, add probes or import shapes to set keys.";
  const char* brief =
      w.document.is_movable() ? "Pose the model and press I to set a key." : "No pose to key yet.";
  if (ImGui::CalcTextSize(text).x > t.high.x - t.low.x) text = brief;
  const ImVec2 size = ImGui::CalcTextSize(text);
  draw.AddText({0.5f * (t.low.x + t.high.x - size.x), t.key_y() - 0.5f * size.y}, t.ui.colors.faint, text);
}

}  // namespace

void timeline_track(const Context& ui, ImVec2 low, ImVec2 high) {
  workspace::TimeView& view = ui.workspace.view.time;
  if (!view.fitted) view.seen = workspace::fitting(ui.workspace.document.timeline());
  view.fitted = true;
  const Track track{ui, low, high};
  take_mouse(track);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({low.x, low.y + ruler_height}, high, ui.colors.card, 4);
  draw.PushClipRect(low, high, true);
  ruler(track, draw);
  outside(track, draw);
  keys(track, draw);
  box(track, draw);
  hint_on_empty_track(track, draw);
  playhead(track, draw);
  draw.PopClipRect();
}

}  // namespace viete::ui
