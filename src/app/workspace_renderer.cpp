#include "app/workspace_renderer.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "document/elements.h"
#include "workspace/pointer.h"

namespace viete::app {

namespace {

glm::dmat4 file_to_view(const document::Space& space) {
  glm::dmat4 m(1);
  for (int i = 0; i < 3; ++i) {
    m[i][i] = space.scale;
    m[3][i] = -space.center[i] * space.scale;
  }
  return m;
}

glm::vec4 opaque(const glm::vec3& color) {
  return {color, 1};
}

render::Paint paint_of(document::Shading shading, bool file_has_looks) {
  using render::Paint;
  constexpr Paint paints[] = {
      Paint::plain,   Paint::porcelain, Paint::jade, Paint::file,
      Paint::checker, Paint::normals,   Paint::zebra};  // in document::Shading's order
  const Paint paint = paints[static_cast<std::size_t>(shading)];
  return paint == Paint::file && !file_has_looks ? Paint::plain : paint;
}

// For each cage vertex, returns its fraction of the selection's motion. Empty without soft selection.
std::vector<float> soft_shares(const workspace::Workspace& w) {
  if (!w.view.tools || !w.view.handling.soft.on || document::moving_vertices(w.document).empty()) return {};
  std::vector<float> shares(w.document.pose().positions.size(), 0.0f);
  const auto& drag = w.view.interaction.drag;
  for (const auto& g : drag ? drag->grip().vertices : workspace::grip_of(w).vertices)
    shares[g.vertex] = static_cast<float>(g.share);
  return shares;
}

// Blends the cage's colour (share 0) and the selection's colour (share 1).
glm::vec4 ramp(const render::Theme& theme, float share) {
  return opaque(glm::mix(theme.cage, theme.selection, share));
}

void soften(const std::vector<float>& shares, const render::Theme& theme, std::vector<render::Disc>& discs) {
  for (std::size_t v = 0; v < shares.size(); ++v) {
    const float share = shares[v];
    if (share > 0 && share < 1) discs[v] = {ramp(theme, share), 3 + 1.5f * share, false};
  }
}

std::vector<glm::vec4> ramp_of_ends(const std::vector<float>& shares, const render::Theme& theme,
                                    const std::vector<render::Segment>& segments) {
  std::vector<glm::vec4> colors;
  colors.reserve(2 * segments.size());
  for (const auto& segment : segments)
    for (const auto v : segment) colors.push_back(ramp(theme, shares[v]));
  return colors;
}

render::View seen(const ViewDrawing& d, const ViewDrawing::Part& part) {
  return {part.view, part.projection, d.size, d.scale};
}

using document::ElementKind;

void set_triangles(render::FaceLayer& layer, const std::vector<render::Triangle>& triangles,
                   const std::vector<mesh::Point>& positions) {
  layer.set_triangles(triangles, positions.size());
  if (!triangles.empty()) layer.set_positions(positions);
}

// Adds the edges of an element. A vertex has no edges.
void add_outline(const std::vector<std::uint32_t>& corners, std::vector<render::Segment>& segments) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < (n > 2 ? n : n - 1); ++i)
    segments.push_back({corners[i], corners[(i + 1) % n]});
}

std::vector<std::uint8_t> marks_of(const pose::Cage& cage, const document::Selection& selection) {
  std::vector<std::uint8_t> marked(document::element_count(cage, selection.kind()), 0);
  for (const auto i : selection.indices()) marked[i] = 1;
  return marked;
}

}  // namespace

WorkspaceRenderer::WorkspaceRenderer(const render::Gl& gl)
    : gl_(gl),
      backdrop_(gl),
      grid_(gl),
      cage_faces_(gl),
      cage_lines_(gl),
      ghost_lines_(gl),
      cage_vertices_(gl),
      marks_(gl),
      findings_(gl) {
  models_.push_back(std::make_unique<ModelLayer>(gl));
}

