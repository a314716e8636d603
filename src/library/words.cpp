#include "library/words.h"

#include <cctype>

#include "deform/probe.h"
#include "deform/scheme.h"

namespace viete::library {

namespace {

template <class Entry>
std::string lines_of(std::span<const Entry> table) {
  std::string lines;
  for (const Entry& entry : table)
    lines += "\n  '" + std::string(entry.name) + "': " + std::string(entry.sentence);
  return lines;
}

}  // namespace

std::string without_dashes(const std::string& sentence) {
  std::string words;
  for (std::size_t i = 0; i < sentence.size(); ++i) {
    const bool begins = i == 0 || sentence[i - 1] == ' ';
    if (!begins || sentence.compare(i, 2, "--") != 0) {
      words += sentence[i];
      continue;
    }
    for (i += 2;
         i < sentence.size() && (std::isalpha(static_cast<unsigned char>(sentence[i])) || sentence[i] == '-');
         ++i)
      words += sentence[i] == '-' ? '_' : sentence[i];
    --i;
  }
  return words;
}

std::string ways_text() {
  return lines_of(deform::all_ways());
}

std::string choices_text() {
  return "\nweights:" + lines_of(deform::all_weights()) + "\nblend:" + lines_of(deform::all_blends());
}

std::string falloffs_text() {
  return lines_of(deform::all_falloffs());
}

}  // namespace viete::library
