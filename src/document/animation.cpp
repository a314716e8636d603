#include "document/animation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "pose/maps.h"

namespace viete::document {

namespace {

void add_share(pose::ProbePose& sum, const pose::ProbePose& pose, double factor) {
  sum.turn = sum.turn + factor * pose.turn;
  sum.move = sum.move + factor * pose.move;
  sum.stretch = pose::plus(sum.stretch, factor, pose.stretch);
}

}  // namespace

void VectorCache::follow(const std::shared_ptr<const pose::Cage>& cage) {
  if (cage == cage_) {
    std::erase_if(known_, [](const auto& entry) { return entry.second.pose.use_count() == 1; });
    return;
  }
  known_.clear();
  cage_ = cage;
  space_ = cage ? std::make_shared<const shapes::PoseSpace>(cage) : nullptr;
}

std::shared_ptr<const shapes::LogVector> VectorCache::of(const SharedPose& pose,
                                                         std::span<const mesh::Vec3> turns_before) {
  if (!space_) return nullptr;
  const bool depends = pose->cage.turns.empty();
  const auto found = known_.find(pose.get());
  if (found != known_.end() && (!depends || std::ranges::equal(found->second.turns_before, turns_before)))
    return found->second.vector;
  const auto vector = std::make_shared<const shapes::LogVector>(space_->vector(pose->cage, turns_before));
  known_[pose.get()] = {pose, {turns_before.begin(), turns_before.end()}, vector};
  return vector;
}

void VectorCache::follow_model(const std::shared_ptr<const mesh::Surface>& model) {
  if (model == model_) {
    std::erase_if(known_shapes_, [](const auto& entry) { return entry.second.shape.use_count() == 1; });
    return;
  }
  known_shapes_.clear();
  model_ = model;
  shapes_ = nullptr;
}

const std::shared_ptr<const shapes::ShapeSpace>& VectorCache::shapes(base::WorkerPool& pool) {
  if (!shapes_) shapes_ = std::make_shared<const shapes::ShapeSpace>(*model_, pool);
  return shapes_;
}

std::shared_ptr<const shapes::LogVector> VectorCache::of(
    const SharedShape& shape, const std::shared_ptr<const shapes::LogVector>& before, base::WorkerPool& pool,
    shapes::ShapeReport& report) {
  KnownShape& known = known_shapes_[shape.get()];
  const auto found = std::ranges::find(known.after, before, &VectorAfter::before);
  if (found != known.after.end()) {
    report = found->report;
    return found->vector;
  }
  const auto& space = *shapes(pool);
  const auto& positions = shape ? *shape : space.rest();
  const auto vector = std::make_shared<const shapes::LogVector>(
      shape || before ? space.vector(positions, pool, before.get(), &report) : space.at_rest());
  known.shape = shape;
  known.after.push_back({before, vector, report});
  return vector;
}

void VectorCache::take(VectorCache&& others) {
  if (others.model_ != model_) return;
  if (!shapes_) shapes_ = others.shapes_;
  for (auto& [key, known] : others.known_shapes_) {
    KnownShape& own = known_shapes_[key];
    own.shape = known.shape;
    own.after.insert(own.after.end(), known.after.begin(), known.after.end());
  }
}

std::vector<pose::ProbePose> blended_probes(std::span<const ProbeTerm> terms) {
  std::size_t count = 0;
  for (const auto& [poses, factor] : terms) count = std::max(count, poses->size());
  std::vector<pose::ProbePose> sum(count);
  for (const auto& [poses, factor] : terms)
    for (std::size_t i = 0; i < poses->size(); ++i) add_share(sum[i], (*poses)[i], factor);
  return sum;
}

bool in_range(const WholePose& pose, double farthest) {
  const auto drawn = [farthest](const mesh::Vec3& p) {
    return std::ranges::all_of(p, [farthest](double x) { return std::abs(x) <= farthest; });
  };
  const auto turned = [](const mesh::Vec3& turn) { return mesh::norm(turn) <= largest_turn; };
  return std::ranges::all_of(pose.cage.positions, drawn) &&
         (!pose.shape || std::ranges::all_of(*pose.shape, drawn)) &&
         std::ranges::all_of(pose.cage.turns, turned) &&
         std::ranges::all_of(pose.probes, [&](const pose::ProbePose& p) {
           return turned(p.turn) && drawn(p.move) && is_probe_stretch(p.stretch);
         });
}

// A missing turn counts as 0. When the pose is drawn, the turn gets a value of up to half a turn. Therefore
// differences up to half a turn are ignored. Different whole turns differ by at least a full turn.
bool same_pose(const pose::Pose& a, const pose::Pose& b) {
  if (a.positions != b.positions) return false;
  const auto turn = [](const pose::Pose& pose, std::size_t part) {
    return part < pose.turns.size() ? pose.turns[part] : mesh::Vec3{0, 0, 0};
  };
  for (std::size_t part = 0; part < std::max(a.turns.size(), b.turns.size()); ++part)
    if (!(mesh::norm(turn(a, part) - turn(b, part)) < std::numbers::pi + 1e-3)) return false;
  return true;
}

bool same_pose(const WholePose& a, const WholePose& b) {
  for (std::size_t i = 0; i < std::max(a.probes.size(), b.probes.size()); ++i)
    if (!(a.probe(i) == b.probe(i))) return false;
  return same_pose(a.cage, b.cage) && same_shape(a.shape, b.shape);
}

Animation::Animation(const Timeline& timeline, VectorCache& vectors)
    : timeline_(timeline), space_(vectors.space()) {
  if (std::ranges::any_of(timeline_.keys, [](const PoseKey& key) { return key.pose->shape != nullptr; }))
    add_shapes(vectors);
  for (const PoseKey& key : timeline_.keys) take_farthest(*key.pose);
  base::WorkerPool pool;
  for (const Channel& channel : timeline_.channels) {
    shapes::ShapeReport report;
    (void)vectors.of(channel.pose);
    if (channel.pose->shape) (void)vectors.of(channel.pose->shape, nullptr, pool, report);
    take_farthest(*channel.pose);
  }
  if (!timeline_.channels.empty()) channels_ = vectors;
  if (!space_) return;
  std::span<const mesh::Vec3> turns;
  for (const PoseKey& key : timeline_.keys) {
    vectors_.push_back(vectors.of(key.pose, turns));
    turns = vectors_.back()->turns;
  }
  for (std::size_t i = 0; i + 1 < vectors_.size(); ++i)
    anchors_.push_back(space_->logs().anchors_between(*vectors_[i], *vectors_[i + 1]));
}

void Animation::take_farthest(const WholePose& pose) {
  const auto take = [this](std::span<const mesh::Point> positions) {
    for (const mesh::Point& p : positions) farthest_ = std::max(farthest_, mesh::largest_abs(p));
  };
  take(pose.cage.positions);
  if (pose.shape) take(*pose.shape);
}

void Animation::add_shapes(VectorCache& vectors) {
  base::WorkerPool pool;
  shapes_ = vectors.shapes(pool);
  std::shared_ptr<const shapes::LogVector> before;
  std::vector<shapes::ShapeReport> reports;
  for (const PoseKey& key : timeline_.keys) {
    shape_vectors_.push_back(before = vectors.of(key.pose->shape, before, pool, reports.emplace_back()));
  }
  if (!timeline_.linear) notes_ = shape_notes(reports);
  for (std::size_t i = 0; i + 1 < shape_vectors_.size(); ++i)
    shape_anchors_.push_back(shapes_->logs().anchors_between(*shape_vectors_[i], *shape_vectors_[i + 1]));
}

WholePose Animation::key(std::size_t key) const {
  WholePose pose = *timeline_.keys[key].pose;
  if (space_ && pose.cage.turns.empty()) pose.cage.turns = vectors_[key]->turns;
  return pose;
}

WholePose Animation::pose_of_keys(double frame, bool linear) const {
  if (timeline_.keys.empty()) return {space_ ? pose::rest_pose(space_->cage()) : pose::Pose(), {}, {}};
  const Moment moment = moment_at(timeline_, frame);
  if (moment.shares.size() == 1) return key(moment.shares.front().key);
  WholePose pose = blend(moment, linear);
  return in_range(pose, farthest_) ? pose : key(moment.from);
}

WholePose Animation::at(double frame, bool linear, SharedPose* base) const {
  if (timeline_.channels.empty()) return pose_of_keys(frame, linear);
  const auto of_keys = std::make_shared<const WholePose>(pose_of_keys(frame, linear));
  if (base) *base = of_keys;
  std::vector<NamedPose> poses;
  for (const Channel& channel : timeline_.channels)
    poses.push_back({channel.name, channel.pose, weight_at(timeline_, channel, frame)});
  VectorCache vectors = channels_;  // a copy, because mixed_upon() adds vectors
  WholePose pose = mixed_upon(vectors, of_keys, poses, linear);
  return in_range(pose, farthest_) ? pose : *of_keys;
}

WholePose Animation::blend(const Moment& moment, bool linear) const {
  const auto& keys = timeline_.keys;
  WholePose pose;
  std::vector<ProbeTerm> probes;
  for (const auto& [key, factor] : moment.shares) probes.push_back({&keys[key].pose->probes, factor});
  pose.probes = blended_probes(probes);
  if (shapes_) pose.shape = blended_shape(moment, linear);
  if (!space_) return pose;
  std::vector<shapes::LogTerm> terms;
  for (const auto& [key, factor] : moment.shares) terms.push_back({vectors_[key].get(), factor});
  pose.cage = linear ? space_->linear(terms) : space_->pose(terms, anchors_[moment.from]);
  return pose;
}

SharedShape Animation::blended_shape(const Moment& moment, bool linear) const {
  std::vector<shapes::LogTerm> terms;
  for (const auto& [key, factor] : moment.shares) terms.push_back({shape_vectors_[key].get(), factor});
  base::WorkerPool pool;
  return blended(*shapes_, terms, linear ? nullptr : &shape_anchors_[moment.from], pool);
}

namespace {

void keep_still(const shapes::ShapeSpace& space, std::span<const shapes::LogTerm> terms,
                std::vector<mesh::Point>& positions) {
  const auto& rest = space.rest();
  double size = 0;
  for (const mesh::Point& p : rest) size = std::max(size, mesh::largest_abs(p));
  for (std::size_t v = 0; v < rest.size(); ++v) {
    const auto rests = [&](const shapes::LogTerm& term) {
      return mesh::largest_abs(space.displacements(*term.vector)[v]) == 0;
    };
    if (mesh::largest_abs(positions[v] - rest[v]) <= 1e-14 * size && std::ranges::all_of(terms, rests))
      positions[v] = rest[v];
  }
}

}  // namespace

void keep_flat(const shapes::ShapeSpace& space, std::span<const shapes::LogTerm> terms,
               std::span<mesh::Point> positions) {
  const auto& rest = space.rest();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto stays = [k](const mesh::Vec3& offset) { return offset[k] == 0; };
    const auto is_flat = [&](const shapes::LogTerm& term) {
      return std::ranges::all_of(space.displacements(*term.vector), stays);
    };
    const bool flat = std::ranges::all_of(rest, [&](const mesh::Point& p) { return p[k] == rest[0][k]; });
    if (!flat || !std::ranges::all_of(terms, is_flat)) continue;
    for (mesh::Point& p : positions) p[k] = rest[0][k];
  }
}

