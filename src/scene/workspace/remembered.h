// What the program remembers from run to run: recent files, the last folder, that the first hints were seen,
// and how its window was arranged.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/document/camera.h"
#include "scene/workspace/keymap.h"

namespace viete::scene {

/// The columns: tools at the left; methods, their timings and the deformer at the right.
enum class Column { tools, methods };

/// Logical pixels. As a person has arranged it; what of it there is room for is shown.
struct PanelLayout {
  static constexpr float least_width = 288, usual_width = 320, largest_width = 560;
  static constexpr float least_view = 320;  ///< which is left between the columns
  static constexpr float menu_height = 26, status_height = 26, timeline_height = 156;

  std::array<float, 2> width{usual_width, usual_width};
  std::array<bool, 2> folded{};
  Column last = Column::methods;         ///< unfolded last: shown where there is room for one
  bool timeline = false;                 ///< below the view, between the columns
  std::map<std::string, bool> sections;  ///< by title, of those that were opened or closed: open?

  bool is_folded(Column column) const { return folded[static_cast<std::size_t>(column)]; }

  friend bool operator==(const PanelLayout&, const PanelLayout&) = default;
};

/// As wide as they are shown in a window; 0: not at all.
struct ColumnWidths {
  float tools = 0, methods = 0;
  float of(Column column) const { return column == Column::tools ? tools : methods; }
};
ColumnWidths shown_columns(const PanelLayout& layout, float window_width);

/// From the top of the view to the status bar.
float column_height(const Viewport& viewport);

/// What columns, bars and timeline leave of a window, below a row of notices of this height. Without panels
/// there is only that row.
Viewport view_between(const PanelLayout& layout, const glm::vec2& window, bool panels, float notice = 0);

/// Shows a column that is not shown, if need be instead of the other; folds away one that is.
void toggle_column(PanelLayout& layout, Column column, float window_width);

/// Within the limits, and so that the view keeps its least width.
void set_width(PanelLayout& layout, Column column, float width, float window_width);

/// A session, or a model with its cage; absolute paths.
struct RecentFile {
  std::filesystem::path file, cage;  ///< cage may be empty

  friend bool operator==(const RecentFile&, const RecentFile&) = default;
};

struct Remembered {
  static constexpr std::size_t most = 12;

  std::vector<RecentFile> recent;  ///< newest first, each once, at most `most`
  std::filesystem::path folder;    ///< where a file was last chosen
  bool hints = true;               ///< the hints of the first start are still to be shown
  bool ask_keys = true;            ///< nobody has said yet which keys the hands know
  bool dark = true;                ///< the theme that was chosen last
  std::optional<bool>
      coarse_motion;  ///< as was chosen: what moves is drawn coarsely; nothing: where that helps
  std::optional<glm::ivec2> window;  ///< its size when it was used last, in logical pixels
  PanelLayout layout;
  Keymap keymap;

  /// To the front. Paths are made absolute.
  void add(const RecentFile& file);

  friend bool operator==(const Remembered&, const Remembered&) = default;
};

/// Throws base::Error if the file is there and cannot be understood; nothing is remembered if it is missing.
Remembered read_remembered(const std::filesystem::path& file);

/// Atomic. Recent files that another program has added since are kept, behind these. Throws base::Error.
void write_remembered(const std::filesystem::path& file, const Remembered& remembered);

}  // namespace viete::scene
