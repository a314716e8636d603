#include "app/model_layer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <future>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/worker_pool.h"
#include "deform/splats.h"
#include "mesh/normals.h"
#include "render/upload.h"
#include "render/view.h"

namespace viete::app {

namespace {

using mesh::none;

constexpr std::size_t triangles_per_splat = 40;  // that take the time of a splat to draw

class LooksMaker {
public:
  LooksMaker(const mesh::Surface& surface, const formats::Attributes& attributes,
             std::span<const mesh::Point> normals, const mesh::Draft* draft)
      : surface_(surface), given_(attributes), normals_(normals), draft_(draft) {}

  ModelLooks make() {
    sort_triangles();
    auto& [triangles, looks, draft_triangles, draft_looks, has_looks, warnings] = made_;
    make_runs(by_look_, triangles, looks);
    for (const formats::Color& c : given_.colors) looks.colors.push_back(bytes_of(c));
    looks.colors_of_corners = draft_looks.colors_of_corners = shows_colors_of_faces();
    has_looks |= !looks.colors.empty();
    if (!draft_) return std::move(made_);
    make_runs(draft_by_look_, draft_triangles, draft_looks);
    if (!given_.colors.empty())
      draft_looks.colors = mesh::picked(std::span<const render::Rgba8>(looks.colors), draft_->vertices);
    return std::move(made_);
  }

private:
  struct Triangle {
    mesh::Triangle vertices, corners;
    std::uint32_t polygon;
  };
  using Look = std::pair<std::uint32_t, bool>;  // material, flat shading
  using ByLook = std::map<Look, std::vector<Triangle>>;

  void sort_triangles() {
    std::vector<std::uint32_t> replaced(draft_ ? surface_.triangles.size() : 0, none);
    for (std::uint32_t d = 0; draft_ && d < draft_->sources.size(); ++d) replaced[draft_->sources[d]] = d;
    std::size_t t = 0, g = 0;
    mesh::for_each_triangle(surface_, [&](const mesh::Triangle& vertices, const mesh::Triangle& corners) {
      const std::uint32_t polygon = surface_.triangle_polygon[t];
      while (g + 1 < given_.groups.size() && given_.groups[g + 1].first_polygon <= polygon) ++g;
      const bool in_group = g < given_.groups.size();
      const std::uint32_t material = in_group ? given_.groups[g].material : none;
      const bool flat =
          (in_group && !given_.groups[g].smooth) || stands_across_an_edge({vertices, corners, polygon});
      by_look_[{material, flat}].push_back({vertices, corners, polygon});
      if (const auto d = draft_ ? replaced[t] : none; d != none)
        draft_by_look_[{material, flat}].push_back({draft_->surface.triangles[d], corners, polygon});
      ++t;
    });
  }

  // If the file has colours of vertices, colours of faces are ignored.
  bool shows_colors_of_faces() const { return given_.colors.empty() && !given_.polygon_colors.empty(); }

  // True if the file's normals at all corners equal the face normal, but a vertex normal differs.
  bool stands_across_an_edge(const Triangle& t) const {
    if (given_.corner_normal.empty()) return false;
    const auto& p = surface_.positions;
    const mesh::Vec3 face =
        mesh::cross(p[t.vertices[1]] - p[t.vertices[0]], p[t.vertices[2]] - p[t.vertices[0]]);
    bool is_edge = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t n = given_.corner_normal[t.corners[k]];
      if (n == none || mesh::cosine(given_.normals[n], face) < 0.995) return false;
      is_edge |= mesh::cosine(normals_[t.vertices[k]], face) < 0.99;
    }
    return is_edge;
  }

