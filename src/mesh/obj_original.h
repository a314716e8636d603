// An OBJ file as it was, to be written again.
#pragma once

#include <memory>
#include <string_view>

#include "mesh/attributes.h"
#include "mesh/original.h"

namespace viete::mesh {

class ObjOriginal final : public Original {
public:
  /// The bytes, which read_obj() has read without an error, live as long as the owner. attributes may be
  /// null.
  ObjOriginal(std::string_view bytes, std::shared_ptr<const void> owner,
              std::shared_ptr<const Attributes> attributes)
      : bytes_(bytes), owner_(std::move(owner)), attributes_(std::move(attributes)) {}

  bool writes(std::string_view extension) const override { return extension == "obj"; }
  std::vector<std::string> write(const Surface& rest, std::span<const Point> positions,
                                 TextWriter& out) const override;

private:
  std::string_view bytes_;
  std::shared_ptr<const void> owner_;
  std::shared_ptr<const Attributes> attributes_;
};

}  // namespace viete::mesh
