#include "ui/mouse_words.h"

#include "scene/workspace/command.h"

namespace viete::ui {

namespace {

void add_looking(const scene::Keymap& keymap, std::vector<MouseLine>& lines) {
  if (keymap.left_orbits()) {
    lines.push_back({"Middle or Alt+left drag", "orbit; with Shift pan, with Ctrl zoom"});
    lines.push_back({"Right drag", "pan"});
  } else if (keymap.alt_moves_camera()) {
    lines.push_back({"Alt+left, middle, right drag", "orbit, pan, zoom"});
    lines.push_back({"Middle or right drag", "orbit; with Shift pan, with Ctrl zoom"});
  } else {
    lines.push_back({"Middle, right or Alt+left drag", "orbit; with Shift pan, with Ctrl zoom"});
  }
  lines.push_back({"Wheel", "zoom to the cursor"});
  lines.push_back({"Double click", "orbit about that place from now on"});
}

}  // namespace

std::string key_or_label(const scene::Keymap& keymap, std::string_view name) {
  const scene::Command& command = *scene::find_command(name);
  const std::string key = scene::text(keymap.of(command).first);
  return key.empty() ? '"' + std::string(command.label) + '"' : key;
}

std::vector<MouseLine> mouse_lines(const scene::Keymap& keymap) {
  std::vector<MouseLine> lines = {
      {"Left click", "select a vertex, edge, face or probe (Shift adds, Ctrl removes)"},
      {"Left drag on it", "move the selection (faces, and crowded vertices: once selected)"}};
  if (keymap.left_orbits()) {
    lines.push_back({"Left drag elsewhere", "orbit; select with a box after " +
                                                key_or_label(keymap, "select_box") + ", with Shift or Ctrl"});
  } else {
    lines.push_back(
        {"Left drag elsewhere", "select with a box; from anywhere with Shift (adds) or Ctrl (removes)"});
  }
  lines.push_back({"Left drag on a handle", "move, rotate or scale along what it points at"});
  lines.push_back({"Ctrl, Shift while dragging", "snap to steps; go a tenth of the way"});
  lines.push_back({"X Y Z, digits, Enter", "while dragging: axis (Shift: plane), amount, done"});
  lines.push_back({"Esc or right button", "during a drag: everything as it was"});
  lines.push_back({"Double click on a slider", "type its number (or Ctrl+click)"});
  lines.push_back({"Right click", "a menu of what can be done there"});
  add_looking(keymap, lines);
  return lines;
}

std::string looking_words(const scene::Keymap& keymap) {
  if (keymap.left_orbits()) return "left or middle drag orbits,  right drag pans,  wheel zooms";
  if (keymap.alt_moves_camera()) return "Alt and left drag orbits,  Alt and middle pans,  wheel zooms";
  return "middle or right drag orbits,  Shift pans,  wheel zooms";
}

std::string empty_space_words(const scene::Keymap& keymap) {
  if (!keymap.left_orbits()) return "on empty space selects;  " + looking_words(keymap);
  return "on empty space orbits;  right drag pans,  wheel zooms,  Shift selects with a box";
}

}  // namespace viete::ui
