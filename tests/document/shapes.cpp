// Tests shapes of the model: import, mixing, sessions, cages and pins.
#include "document/animation.h"
#include "document/probes.h"
#include "document/time_edit.h"
#include "support/distance.h"
#include "support/files.h"
#include "support/posed_cube.h"
#include "support/text.h"
#include "workspace/open_save.h"
#include "workspace/playing.h"

using namespace viete;
using namespace viete::document;
using namespace viete::files;
using namespace viete::workspace;
using test::distance, test::largest_distance, test::mentions, test::turned;

namespace fs = std::filesystem;

namespace {

using Points = std::vector<mesh::Point>;
using What = OpenRequest::What;

constexpr double quarter_turn = 1.5707963267948966;

// A bar of square rings along y.
struct BarFiles : test::TemporaryFolder {
  static constexpr int rings = 17;
  mesh::Surface bar;
  fs::path model = *this / "bar.obj";
  Workspace w;

  explicit BarFiles(bool flat = false) {
    for (int r = 0; r < rings; ++r) {
      const double y = r * 0.25;
      for (const mesh::Point p : {mesh::Point{-0.2, y, -0.2}, {0.2, y, -0.2}, {0.2, y, 0.2}, {-0.2, y, 0.2}})
        if (!flat || p[2] < 0) bar.positions.push_back({p[0], p[1], flat ? 0 : p[2]});
    }
    const std::uint32_t sides = flat ? 2 : 4;
    std::vector<mesh::Triangle> triangles;
    for (std::uint32_t r = 0; r + 1 < rings; ++r)
      for (std::uint32_t s = 0; s < (flat ? 1 : sides); ++s) {
        const std::uint32_t a = sides * r + s, b = sides * r + (s + 1) % sides;
        triangles.insert(triangles.end(), {{a, b, b + sides}, {a, b + sides, a + sides}});
      }
    bar = mesh::from_triangles(std::move(bar.positions), triangles);
    write("bar.obj", bar.positions);
  }

  // Bends the bar about z along an arc. The length of the center line does not change.
  Points bent(double angle) const {
    Points points;
    const double length = bar.positions.back()[1], radius = length / angle;
    for (const mesh::Point& p : bar.positions) {
      const double at = angle * p[1] / length, r = radius - p[0];
      points.push_back({radius - r * std::cos(at), r * std::sin(at), p[2]});
    }
    return points;
  }
  fs::path write(const std::string& name, Points points) const {
    mesh::Surface surface = bar;
    surface.positions = std::move(points);
    formats::write(*this / name, surface);
    return *this / name;
  }
  Document& document() { return w.document; }
  const Points& shape() const { return *w.document.shape(); }

  void open(const fs::path& cage = {}) { REQUIRE(test::load_model(w, model, cage)); }
  void add_bends() {
    REQUIRE(test::open_now(
        w, {What::shapes, {write("left.obj", bent(quarter_turn)), write("right.obj", bent(-1))}}));
    REQUIRE(document().library().poses.size() == 2);
  }
  bool weigh(std::size_t pose, double weight) {
    return set_weight(document(), w.playback.vectors, pose, weight);
  }
  mesh::Point tip() const {
    mesh::Point sum{0, 0, 0};
    for (std::size_t i = shape().size() - 4; i < shape().size(); ++i) sum = sum + 0.25 * shape()[i];
    return sum;
  }
  fs::path cage_file() {
    mesh::Surface cage = test::cube(1);
    for (mesh::Point& p : cage.positions) p = {p[0], 2 + 2.4 * p[1], p[2]};
    formats::write(*this / "cage.obj", cage);
    return *this / "cage.obj";
  }
  // Moves a pin as a drag does.
  void move_pin(std::size_t pin, const mesh::Vec3& offset) {
    record_edit(document(), "move a pin");
    document().changed_probes().all[pin].pose.move = document().probes().all[pin].pose.move + offset;
    settle_pins();
  }
  void settle_pins() {
    int frames = 0;
    do follow_pins(w);
    while (w.frame.pins.is_due() && ++frames < 100);
    CHECK(frames < 100);
  }
  void add_pin_at(std::uint32_t vertex) {
    REQUIRE(add_pin(document(), {}, bar.positions[vertex]));
    follow_pins(w);
  }
};

// A bar that is open, with two shapes in the list.
struct BentBar : BarFiles {
  BentBar() {
    open();
    add_bends();
  }
};

}  // namespace

