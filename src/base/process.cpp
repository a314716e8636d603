#include "base/process.h"

#include <atomic>
#include <charconv>
#include <chrono>
#include <mutex>
#include <sstream>
#include <thread>

#include "base/clock.h"
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

constexpr int look_again_ms = 10;

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

// The output of a child process: the progress from lines such as "37 %", and all other lines.
struct ChildOutput {
  double done = 0;
  std::vector<std::string> lines;
};

ChildOutput output_of(const ChildProgram& child) {
  ChildOutput output;
  std::istringstream text(child.said());
  for (std::string line; std::getline(text, line);) {
    int percent = 0;
    const auto [end, problem] = std::from_chars(line.data(), line.data() + line.size(), percent);
    if (problem == std::errc() && std::string_view(end) == " %") {
      output.done = 0.01 * percent;
    } else if (!line.empty()) {
      for (const std::string_view head : {"viete: ", "note: "})
        if (line.starts_with(head)) line.erase(0, head.size());
      output.lines.push_back(line);
    }
  }
  return output;
}

}  // namespace

ChildProgram::ChildProgram(const std::vector<std::string>& words, const std::string& advice,
                           const std::vector<std::string>& variables, bool keeps_output)
    : name_(words.front()) {
  try {
    child_ = std::make_unique<os::Child>(words, variables, keeps_output);
  } catch (const os::StartFailure& failure) {
    if (failure.limit)
      throw Error(name_, "cannot be run: the limit on processes is reached",
                  "close other programs, or raise the limit (ulimit -u)");
    throw Error(name_, failure.missing ? "this program is not installed" : "cannot be run: " + failure.reason,
                advice);
  }
}

std::vector<std::string> ChildProgram::follow(Progress& progress, double most_seconds) {
  constexpr auto look_again = std::chrono::milliseconds(look_again_ms);
  const double start = wall_seconds();
  try {
    while (running() && wall_seconds() - start < most_seconds) {
      std::this_thread::sleep_for(look_again);
      progress.report(output_of(*this).done);
    }
  } catch (const Cancelled&) {
    stop();
    while (running()) std::this_thread::sleep_for(look_again);
    throw;
  }
  return output_of(*this).lines;
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