  void make_runs(const ByLook& by_look, std::vector<mesh::Triangle>& sorted, render::SurfaceLooks& looks) {
    for (const auto& [look, triangles] : by_look) {
      render::SurfaceRun run{.triangles = triangles.size(), .flat = look.second};
      if (look.first < given_.materials.size()) take_material(given_.materials[look.first], run);
      looks.runs.push_back(run);
      for (const Triangle& t : triangles) {
        sorted.push_back(t.vertices);
        if (shows_colors_of_faces())
          looks.colors.insert(looks.colors.end(), 3, bytes_of(given_.polygon_colors[t.polygon]));
        if (given_.corner_texture.empty()) continue;
        for (const std::uint32_t corner : t.corners) looks.texture_points.push_back(texture_point(corner));
      }
    }
  }

  std::array<float, 2> texture_point(std::uint32_t corner) const {
    const std::uint32_t i = given_.corner_texture[corner];
    if (i == none) return {0, 0};
    return {static_cast<float>(given_.texture_points[i][0]),
            static_cast<float>(1 - given_.texture_points[i][1])};
  }

  void take_material(const formats::Material& material, render::SurfaceRun& run) {
    const formats::Color& c = material.base_color;
    run.color = {render::linear_light(c[0]), render::linear_light(c[1]), render::linear_light(c[2])};
    run.repeats = material.repeats;
    if (material.base_color_image < given_.images.size()) run.image = image(material.base_color_image);
    made_.has_looks |= run.image >= 0 || c[0] != c[1] || c[1] != c[2];
  }

  // The index of an image in looks.images, or -1 if the image cannot be shown.
  int image(std::uint32_t index) {
    const auto [at, added] = images_.try_emplace(index, -1);
    if (!added) return at->second;
    constexpr int longest_side = 4096;
    const formats::ImageFile& file = given_.images[index];
    const std::string place = file.path.empty() ? file.name : file.path.string();
    try {
      if (!file.bytes && file.path.empty()) return -1;  // the reader already reported this
      render::Image decoded =
          file.bytes ? render::decode_image(place, *file.bytes, longest_side)
                     : render::decode_image(
                           place, base::FileBytes(file.path, nullptr, formats::most_image_bytes).view(),
                           longest_side);
      pixels_ += static_cast<std::size_t>(decoded.width) * static_cast<std::size_t>(decoded.height);
      if (pixels_ > most_pixels_)
        throw base::Error(place, "the model's textures have more than 128 million pixels in total",
                          "reduce their size");
      made_.looks.images.push_back(std::move(decoded));
      at->second = static_cast<int>(made_.looks.images.size()) - 1;
    } catch (const base::Error& error) {
      made_.warnings.push_back(std::string(error.what()) + "; shown without this texture");
    }
    return at->second;
  }

  static render::Rgba8 bytes_of(const formats::Color& color) {
    render::Rgba8 bytes;
    for (std::size_t k = 0; k < 4; ++k)
      bytes[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[k], 0.0F, 1.0F)));
    return bytes;
  }

  static constexpr std::size_t most_pixels_ = std::size_t{1} << 27;
  const mesh::Surface& surface_;
  const formats::Attributes& given_;
  std::span<const mesh::Point> normals_;
  const mesh::Draft* draft_;
  ByLook by_look_, draft_by_look_;
  std::map<std::uint32_t, int> images_;
  std::size_t pixels_ = 0;
  ModelLooks made_;
};

}  // namespace

ModelLooks looks_of(const mesh::Surface& surface, const formats::Attributes& attributes,
                    std::span<const mesh::Point> normals, const mesh::Draft* draft) {
  return LooksMaker(surface, attributes, normals, draft).make();
}

namespace {

// The vertices whose splats are at least half opaque, or all vertices of a point set.
std::vector<std::uint32_t> shadow_vertices(std::size_t count, const ModelSplats* capture) {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < count; ++v)
    if (!capture || capture->looks->opacities[v] >= 0.5F) vertices.push_back(v);
  return vertices;
}

