#include "document/selection.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace viete::document {

bool Selection::contains(std::uint32_t index) const {
  return std::binary_search(indices_.begin(), indices_.end(), index);
}

std::optional<std::uint32_t> Selection::active() const {
  return has_picked_ && contains(picked_) ? std::optional(picked_) : std::nullopt;
}

void Selection::select_all(std::size_t count) {
  indices_.resize(count);
  std::iota(indices_.begin(), indices_.end(), 0u);
}

void Selection::invert(std::size_t count) {
  Selection all;
  all.select_all(count);
  all.apply(indices_, SelectMode::remove);
  indices_ = std::move(all.indices_);
}

void Selection::apply(std::span<const std::uint32_t> picked, SelectMode mode) {
  if (mode != SelectMode::remove) {
    has_picked_ = picked.size() == 1;
    if (has_picked_) picked_ = picked.front();
  }
  std::vector<std::uint32_t> result;
  const auto out = std::back_inserter(result);
  switch (mode) {
    case SelectMode::replace: result.assign(picked.begin(), picked.end()); break;
    case SelectMode::add:
      std::set_union(indices_.begin(), indices_.end(), picked.begin(), picked.end(), out);
      break;
    case SelectMode::remove:
      std::set_difference(indices_.begin(), indices_.end(), picked.begin(), picked.end(), out);
      break;
  }
  indices_ = std::move(result);
}

}  // namespace viete::document
