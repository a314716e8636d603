#include "app/saved_bindings.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "app/state_folder.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "deform/binding_file.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* extension = ".binding";

fs::path kept_file(const SavedBindings& saved, const mesh::Surface& model, const deform::Cage& cage,
                   const deform::Weighting& weighting) {
  char name[17];
  const auto key = deform::binding_key(model, cage, weighting, deform::usual_tolerance);
  std::snprintf(name, sizeof name, "%016llx", static_cast<unsigned long long>(key));
  return saved.folder / (std::string(name) + extension);
}

struct Kept {
  fs::path file;
  fs::file_time_type used;
  std::uintmax_t bytes;
};

// And what others are writing now. Another program may be at work in the folder too: what cannot be looked at
// is not there.
std::vector<Kept> all_ours(const fs::path& folder) {
  std::vector<Kept> all;
  std::error_code code;
  for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
    std::error_code gone;
    if (const auto ending = at->path().extension(); ending != extension && ending != ".part") continue;
    const Kept kept{at->path(), at->last_write_time(gone), gone ? 0 : at->file_size(gone)};
    if (!gone) all.push_back(kept);
  }
  return all;
}

// Down to so many bytes in all, the bindings used longest ago first.
void drop_oldest(const fs::path& folder, std::uintmax_t limit) {
  auto all = all_ours(folder);
  const auto bindings = std::partition(all.begin(), all.end(),
                                       [](const Kept& kept) { return kept.file.extension() != extension; });
  std::sort(bindings, all.end(), [](const Kept& a, const Kept& b) { return a.used > b.used; });
  std::uintmax_t sum = 0;
  for (auto kept = all.begin(); kept != all.end(); ++kept) {
    sum += kept->bytes;
    std::error_code ignored;
    if (sum > limit && kept >= bindings) fs::remove(kept->file, ignored);
  }
}

}  // namespace

fs::path bindings_folder() {
  const fs::path cache = cache_folder();
  return cache.empty() ? cache : cache / "bindings";
}

FoundBinding find_binding(const SavedBindings& saved, const mesh::Surface& model, const deform::Cage& cage,
                          const deform::Weighting& weighting, base::Progress& progress) {
  const auto read = [&](const fs::path& file) {
    return std::make_shared<const deform::TiledBinding>(
        deform::read_binding(file, model, cage, weighting, &progress));
  };
  FoundBinding found;
  if (!saved.named.empty()) {
    try {
      return {read(saved.named), ""};
    } catch (const base::Error& error) {
      found.problem = error.what();
    }
  }
  if (saved.folder.empty()) return found;
  const fs::path file = kept_file(saved, model, cage, weighting);
  std::error_code code;
  if (!fs::exists(file, code)) return found;
  try {
    found.tiles = read(file);
    fs::last_write_time(file, fs::file_time_type::clock::now(), code);
  } catch (
      const base::Error&) {  // cut short by a power cut, say: one that took long is made anew and replaces it
  }
  return found;
}

void keep_binding(const SavedBindings& saved, const deform::TiledBinding& tiles, const mesh::Surface& model,
                  const deform::Cage& cage) {
  const std::uintmax_t bytes = tiles.bytes();
  if (saved.folder.empty() || bytes > saved.limit) return;
  std::error_code ignored;  // what is wrong with the folder, writing says
  fs::create_directories(saved.folder, ignored);
  base::remove_stale_parts(saved.folder);
  drop_oldest(saved.folder, saved.limit - bytes);
  deform::write_binding(kept_file(saved, model, cage, tiles.weighting), tiles, model, cage,
                        base::Durability::process);
}

}  // namespace viete::app