TEST_CASE("shapes_become_poses_that_sliders_mix_in_log_space_or_in_straight_lines") {
  BarFiles f;
  f.open();
  CHECK(!f.document().is_movable());
  f.add_bends();
  CHECK(f.document().is_movable());
  CHECK(f.document().library().poses[0].name == "left");
  REQUIRE(f.weigh(0, 1));
  CHECK(f.document().shape() == f.document().library().poses[0].pose->shape);
  REQUIRE(f.weigh(0, 0.5));
  CHECK(largest_distance(f.shape(), f.bent(quarter_turn / 2)) < 0.02);
  const Points half = f.shape();
  REQUIRE(set_linear(f.document(), f.w.playback.vectors, true));
  const Points rest = f.bar.positions, left = f.bent(quarter_turn);
  for (std::size_t v = 0; v < rest.size(); ++v)
    CHECK(mesh::norm(f.shape()[v] - 0.5 * (rest[v] + (*f.document().library().poses[0].pose->shape)[v])) <
          1e-12);
  CHECK(largest_distance(f.shape(), half) > 0.2);
  undo(f.document());
  CHECK(f.shape() == half);
  CHECK(!f.document().timeline().linear);
  REQUIRE(f.weigh(1, -0.5));
  CHECK(f.tip()[0] > BarFiles().bent(quarter_turn / 2)[66][0]);
  REQUIRE(f.weigh(0, -1.5));
  REQUIRE(f.weigh(0, 0));
  REQUIRE(f.weigh(1, 0));
  CHECK(!f.document().shape());
  while (f.document().history().can_undo()) undo(f.document());
  CHECK(f.document().library().poses.empty());
  while (f.document().history().can_redo()) redo(f.document());
  CHECK(f.document().library().poses.size() == 2);
}

TEST_CASE("an_edited_pose_stays_below_the_mix_of_shapes") {
  BentBar f;
  apply_pose(f.w, 1);
  const SharedShape by_hand = f.document().shape();
  REQUIRE(by_hand);
  REQUIRE(f.weigh(0, 0.3));
  CHECK(largest_distance(f.shape(), *by_hand) > 0.1);
  REQUIRE(f.weigh(0, 0));
  CHECK(f.document().shape() == by_hand);
  reset_pose(f.document());
  CHECK(!f.document().shape());
  CHECK(!differs_from_rest(f.document()));
}

TEST_CASE("files_that_fit_are_shapes_when_dropped_and_the_model_itself_is_opened_again") {
  BarFiles f;
  f.open();
  const fs::path left = f.write("left.obj", f.bent(1)), right = f.write("right.ply", f.bent(-1)),
                 third = f.write("third.off", f.bent(2));
  REQUIRE(test::open_now(f.w, {What::dropped, {left}}));
  CHECK(f.document().library().poses.size() == 1);
  CHECK(mentions(f.w.messages.all().front().text, "as a shape"));
  REQUIRE(test::open_now(f.w, {What::dropped, {third, right}}));
  REQUIRE(test::open_now(f.w, {What::dropped, {left, right, third}}));
  CHECK(f.document().library().poses.size() == 6);
  CHECK(f.document().library().poses[5].name == "third 2");
  CHECK(!test::open_now(f.w, {What::shapes, {f.cage_file()}}));
  CHECK(mentions(f.w.messages.all().back().text, "the file has 8 vertices, the model has 68"));
  CHECK(f.document().library().poses.size() == 6);
  REQUIRE(test::open_now(f.w, {What::dropped, {f.model}}));
  CHECK(f.document().library().poses.empty());
  // Imports all suitable files of a folder, except the model itself.
  REQUIRE(test::open_now(f.w, {What::shapes, {f / "."}}));
  CHECK(f.document().library().poses.size() == 3);
}