SharedShape blended(const shapes::ShapeSpace& space, std::span<const shapes::LogTerm> terms,
                    const shapes::AnchorWeights* anchors, base::WorkerPool& pool) {
  std::vector<mesh::Point> positions(space.rest().size());
  if (anchors) {
    shapes::LogSpace::Work work;
    space.shape(terms, *anchors, pool, work, positions);
  } else {
    space.linear(terms, positions);
  }
  keep_still(space, terms, positions);
  keep_flat(space, terms, positions);
  return std::make_shared<const std::vector<mesh::Point>>(std::move(positions));
}

SharedShape mixed(const shapes::ShapeSpace& space, std::span<const ShapeTerm> terms, bool linear,
                  base::WorkerPool& pool, std::vector<std::string>* notes) {
  std::vector<ShapeTerm> moving;
  for (const ShapeTerm& term : terms)
    if (term.shape && term.factor != 0) moving.push_back(term);
  if (moving.empty()) return std::make_shared<const std::vector<mesh::Point>>(space.rest());
  if (moving.size() == 1 && moving.front().factor == 1) return moving.front().shape;
  std::vector<shapes::LogVector> vectors;
  std::vector<shapes::LogTerm> sum;
  std::vector<shapes::ShapeReport> reports(moving.size());
  vectors.reserve(moving.size());
  for (std::size_t i = 0; i < moving.size(); ++i) {
    vectors.push_back(space.vector(*moving[i].shape, pool, nullptr, &reports[i]));
    sum.push_back({&vectors.back(), moving[i].factor});
  }
  if (notes && !linear) *notes = shape_notes(reports);
  if (linear) return blended(space, sum, nullptr, pool);
  const shapes::AnchorWeights anchors = space.logs().anchors_from(space.logs().at_rest(), sum);
  return blended(space, sum, &anchors, pool);
}

