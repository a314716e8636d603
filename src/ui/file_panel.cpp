#include <imgui_internal.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "base/text.h"
#include "ui/imgui_bridge.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "workspace/file_browser.h"

namespace viete::ui {

namespace {

using Browser = workspace::FileBrowser;
using Purpose = Browser::Purpose;
using What = files::OpenRequest::What;
using Content = workspace::SaveFile::Content;

/// A purpose of the panel: a title, and what is opened from or saved to the chosen file.
struct Task {
  Purpose purpose;
  const char* title;
  std::optional<What> open{};
  std::optional<Content> save{};
};

const Task tasks[] = {{Purpose::model, "Open model or session", What::model},
                      {Purpose::cage, "Open cage", What::cage},
                      {Purpose::pose, "Open pose", What::pose},
                      {Purpose::poses, "Import poses from a file or its folder", What::poses},
                      {Purpose::shapes, "Import shapes from a file or its folder", What::shapes},
                      {Purpose::animation, "Import animation", What::animation},
                      {Purpose::locate_model, "Locate the session's model"},
                      {Purpose::locate_cage, "Locate the session's cage"},
                      {Purpose::save_session, "Save session", {}, Content::session},
                      {Purpose::save_pose, "Save pose", {}, Content::pose},
                      {Purpose::save_cage, "Save cage", {}, Content::cage},
                      {Purpose::save_model, "Export model", {}, Content::model},
                      {Purpose::save_animation, "Export animation", {}, Content::animation}};

const Task& task_of(Purpose purpose) {
  return *std::ranges::find(tasks, purpose, &Task::purpose);
}

void request(workspace::Workspace& w, Purpose purpose, const std::filesystem::path& path) {
  const Task& task = task_of(purpose);
  if (task.open) {
    w.jobs.wishes.open({*task.open, {path}});
  } else if (task.save) {
    w.jobs.wishes.save(*task.save, path);
  } else if (auto request = std::exchange(w.files.unopened, std::nullopt)) {
    (purpose == Purpose::locate_model ? request->located.model : request->located.cage) = path;
    w.jobs.wishes.open(*std::move(request));
  }
}

// The panel stays open until the file has been read or written.
void ask(workspace::Workspace& w, const std::filesystem::path& path) {
  if (!w.files.browser.asked.empty()) return;
  request(w, w.files.browser.purpose, path);
  w.files.browser.asked = path;
}

// Shows a folder in the panel, or asks for a file.
void choose(workspace::Workspace& w, const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return workspace::enter(w.files.browser, path);
  ask(w, path);
  w.preferences.folder = path.parent_path();
}

// Opens the path in the filter. If that is impossible, keeps the path row and sets Browser::filter_problem.
void choose_filtered(workspace::Workspace& w) {
  Browser& browser = w.files.browser;
  const std::string path = std::exchange(browser.path, browser.filter);
  const std::filesystem::path typed = workspace::typed_path(browser);
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(typed, ignored);
  browser.filter_problem = is_folder ? "" : workspace::problem_of_name(browser);
  if (!browser.filter_problem.empty()) {
    browser.path = path;
    return;
  }
  browser.filter.clear();
  choose(w, is_folder ? typed : workspace::chosen_file(browser));
}

void choose_typed(workspace::Workspace& w) {
  auto& browser = w.files.browser;
  if (workspace::filters_by_path(browser)) return choose_filtered(w);
  const std::filesystem::path typed = workspace::typed_path(browser);
  std::error_code ignored;
  if (std::filesystem::is_directory(typed, ignored)) return choose(w, typed);
  browser.problem = workspace::problem_of_name(browser);
  if (browser.problem.empty()) choose(w, workspace::chosen_file(browser));
}

// The user must press Enter twice to overwrite a file.
void confirm_typed(workspace::Workspace& w) {
  if (w.files.browser.replaces() && w.files.browser.warned != w.files.browser.path) {
    w.files.browser.warned = w.files.browser.path;
  } else {
    choose_typed(w);
  }
}

std::string bytes_text(std::uintmax_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + " B";
  const std::string tenths = std::to_string(bytes / 100000 % 10);
  return bytes < 1000000 ? std::to_string(bytes / 1000) + " kB"
                         : std::to_string(bytes / 1000000) + "." + tenths + " MB";
}

bool text_field(const char* id, const char* empty, std::string& value, ImGuiInputTextFlags flags) {
  char text[4096];
  std::strncpy(text, value.c_str(), sizeof text - 1);
  text[sizeof text - 1] = 0;
  const bool done = ImGui::InputTextWithHint(id, empty, text, sizeof text, flags);
  value = text;
  return done;
}

void path_field(const Context& ui) {
  Browser& browser = ui.workspace.files.browser;
  if (browser.appearing && browser.saves()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  // A proposed name is selected, so that typing replaces it. A name with a problem is not selected.
  const bool proposed = browser.problem.empty() && browser.warned.empty();
  const auto flags = ImGuiInputTextFlags_EnterReturnsTrue |
                     (proposed ? ImGuiInputTextFlags_AutoSelectAll : ImGuiInputTextFlags_None);
  const std::string before = browser.path;
  const bool enter = text_field("##path", "", browser.path, flags);
  record(ui, "file_path");
  hint(browser.saves() ? "File to write. The extension sets the format."
                       : "File to open. Press Enter to open it.");
  if (browser.path != before) {
    browser.problem.clear();
    browser.highlighted = browser.saves() ? Browser::none : 0;
  }
  if (enter) confirm_typed(ui.workspace);
  if (enter && browser.open) ImGui::SetKeyboardFocusHere(-1);
}

void format_buttons(const Context& ui, const std::vector<std::string_view>& formats, bool own_row) {
  Browser& browser = ui.workspace.files.browser;
  const std::string now = workspace::format_of(browser);
  for (const std::string_view format : formats) {
    std::string label(format);
    std::ranges::transform(label, label.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    if (!own_row || format != formats.front()) ImGui::SameLine();
    const bool active = now == format;
    ImGui::PushStyleColor(ImGuiCol_Button, active ? ui.colors.card_active : ui.colors.card);
    ImGui::PushStyleColor(ImGuiCol_Text, active ? ui.colors.text : ui.colors.faint);
    if (button(ui, label.c_str(), "format_" + std::string(format), "Write " + label + "."))
      workspace::set_format(browser, std::string(format));
    ImGui::PopStyleColor(2);
  }
}

void set_filter(Browser& browser, const std::string& filter) {
  if (filter == browser.filter) return;
  browser.filter = filter;
  browser.filter_problem.clear();
  browser.highlighted = browser.saves() && filter.empty() ? Browser::none : 0;
  if (!browser.saves()) browser.path = browser.folder.string();
}

// Adds typed characters to the filter while no text field has the focus. Backspace removes the last one.
void type_filter(Browser& browser) {
  std::string filter = browser.filter;
  if (key_pressed(workspace::Key::backspace, true) && !filter.empty())
    filter = base::cut(filter, filter.size() - 1);
  const ImVector<ImWchar>& typed = ImGui::GetIO().InputQueueCharacters;
  char text[256] = "";
  if (!typed.empty()) ImTextStrToUtf8(text, sizeof text, typed.begin(), typed.end());
  set_filter(browser, filter + text);
}

// Returns true if the filter has the keyboard focus.
bool filter_row(const Context& ui) {
  Browser& browser = ui.workspace.files.browser;
  if (button(ui, "Up", "file_up", "Go to the parent folder.  (Backspace)"))
    workspace::enter(browser, browser.folder.parent_path());
  ImGui::SameLine();
  if (browser.appearing && !browser.saves()) ImGui::SetKeyboardFocusHere();
  const auto formats = browser.saves() ? browser.formats() : std::vector<std::string_view>();
  constexpr float button_width = 53;
  const bool own_row = formats.empty() || formats.size() > 8;
  ImGui::SetNextItemWidth(own_row ? -1.0f : -button_width * static_cast<float>(formats.size()));
  std::string filter = browser.filter;
  text_field("##filter", "Filter", filter, 0);
  record(ui, "file_filter");
  set_filter(browser, filter);
  const bool typing = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
  format_buttons(ui, formats, own_row);
  return typing;
}

// Returns the clicked entry. A click changes the list, so the click is handled after drawing.
std::optional<std::size_t> entry_list(const Context& ui, const std::vector<const Browser::Entry*>& entries,
                                      bool moved) {
  std::optional<std::size_t> clicked;
  if (const std::string& problem = ui.workspace.files.browser.filter_problem; !problem.empty()) {
    note(ui, problem, ui.colors.bad);
    record(ui, "filter_problem");
    return clicked;
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& entry = *entries[i];
    const Browser& browser = ui.workspace.files.browser;
    const bool highlighted = i == browser.highlighted;
    const float line = ImGui::GetCursorScreenPos().y;
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    const std::string label = entry.folder ? entry.name + "/" : entry.name;
    ImGui::PushStyleColor(ImGuiCol_Header, ui.colors.card_active);
    if (ImGui::Selectable((label + "##" + std::to_string(i)).c_str(), highlighted,
                          ImGuiSelectableFlags_AllowDoubleClick))
      clicked = i;
    ImGui::PopStyleColor();
    if (highlighted && moved) ImGui::SetScrollHereY();
    record(ui, "file/" + entry.name);
    if (!entry.folder) {  // the size, on the same line
      text_right(ui, right, bytes_text(entry.bytes), ui.colors.faint, line);
    }
  }
  if (!entries.empty()) return clicked;
  const bool sessions = ui.workspace.files.browser.purpose == Purpose::save_session;
  note(ui, workspace::filters_by_path(ui.workspace.files.browser) ? "Press Enter to go to this path."
           : !ui.workspace.files.browser.filter.empty()           ? "No file matches."
           : sessions                                             ? "No session in this folder."
                      : "No " + workspace::format_list(ui.workspace.files.browser) + " file in this folder.");
  return clicked;
}

// Opens a folder or file. When saving, the first call for a file only copies its path to the text field.
void take(workspace::Workspace& w, const Browser::Entry& entry) {
  const std::filesystem::path path = w.files.browser.folder / entry.name;
  if (entry.folder || !w.files.browser.saves()) return choose(w, path);
  if (w.files.browser.path == path.string()) return confirm_typed(w);
  w.files.browser.path = path.string();
}

// A click selects an entry. A double click also opens the entry, except a file when saving.
void click_entry(workspace::Workspace& w, std::size_t index) {
  workspace::highlight(w.files.browser, index);
  const Browser::Entry& entry = *workspace::shown(w.files.browser)[index];
  if (ImGui::IsMouseDoubleClicked(0) && (entry.folder || !w.files.browser.saves())) take(w, entry);
}

// Up and Down move the highlight, Enter confirms, Esc closes. If the filter was empty, Backspace goes to the
// parent folder. Returns true if the highlight moved.
bool handle_keys(const Context& ui, bool typing_filter, bool filter_was_empty) {
  Browser& browser = ui.workspace.files.browser;
  const int steps = arrow_steps();
  if (steps != 0) workspace::move_highlight(browser, steps);
  if (key_pressed(workspace::Key::escape)) browser.open = false;
  const bool typing = ImGui::GetIO().WantTextInput;
  if (typing && !typing_filter) return steps != 0;
  if (key_pressed(workspace::Key::backspace) && filter_was_empty)
    workspace::enter(browser, browser.folder.parent_path());
  if (!typing) type_filter(browser);
  if (!enter_pressed()) return steps != 0;
  const auto entries = workspace::shown(browser);
  if (!browser.saves() && workspace::filters_by_path(browser)) {
    choose_typed(ui.workspace);
    browser.appearing = browser.open;
    return false;
  }
  if (browser.highlighted < entries.size()) {
    take(ui.workspace, *entries[browser.highlighted]);
    browser.appearing = browser.open;  // keeps the keyboard focus
  } else if (browser.saves() && browser.filter.empty()) {
    confirm_typed(ui.workspace);
  }
  return steps != 0;
}

bool shows_pictures(const Browser& browser) {
  return browser.pictures && browser.makes_pictures();
}

void morph_row(const Context& ui) {
  workspace::MorphChoice& morphs = ui.workspace.files.browser.morphs;
  row_label("Tolerance", 0);
  if (const auto percent = number_field(ui, "morph_tolerance", 100 * morphs.tolerance, 64,
                                        "Maximum playback error, in percent of the model's diagonal."))
    morphs.tolerance = std::clamp(*percent / 100, 1e-7, 1.0);
  ImGui::SameLine();
  ImGui::TextUnformatted("%");
  ImGui::SameLine(0, 18);
  checkbox(ui, "Normals", "morph_normals", morphs.normals,
           "Export normals, for correct shading in every player. Doubles the file size.");
}

void picture_choices(const Context& ui) {
  workspace::PictureChoice& choice = *ui.workspace.files.browser.pictures;
  const auto box = [&](const char* label, const char* name, bool& on, const char* what) {
    checkbox(ui, label, name, on, what);
    ImGui::SameLine(0, 18);
  };
  box("Cage", "picture_cage", choice.cage, "Draw the cage.");
  box("Grid", "picture_grid", choice.grid, "Draw the ground grid.");
  box("Light theme", "picture_light", choice.light, "Use the light theme.");
  box("Panels", "picture_panels", choice.panels, "Include the panels and bars of the window.");
  const auto side = [&](const char* name, int& pixels) {
    constexpr double least = workspace::least_picture, most = workspace::largest_picture;
    if (const auto typed = number_field(ui, name, pixels, 64, "Width and height in pixels, 16 to 8192."))
      pixels = static_cast<int>(std::clamp(*typed, least, most));
  };
  side("picture_width", choice.width);
  ImGui::SameLine();
  ImGui::TextUnformatted("x");
  ImGui::SameLine();
  side("picture_height", choice.height);
}

// Two lines below the path: an error, or a warning that a file will be replaced.
void path_note(const Context& ui) {
  const Browser& browser = ui.workspace.files.browser;
  const float line = ImGui::GetCursorPosY();
  if (!browser.problem.empty()) {
    note(ui, browser.problem, ui.colors.bad);
    record(ui, "file_problem");
  } else if (const auto [first, count] = browser.replaced(); count > 0) {
    const std::string more = count > 1 ? " and " + base::counted(count - 1, "more file") : "";
    const std::string exist =
        first.filename().string() + more + (count > 1 ? " already exist" : " already exists");
    const std::string them = count > 1 ? "them." : "it.";
    note(ui,
         exist + (browser.warned == browser.path ? "; press Enter again to replace " + them
                                                 : " and will be replaced."),
         ui.colors.warn);
    record(ui, "file_replaces");
  }
  const float end = line + 2 * ImGui::GetTextLineHeightWithSpacing();
  ImGui::SetCursorPosY(std::max(end, ImGui::GetCursorPosY()));
}

void button_row(const Context& ui) {
  Browser& browser = ui.workspace.files.browser;
  const bool replaces = browser.replaces();
  const char* label = !browser.saves() ? "Open###choose" : replaces ? "Replace###choose" : "Save###choose";
  const bool confirmed = button(ui, label, "file_choose", "");
  ImGui::SameLine();
  if (button(ui, "Cancel", "file_cancel", "")) browser.open = false;
  if (browser.purpose == Purpose::poses || browser.purpose == Purpose::shapes) {
    ImGui::SameLine();
    if (button(ui, "Import folder", "file_folder",
               browser.purpose == Purpose::poses ? "Import all posed versions of the cage in this folder."
                                                 : "Import all shapes of the model in this folder."))
      ask(ui.workspace, browser.folder);
  }
  if (!confirmed) return;
  const auto entries = workspace::shown(browser);
  const bool untouched = !browser.saves() && browser.path == browser.folder.string();
  if (untouched && browser.highlighted < entries.size())
    take(ui.workspace, *entries[browser.highlighted]);
  else
    choose_typed(ui.workspace);
}

void content(const Context& ui) {
  Browser& browser = ui.workspace.files.browser;
  path_field(ui);
  path_note(ui);
  const bool filter_was_empty = browser.filter.empty();
  const bool typing_filter = filter_row(ui);
  browser.appearing = false;
  const bool moved = browser.open && handle_keys(ui, typing_filter, filter_was_empty);
  const float row = ImGui::GetFrameHeight() + 12;
  ImGui::BeginChild("entries", {0, browser.makes_morphs() || shows_pictures(browser) ? -2 * row : -row},
                    true);
  const auto clicked = entry_list(ui, workspace::shown(browser), moved);
  ImGui::EndChild();
  record(ui, "file_list");
  if (clicked) click_entry(ui.workspace, *clicked);
  if (browser.makes_morphs()) morph_row(ui);
  if (shows_pictures(browser)) picture_choices(ui);
  button_row(ui);
}

}  // namespace

void file_panel(const Context& ui) {
  Browser& browser = ui.workspace.files.browser;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ImVec2 size{std::min(640.0f, display.x), std::min(460.0f, display.y)};
  bool open = true;
  workspace::refresh(browser);
  const Dialog dialog((std::string(task_of(browser.purpose).title) + "###file_panel").c_str(),
                      {.at = middle_of_view(ui), .size = size}, dialog_flags, &open);
  if (dialog) content(ui);
  if (!open) browser.open = false;
  if (!browser.open) browser.asked.clear();  // later errors are shown as messages
}

}  // namespace viete::ui