TEST_CASE("a_session_keeps_shapes_keys_and_pins_to_the_bit") {
  BarFiles f;
  f.open(f.cage_file());
  f.add_bends();
  f.document().changed_timeline().keys.clear();
  REQUIRE(f.weigh(0, 0.37));
  set_key(f.document(), 1);
  f.document().put_frame(20);
  apply_pose(f.w, 1);
  set_key(f.document(), 20);
  f.add_pin_at(30);
  set_pulls(f.document(), true);
  f.document().changed_pose().positions[2][0] += 0.25;
  const fs::path file = f / "all.viete";
  REQUIRE(save_session(f.w, file));
  CHECK(!has_unsaved_edits(f.w));
  Workspace again = test::opened({file});
  const Document &a = f.document(), &b = again.document;
  CHECK(*b.shape() == *a.shape());
  CHECK(b.probes() == a.probes());
  REQUIRE(b.library().poses.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) CHECK(*b.library().poses[i].pose == *a.library().poses[i].pose);
  REQUIRE(b.timeline().keys.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) CHECK(*b.timeline().keys[i].pose == *a.timeline().keys[i].pose);
  CHECK(b.pose().positions == a.pose().positions);
  CHECK(!has_unsaved_edits(again));
  // The file has each shape once: two imported shapes and one mixed shape.
  const std::string text = test::file_bytes(file);
  std::size_t shapes = 0;
  for (std::size_t at = 0; (at = text.find("\"float", at)) != std::string::npos; ++at) ++shapes;
  CHECK(shapes == 3);
}

TEST_CASE("shapes_stay_when_the_model_gets_a_cage_and_poses_of_another_cage_go") {
  BentBar f;
  REQUIRE(f.weigh(0, 1));
  const SharedShape left = f.document().shape();
  REQUIRE(test::load_cage(f.w, f.cage_file()));
  CHECK(f.document().shape() == left);
  REQUIRE(f.document().library().poses.size() == 2);
  CHECK(f.document().library().poses[0].pose->cage.positions == f.document().cage()->surface.positions);
  f.document().changed_pose().positions[0][1] -= 0.3;
  f.document().put_shape(nullptr);
  keep_pose(f.document(), f.w.playback.vectors, "of the cage");
  REQUIRE(f.weigh(0, 0.5));
  REQUIRE(f.weigh(2, 0.5));
  CHECK(f.document().shape());
  mesh::Surface cage = test::cube(3);
  formats::write(f / "other.obj", cage);
  REQUIRE(test::load_cage(f.w, f / "other.obj"));
  CHECK(f.document().library().poses.size() == 2);
  CHECK(mentions(f.w.messages.all().back().text, "1 pose"));
}

TEST_CASE("keys_with_shapes_play_and_a_pin_goes_with_its_vertex") {
  BentBar f;
  f.add_pin_at(67);
  set_key(f.document(), 1);
  f.document().put_frame(21);
  apply_pose(f.w, 0);
  set_key(f.document(), 21);
  follow_pins(f.w);
  for (const double frame : {11.0, 1.0, 21.0, 7.5}) {
    go_to_frame(f.w, frame);
    follow_pins(f.w);
    CHECK(!f.w.frame.pins.is_due());
    const Probe& pin = f.document().probes().all[0];
    CHECK(pin.place + pin.pose.move == shape_of_vertex(f.document(), 67));
    if (frame == 11) CHECK(largest_distance(f.shape(), f.bent(quarter_turn / 2)) < 0.02);
  }
  CHECK(!has_unkeyed_pose(f.w));
}

