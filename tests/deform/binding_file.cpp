#include "deform/binding_file.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstring>

#include "deform/bind.h"
#include "deform/bound.h"
#include "support/folder.h"

using namespace viete::test;
using viete::base::Error;
using viete::base::WorkerPool;
namespace fs = std::filesystem;

namespace {

struct Saved {
  viete::mesh::Surface model;
  std::shared_ptr<const Cage> cage;
  std::shared_ptr<const TiledBinding> binding;
  fs::path file;
};

Saved save(const TemporaryFolder& folder, Weighting weighting, double tolerance) {
  WorkerPool pool(2);
  Saved s{tube(120, 60, 0.3, 1.5), std::make_shared<const Cage>(make_cage(tube(7, 12, 0.6, 2))), nullptr,
          folder / "a.binding"};
  s.binding = std::make_shared<const TiledBinding>(bind_tiles(s.model, *s.cage, weighting, pool, tolerance));
  write_binding(s.file, *s.binding, s.model, *s.cage);
  return s;
}

TiledBinding read(const Saved& s) {
  return read_binding(s.file, s.model, *s.cage, s.binding->weighting);
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

// What reading it says; empty if it can be read.
std::string refusal(const Saved& s) {
  try {
    read(s);
    return "";
  } catch (const Error& error) {
    CHECK(error.place() == s.file.string());
    CHECK_FALSE(error.advice().empty());
    return error.problem();
  }
}

}  // namespace

TEST_CASE("a_saved_binding_comes_back_to_the_last_bit_and_gives_the_same_frames") {
  const TemporaryFolder folder;
  for (const Weighting& weighting : {faces, cut_off(0.2), mean_values, harmonics, cut_off(0.1)}) {
    for (const double tolerance : {0.0, usual_tolerance}) {
      const Saved s = save(folder, weighting, tolerance);
      const TiledBinding back = read(s);
      const TiledBinding& b = *s.binding;
      if (tolerance == 0) CHECK(b.has_lists() == weighting.partial());
      if (!weighting.partial()) CHECK(b.compressed() == (!(weighting == mean_values) && tolerance > 0));
      CHECK(back.weighting == weighting);
      CHECK(back.storage() == b.storage());
      CHECK(back.list_starts == b.list_starts);
      CHECK(back.listed == b.listed);
      CHECK(back.handles == b.handles);
      CHECK(back.failed == b.failed);
      CHECK(back.unit == b.unit);
      CHECK(back.tolerance == b.tolerance);
      CHECK(back.leaves.order == b.leaves.order);
      CHECK(same_bits(back.offsets, b.offsets));
      CHECK(b.sample.empty() != (weighting == harmonics));
      CHECK(same_bits(back.sample, b.sample));
      CHECK(same_bits(back.weights, b.weights));
      CHECK(same_bits(back.factors, b.factors));
      CHECK(same_bits(back.skeleton, b.skeleton));
      REQUIRE(back.factored.size() == b.factored.size());
      for (std::size_t leaf = 0; leaf < b.factored.size(); ++leaf) {
        const auto &x = back.factored[leaf], &y = b.factored[leaf];
        CHECK((x.first == y.first && x.rank == y.rank && x.pivots == y.pivots && x.dense == y.dense));
      }
      WorkerPool pool(2);
      FusedFrame before(s.cage, s.binding, pool),
          after(s.cage, std::make_shared<const TiledBinding>(back), pool);
      const Pose pose{mapped(s.cage->surface.positions, shear()), {}};
      before.deform(pose);
      after.deform(pose);
      CHECK(same_bits(before.vertices(), after.vertices()));
    }
  }
}

TEST_CASE("leaves_that_stay_dense_among_factored_ones_come_back_too") {
  const TemporaryFolder folder;
  const Saved s = save(folder, faces, usual_tolerance);
  TiledBinding b = *s.binding;
  REQUIRE(b.factored.size() > 2);
  for (const std::size_t leaf : {std::size_t(1), b.factored.size() - 1}) {
    b.factored[leaf].dense = true;
    b.factored[leaf].rank = static_cast<std::uint32_t>(b.handles);
  }
  const auto sizes = b.lay_out_factors();
  b.factors.resize(sizes.factors);
  b.skeleton.resize(sizes.skeleton);
  Random random(5);
  for (auto* floats : {&b.factors, &b.skeleton}) {
    for (float& x : *floats) x = static_cast<float>(random(-1, 1));
  }
  write_binding(s.file, b, s.model, *s.cage);
  const TiledBinding back = read(s);
  CHECK(same_bits(back.factors, b.factors));
  CHECK(same_bits(back.skeleton, b.skeleton));
  for (std::size_t leaf = 0; leaf < b.factored.size(); ++leaf) {
    const auto &x = back.factored[leaf], &y = b.factored[leaf];
    CHECK((x.first == y.first && x.rank == y.rank && x.pivots == y.pivots && x.dense == y.dense));
  }
}

TEST_CASE("a_binding_of_something_else_is_stale_and_says_of_what") {
  const TemporaryFolder folder;
  const Saved s = save(folder, faces, usual_tolerance);
  const auto stale = [&](const Saved& other, Weighting weighting) -> std::string {
    try {
      read_binding(s.file, other.model, *other.cage, weighting);
    } catch (const StaleBinding& error) {
      CHECK(error.place() == s.file.string());
      CHECK(error.advice().find("viete bind") != std::string::npos);
      return error.problem();
    }
    return "";
  };
  CHECK(stale(s, faces) == "");
  CHECK(stale(s, mean_values).find("not for elements vertices with weights mean-value") != std::string::npos);
  Saved moved = s;
  moved.model.positions[77][1] = std::nextafter(moved.model.positions[77][1], 9);
  CHECK(stale(moved, faces) == "is stale: the model is not the one that it was made for");
  Saved turned = s;
  std::swap(turned.model.triangles[5][0], turned.model.triangles[5][1]);
  CHECK(stale(turned, faces).find("the model is not") != std::string::npos);
  auto cage = s.cage->surface;
  cage.positions[3][0] += 1e-9;
  const Saved other_cage{s.model, std::make_shared<const Cage>(make_cage(cage)), nullptr, s.file};
  CHECK(stale(other_cage, faces) == "is stale: the cage is not the one that it was made for");
  const Saved nothing_alike{tube(4, 12, 0.3, 1), std::make_shared<const Cage>(make_cage(box())), nullptr,
                            s.file};
  CHECK(stale(nothing_alike, faces).find("model and cage are not") != std::string::npos);
}

TEST_CASE("keys_tell_models_cages_weights_radii_and_tolerances_apart") {
  const auto model = tube(4, 12, 0.3, 1), longer = tube(4, 12, 0.3, 1.1);
  const Cage cage = make_cage(box()), wider = make_cage(box({1, 1, 1.1}));
  const auto key = binding_key(model, cage, faces, 1e-5);
  CHECK(key == binding_key(model, cage, faces, 1e-5));
  CHECK(key != binding_key(longer, cage, faces, 1e-5));
  CHECK(key != binding_key(model, wider, faces, 1e-5));
  CHECK(key != binding_key(model, cage, mean_values, 1e-5));
  CHECK(key == binding_key(model, cage, {.radius = 0.3}, 1e-5));
  const auto near = binding_key(model, cage, cut_off(0.3), 1e-5);
  CHECK(near != binding_key(model, cage, cut_off(0.4), 1e-5));
  CHECK(key != binding_key(model, cage, faces, 1e-4));
}

TEST_CASE("every_damaged_byte_is_found") {
  const TemporaryFolder folder;
  for (const double tolerance : {0.0, usual_tolerance}) {
    const Saved s = save(folder, faces, tolerance);
    const std::string whole = file_bytes(s.file);
    CHECK(refusal(s) == "");
    const auto damage = [&](std::size_t at) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
      put_file(s.file, bytes);
      CHECK_MESSAGE(refusal(s) != "", at);
    };
    for (std::size_t at = 0; at < 200; ++at) damage(at);  // header, ranks
    for (std::size_t at = 200; at < whole.size(); at += whole.size() / 50) damage(at);
    damage(whole.size() - 1);
  }
}

