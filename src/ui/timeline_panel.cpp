// The timeline below the view: playback, keys and their easing.
#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "document/time_edit.h"
#include "ui/imgui_bridge.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command_tables.h"
#include "workspace/playing.h"
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

// Draws ruler, keys and playhead.
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

constexpr float bar_height = 24, more_width = 28, icon = 5;

void arrow(const Pen& pen, float x, float length) {
  pen.draw.AddTriangleFilled(pen.at(x + length, 0), pen.at(x - 0.4f * length, -0.9f),
                             pen.at(x - 0.4f * length, 0.9f), pen.color);
}
void bar(const Pen& pen, float x) {
  pen.draw.AddRectFilled(pen.at(x - 0.18f, -0.9f), pen.at(x + 0.18f, 0.9f), pen.color);
}
void diamond(const Pen& pen, float x) {
  pen.draw.AddQuadFilled(pen.at(x, -0.7f), pen.at(x + 0.6f, 0), pen.at(x, 0.7f), pen.at(x - 0.6f, 0),
                         pen.color);
}

void first_icon(const Pen& pen, bool) {
  bar(pen, -0.9f);
  arrow(pen, 0.1f, -0.8f);
}
void previous_key_icon(const Pen& pen, bool) {
  diamond(pen, 0.8f);
  arrow(pen, -0.4f, -0.8f);
}
void play_icon(const Pen& pen, bool playing) {
  if (!playing) return arrow(pen, -0.15f, 1.1f);
  bar(pen, -0.45f);
  bar(pen, 0.45f);
}
void next_key_icon(const Pen& pen, bool) {
  diamond(pen, -0.8f);
  arrow(pen, 0.4f, 0.8f);
}
void last_icon(const Pen& pen, bool) {
  bar(pen, 0.9f);
  arrow(pen, -0.1f, 0.8f);
}
void key_icon(const Pen& pen, bool) {
  diamond(pen, 0);
}
void camera_icon(const Pen& pen, bool) {
  pen.draw.AddRect(pen.at(-1, -0.6f), pen.at(0.4f, 0.6f), pen.color, 1, 0, 1.25f);
  pen.draw.AddTriangleFilled(pen.at(0.4f, 0), pen.at(1, -0.5f), pen.at(1, 0.5f), pen.color);
}
void auto_icon(const Pen& pen, bool on) {
  if (on) return pen.draw.AddCircleFilled(pen.middle, 0.8f * icon, pen.color);
  pen.draw.AddCircle(pen.middle, 0.8f * icon, pen.color, 0, 1.25f);
}
void export_icon(const Pen& pen, bool) {
  pen.draw.AddLine(pen.at(0, 0.4f), pen.at(0, -0.7f), pen.color, 1.25f);
  pen.draw.AddTriangleFilled(pen.at(0, -1.1f), pen.at(-0.5f, -0.4f), pen.at(0.5f, -0.4f), pen.color);
  const ImVec2 tray[] = {pen.at(-0.9f, 0.2f), pen.at(-0.9f, 0.9f), pen.at(0.9f, 0.9f), pen.at(0.9f, 0.2f)};
  pen.draw.AddPolyline(tray, 4, pen.color, 0, 1.25f);
}

void icon_button(const Context& ui, const char* name, void (*draw)(const Pen&, bool)) {
  const workspace::Command& command = *workspace::find_command(name);
  const bool enabled = command.enabled(ui.workspace), on = command.on(ui.workspace);
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ui.colors.card_active);
  if (button(ui, (std::string("##") + name).c_str(), std::string("time/") + name,
             std::string(command.label) + ".  " + hint_of(ui, command), {28, bar_height}, enabled))
    command.run(ui.workspace);
  if (on) ImGui::PopStyleColor();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImU32 color = faded(on ? ui.colors.accent : ui.colors.text, enabled ? 1 : 0.35f);
  draw({*ImGui::GetWindowDrawList(), {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)}, color, icon}, on);
}