void WorkspaceRenderer::set_colors(const workspace::Workspace& w) {
  bool changed = false;
  for (std::size_t view = 0; view < std::min(models_.size(), w.view.split.count()); ++view)
    changed |= models_[view]->set_colors(w, workspace::shown_field(w, view), w.view.split.views[view].shown);
  if (changed) ++content_;
}

void WorkspaceRenderer::set_views(std::size_t count, const document::Document& document,
                                  const ModelShading& shading) {
  if (models_.size() == count) return;
  ++content_;
  models_.resize(std::min(models_.size(), count));
  while (models_.size() < count) {
    models_.push_back(std::make_unique<ModelLayer>(gl_));
    models_.back()->set_document(document, shading);
  }
}

void WorkspaceRenderer::set_document(const document::Document& document, const ModelShading& shading) {
  for (const auto& model : models_) model->set_document(document, shading);
  file_has_looks_ = shading.looks.has_looks;
  ++content_;
  set_cage_faces(document);
}

void WorkspaceRenderer::set_another_cage(const document::Document& document, const ModelShading& shading) {
  set_rest(document, shading);
  set_cage_faces(document);
}

void WorkspaceRenderer::set_cage_faces(const document::Document& document) {
  hand_.reset();
  if (!document.has_cage()) return;
  const mesh::Surface& cage = document.cage()->surface;
  cage_faces_.set_triangles(cage.triangles, cage.positions.size());
  set_shown_edges(document);
  ghost_lines_.set_segments(document.cage()->edges, cage.positions.size());
  ghost_lines_.set_positions(cage.positions);
}

void WorkspaceRenderer::set_shown_edges(const document::Document& document) {
  hidden_ = document.groups().hidden;
  const auto hidden = document::hidden_elements(document, document::ElementKind::edge);
  shown_edges_.clear();
  for (std::size_t e = 0; e < hidden.size(); ++e)
    if (!hidden[e]) shown_edges_.push_back(document.cage()->edges[e]);
  cage_lines_.set_segments(shown_edges_, document.pose().positions.size());
  cage_lines_.set_positions(document.pose().positions);
  hand_.reset();
}

void WorkspaceRenderer::set_rest(const document::Document& document, const ModelShading& shading) {
  for (const auto& model : models_) model->set_rest(document, shading);
  ++content_;
}

void WorkspaceRenderer::set_cage(const workspace::Workspace& w) {
  const auto& positions = w.document.pose().positions;
  cage_faces_.set_positions(positions);
  cage_lines_.set_positions(positions);
  cage_vertices_.set_positions(positions);
  ++content_;
}

void WorkspaceRenderer::set_hand(const workspace::Workspace& w) {
  const render::Theme theme = render::theme(w.view.options.dark);
  const auto& document = w.document;
  // While vertices cannot be selected, they are drawn smaller.
  const bool vertices = !w.view.tools || document.selection().kind() == document::ElementKind::vertex;
  const auto selected = w.view.tools ? document::selected_vertices(*document.cage(), document.selection())
                                     : std::vector<std::uint32_t>{};
  Hand hand{w.view.options.dark, {}, {}};
  auto& discs = hand.discs;
  discs.assign(document.pose().positions.size(), {opaque(theme.cage), vertices ? 3.0f : 1.75f, false});
  for (const auto v : selected) discs[v] = {opaque(theme.selection), vertices ? 4.5f : 2.5f, false};
  const std::vector<float> shares = soft_shares(w);
  soften(shares, theme, discs);
  for (const auto v : document.groups().hidden) discs[v].radius = 0;
  if (hidden_ != document.groups().hidden) set_shown_edges(document);
  const auto hovered = w.view.tools ? w.view.interaction.hovered : std::nullopt;
  if (vertices && hovered && *hovered < discs.size()) discs[*hovered].ring = true;
  if (!shares.empty()) hand.ends = ramp_of_ends(shares, theme, shown_edges_);
  if (marks_.set(w, theme)) ++content_;
  if (hand_ == hand) return;
  ++content_;
  hand_ = std::move(hand);
  cage_vertices_.set_discs(hand_->discs);
  if (shares.empty()) {
    cage_lines_.set_color(opaque(theme.cage));
  } else {
    cage_lines_.set_end_colors(hand_->ends);
  }
  ghost_lines_.set_color(opaque(theme.cage));
}