TEST_CASE("files_that_are_cut_short_or_too_long_or_foreign_are_refused_with_the_reason") {
  const TemporaryFolder folder;
  for (const double tolerance : {0.0, usual_tolerance}) {
    const Saved s = save(folder, faces, tolerance);
    const std::string whole = file_bytes(s.file);
    for (const std::size_t length : {std::size_t(0), std::size_t(1), std::size_t(103)}) {
      put_file(s.file, whole.substr(0, length));
      CHECK(refusal(s) == "this is no saved binding");
    }
    for (const std::size_t length :
         {std::size_t(104), std::size_t(105), whole.size() / 2, whole.size() - 1}) {
      put_file(s.file, whole.substr(0, length));
      CHECK(refusal(s).find("is cut short") == 0);
    }
    put_file(s.file, whole + "x");
    CHECK(refusal(s).find("is too long") == 0);
    put_file(s.file, "OFF\n" + std::string(1000, '7'));
    CHECK(refusal(s) == "this is no saved binding");
    std::string foreign = whole;
    std::reverse(foreign.begin() + 16, foreign.begin() + 20);
    put_file(s.file, foreign);
    CHECK(refusal(s).find("another order of bytes") != std::string::npos);
    std::string future = whole;
    future[20] = 9;
    put_file(s.file, future);
    CHECK(refusal(s).find("version 9, this program reads version 4") != std::string::npos);
  }
}

