#include "base/error.h"

#include <new>
#include <utility>

#include "base/text.h"

namespace viete::base {

namespace {

std::string sentence(const std::string& place, const std::string& problem, const std::string& advice) {
  std::string text = place.empty() ? problem : place + ": " + problem;
  if (!advice.empty()) text += "; " + advice;
  return text;
}

}  // namespace

Error::Error(std::string place, std::string problem, std::string advice)
    : std::runtime_error(sentence(printable(place), printable(problem), printable(advice))),
      place_(std::move(place)),
      problem_(printable(problem)),
      advice_(printable(advice)) {}

std::string message_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return "not enough memory; close other programs or use a smaller model";
  return error.what();
}

}  // namespace viete::base
