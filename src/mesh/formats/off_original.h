// An OFF file as it was, to be written again.
#pragma once

#include <memory>
#include <string_view>
#include <utility>

#include "mesh/formats/off_form.h"
#include "mesh/formats/original.h"

namespace viete::mesh {

/// Everything stays but coordinates that moved and the normals of NOFF that follow; they are printed with as
/// many decimals as the file has, and no fewer than six digits of the model's diagonal need.
class OffOriginal final : public Original {
public:
  /// The bytes, which read_off() has read without an error, live as long as the owner. body: where the first
  /// vertex is looked for.
  OffOriginal(std::string_view bytes, std::shared_ptr<const void> owner, std::size_t body,
              const OffForm& form)
      : Original("OFF"), bytes_(bytes), owner_(std::move(owner)), body_(body), form_(form) {}

  std::vector<std::string> write(const Surface& rest, std::span<const Point> positions,
                                 TextWriter& out) const override;

private:
  std::string_view bytes_;
  std::shared_ptr<const void> owner_;
  std::size_t body_;
  OffForm form_;
};

}  // namespace viete::mesh