// Points that are not finite stay so.
std::vector<render::SurfaceVertex> drawn_vertices(const mesh::Point& origin,
                                                  std::span<const mesh::Point> points) {
  std::vector<render::SurfaceVertex> vertices;
  vertices.reserve(points.size());
  for (const mesh::Point& point : points) {
    const mesh::Point p = point - origin;
    vertices.push_back({{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}, {}});
  }
  return vertices;
}

}  // namespace

ModelSplats splats_of(const std::shared_ptr<const mesh::Splats>& splats) {
  constexpr float constant_harmonic = 0.28209479F;
  auto looks = std::make_shared<render::SplatLooks>();
  ModelSplats made;
  const std::size_t count = splats->size();
  looks->opacities.resize(count);
  looks->colors.resize(count);
  base::for_blocks(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      looks->opacities[i] = 1 / (1 + std::exp(-splats->opacities[i]));
      for (std::size_t k = 0; k < 3; ++k)
        looks->colors[i][k] = 0.5F + constant_harmonic * splats->colors[i][k];
    }
  });
  made.shapes = deform::rest_shapes(*splats);
  looks->harmonics = {splats, &splats->harmonics};
  looks->degree = splats->degree;
  made.looks = std::move(looks);
  return made;
}

ModelShading shading_of(const document::OpenedSurface& model, std::size_t moving) {
  ModelShading shading;
  const auto& surface = model.surface;
  if (model.splats) {
    shading.surface = surface;
    shading.splats = std::make_shared<const ModelSplats>(splats_of(model.splats));
    const std::size_t most = std::max<std::size_t>(moving / triangles_per_splat, 1);
    shading.draft_step = std::max<std::size_t>((model.splats->size() + most - 1) / most, 1);
    return shading;
  }
  if (surface->triangles.empty()) shading.spacing = mesh::point_spacing(surface->positions);
  const auto& positions = surface->positions;
  std::vector<mesh::Point> normals(positions.size());
  shading.normals.resize(positions.size());
  auto around = mesh::vertex_triangles(positions.size(), surface->triangles);
  base::for_blocks(positions.size(), [&](std::size_t begin, std::size_t end) {
    mesh::vertex_normals(positions, surface->triangles, around, begin, end, normals);
    for (std::size_t v = begin; v < end; ++v) shading.normals[v] = base::pack_normal(normals[v]);
  });
  auto draft = std::async([&] {  // beside the shading of creases
    if (surface->triangles.size() <= moving) return mesh::Draft();
    return mesh::draft_of(*surface, normals, model.bounds, model.summary.area,
                          std::max<std::size_t>(moving / 12, 1));
  });
  shading.occlusion = mesh::bake_cavity(positions, normals, surface->triangles, std::move(around),
                                        model.summary.inside_out());
  if (mesh::Draft made = draft.get(); !made.surface.triangles.empty())
    shading.draft = std::make_shared<const mesh::Draft>(std::move(made));
  if (model.attributes) shading.looks = looks_of(*surface, *model.attributes, normals, shading.draft.get());
  shading.surface = surface;
  return shading;
}

void ModelLayer::set_document(const document::Document& document, const ModelShading& shading) {
  const mesh::Surface& model = *document.model().surface;
  const ModelLooks& looks = shading.looks;
  capture_ = shading.splats;
  draft_step_ = shading.draft_step;
  spacing_ = shading.spacing;
  splats_.reset();
  if (capture_) {
    splats_.emplace(gl_).set_looks(capture_->looks);
    surface_.set_triangles({}, 0);
  } else {
    surface_.set_triangles(looks.triangles.empty() ? model.triangles : looks.triangles,
                           model.positions.size());
  }
  surface_.set_looks(looks.looks);
  surface_.set_occlusion(shading.occlusion);
  draft_ = shading.draft;
  const mesh::Surface& seen = draft_ ? draft_->surface : model;
  if (seen.triangles.empty()) {
    shadow_.set_points(shadow_vertices(seen.positions.size(), capture_.get()), seen.positions);
  } else {
    shadow_.set_triangles(seen.triangles, seen.positions);
  }
  if (draft_) {
    const auto& sorted = looks.draft_triangles;
    coarse_.set_triangles(sorted.empty() ? seen.triangles : sorted, seen.positions.size());
    coarse_.set_looks(looks.draft_looks);
    coarse_.set_occlusion(mesh::picked(std::span(shading.occlusion), draft_->vertices));
  }
  coarse_.share_images_of(surface_);  // without a draft, frees the images of the last model
  vertices_ = model.positions.size();
  colored_.reset();
  set_rest(document, shading);
}

