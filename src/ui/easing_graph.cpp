// How a key comes to the next one: a choice, and a curve with two handles.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "scene/document/time_edit.h"
#include "scene/workspace/command_conditions.h"
#include "scene/workspace/playing.h"
#include "scene/workspace/time_gestures.h"
#include "ui/choice_list.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

using scene::Easing;

constexpr double overshoot = 0.4;  // of the way, seen above and below

// Shares of the time and of the way, on screen.
struct Graph {
  ImVec2 low, high;

  ImVec2 at(double x, double y) const {
    const double share = (1 + overshoot - y) / (1 + 2 * overshoot);
    return {low.x + static_cast<float>(x) * (high.x - low.x),
            low.y + static_cast<float>(share) * (high.y - low.y)};
  }
  std::array<double, 2> under(ImVec2 p) const {
    const double x = static_cast<double>((p.x - low.x) / (high.x - low.x));
    const double share = static_cast<double>((p.y - low.y) / (high.y - low.y));
    return {std::clamp(x, 0.0, 1.0), 1 + overshoot - share * (1 + 2 * overshoot)};
  }
};

void easing_choice(const Context& ui, const scene::PoseKey* key, float width) {
  ImGui::BeginDisabled(!key);
  choice_list(
      ui, "time/easing", key ? std::optional(key->easing) : std::nullopt, width,
      {"time/", "Easing", "How the selected keys, or the one before this frame, come to the next one"});
  ImGui::EndDisabled();
}

// What is played: the keys beside these two have their part in it. Of an edit of this very frame time is to
// see first that it has changed the motion.
void curve(const Context& ui, const Graph& g, const scene::PoseKey& key) {
  constexpr int pieces = 48;
  scene::Workspace& w = ui.workspace;
  const bool followed = w.playback.seen_revision == w.document.history.revision();
  const auto animation = followed ? scene::animation_of(w) : w.playback.animation;
  if (!animation) return;
  const auto& keys = ui.workspace.document.timeline.keys;
  const auto from = std::ranges::lower_bound(keys, key.frame, {}, &scene::PoseKey::frame) - keys.begin();
  const std::vector<double> progress = animation->progress(static_cast<std::size_t>(from), pieces);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < progress.size(); ++i) {
    if (key.easing == Easing::hold && i == pieces) draw.PathLineTo(g.at(1, 0));
    draw.PathLineTo(g.at(static_cast<double>(i) / pieces, progress[i]));
  }
  draw.PathStroke(ui.colors.accent, 0, 1.75f);
}

// One of the two: what is dragged moves both coordinates.
void handle(const Context& ui, const Graph& g, const scene::PoseKey& key, int which) {
  constexpr float reach = 7;
  scene::Workspace& w = ui.workspace;
  const double x = key.handles[2 * which], y = key.handles[2 * which + 1];
  const ImVec2 p = g.at(x, std::clamp(y, -overshoot, 1 + overshoot)), end = g.at(which, which);
  const std::string name = "time/handle" + std::to_string(which + 1);
  ImGui::SetCursorScreenPos({p.x - reach, p.y - reach});
  ImGui::InvisibleButton(name.c_str(), {2 * reach, 2 * reach});
  record(ui, name);
  const bool held = ImGui::IsItemActive(), lit = held || ImGui::IsItemHovered();
  const bool in_force = key.easing == Easing::bezier;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 color = faded(lit ? ui.colors.highlight : ui.colors.text, in_force || lit ? 0.9f : 0.3f);
  draw.AddLine(end, p, faded(color, 0.6f), 1);
  draw.AddCircleFilled(p, lit ? 4.5f : 3.5f, color);
  if (!held && lit) hint("Drag it: how the motion leaves this key, or comes to the next one");
  if (!held || !ImGui::IsMouseDragging(0, 1) || scene::in_hand(w)) return;
  scene::Handles handles = key.handles;
  const auto [to_x, to_y] = g.under(ImGui::GetIO().MousePos);
  handles[2 * which] = to_x, handles[2 * which + 1] = to_y;
  if (handles != key.handles) scene::set_handles(w.document, key.frame, handles);
}

}  // namespace

void easing_graph(const Context& ui, ImVec2 size) {
  const scene::Workspace& w = ui.workspace;
  const std::vector<int> eased = scene::eased_keys(w);
  const scene::PoseKey* found = eased.empty() ? nullptr : scene::key_at(w.document.timeline, eased.front());
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  easing_choice(ui, found, size.x);
  const Graph g{{corner.x, ImGui::GetCursorScreenPos().y}, {corner.x + size.x, corner.y + size.y}};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(g.low, g.high, ui.colors.card, 4);
  for (const double y : {0.0, 1.0}) draw.AddLine(g.at(0, y), g.at(1, y), ui.colors.line);
  if (!found) return;
  const scene::PoseKey key = *found;  // what is dragged changes it
  draw.PushClipRect(g.low, g.high, true);
  curve(ui, g, key);
  draw.PopClipRect();
  for (const int which : {0, 1}) handle(ui, g, key, which);
}

}  // namespace viete::ui
