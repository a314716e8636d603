#include "interact/mirror_edit.h"

#include <numeric>

#include "document/elements.h"
#include "interact/grip.h"

namespace viete::interact {

namespace {

void put_visible(document::Document& document, std::span<const std::uint8_t> hidden, std::uint32_t v,
                 const mesh::Point& place) {
  if (v >= hidden.size() || !hidden[v]) document.changed_pose().positions[v] = place;
}

std::vector<mesh::Point> begin_edit(document::Document& document, const char* label) {
  record_edit(document, label);
  return document.changed_pose().positions;
}

}  // namespace

void copy_to_other_side(document::Document& document, const document::Mirror& mirror) {
  const auto leading = leading_vertices(document, &mirror);
  const auto before = begin_edit(document, "copy to the other side");
  const auto hidden = hidden_elements(document, document::ElementKind::vertex);
  for (const auto v : leading) {
    if (mirror.partners[v] == document::Mirror::none) continue;
    const mesh::Point image = document::reflected(mirror.plane, before[v]);
    put_visible(document, hidden, mirror.partners[v],
                mirror.is_on_plane(v) ? 0.5 * (before[v] + image) : image);
  }
}

void swap_sides(document::Document& document, const document::Mirror& mirror) {
  std::vector<std::uint32_t> vertices = moving_vertices(document);
  if (vertices.empty()) {
    vertices.resize(mirror.partners.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
  }
  const auto before = begin_edit(document, "swap sides");
  const auto hidden = hidden_elements(document, document::ElementKind::vertex);
  for (const auto v : with_partners(std::move(vertices), &mirror)) {
    if (mirror.partners[v] == document::Mirror::none) continue;
    put_visible(document, hidden, v, document::reflected(mirror.plane, before[mirror.partners[v]]));
  }
}

void paste_pose(document::Document& document, std::span<const std::uint32_t> vertices,
                std::span<const mesh::Point> positions, const document::Mirror* mirror) {
  begin_edit(document, "paste pose");
  const auto hidden = hidden_elements(document, document::ElementKind::vertex);
  for (std::size_t i = 0; i < vertices.size() && mirror; ++i) {
    if (mirror->is_paired(vertices[i]))
      put_visible(document, hidden, mirror->partners[vertices[i]],
                  document::reflected(mirror->plane, positions[i]));
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) put_visible(document, hidden, vertices[i], positions[i]);
}

}  // namespace viete::interact
