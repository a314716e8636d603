// A binding as a file: saved once, and read where binding anew would take longer.
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"
#include "deform/tiled_binding.h"

namespace viete::deform {

/// A saved binding that is whole, but of another model, cage or weighting than those at hand.
class StaleBinding : public base::Error {
public:
  using base::Error::Error;
};

/// A name for what bind_tiles() makes of these, by this program and any later one that reads its files: of
/// their positions and triangles, not of their names.
std::uint64_t binding_key(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
                          double tolerance);

/// Saves the weights and what stands for them; what follows from model and cage alone is left out. The file
/// holds numbers as this machine stores them:
///   header    words that say what it is, version, byte order; checksums of model, cage and the order of the
///             vertices; elements, weights, storage, radius, tolerance; checksums of what follows and of
///             itself
///   ranks     32 bits a leaf: compressed bindings, 0: dense; with lists, their lengths
///   listed    32 bits a handle, leaf by leaf (with lists only)
///   floats    offsets, weights, factors, skeleton, as in TiledBinding
///   doubles   sample (weights along the surface only)
/// binding must be of this model and cage. Atomic. Throws base::Error.
void write_binding(const std::filesystem::path& file, const TiledBinding& binding, const mesh::Surface& model,
                   const Cage& cage, base::Durability durability = base::Durability::power_cut);

/// True if a file that begins with these bytes (16 at least) calls itself a binding.
bool is_binding(std::string_view beginning);

/// The binding that was written, to the last bit. Throws StaleBinding when it is of something else, saying of
/// what; base::Error when it is no such file, damaged, cut short, of another version or byte order, or when
/// it does not fit the memory that is free; base::Cancelled.
TiledBinding read_binding(const std::filesystem::path& file, const mesh::Surface& model, const Cage& cage,
                          const Weighting& weighting, base::Progress* progress = nullptr);

}  // namespace viete::deform
