// Lists of commands that choose a value, with tooltips and pictures.
#pragma once

#include <string>

#include "scene/pictures/choice_picture.h"
#include "scene/pictures/picture_view.h"
#include "scene/workspace/choice_commands.h"
#include "ui/context.h"
#include "ui/widgets.h"

namespace viete::ui {

/// Draws into the current window, relative to a corner.
class PicturePainter {
public:
  PicturePainter(const Context& ui, ImVec2 corner);
  ~PicturePainter();
  PicturePainter(const PicturePainter&) = delete;
  PicturePainter& operator=(const PicturePainter&) = delete;

  void draw(const scene::PictureShape& shape);

private:
  using Shape = scene::PictureShape;

  std::vector<ImVec2> placed(const Shape& shape) const;
  void line(const Shape& shape, ImU32 color, float width, ImDrawFlags flags = 0);
  void fill(const Shape& shape, ImU32 color);
  void lit(const Shape& shape);
  ImU32 color_of(float weight) const;
  void weighed(const Shape& shape);
  void triangles(const Shape& shape, const std::vector<ImU32>& colors);

  const Context& ui_;
  ImDrawList& list_;
  ImVec2 corner_;
};

/// Placed next to the window or list of the last item, so that no other entry is covered.
void picture_hint(const Context& ui, const scene::ChoicePicture& picture, const std::string& sentence,
                  const std::string& more = "");

/// For the last item while it is hovered; only then the picture is created.
template <class Choice>
void choice_hint(const Context& ui, Choice choice, const std::string& more = "") {
  if (wants_hint())
    picture_hint(ui, ui.workspace.choice_pictures.of(choice), std::string(scene::entry(choice).sentence),
                 more);
}

struct ChoiceListWords {
  const char* prefix = "";  ///< of the entries' widget names, for tests
  const char* none = "";    ///< text shown without a value
  const char* about = "";   ///< hint that replaces that of the value
};

/// A combo box of all values with the current one marked.
template <class Value>
void choice_list(const Context& ui, const std::string& name, std::optional<Value> now, float width,
                 const ChoiceListWords& words = {}) {
  ImGui::SetNextItemWidth(width);
  const char* const shown = now ? base::entry_of(*now).label.data() : words.none;
  const bool open = ImGui::BeginCombo(("##" + name).c_str(), shown, ImGuiComboFlags_HeightLargest);
  record(ui, name, now.has_value());
  if (!open) return hint(*words.about || !now ? words.about : std::string(base::entry_of(*now).hint));
  const std::span<const base::Choice> all = choices(Value{});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto value = static_cast<Value>(i);
    const scene::Command& command = *scene::find_command(scene::choice_command_name(value));
    if (ImGui::Selectable(all[i].label.data(), value == now) && command.enabled(ui.workspace))
      command.run(ui.workspace);
    record(ui, words.prefix + command.name);
    hint(std::string(all[i].hint));
  }
  ImGui::EndCombo();
}

/// As choice_list(), for a table without commands; returns a newly chosen value.
template <class Entry, class Value = decltype(Entry::value)>
std::optional<Value> entry_list(const Context& ui, const std::string& name, std::span<const Entry> table,
                                Value now) {
  const auto label = [](const Entry& e) {
    if constexpr (requires { e.label; })
      return e.label.data();
    else
      return e.name.data();
  };
  std::optional<Value> chosen;
  const Entry& shown = entry(now);
  const bool open = ImGui::BeginCombo(("##" + name).c_str(), label(shown));
  record(ui, name);
  if (!open) {
    hint(std::string(shown.sentence));
    return chosen;
  }
  for (const Entry& e : table) {
    if (ImGui::Selectable(label(e), e.value == now)) chosen = e.value;
    record(ui, name + '_' + std::string(e.name));
    hint(std::string(e.sentence));
  }
  ImGui::EndCombo();
  return chosen;
}

}  // namespace viete::ui
