#include "scene/document/shape_mix.h"

#include <algorithm>

#include "base/text.h"

namespace viete::scene {

namespace {

void keep_still(const std::vector<mesh::Point>& rest, std::span<const deform::LogTerm> terms,
                std::vector<mesh::Point>& positions) {
  double size = 0;
  for (const mesh::Point& p : rest) size = std::max(size, mesh::largest_abs(p));
  for (std::size_t v = 0; v < rest.size(); ++v) {
    const auto rests = [v](const deform::LogTerm& term) {
      return mesh::largest_abs(term.vector->ways[v]) == 0;
    };
    if (mesh::largest_abs(positions[v] - rest[v]) <= 1e-14 * size && std::ranges::all_of(terms, rests))
      positions[v] = rest[v];
  }
}

}  // namespace

void keep_flat(const std::vector<mesh::Point>& rest, std::span<const deform::LogTerm> terms,
               std::span<mesh::Point> positions) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto stays = [k](const mesh::Vec3& way) { return way[k] == 0; };
    const auto is_flat = [&](const deform::LogTerm& term) {
      return std::ranges::all_of(term.vector->ways, stays);
    };
    const bool flat = std::ranges::all_of(rest, [&](const mesh::Point& p) { return p[k] == rest[0][k]; });
    if (!flat || !std::ranges::all_of(terms, is_flat)) continue;
    for (mesh::Point& p : positions) p[k] = rest[0][k];
  }
}

SharedShape blended(const deform::LogSpace& space, std::span<const deform::LogTerm> terms,
                    const deform::Held* held, base::WorkerPool& pool) {
  std::vector<mesh::Point> positions(space.rest().size());
  if (held) {
    deform::LogSpace::Work work;
    space.shape(terms, *held, pool, work, positions);
  } else {
    space.straight(terms, positions);
  }
  keep_still(space.rest(), terms, positions);
  keep_flat(space.rest(), terms, positions);
  return std::make_shared<const std::vector<mesh::Point>>(std::move(positions));
}

SharedShape mixed(const deform::ShapeSpace& space, std::span<const ShapeTerm> terms, bool straight,
                  base::WorkerPool& pool, std::vector<std::string>* notes) {
  std::vector<ShapeTerm> moving;
  for (const ShapeTerm& term : terms)
    if (term.shape && term.factor != 0) moving.push_back(term);
  if (moving.empty()) return std::make_shared<const std::vector<mesh::Point>>(space.logs().rest());
  if (moving.size() == 1 && moving.front().factor == 1) return moving.front().shape;
  std::vector<deform::LogVector> vectors;
  std::vector<deform::LogTerm> sum;
  std::vector<deform::ShapeReport> reports(moving.size());
  vectors.reserve(moving.size());
  for (std::size_t i = 0; i < moving.size(); ++i) {
    vectors.push_back(space.vector(*moving[i].shape, pool, nullptr, &reports[i]));
    sum.push_back({&vectors.back(), moving[i].factor});
  }
  if (notes && !straight) *notes = shape_notes(reports);
  if (straight) return blended(space.logs(), sum, nullptr, pool);
  const deform::Held held = space.logs().held_from(space.logs().at_rest(), sum);
  return blended(space.logs(), sum, &held, pool);
}

std::vector<std::string> shape_notes(std::span<const deform::ShapeReport> reports) {
  std::size_t folded = 0, torn = 0, of_folded = 0, of_torn = 0;
  for (const deform::ShapeReport& report : reports) {
    folded = std::max(folded, report.folded), of_folded += report.folded > 0;
    torn = std::max(torn, report.torn), of_torn += report.torn > 0;
  }
  std::vector<std::string> notes;
  const auto text = [](std::size_t most, std::size_t shapes) {
    const std::string number = base::with_thousands(most);
    return shapes == 1 ? number : "up to " + number + " in each of " + base::counted(shapes, "shape");
  };
  if (folded > 0)
    notes.push_back("triangles that fold over or collapse, which follow their neighbours: " +
                    text(folded, of_folded));
  if (torn > 0)
    notes.push_back(
        "pairs of neighbouring triangles that rotate more than 180 degrees relative to each other, where the "
        "rotation direction is ambiguous: " +
        text(torn, of_torn));
  return notes;
}

}  // namespace viete::scene
