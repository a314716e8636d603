#include "scene/document/length_unit.h"
#include "mesh/formats/format_table.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace viete::scene {

namespace {

constexpr LengthUnitEntry units[] = {{"none", "units that are not known", 1},
                                     {"mm", "millimetres", 0.001},
                                     {"cm", "centimetres", 0.01},
                                     {"m", "metres", 1},
                                     {"in", "inches", 0.0254},
                                     {"ft", "feet", 0.3048}};

struct Spellings {
  std::string_view words;  // with a blank before and after each
  LengthUnit unit;
};

constexpr Spellings spellings[] = {
    {" mm millimeter millimeters millimetre millimetres ", LengthUnit::millimetre},
    {" cm centimeter centimeters centimetre centimetres ", LengthUnit::centimetre},
    {" m meter meters metre metres ", LengthUnit::metre},
    {" in inch inches ", LengthUnit::inch},
    {" ft foot feet ", LengthUnit::foot}};

// In lower case; a point within a number belongs to it.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool point =
        c == '.' && i + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[i + 1]));
    if (std::isalnum(c) || point) {
      words.back() += static_cast<char>(std::tolower(c));
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool is_filler(const std::string& word) {
  constexpr std::array fillers{"is", "are", "of", "length", "in", "1", "1.0", "one", "the", "file"};
  return std::ranges::find(fillers, word) != fillers.end();
}

LengthUnit unit_of_word(const std::string& word) {
  const auto found = std::ranges::find_if(
      spellings, [&](const Spellings& s) { return s.words.find(' ' + word + ' ') != s.words.npos; });
  return found == std::end(spellings) ? LengthUnit::unknown : found->unit;
}

// "units" and, with nothing but fillers between, a name. "in" is one only as the last word.
LengthUnit named_unit(const std::string& comment) {
  const auto words = words_of(comment);
  const auto named = [](const std::string& word) { return word == "unit" || word == "units"; };
  auto at = std::ranges::find_if(words, named);
  if (at == words.end()) return LengthUnit::unknown;
  do ++at;
  while (at != words.end() && is_filler(*at) && at + 1 != words.end());
  return at == words.end() ? LengthUnit::unknown : unit_of_word(*at);
}

}  // namespace

std::span<const LengthUnitEntry> all_length_units() {
  return units;
}

const LengthUnitEntry& entry(LengthUnit unit) {
  return units[static_cast<std::size_t>(unit)];
}

std::optional<LengthUnit> length_unit_of_symbol(std::string_view symbol) {
  const auto found = std::ranges::find(units, symbol, &LengthUnitEntry::symbol);
  if (found == std::end(units)) return std::nullopt;
  return static_cast<LengthUnit>(found - std::begin(units));
}

LengthUnit guessed_unit(std::string_view format, const std::vector<std::string>& comments) {
  const mesh::Format* found = mesh::format_of_description(format);
  if (found && found->in_metres) return LengthUnit::metre;
  for (const std::string& comment : comments) {
    const LengthUnit unit = named_unit(comment);
    if (unit != LengthUnit::unknown) return unit;
  }
  return LengthUnit::unknown;
}

std::string with_unit(const std::string& number, LengthUnit unit, int power) {
  if (unit == LengthUnit::unknown) return number;
  const char* raised = power == 2 ? "\u00b2" : power == 3 ? "\u00b3" : "";
  return number + ' ' + std::string(entry(unit).symbol) + raised;
}

}  // namespace viete::scene
