#include "app/script.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "scene/workspace/command.h"
#include "ui/imgui_bridge.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

using Do = Step::Kind;

constexpr const char* first_line = "viete script 1";
constexpr double most_pixels = 1e5, most_seconds = 3600;
constexpr int most_times = 1'000'000;
constexpr std::size_t most_bytes = 256 << 20;

struct KindWord {
  Do kind;
  const char* word;
};
constexpr KindWord kind_words[] = {
    {Do::move, "move"},   {Do::glide, "glide"},     {Do::press, "press"},     {Do::release, "release"},
    {Do::type, "type"},   {Do::wheel, "wheel"},     {Do::leave, "leave"},     {Do::drop, "drop"},
    {Do::frame, "frame"}, {Do::command, "command"}, {Do::try_command, "try"}, {Do::wait, "wait"},
    {Do::pause, "pause"}, {Do::size, "size"},       {Do::chapter, "chapter"}};

constexpr const char* button_words[] = {"left", "right", "middle"};

struct HeldKey {
  int code;
  const char* name;
};
constexpr HeldKey held_keys[] = {{340, "Shift"},       {341, "Ctrl"},       {342, "Alt"},
                                 {344, "Right Shift"}, {345, "Right Ctrl"}, {346, "Right Alt"}};

std::string name_of_key(int code) {
  for (const HeldKey& held : held_keys)
    if (held.code == code) return held.name;
  for (const scene::Key key : scene::all_keys())
    if (ui::key_code(key) == code) return scene::text(scene::Shortcut{key});
  return std::to_string(code);
}

std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << std::quoted(text);
  return out.str();
}

// One line, word by word.
class Line {
public:
  Line(const fs::path& file, std::size_t line, const std::string& text)
      : place_(file.string() + ':' + std::to_string(line)), in_(text) {}

  [[noreturn]] void fail(const std::string& problem, const std::string& advice = "correct it in the file") {
    throw base::Error(place_, problem, advice);
  }
  bool at_end() { return (in_ >> std::ws).eof(); }
  std::string word() {
    std::string text;
    in_ >> text;
    return text;
  }
  std::string text(const char* what) {
    std::string text;
    if (at_end() || in_.peek() != '"' || !(in_ >> std::quoted(text)))
      fail(std::string("expected ") + what + " in quotation marks");
    return text;
  }
  std::string rest() {
    std::string text;
    std::getline(in_ >> std::ws, text);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.pop_back();
    return text;
  }
  double number(double least, double most) {
    const std::string text = word();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= least && value <= most))
      fail(text.empty()
               ? "a number is missing"
               : '"' + text + "\" is no number from " + app::number(least) + " to " + app::number(most));
    return value;
  }
  int whole(int least, int most) {
    const double value = number(least, most);
    if (value != static_cast<int>(value)) fail("expected a whole number");
    return static_cast<int>(value);
  }
  void end() {
    if (!at_end()) fail("there is more on this line than belongs there: " + rest());
  }
  std::vector<fs::path> files(const fs::path& folder) {
    std::vector<fs::path> all;
    do all.push_back((folder / text("a file")).lexically_normal());
    while (!at_end());
    return all;
  }

private:
  std::string place_;
  std::istringstream in_;
};

Place read_place(Line& line) {
  const std::string of = line.word();
  Place place;
  if (of == "view") {
    place.of = Place::Of::view;
  } else if (of == "window") {
    place.of = Place::Of::window;
  } else if (of == "widget") {
    place.of = Place::Of::widget;
    place.widget = line.text("the name of a widget");
  } else if (of == "vertex") {
    place.of = Place::Of::vertex;
    place.vertex = static_cast<unsigned>(line.whole(0, 1'000'000'000));
  } else if (of == "by") {
    place.of = Place::Of::cursor;
  } else {
    line.fail("\"" + of + "\" is no place", "write view, window, widget, vertex or by");
  }
  place.by.x = line.number(-most_pixels, most_pixels);
  place.by.y = line.number(-most_pixels, most_pixels);
  return place;
}

std::string text_of(const Place& place) {
  const std::string by = ' ' + number(place.by.x) + ' ' + number(place.by.y);
  switch (place.of) {
    case Place::Of::view: return "view" + by;
    case Place::Of::window: return "window" + by;
    case Place::Of::widget: return "widget " + quoted(place.widget) + by;
    case Place::Of::vertex: return "vertex " + std::to_string(place.vertex) + by;
    case Place::Of::cursor: return "by" + by;
  }
  return {};
}

int read_button(Line& line) {
  const std::string word = line.word();
  const auto* const found = std::ranges::find(button_words, word);
  if (found == std::end(button_words))
    line.fail("\"" + word + "\" is no button", "write left, right or middle");
  return static_cast<int>(found - std::begin(button_words));
}

void read_key(Line& line, Step& step) {
  const std::string way = line.word();
  if (way != "up" && way != "down") line.fail("expected down or up behind key");
  step.kind = way == "down" ? Do::key_down : Do::key_up;
  const std::string name = line.rest();
  for (const HeldKey& held : held_keys)
    if (name == held.name) step.code = held.code;
  if (step.code) return;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), step.code);
  const bool is_number = error == std::errc() && end == name.data() + name.size() && name.size() > 1;
  if (is_number && step.code > 0 && step.code < 512) return;
  const auto key = scene::shortcut_of(name);
  if (!key || *key != scene::Shortcut{key->key} || name.empty()) line.fail("\"" + name + "\" is no key");
  step.code = ui::key_code(key->key);
}

std::string read_command(Line& line) {
  const std::string name = line.word();
  if (!scene::find_command(name)) line.fail("there is no command " + quoted(name));
  return name;
}