TEST_CASE("no_size_in_a_file_is_believed_before_the_bytes_are_there") {
  // Ranks that are as high as they can be ask for more than is there; higher ones are damage.
  const TemporaryFolder folder;
  const Saved s = save(folder, faces, usual_tolerance);
  const std::string whole = file_bytes(s.file);
  for (const std::uint32_t rank : {std::uint32_t(s.binding->handles), 0x7fffffffu, 0xffffffffu}) {
    std::string bytes = whole;
    for (std::size_t leaf = 0; leaf < s.binding->factored.size(); ++leaf)
      std::memcpy(bytes.data() + 104 + 4 * leaf, &rank, 4);
    put_file(s.file, bytes);
    const std::string problem = refusal(s);
    CHECK_MESSAGE((problem.find("is cut short") == 0 || problem == "is damaged"), problem);
  }
}

TEST_CASE("lists_are_checked_like_ranks") {
  const TemporaryFolder folder;
  const Saved s = save(folder, cut_off(0.2), 0);
  REQUIRE(s.binding->has_lists());
  const std::string whole = file_bytes(s.file);
  CHECK(refusal(s) == "");
  for (std::size_t at = 0; at < whole.size(); at += at < 600 ? 7 : whole.size() / 50) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    put_file(s.file, bytes);
    CHECK_MESSAGE(refusal(s) != "", at);
  }
  for (const std::size_t length :
       {std::size_t(105), std::size_t(104 + 4 * s.binding->leaves.count() + 5), whole.size() - 1}) {
    put_file(s.file, whole.substr(0, length));
    CHECK(refusal(s).find("is cut short") == 0);
  }
  for (const std::uint32_t wrong : {std::uint32_t(s.binding->handles), 0x7fffffffu, 0xffffffffu}) {
    for (const std::size_t at : {std::size_t(0), s.binding->leaves.count()}) {  // a length, and a handle
      std::string bytes = whole;
      std::memcpy(bytes.data() + 104 + 4 * at, &wrong, 4);
      put_file(s.file, bytes);
      const std::string problem = refusal(s);
      CHECK_MESSAGE((problem.find("is cut short") == 0 || problem == "is damaged"), problem);
    }
  }
}

TEST_CASE("what_is_no_regular_file_is_no_binding") {
  const TemporaryFolder folder;
  Saved s = save(folder, faces, 0);
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const fs::path& file : {folder / "missing", folder.path(), folder / "pipe"}) {
    s.file = file;
    CHECK(refusal(s) == "there is no such file");
  }
}

TEST_CASE("a_binding_that_cannot_be_written_leaves_the_one_before") {
  const TemporaryFolder folder;
  const Saved s = save(folder, faces, 0);
  CHECK_THROWS_AS(write_binding(folder / "none" / "a", *s.binding, s.model, *s.cage), Error);
  CHECK(refusal(s) == "");
  CHECK(folder.entries() == 1);
}

TEST_CASE("reading_a_binding_reports_progress_and_can_be_cancelled") {
  const TemporaryFolder folder;
  const Saved s = save(folder, faces, 0);
  viete::base::Progress progress;
  read_binding(s.file, s.model, *s.cage, faces, &progress);
  CHECK(progress.done() == 1);
  progress.cancel();
  CHECK_THROWS_AS(read_binding(s.file, s.model, *s.cage, faces, &progress), viete::base::Cancelled);
}

TEST_CASE("what_a_binding_is_expected_to_take_is_at_least_its_file") {
  for (const Weighting weighting : {faces, mean_values}) {
    const TemporaryFolder folder;
    const Saved s = save(folder, weighting, viete::deform::usual_tolerance);
    const std::size_t expected = viete::deform::binding_bytes(s.model.positions.size(), s.binding->handles,
                                                              viete::deform::EngineKind::fused, weighting);
    CHECK(expected >= fs::file_size(s.file));
    CHECK(expected <= 3 * fs::file_size(s.file));
  }
}

TEST_CASE("a_binding_is_known_by_its_beginning") {
  const TemporaryFolder folder;
  const Saved s = save(folder, faces, 0);
  CHECK(viete::deform::is_binding(file_bytes(s.file).substr(0, 16)));
  CHECK_FALSE(viete::deform::is_binding("viete binding"));
  CHECK_FALSE(viete::deform::is_binding("# a surface: vertices"));
  CHECK_FALSE(viete::deform::is_binding(""));
}
