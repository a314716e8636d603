// A folder being looked through to open or save a file: state only, drawn by the file panel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document/files_in_use.h"

namespace viete::scene {

/// What a person asks of morph targets, see AnimationExport.
struct MorphChoice {
  double tolerance = 1e-4;
  bool normals = true;

  friend bool operator==(const MorphChoice&, const MorphChoice&) = default;
};

/// How pictures are drawn.
struct PictureChoice {
  bool cage = false, grid = true, light = false, panels = false;
  int width = 0, height = 0;  ///< logical pixels, least_picture to largest_picture
};
inline constexpr int least_picture = 16, largest_picture = 8192;

struct FileBrowser {
  enum class Purpose {
    model,
    cage,
    pose,
    poses,
    shapes,
    animation,
    locate_model,  ///< of a session
    locate_cage,
    save_session,
    save_pose,
    save_named_pose,
    save_cage,
    save_model,
    save_animation
  };
  struct Entry {
    std::string name;
    bool folder = false;
    std::uintmax_t bytes = 0;
  };

  bool open = false;
  bool appearing = false;  ///< it was opened just now: the keyboard is to go there
  Purpose purpose = Purpose::model;
  std::filesystem::path folder;
  std::filesystem::file_time_type changed{};  ///< the folder, when it was listed
  std::vector<Entry>
      entries;       ///< folders first, then files that fit the purpose, each by name without regard to case
  std::string path;  ///< what the text field holds
  std::string problem;  ///< why the folder or the file cannot be taken, shown below the path; or empty
  std::filesystem::path asked;  ///< the file or folder that is being read or written for it; empty: none
  std::string suggested;        ///< file name to save under; kept while folders are walked
  FilesInUse in_use;            ///< that are neither proposed nor replaced
  std::string filter;           ///< only entries that contain it, without regard to case, are shown
  std::string warned;           ///< the path whose file Enter would have replaced: a second Enter does
  /// Among the entries that are shown: what Enter takes. Past them: none, and Enter saves under the name.
  std::size_t highlighted = 0;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t recent = none;  ///< chosen of the files that were open before, instead

  MorphChoice morphs;
  std::optional<PictureChoice> pictures;  ///< nothing: as the window looks at them
  std::string morph_size;  ///< how many targets these take, and how much; empty: it is being found

  bool saves() const { return purpose >= Purpose::save_session; }
  /// Those of mesh::all_formats() that fit the purpose, by extension: of a pose what keeps the order of the
  /// vertices; of animations sequences too, and pictures to save.
  std::vector<std::string_view> formats() const;
  /// Whether the file of the text field is an animation of morph targets.
  bool makes_morphs() const;
  /// Whether it is pictures.
  bool makes_pictures() const;
  /// Whether the file of the text field is there and not in use, so that saving would replace it.
  bool replaces() const;
};

/// Shows the browser in a folder (the current one if it is empty or gone).
void show(FileBrowser& browser, FileBrowser::Purpose purpose, const std::filesystem::path& folder,
          const std::string& suggested = "", FilesInUse in_use = {});
/// Lists another folder; on failure stays where it is and says why.
void enter(FileBrowser& browser, const std::filesystem::path& folder);

/// Lists the folder anew if files have come or gone there since; what is typed and highlighted stays.
void refresh(FileBrowser& browser);

/// The entries that pass the filter, in order.
std::vector<const FileBrowser::Entry*> shown(const FileBrowser& browser);
/// That one of those that are shown: what Enter and the button take. When saving, a file lends its name; as
/// to a folder, the name stays.
void highlight(FileBrowser& browser, std::size_t index);
/// Up or down the list by so many, as far as it goes; when saving, the name stays.
void move_highlight(FileBrowser& browser, int steps);

/// Whether the filter is the beginning of a path, with / or ~, rather than of a name.
bool filters_by_path(const FileBrowser& browser);

/// What the text field names, as it is typed: relative to the folder, ~ being the home folder.
std::filesystem::path typed_path(const FileBrowser& browser);
/// The same with the extension that the purpose asks for if it has none.
std::filesystem::path chosen_file(const FileBrowser& browser);
/// Why that file cannot be opened or written as it is named; empty if it can be tried.
std::string problem_of_name(const FileBrowser& browser);
/// "OBJ, PLY or OFF".
std::string format_list(const FileBrowser& browser);
/// The extension of the file to be saved, in lower case: "ply".
std::string format_of(const FileBrowser& browser);
/// Shows why `asked` could not be read or written; the path stays. False if the dialog did not ask for it.
bool refuse(FileBrowser& browser, const std::filesystem::path& asked, const std::string& problem);
/// Another extension for it.
void set_format(FileBrowser& browser, const std::string& extension);

}  // namespace viete::scene
