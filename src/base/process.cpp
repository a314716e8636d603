#include "base/process.h"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>

namespace viete::base {

namespace {

// The 22nd field of /proc/PID/stat; the second, the program's name in parentheses, may hold anything. Empty
// if there is no such process, or if it has ended and nobody has asked how (in containers for good).
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

}  // namespace viete::base
