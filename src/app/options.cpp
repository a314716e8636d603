#include "app/options.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "analysis/field.h"
#include "base/text.h"
#include "document/range.h"
#include "pose/probe.h"
#include "workspace/frame_stats.h"

namespace viete::app {

namespace {

template <class Number>
bool read_whole_text(const std::string& text, Number& number) {
  const auto end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, number);
  return code == std::errc() && stop == end;
}

std::string number_text(std::int64_t number) {
  return (number < 0 ? "-" : "") + base::with_thousands(static_cast<std::size_t>(std::abs(number)));
}
std::string number_text(double number) {
  char text[32];
  if (number >= 1e4 && number < 1e15) return number_text(static_cast<std::int64_t>(number));
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const std::string name = nearest(word, names);
  return name.empty() ? "" : "; did you mean " + name + "?";
}

template <class Number>
CLI::Option* limit(CLI::Option* option, Number low, Number high, const std::string& what) {
  const std::string range = number_text(low) + " to " + number_text(high);
  option->option_text("NUMBER")->description(option->get_description() + ", " + range);
  return option->check([=](const std::string& text) -> std::string {
    Number number{};
    if (read_whole_text(text, number) && number >= low && number <= high) return {};  // rejects NaN
    return "needs " + what + " from " + range + ", not " + text;
  });
}

// One entry of a list in the help, wrapped to 80 columns, with a line break at the end.
std::string help_line(const std::string& name, const std::string& text) {
  constexpr std::size_t text_column = 26;
  std::string out = "  " + name;
  if (text.empty()) return out + '\n';
  if (out.size() + 2 > text_column) {
    out += '\n';
    out.append(text_column, ' ');
  } else {
    out.resize(text_column, ' ');
  }
  return out + wrapped(text, text_column, text_column) + '\n';
}

}  // namespace

CLI::Option* add_file_option(CLI::App& app, const std::string& name, std::filesystem::path& file,
                             const std::string& text) {
  return app.add_option(name, file, text)->option_text("FILE");
}

CLI::Option* in_range(CLI::Option* option, double low, double high) {
  return limit(option, low, high, "a number");
}

CLI::Option* whole_in_range(CLI::Option* option, std::int64_t low, std::int64_t high) {
  return limit(option, low, high, "a whole number");
}

CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& words) {
  return option->option_text("WORD")->check([words](const std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return {};
    return "needs " + base::listed(words) + ", not " + text + suggestion(text, words);
  });
}

void add_force_option(CLI::App& app, bool& force) {
  app.add_flag("--force", force, "Replace any existing file, even an input");
}

files::Force force_of(bool given) {
  if (given) return files::Force::given;
  return base::os::variable("VIETE_PROGRESS").empty() ? files::Force::offered : files::Force::none;
}

void add_method_option(CLI::App& app, const std::function<void(sym3::Method)>& take) {
  std::vector<std::string> words;
  for (const sym3::Method m : analysis::compared_methods) words.emplace_back(sym3::name(m));
  auto* option = app.add_option_function<std::string>(
      "--method", [take](const std::string& word) { take(*sym3::method_from_name(word)); },
      "Matrix exponential: " + base::listed(words));
  one_of(option, words)->default_str("fast");
}

void add_choice_options(CLI::App& app, pose::PartialChoice& choice) {
  add_choice<pose::Weights>(app, "--weights", "Weights, see 'viete help deformers'", choice.weights);
  add_choice<pose::Blend>(app, "--blend", "Blend of transformations, see 'viete help deformers'",
                          choice.blend);
}

std::string deformers_help() {
  std::string text = "Values of the options of viete\n";
  const auto list = [&text](const char* title, std::span<const base::Choice> values) {
    text += std::string("\n") + title + ":\n";
    for (const base::Choice& value : values)
      text += help_line(std::string(value.word), std::string(value.hint));
  };
  list("Deformers (--deformer)", choices(pose::Preset{}));
  list("Weights (--weights)", choices(pose::Weights{}));
  list("Blends (--blend)", choices(pose::Blend{}));
  list("Falloffs of probes", choices(pose::Falloff{}));
  text += "\nMethods (--method):\n";
  for (const sym3::Method method : analysis::compared_methods)
    text += help_line(std::string(sym3::name(method)),
                      std::ranges::find(sym3::methods(), method, &sym3::MethodEntry::method)->sentence);
  list("Maps (--map)", choices(analysis::Field::none));
  return text + "\nThe manual explains all terms: viete manual glossary";
}