std::optional<int> frame_field(const Context& ui, const char* label, const char* name, double value,
                               float width, const char* what) {
  if (*label) {
    ImGui::AlignTextToFramePadding();
    text_in(ui.colors.faint, label);
    ImGui::SameLine(0, 4);
  }
  const auto typed = number_field(ui, name, value, width, what);
  if (!typed || !std::isfinite(*typed)) return std::nullopt;
  constexpr double largest = document::Timeline::largest_frame;
  return static_cast<int>(std::lround(std::clamp(*typed, -largest, largest)));
}

void frame_shown(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  const double shown = std::round(w.document.frame() * 10) / 10;
  if (const auto frame = frame_field(ui, "Frame", "time/frame", shown, 64, "Current frame.")) {
    workspace::stop_playing(w);
    workspace::go_to_frame(w, *frame);
  }
}

// A part of a row. A part that does not fit moves to the menu at the end of the row.
struct ToolPiece {
  float width, gap;
  std::function<void()> draw;
  std::function<void()> in_menu = draw;
};

ToolPiece button_piece(const Context& ui, const char* name, void (*icon)(const Pen&, bool), float gap = 4) {
  return {28, gap, [&ui, name, icon] { icon_button(ui, name, icon); },
          [&ui, name] { menu_item(ui, *workspace::find_command(name)); }};
}

std::size_t fitting_pieces(std::span<const ToolPiece> pieces, float room) {
  std::size_t count = 0;
  for (float taken = 0; count < pieces.size(); ++count) {
    taken += pieces[count].gap + pieces[count].width;
    if (taken > room) break;
  }
  return count;
}

// A menu of the parts that do not fit.
void more_pieces(const Context& ui, const char* name, std::span<const ToolPiece> others) {
  if (button(ui, (std::string("##") + name).c_str(), name, "More timeline settings.",
             {more_width, bar_height}))
    ImGui::OpenPopup(name);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  for (const float x : {-5.0f, 0.0f, 5.0f})
    ImGui::GetWindowDrawList()->AddCircleFilled({0.5f * (low.x + high.x) + x, 0.5f * (low.y + high.y)}, 1.6f,
                                                ui.colors.text);
  if (!ImGui::BeginPopup(name)) return;
  if (key_pressed(workspace::Key::escape)) ImGui::CloseCurrentPopup();
  for (const ToolPiece& piece : others) piece.in_menu();
  ImGui::EndPopup();
}

// Adds the parts to the current row, up to x = `right`.
void row_of_pieces(const Context& ui, const char* menu, std::span<const ToolPiece> pieces, float right) {
  const float room = right - ImGui::GetItemRectMax().x;
  std::size_t count = fitting_pieces(pieces, room);
  if (count < pieces.size()) count = fitting_pieces(pieces, room - 4 - more_width);
  for (const ToolPiece& piece : pieces.first(count)) {
    ImGui::SameLine(0, piece.gap);
    piece.draw();
  }
  if (count == pieces.size()) return;
  ImGui::SameLine(0, 4);
  more_pieces(ui, menu, pieces.subspan(count));
}

void transport(const Context& ui, float right) {
  constexpr std::pair<const char*, void (*)(const Pen&, bool)> first[] = {{"first_frame", first_icon},
                                                                          {"previous_key", previous_key_icon},
                                                                          {"play", play_icon},
                                                                          {"next_key", next_key_icon}};
  for (const auto& [name, icon] : first) {
    icon_button(ui, name, icon);
    ImGui::SameLine();
  }
  icon_button(ui, "last_frame", last_icon);
  const ToolPiece pieces[] = {{112, 12, [&] { frame_shown(ui); }},
                              button_piece(ui, "set_key", key_icon, 12),
                              button_piece(ui, "set_camera_key", camera_icon),
                              button_piece(ui, "toggle_auto_key", auto_icon),
                              button_piece(ui, "save_animation", export_icon, 12)};
  row_of_pieces(ui, "time/more", pieces, right);
}

