#include "mesh/formats/obj_normals.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "mesh/formats/spread_normals.h"
#include "mesh/normals.h"

namespace viete::mesh {

namespace {

std::string words_of(const Vec3& normal, const Printed& printed) {
  std::array<char, 400> room;
  std::string words;
  for (const double x : normal) words.append(printed.print(x, room)).append(1, ' ');
  return words;
}

}  // namespace

ObjNormals::ObjNormals(const Surface& rest, const Attributes& attributes,
                       std::span<const std::uint32_t> blocks, std::span<const Point> positions,
                       const Printed& printed) {
  const SpreadNormals spread(rest, attributes);
  std::vector<Vec3> moved = deformed_normals(rest, positions, spread.normals, spread.of_corner);
  keep_lengths(spread.normals, moved);
  std::vector<std::uint32_t> value_of(moved.size());
  for (std::size_t n = 0; n < attributes.normals.size(); ++n) {
    const auto begin = spread.first[n], end = spread.first[n + 1];
    first_.push_back(static_cast<std::uint32_t>(values_.size()));
    // The line keeps its words if some corners do.
    const auto kept = std::find(moved.begin() + begin, moved.begin() + end, attributes.normals[n]);
    values_.push_back(kept == moved.begin() + end ? moved[begin] : *kept);
    value_of[begin] = first_[n];
    if (end - begin == 1) continue;
    std::map<std::string, std::uint32_t> printed_before = {{words_of(values_.back(), printed), first_[n]}};
    for (auto i = begin; i < end; ++i) {
      const auto next = static_cast<std::uint32_t>(values_.size());
      const auto [at, is_new] = printed_before.emplace(words_of(moved[i], printed), next);
      if (is_new) values_.push_back(moved[i]);
      value_of[i] = at->second;
    }
  }
  first_.push_back(static_cast<std::uint32_t>(values_.size()));
  std::vector<std::uint32_t> value_of_corner = spread.of_corner;
  for (std::uint32_t& v : value_of_corner) v = v == none ? none : value_of[v];
  number(blocks, attributes, value_of_corner);
}

void ObjNormals::number(std::span<const std::uint32_t> blocks, const Attributes& attributes,
                        std::span<const std::uint32_t> value_of_corner) {
  std::vector<std::uint32_t> index_of_value(values_.size());
  std::uint32_t next = 0, begin = 0;
  for (const std::uint32_t end : blocks) {
    for (auto n = begin; n < end; ++n) {
      index_of_value[first_[n]] = next;
      index_.push_back(next++);
    }
    for (auto n = begin; n < end; ++n) {
      for (auto v = first_[n] + 1; v < first_[n + 1]; ++v) index_of_value[v] = next++;
    }
    begin = end;
  }
  if (!adds_lines()) return;
  corner_index_.resize(attributes.corner_normal.size(), none);
  for (std::size_t c = 0; c < corner_index_.size(); ++c) {
    if (value_of_corner[c] != none) corner_index_[c] = index_of_value[value_of_corner[c]];
  }
}

}  // namespace viete::mesh