void add_number_option(CLI::App& app, std::string_view name, pose::AskedDeformer& asked) {
  const pose::NumberEntry& number = pose::number(name);
  const auto take = [&](double percent) { asked.*number.asked = percent / 100; };
  auto* option = app.add_option_function<double>("--" + std::string(name), take, std::string(number.hint));
  in_range(option, 100 * number.least, 100 * number.largest)
      ->option_text("PERCENT")
      ->default_str(number_text(number.percent({})));
}

void add_arap_options(CLI::App& app, pose::AskedDeformer& asked) {
  app.add_flag("--arap", asked.arap, "Solve for a mesh that is as rigid as possible (ARAP)");
  auto* number = app.add_option_function<int>(
      "--iterations", [&asked](int n) { asked.iterations = n; }, "ARAP: number of solves per frame");
  whole_in_range(number, 1, pose::most_iterations)->default_str("1");
  add_number_option(app, "attach", asked);
  add_number_option(app, "hold", asked);
}

void add_digits_option(CLI::App& app, formats::Digits& digits) {
  const auto take = [&digits](const std::string& text) {
    int decimals = -1;
    const char* const end = text.data() + text.size();
    const bool whole = std::from_chars(text.data(), end, decimals).ptr == end;
    if (text == "all") {
      digits = {formats::Digits::Kind::all};
    } else if (whole && decimals >= 0 && decimals <= 17) {
      digits = {formats::Digits::Kind::decimals, decimals};
    } else {
      throw CLI::ValidationError("--digits", "needs a number from 0 to 17, or all, not " + text);
    }
  };
  app.add_option_function<std::string>("--digits", take, "Decimals in text files")
      ->option_text("NUMBER|all")
      ->default_str("as in the input");
}

void add_size_option(CLI::App& app, glm::ivec2& size) {
  app.add_option_function<std::string>(
         "--size",
         [&size](const std::string& text) {
           int w = 0, h = 0;
           char rest = 0;
           const bool whole = std::sscanf(text.c_str(), "%dx%d%c", &w, &h, &rest) == 2;
           if (!whole || w < 16 || h < 16 || w > 32768 || h > 32768)
             throw CLI::ValidationError("--size", "needs WIDTHxHEIGHT, each 16 to 32768, not " + text);
           if (static_cast<std::int64_t>(w) * h > most_pixels)
             throw CLI::ValidationError("--size", "needs at most 268 million pixels, not " + text);
           size = {w, h};
         },
         "Picture size in logical pixels, 16 to 32768; the file has --scale times as many")
      ->option_text("WIDTHxHEIGHT")
      ->default_str("1280x800");
}

std::string wrapped(std::string_view text, std::size_t column, std::size_t indent, std::size_t width) {
  std::string out;
  bool line_has_words = false;
  const auto new_line = [&] {
    out += '\n' + std::string(indent, ' ');
    column = indent;
    line_has_words = false;
  };
  while (!text.empty()) {
    const std::size_t length = std::min(text.find_first_of(" \n"), text.size());
    if (length > 0) {
      if (line_has_words && column + 1 + length > width) new_line();
      if (line_has_words) out += ' ';
      column += length + (line_has_words ? 1 : 0);
      out += text.substr(0, length);
      line_has_words = true;
    }
    if (length < text.size() && text[length] == '\n') new_line();
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return out;
}

std::size_t misspellings(std::string_view a, std::string_view b) {
  // Optimal string alignment: computes a table of distances between prefixes of a and b, row by row.
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t other = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + other});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t telling = 3;  // shortest prefix that counts as similar
  std::string best;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& name : names) {
    const bool begins = word.size() >= telling && name.size() >= telling &&
                        (name.starts_with(word) || word.starts_with(name));
    const std::size_t count = begins ? 1 : misspellings(word, name);
    if (count >= fewest) continue;
    fewest = count;
    best = name;
  }
  return best;
}

void add_examples(CLI::App& command, const std::vector<std::string>& lines) {
  std::string text = "Examples:";
  for (const std::string& line : lines) text += "\n  viete " + line;
  command.footer(text);
}

namespace {

using OptionList = std::vector<const CLI::Option*>;

// For example "FILE"; empty for a flag.
std::string value_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  return option.get_option_text().empty() ? "VALUE" : option.get_option_text();
}

// For example "-o, --output FILE" or "MODEL".
std::string name_of(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true, false);
  std::string name;
  for (const std::string& letter : option.get_snames()) name += "-" + letter + ", ";
  for (const std::string& word : option.get_lnames()) name += "--" + word;
  const std::string value = value_of(option);
  return value.empty() ? name : name + " " + value;
}

std::string shortest_name(const CLI::Option& option) {
  return option.get_snames().empty() ? "--" + option.get_lnames().front() : "-" + option.get_snames().front();
}

