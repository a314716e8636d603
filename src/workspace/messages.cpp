#include "workspace/messages.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "base/text.h"

namespace viete::workspace {

namespace {

bool is_over(const Message& message, double now) {
  if (!message.visible || message.severity == Severity::error) return false;
  const bool info = message.severity == Severity::info;
  return now - message.said > (info ? Messages::info_seconds : Messages::warning_seconds);
}

}  // namespace

void Messages::say(Severity severity, std::string text, Concern concern) {
  ++revision_;
  text = base::printable(text);
  const auto again = std::ranges::find_if(all_, [&](const Message& m) {
    return (m.visible || &m == &all_.back()) && m.severity == severity && m.text == text;
  });
  if (again != all_.end()) {
    std::rotate(again, again + 1, all_.end());
  } else {
    if (all_.size() >= 200) all_.erase(all_.begin());
    all_.push_back(
        {severity, std::move(text), 0, std::string(concern.topic), concern.scope, 0, revision_, true});
  }
  Message& message = all_.back();
  ++message.times;
  message.said = base::wall_seconds();
  message.revision = revision_;
  message.visible = true;
}

void Messages::log(Severity severity, std::string text) {
  say(severity, std::move(text));
  all_.back().visible = false;
}

void Messages::succeeded(std::string_view topic) {
  for (Message& message : all_) {
    if (message.severity == Severity::error && message.topic == topic) message.visible = false;
  }
}

void Messages::hide_messages() {
  for (Message& message : all_) message.visible &= message.severity == Severity::error;
}

void Messages::forget(Scope scope, unsigned revision) {
  std::erase_if(all_, [&](const Message& m) { return m.scope >= scope && m.revision <= revision; });
}

bool Messages::due(double now) const {
  return std::ranges::any_of(all_, [&](const Message& m) { return is_over(m, now); });
}

void Messages::expire(double now) {
  for (Message& message : all_) {
    if (is_over(message, now)) message.visible = false;
  }
}

}  // namespace viete::workspace