ViewDrawing::Part WorkspaceRenderer::part(const workspace::Workspace& w, std::size_t view) const {
  ViewDrawing::Part part;
  const document::Viewport v = workspace::viewport_of(w.view.split, w.view.camera.viewport, view);
  part.low = v.low() / v.window;
  part.high = v.high() / v.window;
  document::Camera camera = w.view.camera;
  if (const auto pose = workspace::camera_of(w, view); pose != camera.pose()) camera.set_pose(pose);
  part.view = glm::dmat4(camera.view()) * file_to_view(w.document.space());
  camera.viewport = v;
  part.projection = glm::dmat4(camera.projection());
  part.surface.wireframe = w.view.options.wireframe ? 0.3f : 0.0f;
  // Software rendering omits the back faces of a closed surface. This halves the time.
  const auto& summary = w.document.model().summary;
  part.surface.closed =
      gl_.software && summary.closed() && summary.manifold() && summary.oriented() && summary.volume > 0;
  part.surface.paint = paint_of(w.view.options.shading, file_has_looks_);
  part.cage = !workspace::view_settings(w, view).other_blending;
  models_[view]->span(part.surface, w.view.split.views[view].shown);
  return part;
}

ViewDrawing WorkspaceRenderer::drawing(const workspace::Workspace& w, glm::ivec2 size, float scale) const {
  ViewDrawing d;
  d.size = size;
  d.scale = scale;
  d.dark = w.view.options.dark;
  const auto& document = w.document;
  if (!document.model().surface) return d;
  d.content = content_;
  for (std::size_t view = 0; view < std::min(models_.size(), w.view.split.count()); ++view)
    d.parts.push_back(part(w, view));
  d.model = w.view.options.model;
  d.grid = w.view.options.grid;
  d.cage = document.has_cage() && w.view.options.cage;
  d.ghost = w.view.options.ghost;
  const double diagonal = document.space().diagonal();
  const auto& c = document.space().center;
  const document::UpAxis axis = w.view.camera.pose().up;
  const int up = axis == document::UpAxis::z ? 2 : 1;
  const bool down = axis == document::UpAxis::minus_y;
  const mesh::Bounds& box = document.model().bounds;
  mesh::Point ground{c[0], c[1], c[2]};
  ground[static_cast<std::size_t>(up)] = (down ? box.high : box.low)[static_cast<std::size_t>(up)];
  d.shadow = {ground, up, diagonal, down};
  d.ground = {ground, document::grid_cell(diagonal), 1.6 * diagonal, up, down};
  return d;
}

void WorkspaceRenderer::draw(const ViewDrawing& d, bool coarse) {
  const render::Theme theme = render::theme(d.dark);
  if (d.transparent) {
    gl_.ClearColor(0, 0, 0, 0);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
  } else {
    backdrop_.draw(theme);
  }
  for (std::size_t view = 0; view < d.parts.size(); ++view) {
    const ViewDrawing::Part& part = d.parts[view];
    if (d.parts.size() > 1) clip_to(d, part);
    draw_part(d, view, theme, coarse);
    gl_.Disable(GL_SCISSOR_TEST);
  }
}

// OpenGL counts pixels from the bottom of the window.
void WorkspaceRenderer::clip_to(const ViewDrawing& d, const ViewDrawing::Part& part) const {
  const glm::ivec2 low(glm::round(part.low * glm::vec2(d.size))),
      high(glm::round(part.high * glm::vec2(d.size)));
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(low.x, d.size.y - high.y, high.x - low.x, high.y - low.y);
}