Step read_step(const std::string& word, Line& line, const fs::path& folder) {
  Step step;
  if (word == "key") {
    read_key(line, step);
    return step;
  }
  const auto* const found = std::ranges::find(kind_words, word, &KindWord::word);
  if (found == std::end(kind_words)) line.fail("\"" + word + "\" is nothing that a script can say");
  step.kind = found->kind;
  switch (step.kind) {
    case Do::glide: step.number = line.number(0, most_seconds); [[fallthrough]];
    case Do::move: step.place = read_place(line); break;
    case Do::press:
    case Do::release: step.code = read_button(line); break;
    case Do::type: step.text = line.text("what is typed"); break;
    case Do::wheel: step.number = line.number(-1000, 1000); break;
    case Do::drop: step.files = line.files(folder); break;
    case Do::command:
    case Do::try_command: step.text = read_command(line); break;
    case Do::frame:
      step.number = line.number(0, most_seconds);
      step.code = line.at_end() ? 1 : line.whole(1, most_times);
      break;
    case Do::pause: step.number = line.number(0, most_seconds); break;
    case Do::size: step.size = {line.whole(16, 16384), line.whole(16, 16384)}; break;
    case Do::chapter:
      step.text = line.text("a title");
      step.more = line.text("a text");
      break;
    case Do::leave:
    case Do::wait:
    case Do::key_down:
    case Do::key_up: break;
  }
  line.end();
  return step;
}

// True if the line belongs to the head.
bool read_head(const std::string& word, Line& line, Script& script) {
  if (word == "window") {
    script.window = {line.whole(16, 16384), line.whole(16, 16384)};
  } else if (word == "view") {
    script.view = line.number(1, 16384);
  } else if (word == "open") {
    script.open = line.files(script.file.parent_path());
  } else if (word == "poses") {
    script.poses = line.files(script.file.parent_path()).front();
  } else if (word == "arranged") {
    script.arranged = line.rest();
  } else if (word == "brush") {
    script.brush_radius = line.number(1, 1000);
    script.brush_share = line.number(0, 1);
  } else {
    return false;
  }
  line.end();
  return true;
}

}  // namespace

std::size_t Script::chapters() const {
  return static_cast<std::size_t>(std::ranges::count(steps, Do::chapter, &Step::kind));
}

Script read_script(const fs::path& file) {
  std::error_code wrong;
  if (fs::is_directory(file, wrong)) throw base::Error(file.string(), "this is a folder", "name a script");
  if (fs::file_size(file, wrong) > most_bytes && !wrong)
    throw base::Error(file.string(), "this is too large for a script", "name a script");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw base::Error(file.string(), "it cannot be read", "check its name");
  Script script;
  script.file = fs::absolute(file, wrong);
  std::string text;
  for (std::size_t number = 1; std::getline(in, text); ++number) {
    Line line(file, number, text);
    if (number == 1) {
      if (line.rest() != first_line)
        line.fail("this is no script: it does not begin with \"" + std::string(first_line) + '"',
                  "name a file that Help, Record has written");
      continue;
    }
    if (line.at_end()) continue;
    const std::string word = line.word();
    if (word[0] == '#' || (script.steps.empty() && read_head(word, line, script))) continue;
    script.steps.push_back(read_step(word, line, script.file.parent_path()));
    script.steps.back().line = number;
  }
  if (in.bad()) throw base::Error(file.string(), "it cannot be read to its end", "check the disk");
  if (script.steps.empty()) throw base::Error(file.string(), "there is no step in it", "record it again");
  return script;
}

std::string text_of(const Step& step, const fs::path& folder) {
  if (step.kind == Do::key_down || step.kind == Do::key_up)
    return std::string("key ") + (step.kind == Do::key_down ? "down " : "up ") + name_of_key(step.code) +
           '\n';
  std::string text = std::ranges::find(kind_words, step.kind, &KindWord::kind)->word;
  switch (step.kind) {
    case Do::glide: text += ' ' + number(step.number); [[fallthrough]];
    case Do::move: text += ' ' + text_of(step.place); break;
    case Do::press:
    case Do::release: text += std::string(" ") + button_words[std::clamp(step.code, 0, 2)]; break;
    case Do::type: text += ' ' + quoted(step.text); break;
    case Do::drop:
      for (const fs::path& file : step.files) text += ' ' + quoted(file.lexically_proximate(folder).string());
      break;
    case Do::command:
    case Do::try_command: text += ' ' + step.text; break;
    case Do::frame:
      text += ' ' + number(step.number) + (step.code > 1 ? ' ' + std::to_string(step.code) : "");
      break;
    case Do::wheel:
    case Do::pause: text += ' ' + number(step.number); break;
    case Do::size: text += ' ' + std::to_string(step.size.x) + ' ' + std::to_string(step.size.y); break;
    case Do::chapter: text += ' ' + quoted(step.text) + ' ' + quoted(step.more); break;
    case Do::leave:
    case Do::wait:
    case Do::key_down:
    case Do::key_up: break;
  }
  return text + '\n';
}

std::string head_of(const Script& script) {
  std::string text = std::string(first_line) + "\nwindow " + std::to_string(script.window.x) + ' ' +
                     std::to_string(script.window.y) + '\n';
  if (script.view > 0) text += "view " + number(script.view) + '\n';
  if (!script.open.empty()) {
    text += "open";
    for (const fs::path& file : script.open)
      text += ' ' + quoted(file.lexically_proximate(script.file.parent_path()).string());
    text += '\n';
  }
  if (script.brush_radius > 0)
    text += "brush " + number(script.brush_radius) + ' ' + number(script.brush_share) + '\n';
  if (!script.arranged.empty()) text += "arranged " + script.arranged + '\n';
  return text;
}

}  // namespace viete::app
