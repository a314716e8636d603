// Ruler, keys and playhead of the timeline.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ui/imgui_bridge.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/playing.h"
#include "workspace/time_gestures.h"
#include "workspace/time_view.h"

namespace viete::ui {

namespace {

constexpr float ruler_height = 18, key_radius = 5.5f, near_key = 7, row_height = 20, names_width = 116;
constexpr float most_rows = 7, least_rows_height = 62;  // more rows scroll

// A row of keys.
struct Row {
  std::string label;
  std::string channel;  // empty for poses and cameras
  bool cameras = false;
  float y = 0;  // the middle of the row
};

// Maps frames to the screen.
struct Track {
  const Context& ui;
  ImVec2 low, high;
  std::vector<Row> rows;

  const document::Timeline& timeline() const { return ui.workspace.document.timeline(); }

  const workspace::FrameWindow& seen() const { return ui.workspace.view.time.seen; }
  float width() const { return high.x - low.x; }
  float x_of(double frame) const { return low.x + static_cast<float>(seen().share_of(frame)) * width(); }
  double share_at(float x) const { return static_cast<double>((x - low.x) / width()); }
  double frame_at(float x) const { return seen().frame_at(share_at(x)); }
  // Calls act(key, next key or null) for the keys of a row. The mouse can have removed its last key.
  template <class Act>
  void for_keys(const Row& row, const Act& act) const {
    const auto visit = [&](const auto& keys) {
      for (const auto& key : keys) act(key, &key == &keys.back() ? nullptr : &key + 1);
    };
    if (row.channel.empty()) return row.cameras ? visit(timeline().cameras) : visit(timeline().keys);
    if (const document::Channel* channel = channel_of(timeline(), row.channel)) visit(channel->keys);
  }
};

// The weights are in the order of the list of poses.
std::vector<Row> rows_of(const document::Document& document) {
  const document::Timeline& timeline = document.timeline();
  std::vector<Row> rows{{"Poses", ""}};
  if (timeline.channels.empty() || !timeline.cameras.empty()) rows.push_back({"Camera", "", true});
  for (const document::NamedPose& named : document.library().poses)
    if (channel_of(timeline, named.name)) rows.push_back({named.name, named.name});
  return rows;
}

// Draws the names of the rows. Returns the distance by which the rows are scrolled.
float row_names(const Context& ui, std::span<const Row> rows, ImVec2 low, float height) {
  ImGui::SetCursorScreenPos(low);
  const float above = 0.5f * (row_height - ImGui::GetTextLineHeight());
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, above});
  ImGui::BeginChild("rows", {names_width, height});
  const float room = ImGui::GetContentRegionAvail().x - 6;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string shown = shortened(rows[i].label, room);
    ImGui::SetCursorPosY(static_cast<float>(i) * row_height + above);
    text_in(ui.colors.faint, shown);
    record(ui, "time/row/" + std::to_string(i));
    if (shown != rows[i].label) hint(rows[i].label);
  }
  const float scrolled = ImGui::GetScrollY();
  ImGui::EndChild();
  ImGui::PopStyleVar();
  return scrolled;
}

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
  const document::Timeline& timeline = t.timeline();
  const ImU32 shade = faded(t.ui.colors.halo, 0.55f);
  const float first = std::clamp(t.x_of(timeline.first), t.low.x, t.high.x);
  const float last = std::clamp(t.x_of(timeline.last), t.low.x, t.high.x);
  draw.AddRectFilled({t.low.x, t.low.y + ruler_height}, {first, t.high.y}, shade);
  draw.AddRectFilled({last, t.low.y + ruler_height}, t.high, shade);
}

bool is_selected(const workspace::Workspace& w, const document::KeyPlace& place) {
  return std::ranges::binary_search(w.view.time.selected, place);
}

// A diamond, and the line to the next key, which is thin for the easing `hold`.
template <class Key>
void key_mark(const Track& t, ImDrawList& draw, const Row& row, const Key& key, const Key* next) {
  const float x = t.x_of(key.frame), y = row.y, r = key_radius;
  const bool holds = key.easing == document::Easing::hold;
  if (next)
    draw.AddLine({x, y}, {t.x_of(next->frame), y}, faded(t.ui.colors.accent, holds ? 0.15f : 0.5f),
                 holds ? 1.0f : 2.0f);
  const bool selected = is_selected(t.ui.workspace, {key.frame, row.channel});
  draw.AddQuadFilled({x, y - r}, {x + r, y}, {x, y + r}, {x - r, y},
                     selected ? t.ui.colors.highlight : t.ui.colors.accent);
  draw.AddQuad({x, y - r}, {x + r, y}, {x, y + r}, {x - r, y}, t.ui.colors.halo, 1);
}

void key_mark(const Track& t, ImDrawList& draw, const Row& row, const document::CameraKey& key,
              const document::CameraKey*) {
  const float x = t.x_of(key.frame), r = key_radius - 1;
  const ImU32 color = is_selected(t.ui.workspace, key.frame) ? t.ui.colors.highlight : t.ui.colors.neutral;
  draw.AddRectFilled({x - r, row.y - 0.8f * r}, {x + r, row.y + 0.8f * r}, color, 1.5f);
}

