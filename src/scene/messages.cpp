#include "scene/messages.h"

#include <utility>

#include "base/printable.h"

namespace viete::scene {

void Messages::say(Severity severity, std::string text) {
  ++revision_;
  text = base::printable(text);
  if (!all_.empty() && all_.back().severity == severity && all_.back().text == text) {
    ++all_.back().times;
    return;
  }
  if (all_.size() >= 200) all_.erase(all_.begin());
  all_.push_back({severity, std::move(text), 1});
}

}  // namespace viete::scene
