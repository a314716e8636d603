#include "scene/recovery.h"

#include <sys/stat.h>

#include <algorithm>

#include "base/error.h"
#include "base/process.h"
#include "scene/session.h"

namespace viete::scene {

namespace fs = std::filesystem;

namespace {

// PROCESS.viete or PROCESS_3.viete.
std::string process_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  return stem.substr(0, stem.find('_'));
}

std::tm local(std::time_t time) {
  std::tm parts{};
  localtime_r(&time, &parts);
  return parts;
}

std::string text(const char* format, const std::tm& time) {
  char buffer[64];
  return {buffer, std::strftime(buffer, sizeof buffer, format, &time)};
}

}  // namespace

fs::path recovery_file(const fs::path& folder) {
  return folder / (base::process_name() + ".viete");
}

fs::path set_aside_file(const fs::path& folder) {
  std::error_code ignored;
  for (int i = 1;; ++i) {
    const fs::path file = folder / (base::process_name() + "_" + std::to_string(i) + ".viete");
    if (!fs::exists(file, ignored)) return file;
  }
}

Leftover describe_leftover(const fs::path& file) {
  Leftover leftover{file, file.filename().string(), 0};
  struct stat status {};
  if (stat(file.c_str(), &status) == 0) leftover.time = status.st_mtime;
  try {
    const Session session = read_session(file);
    leftover.name = (session.origin.empty() ? session.model : session.origin).filename().string();
  } catch (const std::exception&) {
    // Its own name will do; opening it says what is wrong.
  }
  return leftover;
}

std::vector<Leftover> find_leftovers(const fs::path& folder) {
  std::vector<Leftover> all;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    const fs::path& file = entry->path();
    if (is_session(file) && !base::process_runs(process_of(file))) all.push_back(describe_leftover(file));
  }
  std::sort(all.begin(), all.end(), [](const Leftover& a, const Leftover& b) {
    return a.time != b.time ? a.time > b.time : a.file < b.file;
  });
  return all;
}

std::string when(std::time_t time, std::time_t now) {
  const std::tm then = local(time), today = local(now);
  const bool same_day = then.tm_year == today.tm_year && then.tm_yday == today.tm_yday;
  return text(same_day ? "today %H:%M" : "%b %d, %H:%M", then);
}

}  // namespace viete::scene