void keys(const Track& t, ImDrawList& draw) {
  draw.PushClipRect({t.low.x, t.low.y + ruler_height}, t.high, true);
  for (const Row& row : t.rows)
    t.for_keys(row, [&](const auto& key, const auto* next) { key_mark(t, draw, row, key, next); });
  draw.PopClipRect();
}

void playhead(const Track& t, ImDrawList& draw) {
  const float x = t.x_of(t.ui.workspace.document.frame());
  if (x < t.low.x - 1 || x > t.high.x + 1) return;
  const ImU32 color = t.ui.colors.highlight;
  draw.AddLine({x, t.low.y + ruler_height - 5}, {x, t.high.y}, color, 1.5f);
  draw.AddTriangleFilled({x - 5, t.low.y + ruler_height - 8}, {x + 5, t.low.y + ruler_height - 8},
                         {x, t.low.y + ruler_height - 1}, color);
}

// The upper and the lower end of the box selection. Without rows of weights, a box has the height of the
// track.
std::pair<float, float> box_ends(const Track& t) {
  const float top = t.low.y + ruler_height;
  if (t.timeline().channels.empty()) return {top, t.high.y};
  const auto [low, high] = std::minmax(ImGui::GetIO().MouseClickedPos[0].y, ImGui::GetIO().MousePos.y);
  return {std::max(low, top), std::min(high, t.high.y)};
}

void box(const Track& t, ImDrawList& draw) {
  const auto& drag = t.ui.workspace.view.time.drag;
  if (!drag || drag->what != workspace::TimeView::What::box) return;
  const float pressed = t.x_of(drag->pressed), now = ImGui::GetIO().MousePos.x;
  const auto [top, bottom] = box_ends(t);
  draw.AddRectFilled({std::min(pressed, now), top}, {std::max(pressed, now), bottom},
                     faded(t.ui.colors.highlight, 0.15f));
}

std::optional<document::KeyPlace> key_near(const Track& t, ImVec2 mouse) {
  const auto distance_to = [&](const Row& row) { return std::abs(row.y - mouse.y); };
  const Row& row = *std::ranges::min_element(t.rows, {}, distance_to);
  std::optional<document::KeyPlace> found;
  float nearest = near_key;
  t.for_keys(row, [&](const auto& key, const auto*) {
    const float distance = std::abs(t.x_of(key.frame) - mouse.x);
    if (distance >= nearest) return;
    nearest = distance;
    found.emplace(key.frame, row.channel);
  });
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
  const auto [top, bottom] = box_ends(t);
  std::vector<std::string> rows;
  for (const Row& row : t.rows)
    if (row.y + 0.5f * row_height > top && row.y - 0.5f * row_height < bottom) rows.push_back(row.channel);
  workspace::drag_time(w, frame, rows);
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
  const auto key = hovered ? key_near(t, mouse) : std::nullopt;
  if (ImGui::IsItemActivated()) press(t, mouse);
  follow_mouse(t);
  if (hovered && ImGui::GetIO().MouseWheel != 0) {
    const double factor = std::pow(0.85, static_cast<double>(ImGui::GetIO().MouseWheel));
    w.view.time.seen = workspace::zoomed(t.seen(), t.share_at(mouse.x), factor);
  }
  if (hovered && key && ImGui::IsMouseDoubleClicked(0)) workspace::go_to_frame(w, key->frame);
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
  draw.AddText({0.5f * (t.low.x + t.high.x - size.x), t.rows.front().y - 0.5f * size.y}, t.ui.colors.faint,
               text);
}

}  // namespace

void timeline_track(const Context& ui, ImVec2 low, ImVec2 high) {
  workspace::TimeView& view = ui.workspace.view.time;
  if (!view.fitted) view.seen = workspace::fitting(ui.workspace.document.timeline());
  view.fitted = true;
  Track track{ui, low, high, rows_of(ui.workspace.document)};
  const float height = high.y - low.y - ruler_height, top = low.y + ruler_height;
  const auto count = static_cast<float>(track.rows.size());
  const bool named = !track.timeline().channels.empty();
  ui.workspace.preferences.layout.more_timeline =
      std::max(0.0f, std::min(count, most_rows) * row_height - least_rows_height);
  const float scrolled = named ? row_names(ui, track.rows, {low.x, top}, height) : 0;
  if (named) track.low.x += names_width;
  for (std::size_t i = 0; i < track.rows.size(); ++i)
    track.rows[i].y = top + (named ? (static_cast<float>(i) + 0.5f) * row_height - scrolled
                                   : (i == 0 ? 0.36f : 0.78f) * height);
  take_mouse(track);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({track.low.x, top}, high, ui.colors.card, 4);
  draw.PushClipRect(track.low, high, true);
  ruler(track, draw);
  outside(track, draw);
  keys(track, draw);
  box(track, draw);
  hint_on_empty_track(track, draw);
  playhead(track, draw);
  draw.PopClipRect();
}

}  // namespace viete::ui