void interpolation_choice(const Context& ui) {
  const bool linear = ui.workspace.document.timeline().linear;
  const workspace::Command& command = *workspace::find_command("toggle_linear");
  const char* labels[] = {"Log space", "Linear"};
  constexpr float widths[] = {76, 56};
  const char* hints[] = {
      "Interpolate rotation and stretch between poses: halfway to 180 degrees is 90 degrees.",
      "Interpolate vertex positions linearly between poses. Rotating parts shrink."};
  ImGui::BeginDisabled(!command.enabled(ui.workspace));
  for (int i = 0; i < 2; ++i) {
    if (i > 0) ImGui::SameLine(0, 2);
    const bool on = linear == (i == 1);
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ui.colors.card_active);
    if (on) ImGui::PushStyleColor(ImGuiCol_Text, ui.colors.accent);
    if (button(ui, labels[i], i == 0 ? "time/log_space" : "time/linear", hints[i], {widths[i], bar_height}) &&
        !on)
      command.run(ui.workspace);
    if (on) ImGui::PopStyleColor(2);
  }
  ImGui::EndDisabled();
}

void rate_field(const Context& ui) {
  document::Document& document = ui.workspace.document;
  document::Playing play = document.timeline();
  const auto rate =
      number_field(ui, "time/rate", play.rate, 40, "Playback rate in frames per second, 1 to 240.");
  ImGui::SameLine(0, 4);
  ImGui::AlignTextToFramePadding();
  text_in(ui.colors.faint, "fps");
  if (!rate || !std::isfinite(*rate)) return;
  play.rate = *rate;
  document::set_play(document, play);
}

void easing_choice(const Context& ui) {
  const workspace::Workspace& w = ui.workspace;
  const workspace::KeyPlaces eased = workspace::eased_keys(w);
  const auto easing =
      eased.empty() ? std::nullopt : document::easing_at(w.document.timeline(), eased.front());
  ImGui::BeginDisabled(!easing);
  choice_list(ui, "time/easing", easing, 132,
              {"time/", "Easing",
               "Interpolation from the selected keys, or from the key before this frame, to the next key."});
  ImGui::EndDisabled();
}

void range(const Context& ui, float right) {
  document::Document& document = ui.workspace.document;
  document::Playing play = document.timeline();
  if (const auto first =
          frame_field(ui, "From", "time/first", play.first, 44, "First frame of the playback range.")) {
    play.first = *first;
    play.last = std::max(play.last, *first + 1);
  }
  ImGui::SameLine(0, 8);
  if (const auto last =
          frame_field(ui, "to", "time/last", play.last, 44, "Last frame of the playback range.")) {
    play.last = *last;
    play.first = std::min(play.first, *last - 1);
  }
  document::set_play(document, play);
  const ToolPiece pieces[] = {{76, 8, [&] { rate_field(ui); }},
                              {92, 8,
                               [&] {
                                 choice_list(ui, "time/repeat", std::optional(document.timeline().repeat), 92,
                                             {.prefix = "time/"});
                               }},
                              {134, 8, [&] { interpolation_choice(ui); }},
                              {132, 8, [&] { easing_choice(ui); }}};
  row_of_pieces(ui, "time/more_of_range", pieces, right);
}

}  // namespace

void timeline_panel(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  w.view.time.hovered = false;
  if (!w.preferences.layout.timeline) return;
  const document::Viewport& v = w.view.camera.viewport;
  const float edge = v.origin.y + v.size.y;
  const Window window("Timeline",
                      {.at = {v.origin.x, edge},
                       .pivot = {0, 0},
                       .size = {v.size.x, w.preferences.layout.timeline_height()},
                       .rounding = 0,
                       .padding = {10, 8}},
                      fixed_flags | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus |
                          ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4, 6});
  w.view.time.hovered =
      ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem | ImGuiHoveredFlags_ChildWindows);
  ImGui::GetWindowDrawList()->AddLine({v.origin.x, edge}, {v.origin.x + v.size.x, edge}, ui.colors.line);
  const ImVec2 low = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  ImGui::BeginDisabled(!w.document.model().surface);
  transport(ui, low.x + room.x);
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const float bottom = low.y + room.y - bar_height - 6;
  timeline_track(ui, top, {low.x + room.x, bottom});
  ImGui::SetCursorScreenPos({low.x, bottom + 6});
  range(ui, low.x + room.x);
  ImGui::EndDisabled();
  ImGui::PopStyleVar();
}

}  // namespace viete::ui
