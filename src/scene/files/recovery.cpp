#include "scene/files/recovery.h"

#include <sys/stat.h>

#include <algorithm>

#include "base/process.h"
#include "scene/files/session.h"

namespace viete::scene {

namespace fs = std::filesystem;

namespace {

// Parses PROCESS.viete or PROCESS_3.viete.
std::string process_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  return stem.substr(0, stem.find('_'));
}

constexpr const char* restored_ending = "_restored";

// The edited parts of a session, without its view.
Session work_of(const Session& session) {
  Session work;
  work.model = session.model, work.cage = session.cage, work.generated_cage = session.generated_cage;
  work.scheme = session.scheme, work.mask = session.mask, work.probes = session.probes;
  work.groups.sets = session.groups.sets, work.library = session.library, work.timeline = session.timeline;
  work.shape = session.shape, work.pose = session.pose;
  return work;
}

// The work stored in the session or cage on disk. Requires a session, or a cage with a file.
Session on_disk(const Session& kept) {
  if (!kept.origin.empty()) return work_of(read_session(kept.origin));
  Session rest;
  rest.model = kept.model, rest.cage = kept.cage;
  rest.scheme = deform::default_scheme();
  if (kept.pose) {
    rest.pose = deform::Pose{open_surface(kept.cage).surface->positions, kept.pose->turns};
    for (auto& turn : rest.pose->turns) turn = {};
  }
  return rest;
}

bool equals_files(const fs::path& file) {
  try {
    const Session kept = read_session(file);
    if (!kept.warnings.empty() || (kept.origin.empty() && kept.cage.empty())) return false;
    return session_text(work_of(kept), file, false) == session_text(on_disk(kept), file, false);
  } catch (const std::exception&) {
    return false;
  }
}

std::tm local(std::time_t time) {
  std::tm parts{};
  localtime_r(&time, &parts);
  return parts;
}

bool is_same_day(const std::tm& a, const std::tm& b) {
  return a.tm_year == b.tm_year && a.tm_yday == b.tm_yday;
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

fs::path mark_restored(const fs::path& file) {
  if (file.stem().string().ends_with(restored_ending)) return file;
  fs::path marked = file;
  marked.replace_filename(file.stem().string() + restored_ending + file.extension().string());
  std::error_code code;
  fs::rename(file, marked, code);
  return code ? file : marked;
}

RecoveryFile describe_recovery_file(const fs::path& file) {
  RecoveryFile leftover{file, file.filename().string()};
  leftover.restored = file.stem().string().ends_with(restored_ending);
  struct stat status {};
  if (stat(file.c_str(), &status) == 0) leftover.time = status.st_mtime;
  try {
    const Session session = read_session(file);
    const fs::path& of = session.origin.empty() ? session.model : session.origin;
    leftover.name = of.filename().string();
    leftover.folder = of.parent_path();
    leftover.first_edit = session.first_edit;
  } catch (const std::exception&) {
    // Keep the name of the recovery file; opening the file reports the error.
  }
  return leftover;
}

std::vector<RecoveryFile> find_recovery_files(const fs::path& folder) {
  std::vector<RecoveryFile> all;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    const fs::path& file = entry->path();
    if (is_session(file) && !base::process_runs(process_of(file)))
      all.push_back(describe_recovery_file(file));
  }
  std::error_code ignored;
  std::erase_if(all, [&](const RecoveryFile& leftover) {
    return equals_files(leftover.file) && fs::remove(leftover.file, ignored);
  });
  std::sort(all.begin(), all.end(), [](const RecoveryFile& a, const RecoveryFile& b) {
    return a.time != b.time ? a.time > b.time : a.file < b.file;
  });
  return all;
}

std::string when(std::time_t time, std::time_t now) {
  const std::tm then = local(time), today = local(now);
  std::tm noon = today;  // noon of the previous day, robust against clock changes
  noon.tm_hour = 12, --noon.tm_mday;
  if (is_same_day(then, today)) return text("today %H:%M", then);
  if (is_same_day(then, local(std::mktime(&noon)))) return text("yesterday %H:%M", then);
  return text(then.tm_year == today.tm_year ? "%b %d, %H:%M" : "%b %d %Y, %H:%M", then);
}

}  // namespace viete::scene