TEST_CASE("pins_pose_the_model_by_its_shapes_and_undo_leads_back_to_the_bit") {
  BentBar f;
  for (const std::uint32_t v : {0u, 2u, 66u}) f.add_pin_at(v);
  f.add_pin_at(2);  // selects the existing pin
  REQUIRE(f.document().probes().all.size() == 3);
  CHECK(!f.document().shape());
  f.w.view.handling.freedom = 0.3;
  f.move_pin(2, {1, -0.3, 0});
  REQUIRE(f.document().shape());
  CHECK(mesh::norm(f.shape()[66] - (f.bar.positions[66] + mesh::Vec3{1, -0.3, 0})) < 1e-6);
  CHECK(mesh::norm(f.shape()[0] - f.bar.positions[0]) < 1e-6);
  CHECK(f.document().library().poses[0].weight - f.document().library().poses[1].weight > 0.2);
  const SharedShape first = f.document().shape();
  f.move_pin(2, {0.4, -0.3, 0});
  const SharedShape second = f.document().shape();
  const double weight = f.document().library().poses[0].weight;
  undo(f.document());
  f.settle_pins();
  CHECK(f.document().shape() == first);
  redo(f.document());
  f.settle_pins();
  CHECK(f.document().shape() == second);
  CHECK(f.document().library().poses[0].weight == weight);
  // A weight slider changes this shape and moves the pins.
  REQUIRE(f.weigh(0, weight + 0.1));
  CHECK(largest_distance(f.shape(), *second) < 0.5);
  CHECK(largest_distance(f.shape(), *second) > 0.01);
  const Probe& pin = f.document().probes().all[2];
  CHECK(pin.place + pin.pose.move == f.shape()[66]);
  f.settle_pins();
  // After that, a small move of the pin changes the shape only a little.
  const Points before = f.shape();
  f.move_pin(2, {0.001, 0, 0});
  CHECK(largest_distance(f.shape(), before) < 0.02);
}

TEST_CASE("without_shapes_pins_leave_the_model_as_rigid_as_can_be_and_pulling_ones_give_way") {
  BarFiles f;
  f.open();
  for (const std::uint32_t v : {0u, 2u, 66u}) f.add_pin_at(v);
  f.move_pin(2, {0.5, 0, 0});
  REQUIRE(f.document().shape());
  CHECK(mesh::norm(f.shape()[66] - (f.bar.positions[66] + mesh::Vec3{0.5, 0, 0})) < 1e-6);
  double longest = 0;
  for (std::size_t r = 8; r < 60; r += 4)
    longest = std::max(longest, std::abs(mesh::norm(f.shape()[r] - f.shape()[r + 2]) - std::sqrt(0.32)));
  CHECK(longest < 0.06);
  reset_pose(f.document());
  f.settle_pins();
  CHECK(!f.document().shape());
  set_pulls(f.document(), true);
  f.move_pin(2, {0.5, 0, 0});
  const double left = mesh::norm(f.shape()[66] - (f.bar.positions[66] + mesh::Vec3{0.5, 0, 0}));
  CHECK(left > 1e-3);
  CHECK(left < 0.5);
}

TEST_CASE("a_flat_model_stays_exactly_flat_and_is_seen_from_the_front") {
  BarFiles f(true);
  f.open();
  CHECK(f.w.view.camera.pose().orthographic);
  f.add_bends();
  const auto is_flat = [&] {
    return std::ranges::all_of(f.shape(), [](const auto& p) { return p[2] == 0; });
  };
  for (const double weight : {0.5, 1.7, -0.8, 0.123}) {
    REQUIRE(f.weigh(0, weight));
    CHECK(is_flat());
  }
  f.add_pin_at(0);
  f.add_pin_at(33);
  f.move_pin(1, {-0.4, 0.1, 0});
  CHECK(is_flat());
}

namespace {

using Points = std::vector<mesh::Point>;

struct Shapes {
  mesh::Surface rest;
  base::WorkerPool pool;
  shapes::ShapeSpace space;

  explicit Shapes(mesh::Surface surface = test::CubeFiles::subdivided_cube())
      : rest(std::move(surface)), pool(1), space(rest, pool) {}

