// A PLY file as it was, to be written again.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/formats/original.h"
#include "mesh/formats/ply_header.h"

namespace viete::mesh {

/// Header, elements and properties stay in type and order. Of the first vertex element x y z, nx ny nz and
/// tx ty tz follow, of faces nx ny nz, rounded to the type that the file gives them; in text with as many
/// decimals as the file has, and no fewer than six digits of the model's diagonal need.
class PlyOriginal final : public Original {
public:
  /// The bytes, which read_ply() has read without an error, live as long as the owner. body: where the first
  /// element begins. companions: the images that its comments name.
  PlyOriginal(std::string name, std::string_view bytes, std::shared_ptr<const void> owner, PlyHeader header,
              std::size_t body, Companions companions)
      : Original("PLY"),
        name_(std::move(name)),
        bytes_(bytes),
        owner_(std::move(owner)),
        header_(std::move(header)),
        body_(body),
        companions_(std::move(companions)) {}

  std::vector<std::string> beyond_attributes() const override;
  Companions companions() const override { return companions_; }
  /// Throws base::Error too where a position does not fit into the type that the file has for it.
  std::vector<std::string> write(const Surface& rest, std::span<const Point> positions,
                                 TextWriter& out) const override;

private:
  std::string name_;
  std::string_view bytes_;
  std::shared_ptr<const void> owner_;
  PlyHeader header_;
  std::size_t body_;
  Companions companions_;
};

}  // namespace viete::mesh
