// Bindings kept between runs, as the running program finds, keeps, refuses and drops them.
#include <cstring>

#include "app/saved_bindings.h"
#include "base/process.h"
#include "deform/binding_file.h"
#include "deform/deformer.h"
#include "mesh/formats/write.h"
#include "mesh/shapes.h"
#include "program/driver.h"
#include "scene/document/edit.h"
#include "support/folder.h"

using namespace viete;
using test::dragon;
using test::dragon_cage;
using test::Driver;

namespace {

namespace fs = std::filesystem;

app::ViewerOptions keeping_in(const fs::path& folder, double worth_keeping = 0) {
  auto options = Driver::default_options();
  options.size = {640, 400};
  options.bindings = {.folder = folder, .worth_keeping = worth_keeping};
  return options;
}

// The frame of a pose, to the last bit.
std::vector<deform::FrameVertex> frame_of(Driver& d) {
  d.document().changed_pose().positions[3][1] += 0.1;
  d.settle();
  const auto vertices = d.viewer().deformer()->vertices();
  return {vertices.begin(), vertices.end()};
}

std::vector<deform::FrameVertex> open_and_frame(const app::ViewerOptions& options,
                                                std::string* said = nullptr) {
  Driver d(options);
  REQUIRE(d.open({dragon, dragon_cage}));
  auto frame = frame_of(d);
  for (const auto& message : d.workspace().messages.all()) {
    if (said) *said += message.text + "\n";
  }
  return frame;
}

bool same(const std::vector<deform::FrameVertex>& a, const std::vector<deform::FrameVertex>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

fs::path only_file(const fs::path& folder) {
  REQUIRE(std::distance(fs::directory_iterator(folder), {}) == 1);
  return fs::directory_iterator(folder)->path();
}

}  // namespace

TEST_CASE("a_binding_that_took_long_is_kept_and_found_again_and_gives_the_same_frame") {
  const test::TemporaryFolder folder;
  const auto kept = folder / "kept";
  const auto first = open_and_frame(keeping_in(kept));
  const fs::path file = only_file(kept);
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24));
  const auto before = fs::last_write_time(file);
  CHECK(same(open_and_frame(keeping_in(kept, 1e9)), first));
  CHECK(fs::last_write_time(file) > before);  // it was used, and so goes last
  only_file(kept);
}

TEST_CASE("a_binding_that_was_fast_is_not_kept") {
  const test::TemporaryFolder folder;
  open_and_frame(keeping_in(folder / "kept", 1e9));
  CHECK(!fs::exists(folder / "kept"));
}

TEST_CASE("a_kept_binding_is_what_is_shown") {
  // With other offsets under the right name: the dragon is then drawn elsewhere, so it was taken.
  const test::TemporaryFolder folder;
  const auto kept = folder / "kept";
  const auto first = open_and_frame(keeping_in(kept));
  const fs::path file = only_file(kept);
  const auto model = scene::open_document(dragon, dragon_cage);
  auto tiles = deform::read_binding(file, *model.model.surface, *model.cage, deform::Weighting());
  for (float& x : tiles.offsets) x *= 2;
  deform::write_binding(file, tiles, *model.model.surface, *model.cage);
  CHECK(!same(open_and_frame(keeping_in(kept, 1e9)), first));
}

TEST_CASE("a_kept_binding_that_is_damaged_is_made_anew_and_replaced") {
  const test::TemporaryFolder folder;
  const auto kept = folder / "kept";
  const auto first = open_and_frame(keeping_in(kept));
  const fs::path file = only_file(kept);
  const std::string whole = test::file_bytes(file);
  std::string bytes = whole;
  bytes[bytes.size() / 2] ^= 1;
  for (const auto& damaged : {bytes, whole.substr(0, whole.size() / 3), std::string()}) {
    test::put_file(file, damaged);
    std::string said;
    CHECK(same(open_and_frame(keeping_in(kept), &said), first));
    CHECK(said == "");
    CHECK(test::file_bytes(only_file(kept)) == whole);
  }
}

TEST_CASE("another_model_under_the_same_name_gets_its_own_binding") {
  const test::TemporaryFolder folder;
  const auto kept = folder / "kept";
  const fs::path model = folder / "model.ply";
  for (const double radius : {1.0, 1.1}) {
    auto ball = test::sphere(4);
    for (auto& p : ball.positions)
      for (double& x : p) x *= radius;
    mesh::write(model, ball);
    Driver d(keeping_in(kept));
    const fs::path cage = folder / "cage.ply";
    mesh::write(cage, test::moved(test::sphere(2), 5));
    REQUIRE(d.open({model, cage}));
    d.settle();
    CHECK(d.viewer().deformer()->positions()[0][0] ==
          doctest::Approx(d.document().model.surface->positions[0][0]));
  }
  CHECK(std::distance(fs::directory_iterator(kept), {}) == 2);
}

