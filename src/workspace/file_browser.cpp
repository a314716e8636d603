#include "workspace/file_browser.h"

#include <algorithm>
#include <cstdlib>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/numbered_files.h"
#include "files/animation_export.h"
#include "files/output.h"
#include "files/session.h"
#include "foreign/read.h"
#include "formats/format_table.h"

namespace viete::workspace {

namespace fs = std::filesystem;
using Purpose = FileBrowser::Purpose;
using Entry = FileBrowser::Entry;

namespace {

bool fits(const fs::path& path, const FileBrowser& browser) {
  const bool session = browser.purpose == Purpose::model || browser.purpose == Purpose::save_session;
  return (session && files::is_session(path)) ||
         std::ranges::count(browser.formats(), base::extension_of(path)) > 0;
}

bool before(const Entry& a, const Entry& b) {
  if (a.folder != b.folder) return a.folder;
  const std::string x = base::lower_case(a.name), y = base::lower_case(b.name);
  return x != y ? x < y : a.name < b.name;
}

std::vector<Entry> list(const fs::path& folder, const FileBrowser& browser) {
  std::vector<Entry> entries;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::error_code ignored;
    const std::string name = entry.path().filename().string();
    if (name.empty() || name[0] == '.') continue;
    if (entry.is_directory(ignored)) {
      entries.push_back({name, true, 0});
    } else if (fits(entry.path(), browser)) {
      entries.push_back({name, false, entry.file_size(ignored)});
    }
  }
  std::sort(entries.begin(), entries.end(), before);
  return entries;
}

}  // namespace

std::vector<std::string_view> FileBrowser::formats() const {
  std::vector<std::string_view> names;
  const bool serves_captures =
      purpose == Purpose::model || purpose == Purpose::locate_model || (saves() && saves_capture);
  const auto add = [&](bool (*is)(const formats::Format&)) {
    for (const formats::Format& f : formats::all_formats())
      if (is(f) && (serves_captures || !f.stores_only_splats())) names.push_back(f.extension);
  };
  if (purpose == Purpose::save_session) return names;
  if (purpose == Purpose::pose || purpose == Purpose::save_pose || purpose == Purpose::save_cage) {
    add(formats::keeps_order);
  } else if (purpose == Purpose::animation || purpose == Purpose::save_animation) {
    add(formats::is_sequence);
    add(formats::holds_morphs);
    add(purpose == Purpose::animation ? formats::keeps_order : formats::holds_one_frame);
    if (purpose == Purpose::save_animation) {
      names.push_back("png");
      names.insert(names.end(), files::film_formats.begin(), files::film_formats.end());
    }
  } else {
    add(formats::holds_surface);
    if (purpose == Purpose::shapes) add(formats::is_sequence);
    if (!saves())
      for (const foreign::Kind& kind : foreign::all_kinds()) names.push_back(kind.extension);
  }
  return names;
}

bool FileBrowser::makes_morphs() const {
  return purpose == Purpose::save_animation && formats::is_a(formats::holds_morphs, path) &&
         !base::NumberedName::is_pattern(path);
}

bool FileBrowser::makes_pictures() const {
  return purpose == Purpose::save_animation && (format_of(*this) == "png" || files::is_film(path));
}

std::pair<fs::path, std::size_t> FileBrowser::replaced() const {
  std::pair<fs::path, std::size_t> all;
  if (!saves()) return all;
  const auto add = [&](const fs::path& file) {
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored) && !in_use.find(file) && all.second++ == 0) all.first = file;
  };
  const fs::path file = chosen_file(*this);
  if (!base::NumberedName::is_pattern(file)) {
    add(file);
    return all;
  }
  try {
    for (const base::NumberedFile& frame : base::NumberedName(file).find())
      if (frame.number >= first_frame && frame.number <= last_frame) add(frame.path);
  } catch (const base::Error&) {  // the export reports an unsuitable name or folder
  }
  return all;
}

void show(FileBrowser& browser, Purpose purpose, const fs::path& folder, const std::string& suggested,
          document::FilesInUse in_use) {
  browser.suggested = suggested;
  browser.in_use = std::move(in_use);
  browser.open = browser.appearing = true;
  browser.purpose = purpose;
  browser.problem.clear();
  browser.warned.clear();
  browser.asked.clear();
  std::error_code ignored;
  if (!folder.empty()) enter(browser, folder);
  if (folder.empty() || !browser.problem.empty()) enter(browser, fs::current_path(ignored));
}

void enter(FileBrowser& browser, const fs::path& folder) {
  try {
    const fs::path absolute = fs::weakly_canonical(fs::absolute(folder));
    std::error_code ignored;
    browser.changed = fs::last_write_time(absolute, ignored);
    browser.entries = list(absolute, browser);
    browser.folder = absolute;
    browser.path =
        (browser.saves() ? files::proposed_name(absolute / browser.suggested, browser.in_use) : absolute)
            .string();
    browser.problem.clear();
    browser.filter.clear();
    browser.filter_problem.clear();
    browser.highlighted = browser.saves() ? FileBrowser::none : 0;
  } catch (const fs::filesystem_error& error) {
    browser.problem = folder.string() + ": " + error.code().message() + "; choose another folder";
  }
}

