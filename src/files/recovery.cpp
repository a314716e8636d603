#include "files/recovery.h"

#include <algorithm>
#include <chrono>

#include "base/os.h"
#include "base/process.h"
#include "files/session.h"

namespace viete::files {

namespace fs = std::filesystem;

namespace {

// Returns PROCESS for the file PROCESS.viete or PROCESS_3.viete.
std::string process_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  return stem.substr(0, stem.find('_'));
}

constexpr const char* restored_ending = "_restored";

// Returns the work in a session, without the view.
Session work_of(const Session& session) {
  Session work;
  work.model.path = session.model.path;
  work.cage_file.path = session.cage_file.path;
  work.cage_file.surface = session.cage_file.surface;
  work.deformer = session.deformer;
  work.mask = session.mask;
  work.probes = session.probes;
  work.groups.sets = session.groups.sets;
  work.library = session.library;
  work.timeline = session.timeline;
  work.shape = session.shape;
  work.pose = session.pose;
  return work;
}

// Returns the work in the saved session or, if there is no session, the cage file at rest.
Session on_disk(const Session& kept) {
  if (!kept.origin.empty()) return work_of(read_session(kept.origin));
  Session rest;
  rest.model.path = kept.model.path;
  rest.cage_file.path = kept.cage_file.path;
  if (!kept.pose.positions.empty())
    rest.pose.positions = document::open_surface(kept.cage_file.path).surface->positions;
  rest.pose.turns.resize(kept.pose.turns.size());
  return rest;
}

bool equals_files(const fs::path& file) {
  try {
    const Session kept = read_session(file);
    if (kept.origin.empty() && kept.cage_file.path.empty()) return false;
    return session_text(work_of(kept), file, false) == session_text(on_disk(kept), file, false);
  } catch (const std::exception&) {
    return false;
  }
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
  RecoveryFile found{file, file.filename().string()};
  found.restored = file.stem().string().ends_with(restored_ending);
  std::error_code missing;
  const fs::file_time_type time = fs::last_write_time(file, missing);
  if (!missing)
    found.time = std::chrono::system_clock::to_time_t(std::chrono::file_clock::to_sys(
        std::chrono::time_point_cast<std::chrono::system_clock::duration>(time)));
  try {
    const Session session = read_session(file);
    const fs::path& of = session.origin.empty() ? session.model.path : session.origin;
    found.name = of.filename().string();
    found.folder = of.parent_path();
    if (session.camera) found.up = session.camera->up;
    found.posed = session.pose.positions;
    const auto cage = session.cage_file.surface ? session.cage_file.surface
                                                : document::open_surface(session.cage_file.path).surface;
    if (cage->positions.size() == found.posed.size()) found.cage = cage;
  } catch (const std::exception&) {
    // Opening the file reports errors of the session. Without the cage's file there is no picture.
  }
  return found;
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
  std::erase_if(all,
                [&](const RecoveryFile& r) { return equals_files(r.file) && fs::remove(r.file, ignored); });
  std::sort(all.begin(), all.end(), [](const RecoveryFile& a, const RecoveryFile& b) {
    return a.time != b.time ? a.time > b.time : a.file < b.file;
  });
  return all;
}

std::string when(std::time_t time) {
  const std::tm parts = base::os::local_time(time);
  char text[64];
  return {text, std::strftime(text, sizeof text, "%b %d, %H:%M", &parts)};
}

}  // namespace viete::files