TEST_CASE("a_folder_that_cannot_be_written_is_a_message_and_nothing_else") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "file", "");
  std::string said;
  Driver d(keeping_in(folder / "file"));
  REQUIRE(d.open({dragon, dragon_cage}));
  frame_of(d);
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  const auto& all = d.workspace().messages.all();
  while (all.empty() && std::chrono::steady_clock::now() < end) d.frame();
  REQUIRE(all.size() == 1);
  CHECK(all[0].text.find("cannot be written") != std::string::npos);
}

TEST_CASE("those_used_longest_ago_go_when_there_are_too_many") {
  const test::TemporaryFolder folder;
  const auto kept = folder / "kept";
  const auto ball = test::sphere(4);
  base::WorkerPool pool;
  app::SavedBindings saved{.folder = kept, .worth_keeping = 0};
  std::vector<fs::path> files;
  for (const double size : {5.0, 6.0, 7.0, 8.0}) {
    const auto cage = deform::make_cage(test::moved(test::sphere(2), size));
    const auto tiles = deform::bind_tiles(ball, cage, deform::Weighting(), pool, 0);  // all of one size
    const auto age = std::chrono::hours(files.size() == 0 ? 1 : 10 - files.size());
    saved.limit = 3 * (tiles.bytes() + 1000);
    app::keep_binding(saved, tiles, ball, cage);
    for (const auto& entry : fs::directory_iterator(kept)) {
      if (std::find(files.begin(), files.end(), entry.path()) == files.end()) files.push_back(entry.path());
    }
    fs::last_write_time(files.back(), fs::file_time_type::clock::now() - age);
  }
  REQUIRE(files.size() == 4);
  CHECK(fs::exists(files[0]));   // used an hour ago
  CHECK(!fs::exists(files[1]));  // nine hours ago
  CHECK(fs::exists(files[2]));
  CHECK(fs::exists(files[3]));
  test::put_file(kept / "note.txt", "not ours");
  saved.limit = 10;
  const auto cage = deform::make_cage(test::moved(test::sphere(2), 9));
  app::keep_binding(saved, deform::bind_tiles(ball, cage, deform::Weighting(), pool), ball, cage);
  CHECK(fs::exists(kept / "note.txt"));
  CHECK(fs::exists(files[0]));  // one that is larger than all may be is not kept, and drives none out
}

TEST_CASE("what_others_are_writing_counts_and_what_killed_programs_left_goes") {
  const test::TemporaryFolder folder;
  base::WorkerPool pool;
  const auto ball = test::sphere(8);
  app::SavedBindings saved{.folder = folder.path(), .worth_keeping = 0};
  const auto keep = [&](double size) {
    const auto cage = deform::make_cage(test::moved(test::sphere(2), size));
    const auto tiles = deform::bind_tiles(ball, cage, deform::Weighting(), pool, 0);
    saved.limit = 2 * (tiles.bytes() + 1000);
    app::keep_binding(saved, tiles, ball, cage);
    return tiles.bytes();
  };
  const std::size_t bytes = keep(5);
  const fs::path first = only_file(folder.path()), stale = folder / "a.binding.999999999-1-0.part",
                 working = folder / ("b.binding." + base::process_name() + "-99.part");
  test::put_file(stale, std::string(bytes, 'x'));
  keep(6);
  CHECK_FALSE(fs::exists(stale));
  CHECK(fs::exists(first));
  fs::last_write_time(first, fs::file_time_type::clock::now() - std::chrono::hours(1));
  test::put_file(working, std::string(bytes, 'x'));
  keep(7);
  CHECK(fs::exists(working));
  CHECK_FALSE(fs::exists(first));
}

TEST_CASE("a_named_binding_is_used_and_a_stale_or_foreign_one_is_said_and_bound_anew") {
  const test::TemporaryFolder folder;
  const auto right = open_and_frame(keeping_in({}));
  const auto document = scene::open_document(dragon, dragon_cage);
  base::WorkerPool pool;
  const auto tiles = deform::bind_tiles(*document.model.surface, *document.cage, deform::Weighting(), pool);
  auto options = keeping_in({});
  options.bindings.named = folder / "a.binding";
  deform::write_binding(options.bindings.named, tiles, *document.model.surface, *document.cage);
  std::string said;
  CHECK(same(open_and_frame(options, &said), right));
  CHECK(said == "");
  const auto other = deform::make_cage(test::moved(test::sphere(2), 5));
  const auto others = deform::bind_tiles(*document.model.surface, other, deform::Weighting(), pool);
  deform::write_binding(options.bindings.named, others, *document.model.surface, other);
  CHECK(same(open_and_frame(options, &said), right));
  CHECK(said.find("a.binding: is stale: the cage is not the one") != std::string::npos);
  test::put_file(options.bindings.named, "solid nonsense");
  said.clear();
  CHECK(same(open_and_frame(options, &said), right));
  CHECK(said.find("a.binding: this is no saved binding") != std::string::npos);
}