std::string text_of(const CLI::Option& option) {
  std::string text = option.get_description();
  if (!option.get_default_str().empty()) text += " (default: " + option.get_default_str() + ")";
  return text;
}

// The command parsed so far, for example "viete bench exp".
std::string name_of_command(const CLI::App& app) {
  return app.get_parent() ? name_of_command(*app.get_parent()) + " " + app.get_name() : app.get_name();
}

// For example " MODEL [CAGE] -o FILE [OPTIONS]".
std::string words_of(const CLI::App& command) {
  std::string words, required;
  bool others = false;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) {
      others |= !option->get_required();
      if (option->get_required()) required += " " + shortest_name(*option) + " " + value_of(*option);
      continue;
    }
    const std::string name = name_of(*option) + (option->get_expected_max() > 1 ? "..." : "");
    words += option->get_required() ? " " + name : " [" + name + "]";
  }
  if (!command_names(command).empty()) words += " COMMAND ...";
  return words + required + (others ? " [OPTIONS]" : "");
}

std::string usage_of(const CLI::App& app) {
  if (app.get_parent()) return "Usage: " + name_of_command(app) + words_of(app) + '\n';
  return "Usage: viete [MODEL [CAGE]] [OPTIONS of view]\n"
         "       viete COMMAND ...\n"
         "       viete help COMMAND|deformers\n";
}

std::string list(const char* title, const OptionList& options) {
  if (options.empty()) return "";
  std::string out = std::string("\n") + title + ":\n";
  for (const CLI::Option* option : options) out += help_line(name_of(*option), text_of(*option));
  return out;
}

class HelpFormatter : public CLI::FormatterBase {
public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    const OptionList words = app->get_options([](const CLI::Option* o) { return o->get_positional(); });
    const OptionList options =
        app->get_options([](const CLI::Option* o) { return o->nonpositional() && !o->get_group().empty(); });
    std::string out = wrapped(app->get_description(), 0, 0) + "\n\n" + usage_of(*app);
    out += list("Files", words);
    const auto commands = app->get_subcommands([](const CLI::App*) { return true; });
    if (!commands.empty()) out += "\nCommands:\n";
    for (const CLI::App* command : commands)
      out += help_line(command->get_name(), command->get_description());
    out += list("Options", options);
    return out + '\n' + app->get_footer() + '\n';
  }
};

const CLI::App& last_command(const CLI::App& app) {
  const CLI::App* last = &app;
  while (!last->get_subcommands().empty()) last = last->get_subcommands().back();
  return *last;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// Rewrites these messages of CLI11: "--output: 1 required TEXT missing", "--output: At Most 1 required but
// received 2" (since 2.6 "At most") and "--compare: At least 2 required but received 1".
std::string wrong_count(const std::string& words) {
  const std::string option = words.substr(0, words.find(':'));
  const auto number_after = [&](const std::string& limit) {
    const auto at = words.find(limit);
    if (at == words.npos) return std::string();
    const auto from = at + limit.size();
    return words.substr(from, words.find(' ', from) - from);
  };
  if (const std::string least = number_after("At least "); !least.empty())
    return option + " needs " + least + " or more values";
  const bool capital = words.find("At Most ") != words.npos;
  if (const std::string most = number_after(capital ? "At Most " : "At most "); !most.empty() && most != "1")
    return option + " needs at most " + most + " values";
  return option + (words.find("missing") == words.npos ? " is given more than once" : " needs a value");
}

std::string unknown(const CLI::App& command, const std::vector<std::string>& words) {
  const std::string& first = words.front();
  if (first.size() > 1 && first[0] == '-')
    return name_of_command(command) + " has no option " + first +
           suggestion(first.substr(0, first.find('=')), option_names(command));
  if (const auto names = command_names(command); !names.empty())
    return name_of_command(command) + " has no command " + first + suggestion(first, names);
  return "unexpected arguments of " + name_of_command(command) + ": " + base::joined(words, " ");
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string usage_error(const CLI::App& app, const CLI::Error& error) {
  const CLI::App& command = last_command(app);
  const auto words = command.remaining();
  std::string text = error.what();
  if (!words.empty()) {
    text = unknown(command, words);
  } else if (const auto names = command_names(command);
             !names.empty() && error.get_name() == "RequiredError") {
    text = name_of_command(command) + " needs one of " + base::listed(names);
  } else if (error.get_name() == "ArgumentMismatch") {
    text = wrong_count(text);
  }
  return "viete: " + text + "\nTry '" + name_of_command(command) + " --help' for more information.\n";
}

}  // namespace viete::app
