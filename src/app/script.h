// What hands do, as a text that people read, write and replay.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace viete::app {

/// Where the cursor is. Lengths in logical pixels, to the right and down.
struct Place {
  enum class Of {
    view,    ///< from the middle of the view; as much larger as the view is higher than Script::view
    window,  ///< from its left and top
    widget,  ///< from the middle of the one of this name
    vertex,  ///< from where this vertex of the posed cage is seen
    cursor   ///< from where it is
  };
  Of of = Of::view;
  std::string widget{};
  unsigned vertex = 0;
  glm::dvec2 by{0, 0};
};

/// One line of a script:
///   move PLACE, glide SECONDS PLACE     the cursor is there; goes there, in so many seconds
///   press BUTTON, release BUTTON        left, right or middle
///   key down NAME, key up NAME          "G", "Ctrl", "Page Up", "Num 1", or the number of GLFW
///   type "TEXT", wheel STEPS, leave     leave: the cursor leaves the window
///   drop "FILE" ...                     relative to the script's folder
///   command NAME, try NAME              see scene/workspace/command.h; try: where it can be done
///   frame SECONDS [TIMES]               a picture, so long after the one before
///   wait                                until nothing is read, bound or made aside
///   pause SECONDS                       nothing happened so long
///   size WIDTH HEIGHT                   of the window, from now on
///   chapter "TITLE" "TEXT"              of what comes
/// and PLACE: view X Y; window X Y; widget "NAME" X Y; vertex NUMBER X Y; by X Y.
struct Step {
  enum class Kind {
    move,
    glide,
    press,
    release,
    key_down,
    key_up,
    type,
    wheel,
    leave,
    drop,
    command,
    try_command,
    frame,
    wait,
    pause,
    size,
    chapter
  };
  Kind kind = Kind::frame;
  Place place{};
  int code = 0;        ///< of a button or key, see platform::InputEvent; of frames how many
  double number = 0;   ///< seconds, or steps of the wheel
  glm::ivec2 size{};   ///< of the window
  std::string text{};  ///< what is typed, a command's name, a title
  std::string more{};  ///< the text of a chapter
  std::vector<std::filesystem::path> files{};
  std::size_t line = 0;  ///< in its file, from 1
};

/// A text file. First "viete script 1", then, in any order and each at most once:
///   window WIDTH HEIGHT     logical pixels
///   view HEIGHT             of the view, which lengths in it are of
///   open "FILE" ...         a session, or a model, its cage and a pose; relative to the script's folder
///   poses "FILE"            a session of the same model and cage, whose poses and keys it has too
///   brush RADIUS SHARE      see scene::Brush
///   arranged JSON           panels, theme and keys, see scene::arrangement_of()
/// then steps, a line each. Blank lines and what begins with # count for nothing.
struct Script {
  static constexpr const char* extension = ".script";

  std::filesystem::path file;
  glm::ivec2 window{1440, 900};
  double view = 0;  ///< 0: lengths are as they are
  std::vector<std::filesystem::path> open;
  std::filesystem::path poses;  ///< empty: none
  std::string arranged;
  double brush_radius = 0, brush_share = 0;  ///< 0: as it is
  std::vector<Step> steps;

  std::size_t chapters() const;
};

/// Throws base::Error naming file and line.
Script read_script(const std::filesystem::path& file);

/// As lines of a script, with line ends.
std::string text_of(const Step& step, const std::filesystem::path& folder);
/// All of it but its steps.
std::string head_of(const Script& script);

/// Numbers of a script are multiples of these: they are the same when they have been written and read.
inline constexpr double script_pixel = 1.0 / 16, script_second = 1.0 / 1024;

}  // namespace viete::app
