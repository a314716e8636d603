// An OBJ file as it was, to be written again.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/original.h"

namespace viete::mesh {

/// Coordinates that moved are printed with as many decimals as the file has, and no fewer than six digits of
/// the model's diagonal need. Normals follow; a line that serves corners whose normals now differ gets others
/// behind its block, and indices of faces are changed accordingly.
class ObjOriginal final : public Original {
public:
  /// The bytes, which read_obj() has read without an error, live as long as the owner. attributes may be
  /// null. normal_blocks: see ObjNormals. folder: where it lies, empty if that is nowhere.
  ObjOriginal(std::string_view bytes, std::shared_ptr<const void> owner,
              std::shared_ptr<const Attributes> attributes, std::vector<std::uint32_t> normal_blocks,
              std::filesystem::path folder)
      : Original("OBJ"),
        bytes_(bytes),
        owner_(std::move(owner)),
        attributes_(std::move(attributes)),
        normal_blocks_(std::move(normal_blocks)),
        folder_(std::move(folder)) {}

  std::vector<std::string> beyond_attributes() const override;
  Companions companions() const override;
  std::vector<std::string> write(const Surface& rest, std::span<const Point> positions,
                                 TextWriter& out) const override;

private:
  std::string_view bytes_;
  std::shared_ptr<const void> owner_;
  std::shared_ptr<const Attributes> attributes_;
  std::vector<std::uint32_t> normal_blocks_;
  std::filesystem::path folder_;
};

}  // namespace viete::mesh
