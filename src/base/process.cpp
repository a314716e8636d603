#include "base/process.h"

#include <pthread.h>
#include <unistd.h>
#include <atomic>
#include <fstream>
#include <iterator>
#include <mutex>
#include <sstream>

namespace viete::base {

namespace {

// Returns the start time of a process in clock ticks: field 22 of /proc/PID/stat. (Field 2, the program's
// name, may contain spaces and parentheses.) Empty if the process does not exist or is a zombie.
std::string start_of(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto name_end = text.rfind(')');
  if (name_end == std::string::npos) return "";
  std::istringstream fields(text.substr(name_end + 1));
  std::string field;
  fields >> field;
  const bool ended = field == "Z" || field == "X";
  for (int i = 4; i <= 22; ++i) fields >> field;
  return fields && !ended ? field : "";
}

}  // namespace

std::string process_name() {
  const std::string pid = std::to_string(getpid());
  return pid + "-" + start_of(pid);
}

bool process_runs(std::string_view name) {
  const std::string pid(name.substr(0, name.find('-')));
  if (pid.empty() || pid.find_first_not_of("0123456789") != std::string::npos) return false;
  const std::string start = start_of(pid);
  return !start.empty() && name == pid + "-" + start;
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

[[maybe_unused]] const int registered = pthread_atfork(before_fork, after_fork, after_fork);

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

}  // namespace viete::base
