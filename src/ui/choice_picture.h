// Lists of commands that choose a value, with tooltips and pictures.
#pragma once

#include <string>

#include "scene/pictures/choice_picture.h"
#include "scene/pictures/picture_view.h"
#include "scene/workspace/choice_commands.h"
#include "ui/context.h"
#include "ui/widgets.h"

namespace viete::ui {

/// Into the window that is being built, from a corner on.
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

/// Beside the window or list that the last item is in, so that it covers none of the other entries.
void picture_hint(const Context& ui, const scene::ChoicePicture& picture, const std::string& sentence,
                  const std::string& more = "");

/// Of the last item, while the cursor is over it: only then its picture is made.
template <class Choice>
void choice_hint(const Context& ui, Choice choice, const std::string& more = "") {
  if (wants_hint())
    picture_hint(ui, ui.workspace.choice_pictures.of(choice), std::string(scene::entry(choice).sentence),
                 more);
}

struct ChoiceListWords {
  const char* prefix = "";  ///< of the names of its lines, for tests
  const char* none = "";    ///< stands in it where there is no value,
  const char* about = "";   ///< and what it is for, instead of what the value does
};

/// Closed it shows the value, open all of them; what it stands at is marked.
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

/// The same of a table of what is no command: what is chosen, where something is.
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
