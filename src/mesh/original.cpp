#include "mesh/original.h"

#include "base/atomic_file.h"

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

}  // namespace viete::mesh
