// The Poses panel: named poses, each with its picture and weight slider.
#include <cmath>
#include <cstring>
#include <string>

#include "document/pose_edit.h"
#include "document/time_edit.h"
#include "ui/overlay_painter.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/command_tables.h"
#include "workspace/playing.h"

namespace viete::ui {

namespace {

using workspace::pose_picture_size;

constexpr const char* dragged_pose = "pose";
constexpr const char* pose_menu = "Pose menu";
constexpr float percent_width = 54, percent_sign = 14, key_width = 16;

// The user's changes of the list, applied after all rows are drawn.
struct PoseWish {
  std::optional<std::size_t> chosen, applied, keyed;
  std::optional<std::pair<std::size_t, std::string>> name;
  std::optional<std::pair<std::size_t, double>> weight;
  std::optional<std::pair<std::size_t, std::size_t>> moved;
};

void draw_pose(const Context& ui, const document::NamedPose& named, ImVec2 low, bool chosen, bool hovered) {
  workspace::Workspace& w = ui.workspace;
  const ImVec2 high{low.x + pose_picture_size.x, low.y + pose_picture_size.y};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, hovered ? ui.colors.card_hover : ui.colors.card, 4);
  draw_picture(ui, low, w.panels.pose_pictures.of(w.document, named.pose, w.view.camera.pose().up));
  if (chosen) list.AddRect(low, high, ui.colors.accent, 4, 0, 1.5f);
}

// A dropped row gets the place of the row under the pointer.
void drag_row(std::size_t row, PoseWish& wish) {
  if (ImGui::BeginDragDropSource(ImGuiDragDropFlags_SourceNoPreviewTooltip)) {
    ImGui::SetDragDropPayload(dragged_pose, &row, sizeof row);
    ImGui::EndDragDropSource();
  }
  if (!ImGui::BeginDragDropTarget()) return;
  if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(dragged_pose)) {
    std::size_t from = 0;
    std::memcpy(&from, payload->Data, sizeof from);
    wish.moved = std::pair(from, from < row ? row + 1 : row);
  }
  ImGui::EndDragDropTarget();
}

void picture(const Context& ui, std::size_t row, const document::NamedPose& named, PoseWish& wish) {
  const std::string id = "pose/" + std::to_string(row);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  if (ImGui::InvisibleButton(id.c_str(), {pose_picture_size.x, pose_picture_size.y})) wish.chosen = row;
  record(ui, id);
  const bool hovered = ImGui::IsItemHovered();
  if (hovered && ImGui::IsMouseDoubleClicked(0)) wish.applied = row;
  hint("Click to choose, double click to apply, drag to reorder.");
  drag_row(row, wish);
  draw_pose(ui, named, low, ui.workspace.view.chosen_pose == row, hovered);
}

// A filled diamond: the weight has a key at this frame. An outline: it has other keys. A dot: it has no keys.
void key_of_weight(const Context& ui, std::size_t row, PoseWish& wish) {
  const workspace::Workspace& w = ui.workspace;
  const std::string id = "pose_key/" + std::to_string(row);
  const ImVec2 low = ImGui::GetCursorScreenPos(), size{key_width, ImGui::GetFrameHeight()};
  if (ImGui::InvisibleButton(id.c_str(), size)) wish.keyed = row;
  record(ui, id);
  const bool hovered = ImGui::IsItemHovered();
  const document::Channel* channel = channel_of(w.document.timeline(), w.document.library().poses[row].name);
  const ImVec2 middle{low.x + 0.5f * size.x, low.y + 0.5f * size.y};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (channel && key_at(channel->keys, current_frame(w.document)))
    list.AddNgonFilled(middle, 5.5f, ui.colors.accent, 4);
  else if (channel || hovered)
    list.AddNgon(middle, 5, hovered ? ui.colors.text : ui.colors.accent, 4, 1.25f);
  else
    list.AddCircleFilled(middle, 1.5f, ui.colors.faint);
  hint(
      "Set or delete a key of this weight at the current frame. I does the same with the pointer over the "
      "slider.");
}

