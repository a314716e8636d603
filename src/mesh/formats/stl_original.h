// An STL file as it was, to be written again.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/formats/original.h"

namespace viete::mesh {

/// Binary: header, attributes and what stands behind the triangles stay. Text: solids and their names stay,
/// numbers are printed as in the file. Normals of facets that moved follow; those that are 0 0 0 stay so.
class StlOriginal final : public Original {
public:
  /// The bytes, which read_stl() has read without an error, live as long as the owner.
  StlOriginal(std::string name, std::string_view bytes, std::shared_ptr<const void> owner, bool binary)
      : Original("STL"), name_(std::move(name)), bytes_(bytes), owner_(std::move(owner)), binary_(binary) {}

  /// Throws base::Error too where a position does not fit into the float of a binary file.
  std::vector<std::string> write(const Surface& rest, std::span<const Point> positions,
                                 TextWriter& out) const override;

private:
  std::string name_;
  std::string_view bytes_;
  std::shared_ptr<const void> owner_;
  bool binary_;
};

}  // namespace viete::mesh