  SharedShape shape(double degrees) const { return shared(turned(rest.positions, degrees)); }
  // Returns a shape that is not a rigid motion, because one vertex moved.
  SharedShape pulled(double degrees) const {
    Points points = rest.positions;
    points[7][2] += 0.5;
    return shared(turned(points, degrees));
  }
  static SharedShape shared(Points points) { return std::make_shared<const Points>(std::move(points)); }
  Points mixed(std::vector<ShapeTerm> terms, bool linear = false, std::vector<std::string>* notes = nullptr) {
    return *document::mixed(space, terms, linear, pool, notes);
  }
};

}  // namespace

TEST_CASE("half_of_a_turn_of_a_model_is_half_of_its_angle") {
  Shapes s;
  CHECK(distance(s.mixed({{s.shape(170), 0.5}}), *s.shape(85)) < 1e-12);
  CHECK(distance(s.mixed({{s.shape(100), -1}}), *s.shape(-100)) < 1e-12);
  CHECK(distance(s.mixed({{s.shape(100), 2.5}}), *s.shape(250)) < 1e-12);
  CHECK(distance(s.mixed({{s.shape(30), 1}, {s.shape(50), 1}}), *s.shape(80)) < 1e-12);
}

TEST_CASE("rest_and_a_shape_alone_are_themselves_to_the_bit") {
  Shapes s;
  const SharedShape shape = s.pulled(77);
  CHECK(s.mixed({}) == s.rest.positions);
  CHECK(s.mixed({{shape, 0}, {nullptr, 1}}) == s.rest.positions);
  const std::vector<ShapeTerm> alone = {{nullptr, 3}, {shape, 1}, {s.shape(20), 0}};
  CHECK(document::mixed(s.space, alone, false, s.pool) == shape);
}

TEST_CASE("linear_mixes_are_sums_of_displacements") {
  Shapes s;
  const SharedShape a = s.pulled(180), b = s.pulled(50);
  Points expected = s.rest.positions;
  for (std::size_t v = 0; v < expected.size(); ++v)
    expected[v] = expected[v] + 1.5 * ((*a)[v] - s.rest.positions[v]) - 0.5 * ((*b)[v] - s.rest.positions[v]);
  CHECK(distance(s.mixed({{a, 1.5}, {b, -0.5}}, true), expected) < 1e-15);
}

TEST_CASE("a_part_at_rest_in_all_shapes_stays_exactly_at_rest") {
  mesh::Surface both = test::cube(1);
  Points points = both.positions;
  std::vector<mesh::Triangle> triangles = both.triangles;
  for (const auto& p : both.positions) points.push_back({p[0] / 3 + 10.123456789, p[1] / 7, p[2] / 11});
  for (const auto& [a, b, c] : both.triangles) triangles.push_back({a + 8, b + 8, c + 8});
  Shapes s(mesh::from_triangles(points, triangles));
  const Points moved = turned(both.positions, 100);
  std::ranges::copy(moved, points.begin());
  const Points half = s.mixed({{Shapes::shared(points), 0.5}});
  CHECK(half[0] != s.rest.positions[0]);
  for (std::size_t v = 8; v < 16; ++v) CHECK(half[v] == s.rest.positions[v]);
}

TEST_CASE("notes_about_shapes_are_shown_once") {
  Shapes s;
  const SharedShape flat = Shapes::shared(Points(20, {1, 2, 3}));
  std::vector<std::string> notes;
  s.mixed({{s.pulled(30), 0.5}}, false, &notes);
  CHECK(notes.empty());
  s.mixed({{flat, 0.5}}, false, &notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "some triangles folded over or collapsed and follow their neighbours: 36");
  s.mixed({{flat, 0.5}, {flat, 0.25}}, false, &notes);
  CHECK(mentions(notes.at(0), "up to 36 in each of 2 shapes"));
  notes.clear();
  s.mixed({{flat, 0.5}}, true, &notes);
  CHECK(notes.empty());
  const shapes::ShapeReport reports[] = {{0, 0, 3}, {0, 0, 0}, {0, 0, 1200}};
  CHECK(mentions(shape_notes(reports).at(0), "up to 1,200 in each of 2 shapes"));
}
