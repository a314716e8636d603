#include <algorithm>
#include <cstring>
#include <filesystem>
#include <utility>

#include "scene/workspace/file_browser.h"
#include "ui/format.h"
#include "ui/imgui_bridge.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace viete::ui {

namespace {

using Browser = scene::FileBrowser;
using Purpose = Browser::Purpose;
using What = scene::OpenRequest::What;

const char* title(Purpose purpose) {
  switch (purpose) {
    case Purpose::model: return "Open model or session###file_panel";
    case Purpose::cage: return "Open cage###file_panel";
    case Purpose::pose: return "Open pose###file_panel";
    case Purpose::poses: return "Import poses from a file or its folder###file_panel";
    case Purpose::shapes: return "Import shapes from a file or its folder###file_panel";
    case Purpose::animation: return "Import animation###file_panel";
    case Purpose::locate_model: return "Locate model of the session###file_panel";
    case Purpose::locate_cage: return "Locate cage of the session###file_panel";
    case Purpose::save_session: return "Save session###file_panel";
    case Purpose::save_pose: return "Save pose###file_panel";
    case Purpose::save_named_pose: return "Export pose###file_panel";
    case Purpose::save_cage: return "Save cage###file_panel";
    case Purpose::save_model: return "Export deformed mesh###file_panel";
    case Purpose::save_animation: return "Export animation###file_panel";
  }
  return "###file_panel";
}

void request(scene::Workspace& w, Purpose purpose, const std::filesystem::path& path) {
  scene::Requests& requests = w.requests;
  switch (purpose) {
    case Purpose::model: requests.open = scene::OpenRequest{What::model, {path}}; break;
    case Purpose::cage: requests.open = scene::OpenRequest{What::cage, {path}}; break;
    case Purpose::pose: requests.open = scene::OpenRequest{What::pose, {path}}; break;
    case Purpose::poses: requests.open = scene::OpenRequest{What::poses, {path}}; break;
    case Purpose::shapes: requests.open = scene::OpenRequest{What::shapes, {path}}; break;
    case Purpose::animation: requests.open = scene::OpenRequest{What::animation, {path}}; break;
    case Purpose::locate_model:
    case Purpose::locate_cage:
      if ((requests.open = std::exchange(w.unopened, std::nullopt)))
        (purpose == Purpose::locate_model ? requests.open->located.model : requests.open->located.cage) =
            path;
      break;
    case Purpose::save_session: requests.save_session = path; break;
    case Purpose::save_pose: requests.save_pose = path; break;
    case Purpose::save_named_pose: requests.save_named_pose = path; break;
    case Purpose::save_cage: requests.save_cage = path; break;
    case Purpose::save_model: requests.save_model = path; break;
    case Purpose::save_animation: requests.save_animation = path; break;
  }
}

// The panel stays open until the file has been read or written.
void ask(scene::Workspace& w, const std::filesystem::path& path) {
  if (!w.browser.asked.empty()) return;
  request(w, w.browser.purpose, path);
  w.browser.asked = path;
}

// Enters a folder or requests a file.
void choose(scene::Workspace& w, const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return scene::enter(w.browser, path);
  ask(w, path);
  w.preferences.folder = path.parent_path();
}

void choose_recent(scene::Workspace& w, std::size_t index) {
  if (!w.browser.asked.empty()) return;
  open_recent(w, index);
  w.browser.asked = w.preferences.recent[index].file;
}

void choose_typed(scene::Workspace& w) {
  if (w.browser.recent < w.preferences.recent.size()) return choose_recent(w, w.browser.recent);
  if (scene::filters_by_path(w.browser)) w.browser.path = std::exchange(w.browser.filter, "");
  const std::filesystem::path typed = scene::typed_path(w.browser);
  std::error_code ignored;
  if (std::filesystem::is_directory(typed, ignored)) return choose(w, typed);
  w.browser.problem = scene::problem_of_name(w.browser);
  if (w.browser.problem.empty())
    choose(w, scene::chosen_file(w.browser));  // otherwise the name stays for correction
}

// Overwriting a file needs a second Enter.
void confirm_typed(scene::Workspace& w) {
  if (w.browser.replaces() && w.browser.warned != w.browser.path) {
    w.browser.warned = w.browser.path;
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
  Browser& browser = ui.workspace.browser;
  if (browser.appearing && browser.saves()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  // Typing replaces a proposed name; a name to correct or confirm is kept.
  const bool proposed = browser.problem.empty() && browser.warned.empty();
  const auto flags = ImGuiInputTextFlags_EnterReturnsTrue |
                     (proposed ? ImGuiInputTextFlags_AutoSelectAll : ImGuiInputTextFlags_None);
  const std::string before = browser.path;
  const bool enter = text_field("##path", "", browser.path, flags);
  record(ui, "file_path");
  hint(browser.saves() ? "File to write. The extension sets the format." : "File to open. Enter opens it.");
  if (browser.path != before) {
    browser.problem.clear();
    browser.highlighted = browser.saves() ? Browser::none : 0;
    browser.recent = Browser::none;
  }
  if (enter) confirm_typed(ui.workspace);
  if (enter && browser.open) ImGui::SetKeyboardFocusHere(-1);
}

std::string in_capitals(std::string_view format) {
  std::string text(format);
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  return text;
}

// Buttons for OBJ, PLY and so on that change the extension.
void format_buttons(const Context& ui, const std::vector<std::string_view>& formats, bool own_row) {
  Browser& browser = ui.workspace.browser;
  const std::string now = scene::format_of(browser);
  for (const std::string_view format : formats) {
    const std::string label = in_capitals(format);
    if (!own_row || format != formats.front()) ImGui::SameLine();
    const bool active = now == format;
    ImGui::PushStyleColor(ImGuiCol_Button, active ? ui.colors.card_active : ui.colors.card);
    ImGui::PushStyleColor(ImGuiCol_Text, active ? ui.colors.text : ui.colors.faint);
    if (ImGui::Button(label.c_str())) scene::set_format(browser, std::string(format));
    ImGui::PopStyleColor(2);
    record(ui, "format_" + std::string(format));
    hint("Write " + label + ".");
  }
}

void filter_row(const Context& ui) {
  Browser& browser = ui.workspace.browser;
  if (ImGui::Button("Up")) scene::enter(browser, browser.folder.parent_path());
  record(ui, "file_up");
  hint("Go to the parent folder.  (Backspace)");
  ImGui::SameLine();
  if (browser.appearing && !browser.saves()) ImGui::SetKeyboardFocusHere();
  const auto formats = browser.saves() ? browser.formats() : std::vector<std::string_view>();
  constexpr float button_width = 53;
  const bool own_row = formats.empty() || formats.size() > 8;
  ImGui::SetNextItemWidth(own_row ? -1.0f : -button_width * static_cast<float>(formats.size()));
  const std::string before = browser.filter;
  text_field("##filter", "Filter", browser.filter, 0);
  record(ui, "file_filter");
  if (browser.filter != before) {
    browser.highlighted = 0;
    browser.recent = Browser::none;
    if (!browser.saves()) browser.path = browser.folder.string();
  }
  format_buttons(ui, formats, own_row);
}

// The clicked entry; handled after drawing the list, because that changes it.
std::optional<std::size_t> entry_list(const Context& ui, const std::vector<const Browser::Entry*>& entries,
                                      bool moved) {
  std::optional<std::size_t> clicked;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& entry = *entries[i];
    const Browser& browser = ui.workspace.browser;
    const bool highlighted = i == browser.highlighted && browser.recent == Browser::none;
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
    if (!entry.folder) {  // drawn over the highlight, on the same line
      text_right(ui, right, bytes_text(entry.bytes), ui.colors.faint, line);
    }
  }
  if (!entries.empty()) return clicked;
  const bool sessions = ui.workspace.browser.purpose == Purpose::save_session;
  note(ui, scene::filters_by_path(ui.workspace.browser) ? "Enter goes to this path."
           : !ui.workspace.browser.filter.empty()       ? "No file matches."
           : sessions                                   ? "No session in this folder."
                      : "No " + scene::format_list(ui.workspace.browser) + " file in this folder.");
  return clicked;
}

// Enters a folder or opens a file; when saving, proposes to replace that file.
void take(scene::Workspace& w, const Browser::Entry& entry) {
  const std::filesystem::path path = w.browser.folder / entry.name;
  if (entry.folder || !w.browser.saves()) return choose(w, path);
  if (w.browser.path == path.string()) return confirm_typed(w);
  w.browser.path = path.string();
}

// A click selects, a double click confirms, but never overwrites a file.
void click_entry(scene::Workspace& w, std::size_t index) {
  scene::highlight(w.browser, index);
  const Browser::Entry& entry = *scene::shown(w.browser)[index];
  if (ImGui::IsMouseDoubleClicked(0) && (entry.folder || !w.browser.saves())) take(w, entry);
}

void click_recent(scene::Workspace& w, std::size_t index) {
  if (ImGui::IsMouseDoubleClicked(0)) return choose_recent(w, index);
  w.browser.recent = index;
  w.browser.path = w.preferences.recent[index].file.string();
}

// Up and Down move in the list, Enter confirms, Backspace without a filter goes to the parent folder, Esc
// closes. True if the highlight moved.
bool handle_keys(const Context& ui, bool typing_path) {
  Browser& browser = ui.workspace.browser;
  const int steps =
      (key_pressed(scene::Key::down, true) ? 1 : 0) - (key_pressed(scene::Key::up, true) ? 1 : 0);
  if (steps != 0) scene::move_highlight(browser, steps);
  if (key_pressed(scene::Key::escape)) browser.open = false;
  if (typing_path) return steps != 0;
  if (key_pressed(scene::Key::backspace) && browser.filter.empty())
    scene::enter(browser, browser.folder.parent_path());
  if (key_pressed(scene::Key::enter) && !browser.saves() && scene::filters_by_path(browser)) {
    choose_typed(ui.workspace);
    browser.appearing = browser.open;
    return false;
  }
  const auto entries = scene::shown(browser);
  if (key_pressed(scene::Key::enter) && browser.recent != Browser::none) {
    choose_typed(ui.workspace);
  } else if (key_pressed(scene::Key::enter) && browser.highlighted < entries.size()) {
    take(ui.workspace, *entries[browser.highlighted]);
    browser.appearing = browser.open;  // keeps the keyboard in the list
  } else if (key_pressed(scene::Key::enter) && browser.saves()) {
    confirm_typed(ui.workspace);
  }
  return steps != 0;
}

bool shows_pictures(const Browser& browser) {
  return browser.pictures && browser.makes_pictures();
}

// Tolerance of morph targets, and their size.
void morph_row(const Context& ui) {
  scene::MorphChoice& morphs = ui.workspace.browser.morphs;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Tolerance");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(64);
  if (const auto percent = number_field(ui, "morph_tolerance", 100 * morphs.tolerance))
    morphs.tolerance = std::clamp(*percent / 100, 1e-7, 1.0);
  record(ui, "morph_tolerance");
  hint("Maximum playback error, in percent of the model's diagonal.");
  ImGui::SameLine();
  ImGui::TextUnformatted("%");
  ImGui::SameLine(0, 18);
  ImGui::Checkbox("Normals", &morphs.normals);
  record(ui, "morph_normals");
  hint("Export normals, for correct shading in every player. Doubles the file size.");
  ImGui::SameLine(0, 18);
  const std::string& size = ui.workspace.browser.morph_size;
  note(ui, size.empty() ? "computing size" : size);
  record(ui, "morph_size");
}

// Options of pictures.
void picture_choices(const Context& ui) {
  scene::PictureChoice& choice = *ui.workspace.browser.pictures;
  const auto box = [&](const char* label, const char* name, bool& on, const char* what) {
    ImGui::Checkbox(label, &on);
    record(ui, name);
    hint(what);
    ImGui::SameLine(0, 18);
  };
  box("Cage", "picture_cage", choice.cage, "Draw the cage.");
  box("Grid", "picture_grid", choice.grid, "Draw the ground grid.");
  box("Light theme", "picture_light", choice.light, "Use the light theme.");
  box("Panels", "picture_panels", choice.panels, "Include the panels and bars of the window.");
  const auto side = [&](const char* name, int& pixels) {
    ImGui::SetNextItemWidth(64);
    if (const auto typed = number_field(ui, name, pixels))
      pixels =
          static_cast<int>(std::clamp(*typed, double{scene::least_picture}, double{scene::largest_picture}));
    record(ui, name);
    hint("Width and height in pixels, 16 to 8192.");
  };
  side("picture_width", choice.width);
  ImGui::SameLine();
  ImGui::TextUnformatted("x");
  ImGui::SameLine();
  side("picture_height", choice.height);
}

void lists(const Context& ui, bool moved) {
  Browser& browser = ui.workspace.browser;
  const bool recent = browser.purpose == Purpose::model && !ui.workspace.preferences.recent.empty();
  const float row = ImGui::GetFrameHeight() + 12;
  const float height = browser.makes_morphs() || shows_pictures(browser) ? -2 * row : -row;
  if (recent) {
    ImGui::BeginChild("recent", {220, height}, true);
    note(ui, "Recent");
    const auto clicked = recent_list(ui, scene::Preferences::most, browser.recent);
    ImGui::EndChild();
    ImGui::SameLine();
    if (clicked) click_recent(ui.workspace, *clicked);
  }
  ImGui::BeginChild("entries", {0, height}, true);
  const auto clicked = entry_list(ui, scene::shown(browser), moved);
  ImGui::EndChild();
  if (clicked) click_entry(ui.workspace, *clicked);
}

// Below the path, two lines high: an error, or the file to be replaced.
void path_note(const Context& ui) {
  const Browser& browser = ui.workspace.browser;
  const float line = ImGui::GetCursorPosY();
  if (!browser.problem.empty()) {
    note(ui, browser.problem, ui.colors.bad);
    record(ui, "file_problem");
  } else if (browser.replaces()) {
    const std::string name = scene::chosen_file(browser).filename().string();
    note(ui,
         name + (browser.warned == browser.path ? " already exists; press Enter again to replace it."
                                                : " already exists and will be replaced."),
         ui.colors.warn);
    record(ui, "file_replaces");
  }
  const float end = line + 2 * ImGui::GetTextLineHeightWithSpacing();
  ImGui::SetCursorPosY(std::max(end, ImGui::GetCursorPosY()));
}

void button_row(const Context& ui) {
  Browser& browser = ui.workspace.browser;
  const bool replaces = browser.replaces();
  const char* label = !browser.saves() ? "Open###choose" : replaces ? "Replace###choose" : "Save###choose";
  const bool confirmed = ImGui::Button(label);
  record(ui, "file_choose");
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) browser.open = false;
  record(ui, "file_cancel");
  if (browser.purpose == Purpose::poses || browser.purpose == Purpose::shapes) {
    ImGui::SameLine();
    if (ImGui::Button("Import folder")) ask(ui.workspace, browser.folder);
    record(ui, "file_folder");
    hint(browser.purpose == Purpose::poses ? "Import all posed versions of the cage in this folder."
                                           : "Import all shapes of the model in this folder.");
  }
  if (!confirmed) return;
  const auto entries = scene::shown(browser);
  const bool untouched = !browser.saves() && browser.path == browser.folder.string();
  untouched&& browser.highlighted < entries.size() ? take(ui.workspace, *entries[browser.highlighted])
                                                   : choose_typed(ui.workspace);
}

// Keeps the dialog inside a window that became smaller.
void keep_within(const ImVec2& display) {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  const ImVec2 fitting{std::min(size.x, display.x), std::min(size.y, display.y)};
  if (fitting.x < size.x || fitting.y < size.y) ImGui::SetWindowSize(fitting);
  const ImVec2 inside{std::clamp(at.x, 0.0f, display.x - fitting.x),
                      std::clamp(at.y, 0.0f, display.y - fitting.y)};
  if (inside.x != at.x || inside.y != at.y) ImGui::SetWindowPos(inside);
}

}  // namespace

