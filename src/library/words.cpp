#include "library/words.h"

#include "deform/probe.h"
#include "deform/scheme.h"
#include "deform/ways.h"

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

std::string ways_text() {
  return lines_of(deform::all_ways());
}

std::string choices_text() {
  return "\nelements:" + lines_of(deform::all_elements()) + "\nweights:" + lines_of(deform::all_weights()) +
         "\nblend:" + lines_of(deform::all_blends());
}

std::string falloffs_text() {
  return lines_of(deform::all_falloffs());
}

}  // namespace viete::library
