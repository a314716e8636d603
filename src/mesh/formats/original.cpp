#include "mesh/formats/original.h"

#include "base/atomic_file.h"
#include "base/error.h"

namespace viete::mesh {

std::vector<std::string> Original::write_file(const std::filesystem::path& path, const Surface& rest,
                                              std::span<const Point> positions, Digits digits,
                                              base::Progress* progress) const {
  std::vector<std::string> notes;
  base::replace_file(path, [&](const base::ByteSink& sink) {
    TextWriter out(sink, progress, digits);
    notes = write(rest, positions, out);
    out.finish();
  });
  return notes;
}

std::vector<std::string> Original::write_animated(const std::filesystem::path& path, const Surface&,
                                                  std::span<const Point>, const MorphMotion&,
                                                  base::Progress*) const {
  throw base::Error(path.string(), "this format has no morph targets", "write one that has them");
}

}  // namespace viete::mesh