void file_panel(const Context& ui) {
  Browser& browser = ui.workspace.browser;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const auto& v = ui.workspace.viewport;
  const ImVec2 size{std::min(640.0f, display.x), std::min(460.0f, display.y)};
  const ImVec2 low{v.origin.x + 0.5f * (v.size.x - size.x), v.origin.y + 0.5f * (v.size.y - size.y)};
  ImGui::SetNextWindowPos(
      {std::clamp(low.x, 0.0f, display.x - size.x), std::clamp(low.y, 0.0f, display.y - size.y)},
      ImGuiCond_Appearing);
  ImGui::SetNextWindowSize(size, ImGuiCond_Appearing);
  bool open = true;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8);
  scene::refresh(browser);
  ImGui::Begin(title(browser.purpose), &open, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  keep_within(display);
  path_field(ui);
  const bool typing_path = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
  path_note(ui);
  filter_row(ui);
  browser.appearing = false;
  const bool moved = browser.open && handle_keys(ui, typing_path);
  lists(ui, moved);
  if (browser.makes_morphs()) morph_row(ui);
  if (shows_pictures(browser)) picture_choices(ui);
  button_row(ui);
  if (!open) browser.open = false;
  if (!browser.open) browser.asked.clear();  // later errors become messages
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace viete::ui