void WorkspaceRenderer::draw_part(const ViewDrawing& d, std::size_t view, const render::Theme& theme,
                                  bool coarse) {
  const ViewDrawing::Part& part = d.parts[view];
  const render::View seen_from = seen(d, part);
  ModelLayer& model = *models_[view];
  // Translucent splats are drawn over the ground, or under it if it is seen from below.
  const bool ground_first = model.is_capture() && render::from_above(seen_from, d.shadow) > 0;
  if (ground_first) draw_ground(d, model, seen_from, theme);
  if (d.model) model.draw(seen_from, theme, part.surface, coarse);
  if (!ground_first) draw_ground(d, model, seen_from, theme);
  if (d.cage && part.cage) draw_cage(d, seen_from, theme);
  if (view == 0) findings_.draw(seen_from, theme);
}

void WorkspaceRenderer::draw_ground(const ViewDrawing& d, ModelLayer& model, const render::View& view,
                                    const render::Theme& theme) {
  if (!d.grid) return;
  if (d.model) model.draw_shadow(view, theme, d.shadow);
  grid_.draw(view, theme, d.ground);
}

void WorkspaceRenderer::draw_cage(const ViewDrawing& d, const render::View& view,
                                  const render::Theme& theme) const {
  if (d.ghost) ghost_lines_.draw(view, {1, 0.15f, 0.5f});
  cage_faces_.draw(view, {theme.cage, 0.03f, 0.06f, true});
  cage_lines_.draw(view, {1.25f, 0.9f, 0.25f, theme.halo});
  marks_.draw(view, theme);
  cage_vertices_.draw(view, {theme.outline, theme.hover, 0.35f});
}

bool ViewCache::draw(WorkspaceRenderer& renderer, const ViewDrawing& drawing, Fineness fineness, bool half) {
  if (shows(drawing) && fineness_ >= fineness) return false;
  const bool coarse = fineness == Fineness::coarse;
  ViewDrawing now = drawing;
  if (coarse && half) {
    now.size = (now.size + 1) / 2;
    now.scale /= 2;
  }
  const int samples[] = {half ? 0 : samples_.plain, samples_.plain, samples_.smooth};
  picture_.begin(now.size, samples[static_cast<int>(fineness)]);
  renderer.draw(now, coarse);
  picture_.resolve();
  ++count_;
  drawn_ = drawing;
  fineness_ = fineness;
  return true;
}

bool CageMarks::set(const workspace::Workspace& w, const render::Theme& theme) {
  Marks marks;
  marks.positions = w.document.pose().positions;
  if (w.view.tools) {
    add_faces(w, marks);
    add_edges(w, theme, marks);
  }
  if (marks == marks_) return false;
  marks_ = std::move(marks);
  upload();
  return true;
}

void CageMarks::upload() {
  const auto& [selected, hovered, edges, colors, positions] = *marks_;
  set_triangles(selected_faces_, selected, positions);
  set_triangles(hovered_face_, hovered, positions);
  edges_.set_segments(edges, positions.size());
  edges_.set_colors(colors);
  if (!edges.empty()) edges_.set_positions(positions);
}

void CageMarks::add_faces(const workspace::Workspace& w, Marks& marks) {
  const auto& document = w.document;
  const auto& surface = document.cage()->surface;
  if (document.selection().kind() != ElementKind::face) return;
  const auto marked = marks_of(*document.cage(), document.selection());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto face = surface.triangle_polygon[t];
    if (marked[face]) marks.selected.push_back(surface.triangles[t]);
    if (w.view.interaction.hovered == face) marks.hovered.push_back(surface.triangles[t]);
  }
}

