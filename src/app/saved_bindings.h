// Bindings kept between runs, so that a large model is not bound again each time it is opened.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "base/progress.h"
#include "deform/binding.h"

namespace viete::app {

/// A folder of bindings that took long, by what they are of: a model that has changed is simply not in it.
/// Those used longest ago go when the folder grows too large. Deleting it loses nothing but time. And one
/// file that the user has named, which may be stale.
struct SavedBindings {
  std::filesystem::path folder{};        ///< empty: nothing is kept
  std::filesystem::path named{};         ///< tried first; empty: none
  double worth_keeping = 1;              ///< seconds that a binding must have taken
  std::uintmax_t limit = 2'000'000'000;  ///< bytes in the folder, what others are writing there included
};

/// That of the program, in cache_folder(); empty if there is no home folder.
std::filesystem::path bindings_folder();

/// What was found, and what was wrong with what is there.
struct FoundBinding {
  std::shared_ptr<const deform::TiledBinding> tiles;  ///< null: there is none that fits
  std::string problem;                                ///< of the file that the user has named; else empty
};

/// Throws base::Cancelled. Thread-safe.
FoundBinding find_binding(const SavedBindings& saved, const mesh::Surface& model, const deform::Cage& cage,
                          const deform::Weighting& weighting, base::Progress& progress);

/// Into the folder, unless it alone is larger than all may be. Throws base::Error. Thread-safe.
void keep_binding(const SavedBindings& saved, const deform::TiledBinding& tiles, const mesh::Surface& model,
                  const deform::Cage& cage);

}  // namespace viete::app
