#include "app/model_layer.h"

#include <cstddef>

#include "render/palette.h"

namespace viete::app {

void ModelLayer::set_document(const scene::Document& document, const ModelShading& shading) {
  const mesh::Surface& model = *document.model.surface;
  const ModelLooks& looks = shading.looks;
  surface_.set_triangles(looks.triangles.empty() ? model.triangles : looks.triangles, model.positions.size());
  surface_.set_looks(looks.looks);
  surface_.set_occlusion(shading.occlusion);
  shadow_.set_triangles(model.triangles, model.positions);
  vertices_ = model.positions.size();
  colored_.reset();
  set_rest(document, shading);
}

void ModelLayer::set_rest(const scene::Document& document, const ModelShading& shading) {
  surface_.set_positions(document.model.surface->positions, shading.normals);
  shadow_.set_positions(document.model.surface->positions);
}

// The rooms do not know each other; their vertices are the same bytes.
void ModelLayer::set_model(std::span<const deform::FrameVertex> vertices, const mesh::Point& origin) {
  using From = deform::FrameVertex;
  using To = render::SurfaceVertex;
  static_assert(sizeof(From) == sizeof(To) && offsetof(From, position) == offsetof(To, position) &&
                offsetof(From, normal) == offsetof(To, normal));
  const std::span same(reinterpret_cast<const To*>(vertices.data()), vertices.size());
  surface_.set_vertices(same, origin);
  shadow_.set_vertices(same, origin);
}

bool ModelLayer::set_colors(const scene::Workspace& w, lab::Field field, const scene::FieldView& shown) {
  Colored wanted;
  wanted.by_mask = scene::shows_mask(w), wanted.dark = w.view.dark;
  wanted.symmetric = lab::entry(field).symmetric;
  if (wanted.by_mask) wanted.mask = w.document.mask;
  if (field != lab::Field::none && shown.stats.field == field)
    wanted.field = shown.values, wanted.strokes = shown.strokes;
  if (colored_ == wanted || vertices_ == 0) return false;
  colored_ = wanted;
  if (wanted.strokes) set_strokes(*wanted.strokes);
  if (!wanted.by_mask) {
    surface_.set_palette(wanted.symmetric ? render::diverging_palette() : render::surface_palette());
    surface_.set_scalars(wanted.field ? *wanted.field : std::vector<float>());
    return true;
  }
  const render::Theme theme = w.view.dark ? render::dark_theme() : render::light_theme();
  surface_.set_palette(render::blend_palette({theme.held, theme.model}, 64));
  surface_.set_scalars(wanted.mask ? *wanted.mask : std::vector<float>(vertices_, 1.0f));
  return true;
}

void ModelLayer::set_strokes(std::span<const mesh::Point> ends) {
  std::vector<render::Segment> segments;
  for (std::uint32_t i = 0; i + 1 < ends.size(); i += 2) segments.push_back({i, i + 1});
  strokes_.set_segments(segments, ends.size());
  strokes_.set_positions(ends);
  strokes_.set_color({0.07f, 0.08f, 0.1f, 1});
}

void ModelLayer::span(render::SurfaceStyle& style, const scene::FieldView& shown) const {
  const bool by_mask = colored_ && colored_->by_mask;
  style.scalars = by_mask || (colored_ && colored_->field);
  style.scalar_low = by_mask ? 0 : static_cast<float>(shown.stats.low);
  style.scalar_high = by_mask ? 1 : static_cast<float>(shown.stats.high);
}

}  // namespace viete::app
