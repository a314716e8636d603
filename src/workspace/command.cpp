#include "workspace/command.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "base/file_bytes.h"
#include "base/text.h"

namespace viete::workspace {

namespace {

struct Title {
  std::string_view title;
  std::array<std::string_view, 4> groups;
};

constexpr Title titles[] = {{"File", {"File"}},        {"Edit", {"Edit"}},
                            {"Select", {"Select"}},    {"Cage", {"Cage"}},
                            {"Tool", {"Tool"}},        {"Transform", {"Transform"}},
                            {"Probes", {"Probes"}},    {"Time", {"Poses", "Time"}},
                            {"View", {"View"}},        {"Deform", {"Method", "Blend", "Map", "Views"}},
                            {"Help", {"Help", "Keys"}}};

// The first commands of the sections of long menus.
constexpr std::string_view section_starts =
    " save_session save_model restore_leftover screenshot quit select_all select_box select_more "
    "hide_selected save_set edit_cage split_edges subdivide_cage fit_cage toggle_pulls bend copy_pose "
    "place_pivot mirror_copy mask_clear import_poses set_key previous_frame fit_range import_animation "
    "toggle_timeline toggle_z_up toggle_wireframe toggle_grid toggle_theme toggle_panels ";

std::vector<Menu> make_menus() {
  std::vector<Menu> all;
  for (const Title& title : titles) {
    Menu menu{title.title, {}};
    for (const Command& command : commands()) {
      if (std::ranges::count(title.groups, command.group) > 0) menu.items.push_back(&command);
    }
    all.push_back(std::move(menu));
  }
  return all;
}

// True if the text contains the letters in this order, possibly with other letters between them.
bool has_letters(std::string_view text, std::string_view letters) {
  std::size_t at = 0;
  for (const char c : text) {
    if (at < letters.size() && c == letters[at]) ++at;
  }
  return at == letters.size();
}

// How well a word matches a command; 0: no match.
int fit(const Command& command, const std::string& word) {
  const std::string label = base::lower_case(command.label), group = base::lower_case(command.group);
  const std::string words = ' ' + label;
  if (label == word) return 120;
  if (label.starts_with(word)) return 100;
  if (words.find(' ' + word) != std::string::npos) return 80;
  if (label.find(word) != std::string::npos) return 60;
  if (group.starts_with(word)) return 50;
  if (base::lower_case(command.name).find(word) != std::string::npos) return 40;
  if (base::lower_case(command.hint).find(word) != std::string::npos) return 20;
  if (!has_letters(label, word)) return 0;
  return label.front() == word.front() ? 15 : 10;
}

int fit_of_all(const Command& command, const std::vector<std::string>& words) {
  int sum = 1;
  for (const std::string& word : words) {
    const int one = fit(command, word);
    if (one == 0) return 0;
    sum += one;
  }
  return sum;
}

}  // namespace

bool begins_section(const Command& command) {
  return section_starts.find(' ' + command.name + ' ') != std::string_view::npos;
}

std::span<const Menu> menus() {
  static const std::vector<Menu> all = make_menus();
  return all;
}

std::vector<const Command*> find_commands(const Workspace& workspace, std::string_view typed) {
  std::vector<std::string> words;
  std::istringstream stream(base::lower_case(typed));
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<std::pair<int, const Command*>> found;
  for (const Command& command : commands()) {
    if (command.passing && !command.enabled(workspace)) continue;
    if (const int score = fit_of_all(command, words); score > 0) found.emplace_back(score, &command);
  }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const Command*> all;
  for (const auto& [score, command] : found) all.push_back(command);
  return all;
}

std::string Command::label_now(const Workspace& workspace, std::string_view called) const {
  const std::string what = subject ? subject(workspace) : "";
  return what.empty() ? std::string(called) : std::string(called) + ' ' + base::capitalised(what);
}

const Command* find_command(std::string_view name) {
  const auto all = commands();
  const auto found = std::ranges::find(all, name, &Command::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace viete::workspace
