#include "scene/remembered.h"

#include <algorithm>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/json_file.h"

namespace viete::scene {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

fs::path from_root(const fs::path& path) {
  std::error_code ignored;
  return path.empty() ? path : fs::absolute(path, ignored).lexically_normal();
}

RecentFile recent_of(const JsonReader& json) {
  RecentFile recent{json.at("file").path(), {}};
  if (const auto cage = json.find("cage")) recent.cage = cage->path();
  return recent;
}

ordered_json to_json(const RecentFile& recent) {
  ordered_json json = {{"file", path_json(recent.file)}};
  if (!recent.cage.empty()) json["cage"] = path_json(recent.cage);
  return json;
}

// What was there before comes behind, where it does not stand already.
void append_missing(Remembered& to, const std::vector<RecentFile>& more) {
  for (const auto& file : more) {
    if (to.recent.size() >= Remembered::most) return;
    if (std::find(to.recent.begin(), to.recent.end(), file) == to.recent.end()) to.recent.push_back(file);
  }
}

// A file that cannot be understood holds nothing worth keeping.
std::vector<RecentFile> recent_in(const fs::path& file) {
  try {
    return read_remembered(file).recent;
  } catch (const base::Error&) {
    return {};
  }
}

}  // namespace

void Remembered::add(const RecentFile& file) {
  const RecentFile entry{from_root(file.file), from_root(file.cage)};
  std::erase(recent, entry);
  recent.insert(recent.begin(), entry);
  if (recent.size() > most) recent.resize(most);
}

Remembered read_remembered(const fs::path& file) {
  Remembered remembered;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return remembered;
  const nlohmann::json whole = read_json(file);
  const JsonReader json(whole, file.string());
  std::vector<RecentFile> recent;
  if (const auto list = json.find("recent")) {
    for (std::size_t i = 0; i < list->size(); ++i) recent.push_back(recent_of(list->item(i)));
  }
  append_missing(remembered, recent);
  if (const auto folder = json.find("folder")) remembered.folder = folder->path();
  if (const auto hints = json.find("hints")) remembered.hints = hints->boolean();
  return remembered;
}

void write_remembered(const fs::path& file, const Remembered& remembered) {
  Remembered all = remembered;
  append_missing(all, recent_in(file));
  ordered_json json = {{"format", "viete remembered"}, {"version", 1}};
  json["recent"] = ordered_json::array();
  for (const auto& entry : all.recent) json["recent"].push_back(to_json(entry));
  json["folder"] = path_json(all.folder);
  json["hints"] = all.hints;
  base::replace_file(file, readable(json, file), base::Durability::process);
}

}  // namespace viete::scene