namespace {

SharedShape shape_upon(VectorCache& vectors, const SharedShape& base, std::span<const ShapeTerm> shapes,
                       bool linear) {
  if (shapes.empty()) return base;
  if (!base && shapes.size() == 1 && shapes.front().factor == 1) return shapes.front().shape;
  base::WorkerPool pool;
  const auto vector_of = [&](const SharedShape& shape) {
    shapes::ShapeReport report;
    return vectors.of(shape, nullptr, pool, report).get();
  };
  std::vector<shapes::LogTerm> sum;
  for (const ShapeTerm& term : shapes) sum.push_back({vector_of(term.shape), term.factor});
  const shapes::ShapeSpace& space = *vectors.shapes(pool);
  const shapes::AnchorWeights anchors = space.logs().anchors_from(*vector_of(base), sum);
  sum.push_back({vector_of(base), 1});
  return blended(space, sum, linear ? nullptr : &anchors, pool);
}

}  // namespace

WholePose mixed_upon(VectorCache& vectors, const SharedPose& base, std::span<const NamedPose> poses,
                     bool linear) {
  std::vector<ProbeTerm> probes{{&base->probes, 1}};
  std::vector<ShapeTerm> shapes;
  std::vector<shapes::LogTerm> sum;
  WholePose pose = *base;
  for (const auto& [name, term, weight] : poses) {
    if (weight == 0) continue;
    probes.push_back({&term->probes, weight});
    if (term->shape) shapes.push_back({term->shape, weight});
    if (vectors.space()) sum.push_back({vectors.of(term).get(), weight});
    pose.cage = term->cage;  // the result if this is the only pose, see below
  }
  pose.probes = blended_probes(probes);
  pose.shape = shape_upon(vectors, base->shape, shapes, linear);
  if (sum.empty()) return pose;
  const shapes::PoseSpace& space = *vectors.space();
  if (sum.size() == 1 && sum[0].factor == 1 && same_pose(base->cage, pose::rest_pose(space.cage())))
    return pose;
  const auto vector = vectors.of(base);
  const shapes::AnchorWeights anchors = space.logs().anchors_from(*vector, sum);
  sum.push_back({vector.get(), 1});
  pose.cage = linear ? space.linear(sum) : space.pose(sum, anchors);
  return pose;
}

std::vector<std::string> shape_notes(std::span<const shapes::ShapeReport> reports) {
  std::size_t folded = 0, torn = 0, of_folded = 0, of_torn = 0;
  for (const shapes::ShapeReport& report : reports) {
    folded = std::max(folded, report.folded);
    of_folded += report.folded > 0;
    torn = std::max(torn, report.torn);
    of_torn += report.torn > 0;
  }
  std::vector<std::string> notes;
  const bool coarse = std::ranges::any_of(reports, &shapes::ShapeReport::coarse);
  const auto text = [coarse](std::size_t most, std::size_t shapes) {
    const std::string number = base::with_thousands(most) + (coarse ? " of a coarse model" : "");
    return shapes == 1 ? number : "up to " + number + " in each of " + base::counted(shapes, "shape");
  };
  if (folded > 0)
    notes.push_back("some triangles folded over or collapsed and follow their neighbours: " +
                    text(folded, of_folded));
  if (torn > 0)
    notes.push_back(
        "some pairs of neighbouring triangles rotated more than 180 degrees relative to each other; the "
        "rotation direction there is ambiguous: " +
        text(torn, of_torn));
  return notes;
}

}  // namespace viete::document