void refresh(FileBrowser& browser) {
  std::error_code code;
  const auto changed = fs::last_write_time(browser.folder, code);
  if (code || changed == browser.changed) return;
  const auto before = shown(browser);
  const std::string name = browser.highlighted < before.size() ? before[browser.highlighted]->name : "";
  try {
    browser.entries = list(browser.folder, browser);
  } catch (const fs::filesystem_error&) {  // the folder was removed; keep the list
  }
  browser.changed = changed;
  if (name.empty()) return;
  const auto now = shown(browser);
  const auto found = std::ranges::find(now, name, &Entry::name);
  browser.highlighted = found != now.end()
                            ? static_cast<std::size_t>(found - now.begin())
                            : std::min(browser.highlighted, std::max<std::size_t>(now.size(), 1) - 1);
}

std::vector<const Entry*> shown(const FileBrowser& browser) {
  std::vector<const Entry*> entries;
  const std::string filter = base::lower_case(browser.filter);
  for (const auto& entry : browser.entries) {
    if (base::lower_case(entry.name).find(filter) != std::string::npos) entries.push_back(&entry);
  }
  return entries;
}

void highlight(FileBrowser& browser, std::size_t index) {
  const auto entries = shown(browser);
  if (index >= entries.size()) return;
  browser.highlighted = index;
  if (browser.saves() && entries[index]->folder) return;
  browser.path = (browser.folder / entries[index]->name).string();
  browser.problem.clear();
}

void move_highlight(FileBrowser& browser, int steps) {
  const auto last = static_cast<std::ptrdiff_t>(shown(browser).size()) - 1;
  const bool from_none = browser.highlighted == FileBrowser::none;
  const auto wanted = from_none ? 0 : static_cast<std::ptrdiff_t>(browser.highlighted) + steps;
  browser.highlighted =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(wanted, 0, std::max<std::ptrdiff_t>(last, 0)));
  if (!browser.saves()) highlight(browser, browser.highlighted);
}

bool filters_by_path(const FileBrowser& browser) {
  return !browser.filter.empty() && (browser.filter[0] == '/' || browser.filter[0] == '~');
}

fs::path typed_path(const FileBrowser& browser) {
  const fs::path home = base::os::home_folder();
  if (!home.empty() && (browser.path == "~" || browser.path.starts_with("~/")))
    return home.string() + browser.path.substr(1);
  return browser.folder / browser.path;
}

namespace {

// If the format stores only one model per file, adds "_####" for the frame number to the name.
fs::path animation_name(const fs::path& file) {
  if (files::is_animation_format(base::extension_of(file)) || files::is_film(file) ||
      base::NumberedName::is_pattern(file))
    return file;
  return file.parent_path() / (file.stem().string() + "_####" + file.extension().string());
}

}  // namespace

fs::path chosen_file(const FileBrowser& browser) {
  fs::path file = typed_path(browser);
  const bool session = browser.purpose == Purpose::save_session;
  if (session && !files::is_session(file)) file += files::session_extension;
  const bool animation = browser.purpose == Purpose::save_animation;
  if (browser.saves() && !session && file.extension().empty()) {
    const fs::path extension = fs::path(browser.suggested).extension();
    file += !extension.empty() ? extension : animation ? ".pc2" : ".obj";
  }
  return animation ? animation_name(file) : file;
}

std::string problem_of_name(const FileBrowser& browser) {
  const fs::path file = chosen_file(browser);
  const std::string name = file.filename().string();
  std::error_code ignored;
  const bool sequence = browser.purpose == Purpose::shapes || browser.purpose == Purpose::animation;
  if (sequence && base::NumberedName::is_pattern(file)) return "";
  if (!browser.saves())
    return fs::exists(file, ignored)
               ? ""
               : name + " does not exist; choose a file from the list or enter another path";
  if (name.empty() || fs::is_directory(file, ignored)) return "Enter a file name.";
  if (!fs::is_directory(file.parent_path(), ignored))
    return file.parent_path().string() + " is not a folder; choose another folder";
  if (const std::string* used = browser.in_use.find(file))
    return name + " is open (" + *used + ") and cannot be replaced; " +
           base::unused_name(file).filename().string() + " is a free name.";
  if (fits(file, browser)) return "";
  const bool known = formats::find_format(file) != nullptr;  // such as STL, which loses the order of vertices
  return name + (known ? " has an unsuitable format here; use " : " has an unknown extension; use ") +
         format_list(browser);
}

std::string format_list(const FileBrowser& browser) {
  std::string text;
  for (const auto format : browser.formats()) {
    const bool last = format == browser.formats().back();
    text += text.empty() ? "" : last ? " or " : ", ";
    for (const char c : format) text += c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  }
  return text;
}

std::string format_of(const FileBrowser& browser) {
  return base::extension_of(browser.path);
}

bool refuse(FileBrowser& browser, const fs::path& asked, const std::string& problem) {
  if (asked.empty() || browser.asked != asked) return false;
  const std::string place = asked.string() + ": ";  // the panel shows the path already
  browser.problem = problem.starts_with(place) ? problem.substr(place.size()) : problem;
  browser.appearing = !std::exchange(browser.open, true);
  browser.asked.clear();
  return true;
}

void set_format(FileBrowser& browser, const std::string& extension) {
  fs::path path = browser.path;
  browser.suggested = path.replace_extension(extension).filename().string();
  browser.path = path.string();
  browser.path = files::proposed_name(chosen_file(browser), browser.in_use).string();
  browser.highlighted = FileBrowser::none;  // Enter must save under the changed name
  browser.problem.clear();
}

}  // namespace viete::workspace
