#include "app/options.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "app/help.h"
#include "base/text.h"
#include "deform/probe.h"
#include "lab/field.h"
#include "scene/document/range.h"
#include "scene/workspace/frame_stats.h"

namespace viete::app {

namespace {

template <class Number>
bool read_whole_text(const std::string& text, Number& number) {
  const auto end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, number);
  return code == std::errc() && stop == end;
}

// Formats "0.5", "1,000,000".
std::string number_text(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}
std::string number_text(std::int64_t number) {
  return (number < 0 ? "-" : "") + base::with_thousands(static_cast<std::size_t>(std::abs(number)));
}

template <class Number>
CLI::Option* limit(CLI::Option* option, Number low, Number high, const std::string& what) {
  const std::string range = number_text(low) + " to " + number_text(high);
  option->option_text("NUMBER")->description(option->get_description() + ", " + range);
  return option->check([=](const std::string& text) -> std::string {
    Number number{};
    if (read_whole_text(text, number) && number >= low && number <= high) return {};  // NaN is out of range
    return "needs " + what + " from " + range + ", not " + text;
  });
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
    const std::string meant = nearest(text, words);
    return "needs " + listed(words) + ", not " + text +
           (meant.empty() ? "" : "; did you mean " + meant + "?");
  });
}

void add_force_option(CLI::App& app, bool& force) {
  app.add_flag("--force", force, "Allow overwriting inputs and files of other kinds");
}

scene::Force force_of(bool given) {
  if (given) return scene::Force::given;
  return std::getenv("VIETE_PROGRESS") ? scene::Force::none : scene::Force::offered;
}

void add_method_option(CLI::App& app, const std::function<void(sym3::Method)>& take) {
  std::vector<std::string> words;
  for (const sym3::Method m : scene::compared_methods) words.emplace_back(sym3::name(m));
  auto* option = app.add_option_function<std::string>(
      "--method", [take](const std::string& word) { take(*sym3::method_from_name(word)); }, listed(words));
  one_of(option, words)->default_str("fast");
}

void add_choice_options(CLI::App& app, deform::PartialChoice& choice) {
  add_choice(app, "--weights", "Weights, see 'viete help deformers'", deform::all_weights(), choice.weights);
  add_choice(app, "--blend", "Blend of maps, see 'viete help deformers'", deform::all_blends(), choice.blend);
}

std::string deformers_help() {
  std::string text = "Choices of the options of viete\n";
  const auto list = [&text](const char* title, const auto& table) {
    text += std::string("\n") + title + ":\n";
    for (const auto& e : table) text += help_line(std::string(e.name), std::string(e.sentence));
  };
  list("Deformers (--deformer)", deform::all_ways());
  list("Weights (--weights)", deform::all_weights());
  list("Blends (--blend)", deform::all_blends());
  list("Falloffs of probes", deform::all_falloffs());
  text += "\nMethods (--method):\n";
  for (const sym3::Method method : scene::compared_methods)
    text += help_line(std::string(sym3::name(method)),
                      std::ranges::find(sym3::methods(), method, &sym3::MethodEntry::method)->sentence);
  text += "\nMaps (--map):\n";
  for (const base::Choice& map : choices(lab::Field::none))
    text += help_line(std::string(map.word), std::string(map.hint));
  text.pop_back();
  return text;
}

void add_number_option(CLI::App& app, std::string_view name, deform::AskedScheme& asked) {
  const deform::NumberEntry& number = deform::number(name);
  const auto take = [&](double percent) { asked.*number.asked = percent / 100; };
  auto* option =
      app.add_option_function<double>("--" + std::string(name), take, std::string(number.sentence));
  in_range(option, 100 * number.least, 100 * number.largest)
      ->option_text("PERCENT")
      ->default_str(number_text(number.percent({})));
}

// The second option takes precedence.
void add_stitching_options(CLI::App& app, deform::AskedScheme& asked) {
  auto& iterations = asked.iterations;
  auto* stitched = app.add_flag_function(
      "--stitched", [&iterations](std::int64_t) { iterations = 1; },
      "As-rigid-as-possible solve over the whole mesh");
  auto* number = app.add_option_function<int>(
      "--iterations", [&iterations](int n) { iterations = n; }, "Stitching: number of solves per frame");
  whole_in_range(number, 1, deform::most_iterations)->default_str("1")->needs(stitched);
  add_number_option(app, "pins", asked);
  add_number_option(app, "hold", asked);
}

void add_digits_option(CLI::App& app, mesh::Digits& digits) {
  const auto take = [&digits](const std::string& text) {
    int decimals = -1;
    const char* const end = text.data() + text.size();
    const bool whole = std::from_chars(text.data(), end, decimals).ptr == end;
    if (text == "all") {
      digits = {mesh::Digits::Kind::all};
    } else if (whole && decimals >= 0 && decimals <= 17) {
      digits = {mesh::Digits::Kind::decimals, decimals};
    } else {
      throw CLI::ValidationError("--digits", "needs a number from 0 to 17, or all, not " + text);
    }
  };
  app.add_option_function<std::string>("--digits", take, "Decimal places in text files, 0 to 17, or all")
      ->option_text("NUMBER|all")
      ->default_str("as in MODEL");
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
             throw CLI::ValidationError("--size", "needs at most as many pixels as 16384x16384, not " + text);
           size = {w, h};
         },
         "Picture size, 16 to 32768 pixels")
      ->option_text("WIDTHxHEIGHT")
      ->default_str("1280x800");
}

}  // namespace viete::app