void ModelLayer::set_rest(const document::Document& document, const ModelShading& shading) {
  const std::vector<mesh::Point>& positions = document.model().surface->positions;
  if (capture_) {
    const mesh::Point origin = render::origin_of(positions);
    return set_splats(drawn_vertices(origin, positions), origin, capture_->shapes, {});
  }
  surface_.set_positions(positions, shading.normals);
  shadow_.set_positions(draft_ ? draft_->surface.positions : positions);
  if (!draft_) return;
  coarse_.set_positions(draft_->surface.positions,
                        mesh::picked(std::span(shading.normals), draft_->vertices));
}

void ModelLayer::set_model(std::span<const pose::FrameVertex> vertices, const mesh::Point& origin) {
  if (capture_) return set_splats(vertices, origin, capture_->shapes, {});
  surface_.set_vertices(vertices, origin);
  if (draft_) return set_draft(mesh::picked(vertices, draft_->vertices), origin);
  shadow_.set_vertices(vertices, origin);
}

bool ModelLayer::set_colors(const workspace::Workspace& w, analysis::Field field,
                            const workspace::FieldView& shown) {
  Colored wanted;
  wanted.by_mask = workspace::shows_mask(w);
  wanted.dark = w.view.options.dark;
  wanted.symmetric = analysis::entry(field).symmetric;
  if (wanted.by_mask) wanted.mask = w.document.mask();
  if (field != analysis::Field::none && shown.stats.field == field) wanted.field = shown.values;
  if (colored_ == wanted || vertices_ == 0) return false;
  colored_ = wanted;
  const render::Theme theme = render::theme(w.view.options.dark);
  const auto palette = wanted.by_mask     ? render::blend_palette({theme.held, theme.model}, 64)
                       : wanted.symmetric ? render::diverging_palette()
                                          : render::surface_palette();
  std::vector<float> scalars;
  if (wanted.by_mask) scalars = wanted.mask ? *wanted.mask : std::vector<float>(vertices_, 1.0f);
  if (!wanted.by_mask && wanted.field) scalars = *wanted.field;
  if (capture_) {
    splats_->set_palette(palette);
    splats_->set_scalars(scalars);
    return true;
  }
  surface_.set_palette(palette);
  surface_.set_scalars(scalars);
  if (draft_) {
    coarse_.set_palette(palette);
    coarse_.set_scalars(mesh::picked(std::span(std::as_const(scalars)), draft_->vertices));
  }
  return true;
}

void ModelLayer::draw(const render::View& view, const render::Theme& theme, const render::SurfaceStyle& style,
                      bool coarse) {
  if (splats_) return splats_->draw(view, style, coarse ? draft_step_ : 1);
  render::SurfaceStyle of_points = style;
  of_points.spacing = static_cast<float>(spacing_);
  (coarse && draft_ ? coarse_ : surface_).draw(view, theme, of_points);
}

void ModelLayer::span(render::SurfaceStyle& style, const workspace::FieldView& shown) const {
  const bool by_mask = colored_ && colored_->by_mask;
  style.scalars = by_mask || (colored_ && colored_->field);
  style.scalar_low = by_mask ? 0 : static_cast<float>(shown.stats.low);
  style.scalar_high = by_mask ? 1 : static_cast<float>(shown.stats.high);
}

}  // namespace viete::app
