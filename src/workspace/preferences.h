// Persistent preferences: recent files, the last folder, dismissed hints, and the window layout.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "document/camera.h"
#include "workspace/keymap.h"

namespace viete::workspace {

/// The side columns: tools on the left; methods, timings and the deformer on the right.
enum class Column { tools, methods };

/// The user's layout of the panels, in logical pixels. Small windows show fewer columns.
struct PanelLayout {
  static constexpr float least_width = 288, usual_width = 320, largest_width = 560;
  static constexpr float least_view = 320;  ///< minimum view width between the columns
  static constexpr float menu_height = 26, status_height = 26, least_timeline = 156;

  std::array<float, 2> width{usual_width, usual_width};
  std::array<bool, 2> folded{};
  Column last = Column::methods;         ///< the shown column if the window has room for only one
  bool timeline = false;                 ///< shown below the view, between the columns
  float more_timeline = 0;               ///< height of further rows of the timeline; not saved
  std::map<std::string, bool> sections;  ///< by title; true: open

  float timeline_height() const { return timeline ? least_timeline + more_timeline : 0; }
  bool is_folded(Column column) const { return folded[static_cast<std::size_t>(column)]; }

  friend bool operator==(const PanelLayout&, const PanelLayout&) = default;
};

/// Displayed widths of the columns; 0: hidden.
struct ColumnWidths {
  float tools = 0, methods = 0;
  float of(Column column) const { return column == Column::tools ? tools : methods; }
};
ColumnWidths shown_columns(const PanelLayout& layout, float window_width);

/// The height from the top of the view to the status bar.
float column_height(const document::Viewport& viewport);

/// The view: the part of the window without columns, bars, timeline and a row of notices of height `notice`.
/// If `panels` is false, only the row of notices is subtracted.
document::Viewport view_between(const PanelLayout& layout, const glm::vec2& window, bool panels,
                                float notice = 0);

/// Shows or hides a column. If the window has room for only one column, showing a column hides the other.
void toggle_column(PanelLayout& layout, Column column, float window_width);

/// Sets the width of a column, within the limits of columns and so that the view keeps its minimum width.
void set_width(PanelLayout& layout, Column column, float width, float window_width);

/// A session, or a model with its cage.
struct RecentFile {
  std::filesystem::path file, cage;  ///< absolute paths; `cage` may be empty

  friend bool operator==(const RecentFile&, const RecentFile&) = default;
};

struct Preferences {
  static constexpr std::size_t most = 12;

  std::vector<RecentFile> recent;     ///< newest first, unique, at most `most`
  std::filesystem::path folder;       ///< folder of the last chosen file
  bool hints = true;                  ///< show the hints of the first start
  bool ask_keys = true;               ///< the keymap has not been chosen yet
  bool dark = true;                   ///< the last chosen theme
  std::optional<bool> coarse_motion;  ///< draw coarsely during motion; nullopt: automatic
  bool autosave = true;               ///< write unsaved edits to recovery files
  std::optional<float> scale;         ///< device pixels per logical pixel; nullopt: the display's scale
  std::optional<glm::ivec2> window;   ///< last size in logical pixels
  PanelLayout layout;
  Keymap keymap;

  /// Inserts a file at the front. Makes the paths absolute.
  void add(const RecentFile& file);

  friend bool operator==(const Preferences&, const Preferences&) = default;
};

/// Reads the preferences. A missing file gives the defaults. Throws base::Error if the file is damaged.
Preferences read_preferences(const std::filesystem::path& file);

/// Replaces the file atomically. Throws base::Error.
void write_preferences(const std::filesystem::path& file, const Preferences& preferences);

}  // namespace viete::workspace
