#include "base/process.h"

#include <atomic>
#include <charconv>
#include <chrono>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "base/text.h"

namespace viete::base {

std::string process_name() {
  const unsigned long id = os::process_id();
  return std::to_string(id) + "-" + os::process_start(id);
}

bool process_runs(std::string_view name) {
  unsigned long id = 0;
  const char* const end = name.data() + name.size();
  const auto [rest, problem] = std::from_chars(name.data(), end, id);
  if (problem != std::errc() || rest == end || *rest != '-') return false;
  const std::string start = os::process_start(id);
  return !start.empty() && start == std::string_view(rest + 1, end);
}

namespace {

std::mutex entrance;          // fork() locks this mutex
std::atomic<int> inside = 0;  // the number of threads with a ForkDelay
thread_local int own = 0;     // the number of ForkDelays in this thread

void before_fork() {
  entrance.lock();
  for (int all = inside; all > (own > 0); all = inside) inside.wait(all);
}

void after_fork() {
  entrance.unlock();
}

[[maybe_unused]] const bool registered = os::at_fork(before_fork, after_fork);

}  // namespace

ForkDelay::ForkDelay() {
  if (own++ > 0) return;
  const std::lock_guard lock(entrance);
  ++inside;
}

ForkDelay::~ForkDelay() {
  if (--own > 0) return;
  --inside;
  inside.notify_all();
}

namespace {

constexpr int look_again_ms = 20;

// Joins lines: "this; that".
std::string in_one_line(const std::string& lines) {
  std::string text;
  for (const char c : lines) {
    const bool ends = c == '\n' || c == '\r';
    if (!ends)
      text += c;
    else if (!text.ends_with("; "))
      text += "; ";
  }
  return text;
}

}  // namespace

ChildProgram::ChildProgram(const std::vector<std::string>& words, const std::string& advice,
                           const std::vector<std::string>& variables)
    : name_(words.front()) {
  try {
    child_ = std::make_unique<os::Child>(words, variables);
  } catch (const os::StartFailure& failure) {
    if (failure.limit)
      throw Error(name_, "cannot be run: the limit on processes is reached",
                  "close other programs, or raise the limit (ulimit -u)");
    throw Error(name_, failure.missing ? "this program is not installed" : "cannot be run: " + failure.reason,
                advice);
  }
}

void ChildProgram::finish() {
  while (running()) std::this_thread::sleep_for(std::chrono::milliseconds(look_again_ms));
  if (child_->succeeded()) return;
  const std::string text = in_one_line(said());
  throw Error(name_, text.empty() ? "the program ended unexpectedly" : "it reported: " + printable(text, 600),
              "check the program's installation and the free disk space");
}

std::string ChildProgram::said() const {
  std::string text = child_->errors(4096);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text;
}

}  // namespace viete::base
