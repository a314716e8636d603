#include "app/panel_results.h"

#include <numbers>

#include "base/os.h"
#include "deform/vertex_sample.h"
#include "pose/maps.h"
#include "sym3/eigenvalues.h"
#include "sym3/exp.h"

namespace viete::app {

bool SurfaceChecks::follow(workspace::Workspace& w) {
  if (const Surfaces now = surfaces_of(w); checked_ != now) {
    checked_ = now;
    job_.start([model = w.document.model(), cage = w.document.cage_file()](base::Progress& progress) {
      auto findings = document::check(model, cage, &progress);
      base::os::release_freed_memory();
      return findings;
    });
  }
  return take(w, false);
}

bool SurfaceChecks::take(workspace::Workspace& w, bool wait) {
  auto result = job_.poll(wait);
  w.checks.running = job_.running();
  w.checks.done = job_.state().done;
  if (!result) return false;
  if (result->value) {
    w.messages.succeeded("checks");
    workspace::take_findings(w.checks, *std::move(result->value));
    follow_outside(w);
  } else {
    w.messages.error("Checks failed: " + result->problem, {"checks", workspace::Scope::cage});
  }
  return true;
}

// Offers to enclose the model if a change of the cage has pushed vertices of the same model out.
void SurfaceChecks::follow_outside(workspace::Workspace& w) {
  const auto found = workspace::outside_finding(w.checks);
  const std::size_t outside = found ? w.checks.findings[*found].size() : 0;
  const bool edited =
      std::exchange(outside_of_, checked_.model) == checked_.model && w.document.history().can_undo();
  w.checks.pushed_out = edited && (outside > w.checks.outside || (w.checks.pushed_out && outside > 0));
  if (outside > w.checks.outside) w.panels.offer_cage = true;
  w.checks.outside = outside;
}

void SurfaceChecks::finish(workspace::Workspace& w) {
  follow(w);
  if (job_.running()) take(w, true);
}

namespace {

using sym3::Method;

// GLM matrices are column-major.
glm::dmat3 map_of(const sym3::Sym3<double>& stretch, const mesh::Vec3& turn) {
  const auto r = sym3::exp_rotation<double>({turn[0], turn[1], turn[2]});
  const auto s = sym3::exp(stretch);
  const glm::dmat3 rotation(r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]);
  return rotation * glm::dmat3(s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz);
}

std::string words_of(Method method, const sym3::Route& route) {
  if (method == Method::diag) return "eigenvectors by QR";
  if (method == Method::fast) {
    if (route.by_jacobi) return "Jacobi's method";
    const std::string degree = "degree " + std::to_string(route.degree);
    if (route.squarings == 0) return degree + ", without squaring";
    return degree + ", squared " + std::to_string(route.squarings) +
           (route.squarings == 1 ? " time" : " times");
  }
  constexpr const char* cases[] = {"", "case 1: all equal", "case 2: two equal", "case 3: all different"};
  return std::string(method == Method::sd ? "QR, " : "Viete, ") + cases[route.distinct];
}

std::vector<workspace::VertexView::Evaluation> evaluations_of(const sym3::Sym3<double>& sum) {
  std::vector<workspace::VertexView::Evaluation> evaluations;
  for (const Method method : analysis::compared_methods)
    evaluations.push_back({method, words_of(method, sym3::route(sum, method)),
                           sym3::relative_error(sym3::exp(sum, method), sum)});
  return evaluations;
}

workspace::VertexView view_of(std::uint32_t vertex, const deform::VertexSum& sum) {
  workspace::VertexView view;
  view.vertex = vertex;
  view.has_logs = sum.has_logs;
  sym3::Sym3<double> partial{};
  for (const auto& term : sum.terms) {
    partial = pose::plus(partial, term.weight, term.stretch);
    view.terms.push_back({term.handle, term.weight, term.at, sym3::eigenvalues(partial)});
  }
  if (!sum.has_logs) return view;
  view.map = map_of(sum.stretch, sum.turn);
  view.degrees = mesh::norm(sum.turn) * 180 / std::numbers::pi;
  view.evaluations = evaluations_of(sum.stretch);
  return view;
}

}  // namespace

bool VertexInspector::follow(workspace::Workspace& w, const LiveModel& model) {
  if (!is_due(w, model)) return false;
  shown_ = key_of(w, model);
  const auto vertex = shown_.vertex;
  w.view.vertex = {};
  const deform::FrameDeformer* deformer = model.deformer();
  const mesh::Surface& surface = *w.document.model().surface;
  if (!vertex || *vertex >= surface.positions.size()) return true;
  w.view.vertex.vertex = vertex;
  if (!model.ran() || !w.document.has_cage()) return true;
  const Bound& bound = model.bound();
  const weights::Weigher weigher(*bound.cage, bound.binding->weighting);
  const deform::VertexSum sum =
      deform::vertex_sum(weigher, *bound.binding, deformer->mask(), deformer->state().rows(), *vertex);
  w.view.vertex = view_of(*vertex, sum);
  return true;
}

}  // namespace viete::app