void weight(const Context& ui, std::size_t row, double shown, PoseWish& wish) {
  const std::string id = "pose_weight/" + std::to_string(row);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const double percent = std::round(1000 * shown) / 10;
  auto slid = static_cast<float>(percent);
  ImGui::SetNextItemWidth(-percent_width - percent_sign - key_width - ImGui::GetStyle().ItemInnerSpacing.x);
  constexpr double least = 100 * document::PoseLibrary::least_weight,
                   most = 100 * document::PoseLibrary::largest_weight;
  const Slid done = slider(ui, id, percent, least, most, [&] {
    return ImGui::SliderFloat(("##" + id).c_str(), &slid, -50, 150, "", ImGuiSliderFlags_NoInput);
  });
  if (done.moved) wish.weight = std::pair(row, 0.01 * std::round(static_cast<double>(slid)));
  if (done.typed) wish.weight = std::pair(row, 0.01 * *done.typed);
  hint("Weight of this pose. 0 %: no effect. 100 %: the full pose. Values outside this range extrapolate.");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  if (const auto typed =
          number_field(ui, id + "/typed", percent, percent_width, "Weight in percent, from -200 to 300."))
    wish.weight = std::pair(row, 0.01 * *typed);
  ImGui::SameLine(0, 3);
  ImGui::TextUnformatted("%");
  ImGui::SameLine(0, 0);
  key_of_weight(ui, row, wish);
  if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, ImGui::GetItemRectMax()))
    ui.workspace.panels.hovered_weight = row;
}

void row(const Context& ui, std::size_t index, double shown, PoseWish& wish) {
  const document::NamedPose& named = ui.workspace.document.library().poses[index];
  const std::string id = std::to_string(index);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  picture(ui, index, named, wish);
  ImGui::SameLine();
  ImGui::BeginGroup();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 2});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {6, 1});
  const float width = ImGui::GetContentRegionAvail().x;
  if (const auto name =
          name_field(ui, "pose_name/" + id, named.name, width, "Name of the pose. Type to rename it."))
    wish.name = std::pair(index, *name);
  weight(ui, index, shown, wish);
  ImGui::PopStyleVar(2);
  ImGui::EndGroup();
  const bool hovered = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, ImGui::GetItemRectMax());
  if (!hovered || !ImGui::IsMouseClicked(1)) return;
  wish.chosen = index;
  ImGui::OpenPopup(pose_menu);
}

void grant(workspace::Workspace& w, const PoseWish& wish) {
  if (wish.chosen) w.view.chosen_pose = wish.chosen;
  if (wish.weight) {
    const auto [pose, weight] = *wish.weight;
    workspace::change_mix(w, [&] {
      return document::set_weight(w.document, w.playback.vectors, pose, weight, workspace::shown_weights(w));
    });
  }
  if (wish.keyed) {
    w.view.chosen_pose = wish.keyed;
    workspace::find_command("key_weight")->run(w);
  }
  if (wish.name) document::rename_pose(w.document, wish.name->first, wish.name->second);
  if (wish.applied) workspace::apply_pose(w, *wish.applied);
  if (wish.moved) {
    const auto [from, to] = *wish.moved;
    document::move_pose(w.document, from, to);
    w.view.chosen_pose = to > from ? to - 1 : to;
  }
}

}  // namespace

void panel_poses(const Context& ui) {
  workspace::Workspace& w = ui.workspace;
  if (!w.document.model().surface) return;
  const std::size_t poses = w.document.library().poses.size();
  const bool open = section(ui, "Poses");
  if (poses > 0) section_note(ui, count(poses));
  if (!open) return;
  if (poses == 0) {
    note(ui, "Add poses to combine them with sliders or use them as keys.");
    return command_row(ui, {"keep_pose"});
  }
  const bool free = !workspace::is_dragging(w) && !document::is_editing_cage(w.document);
  PoseWish wish;
  w.panels.pose_pictures.tidy();
  // The buttons are above the list, so that they do not move if the list grows.
  command_row(ui, {"keep_pose", "apply_pose", "update_pose"});
  ImGui::BeginDisabled(!free);
  const std::vector<double> shown =
      workspace::shown_weights(w);  // after the buttons, which can change the poses
  for (std::size_t i = 0; i < shown.size(); ++i) row(ui, i, shown[i], wish);
  ImGui::EndDisabled();
  command_menu(ui, pose_menu, {"apply_pose", "update_pose", "key_weight", "remove_pose"});
  if (free) grant(w, wish);
}

}  // namespace viete::ui