// Adds the edges of selected elements. Then adds hovered edges, so that they are drawn on top.
void CageMarks::add_edges(const workspace::Workspace& w, const render::Theme& theme, Marks& marks) {
  const auto& document = w.document;
  const auto kind = document.selection().kind();
  auto& segments = marks.edges;
  const auto add = [&](std::uint32_t element) {
    add_outline(document::element_vertices(*document.cage(), kind, element), segments);
  };
  if (kind != ElementKind::probe)
    for (const auto i : document.selection().indices()) add(i);
  const std::size_t selected = segments.size();
  const auto hovered = w.view.interaction.hovered;
  if (hovered && *hovered < document::element_count(*document.cage(), kind)) add(*hovered);
  marks.colors.assign(segments.size(), glm::vec4(theme.hover, 0.85f));
  std::fill_n(marks.colors.begin(), selected, glm::vec4(theme.selection, 1));
}

void CageMarks::draw(const render::View& view, const render::Theme& theme) const {
  selected_faces_.draw(view, {theme.selection, 0.22f, 0.05f, false});
  hovered_face_.draw(view, {theme.hover, 0.10f, 0.05f, false});
  edges_.draw(view, {2.25f, 1, 0.4f, theme.halo});
}

void FindingMarks::collect(const workspace::Workspace& w) {
  constexpr std::size_t most = 20000;  // the largest number of drawn elements; more would hide the surface
  std::vector<render::Triangle> triangles;
  std::vector<render::Segment> segments;
  // Numbers only the vertices of shown elements, so that only these vertices are updated.
  used_.clear();
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  const auto number = [&](std::uint32_t vertex) {
    const auto [at, added] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(used_.size()));
    if (added) used_.push_back(vertex);
    return at->second;
  };
  bool vertices = false;
  if (w.checks.shown) {
    const document::Finding& finding = w.checks.findings[*w.checks.shown];
    const bool of_cage = finding.subject == document::Subject::cage;
    const mesh::Surface& surface = of_cage ? *w.document.cage_file().surface : *w.document.model().surface;
    vertices = finding.kind == document::ElementKind::vertex;
    for (const auto e : workspace::shown_elements(w.checks, most)) {
      auto corners = document::vertices_of(finding, surface, e);
      for (auto& v : corners) v = number(v);
      const std::size_t n = corners.size();
      for (std::size_t i = 2; i < n; ++i) triangles.push_back({corners[0], corners[i - 1], corners[i]});
      add_outline(corners, segments);
    }
  }
  faces_.set_triangles(triangles, used_.size());
  edges_.set_segments(segments, used_.size());
  const glm::vec4 color(render::theme(w.view.options.dark).finding, 1);
  edges_.set_color(color);
  vertices_.set_discs(std::vector<render::Disc>(used_.size(), {color, vertices ? 4.0F : 2.5F, false}));
}

bool FindingMarks::set(const workspace::Workspace& w, const document::PosedModel& posed, bool moved) {
  const bool same = revision_ == w.checks.revision() && dark_ == w.view.options.dark;
  if (same && (!moved || used_.empty())) return false;
  if (!same) collect(w);
  revision_ = w.checks.revision();
  dark_ = w.view.options.dark;
  if (used_.empty()) {
    vertices_.set_positions({});
    return true;
  }
  const bool of_cage = w.checks.findings[*w.checks.shown].subject == document::Subject::cage;
  std::vector<mesh::Point> positions;
  positions.reserve(used_.size());
  for (const auto v : used_)
    positions.push_back(of_cage ? w.document.pose().positions[v] : posed.at(*w.document.model().surface, v));
  faces_.set_positions(positions);
  edges_.set_positions(positions);
  vertices_.set_positions(positions);
  return true;
}

void FindingMarks::draw(const render::View& view, const render::Theme& theme) const {
  if (used_.empty()) return;
  faces_.draw(view, {theme.finding, 0.30F, 0.05F, false});
  edges_.draw(view, {2.5F, 1, 0.7F});
  vertices_.draw(view, {theme.outline, theme.hover, 0.7F});
}

}  // namespace viete::app
