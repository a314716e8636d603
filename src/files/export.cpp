#include "files/export.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/atomic_file.h"
#include "base/text.h"
#include "base/worker_pool.h"
#include "document/checks.h"
#include "formats/format_table.h"
#include "formats/source.h"
#include "formats/write.h"
#include "mesh/surface.h"

namespace viete::files {

Export export_of(const document::Document& document, const std::filesystem::path& file) {
  Export all{file,
             document.model().surface,
             document.model().attributes,
             document.model().original,
             document.cage(),
             real_pose(document),
             document.deformer(),
             document.method(),
             document.mask(),
             document.probes(),
             document.shape(),
             guessed_up(document.model()),
             {},
             document.model().splats};
  if (document.has_cage()) return all;
  all.cage = std::make_shared<const pose::Cage>(pose::no_cage(document.model().bounds));
  all.pose = pose::rest_pose(*all.cage);
  all.deformer = pose::no_motion();
  return all;
}

namespace {

bool writes_original(const Export& what) {
  return formats::writes_itself(what.original.get(), what.file);
}

}  // namespace

void keep_at_rest(const pose::Cage& cage, const pose::Pose& pose, const pose::Probes& probes,
                  const std::vector<mesh::Point>& shape, std::vector<mesh::Point>& positions) {
  const auto is_unmoved = [](const pose::Probe& p) { return p.pin || p.pose == pose::ProbePose{}; };
  const pose::Pose rest = pose::rest_pose(cage);
  const bool turns = std::ranges::any_of(pose.turns, [](const mesh::Vec3& t) {
    return t != mesh::Vec3{0, 0, 0};
  });
  if (pose.positions == rest.positions && (pose.turns == rest.turns || !turns) &&
      std::ranges::all_of(probes.all, is_unmoved)) {
    positions = shape;
    return;
  }
  double size = 0;
  for (const mesh::Bounds& box : {mesh::bounds(shape), mesh::bounds(cage.surface.positions)})
    size = std::max({size, mesh::largest_abs(box.low), mesh::largest_abs(box.high)});
  const double rounding = 1e-14 * size;
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (std::size_t i = 0; i < 3; ++i) {
      const double rest_place = shape[v][i];
      if (std::abs(positions[v][i] - rest_place) <= rounding) positions[v][i] = rest_place;
    }
}

std::vector<std::string> write_deformed(const Export& what, base::Progress* progress) {
  if (!writes_original(what)) formats::surface_format(what.file);
  formats::check_deformable(what.file, what.original.get());
  base::check_replaceable(what.file);
  base::WorkerPool pool;
  if (progress) progress->section(0, 0.5);
  deform::ExactModel deformed =
      deform::deform_exactly(*what.model, what.cage, what.deformer, what.pose, what.method, pool, progress,
                             what.mask, what.probes, what.shape, what.splats);
  if (progress) progress->section(0.5, 1);
  return write_exact(what, std::move(deformed), progress);
}

std::vector<std::string> write_exact(const Export& what, deform::ExactModel deformed,
                                     base::Progress* progress) {
  const std::vector<mesh::Point>& shape = what.shape ? *what.shape : what.model->positions;
  keep_at_rest(*what.cage, what.pose, what.probes, shape, deformed.positions);
  deform::SplitSplats parts;
  if (what.split && what.splats)
    parts = deform::split_stretched(*what.splats, *deformed.splats, deformed.positions);
  const bool split = parts.split > 0;
  const formats::Content content{*what.model,
                                 split ? parts.positions : deformed.positions,
                                 {},
                                 what.attributes.get(),
                                 split ? &parts.splats : deformed.splats.get(),
                                 split ? parts.sources : std::span<const std::uint32_t>()};
  std::vector<std::string> notes =
      formats::write(what.file, content, what.original.get(), what.digits, progress);
  if (split)
    notes.push_back("split " + base::counted(parts.split, "stretched splat") + ": the file has " +
                    std::to_string(parts.positions.size()) + " splats");
  const auto add = [&](std::vector<std::string> more) { std::ranges::move(more, std::back_inserter(notes)); };
  add(std::move(deformed.warnings));
  add(document::pose_notes(deformed.report, *what.cage, what.pose));
  add(method_notes(what.method, deformed.exp_error));
  if (!writes_original(what) && formats::surface_format(what.file).in_metres) add(gltf_notes(what.up));
  return notes;
}

std::vector<std::string> gltf_notes(document::UpAxis up) {
  if (up != document::UpAxis::z) return {};
  return {
      "the up axis of this glTF file is Z, but other programs expect Y: in these programs, rotate the model "
      "by -90 degrees about X"};
}

std::string at_most(double error) {
  const double half_a_digit = error > 0 ? 0.05 * std::pow(10.0, std::floor(std::log10(error))) : 0;
  return base::formatted("%.1e", error + half_a_digit);
}

std::vector<std::string> method_notes(sym3::Method method, double worst_error) {
  constexpr double negligible = 1e-9;  // 1000 * the error for well-separated eigenvalues
  if (worst_error <= negligible) return {};
  const std::string name(sym3::name(method));
  if (!std::isfinite(worst_error))
    return {"method " + name + " gives NaN in this pose; use method fast or diag"};
  return {"method " + name + " has relative errors up to " + at_most(worst_error) +
          " in this pose, because eigenvalues nearly coincide; use method fast or diag (error below 1e-14)"};
}

}  // namespace viete::files
