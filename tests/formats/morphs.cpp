#include "formats/original.h"

#include "formats/gltf_judge.h"
#include "formats/morph_keys.h"
#include "support/distance.h"
#include "support/gltf.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using test::GltfParts;
using test::mentions, test::raised;

namespace {

struct Wave {
  std::vector<std::vector<Point>> positions;
  test::MorphAnimation animation;

  // The keys are: rest, up, down, rest.
  explicit Wave(const Surface& s) {
    for (const double by : {0.0, 0.5, -0.25, 0.0}) positions.push_back(raised(s, by));
    animation.name = "wave";
    for (std::size_t i = 0; i < positions.size(); ++i)
      animation.keys.push_back({0.5 * static_cast<double>(i), "key " + std::to_string(i), positions[i]});
  }
};

class MorphJudge : public test::GltfJudge {
public:
  using GltfJudge::GltfJudge;

  const tinygltf::Primitive& primitive(std::size_t mesh, std::size_t i) const {
    return model.meshes.at(mesh).primitives.at(i);
  }

  // Returns an attribute of a primitive at a key: the sum of the base values and weight * target.
  std::vector<double> shown(std::size_t node, std::size_t i, const char* attribute, std::size_t key,
                            std::size_t animation = 0) const {
    const auto mesh = static_cast<std::size_t>(model.nodes.at(node).mesh);
    const auto& p = primitive(mesh, i);
    const auto base = floats(p.attributes.at(attribute));
    REQUIRE(model.meshes.at(mesh).weights.size() == p.targets.size());
    return weighed(p, base, attribute, weights(node, key, animation));
  }

  // Returns an attribute of the node's first primitive at default weights.
  std::vector<double> shown(std::size_t node, const char* attribute) const {
    const auto& n = model.nodes.at(node);
    const auto& mesh = model.meshes.at(static_cast<std::size_t>(n.mesh));
    const auto& w = n.weights.empty() ? mesh.weights : n.weights;
    const auto& p = mesh.primitives.at(0);
    return weighed(p, floats(p.attributes.at(attribute)), attribute, {w.begin(), w.end()});
  }

  std::vector<double> weighed(const tinygltf::Primitive& p, const std::vector<float>& base,
                              const char* attribute, const std::vector<float>& w) const {
    std::vector<double> sum(base.begin(), base.end());
    REQUIRE(w.size() == p.targets.size());
    for (std::size_t t = 0; t < w.size(); ++t) {
      if (p.targets[t].count(attribute) == 0) continue;
      const auto delta = floats(p.targets[t].at(attribute));
      REQUIRE(delta.size() == sum.size());
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += static_cast<double>(w[t] * delta[k]);
    }
    return sum;
  }

  std::vector<float> weights(std::size_t node, std::size_t key, std::size_t animation = 0) const {
    const auto& played = model.animations.at(animation);
    for (const auto& channel : played.channels) {
      if (channel.target_node != static_cast<int>(node)) continue;
      CHECK(channel.target_path == "weights");
      const auto& sampler = played.samplers.at(static_cast<std::size_t>(channel.sampler));
      const auto times = floats(sampler.input), all = floats(sampler.output);
      REQUIRE(all.size() % times.size() == 0);
      const std::size_t count = all.size() / times.size();
      return {all.begin() + static_cast<std::ptrdiff_t>(key * count),
              all.begin() + static_cast<std::ptrdiff_t>((key + 1) * count)};
    }
    return {};
  }
};

void check_near(std::span<const double> found, std::span<const Point> expected, double near = 1e-6) {
  REQUIRE(found.size() == 3 * expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    CHECK(found[i] == doctest::Approx(expected[i / 3][i % 3]).epsilon(near).scale(1));
}

void check_near(const std::vector<Point>& found, const std::vector<Point>& expected, double near = 1e-6) {
  CHECK(test::largest_distance(found, expected) < near);
}

// Returns the positions of all vertices in the file. `p` has the positions of the vertices of the surface.
std::vector<Point> of_patch(const std::vector<Point>& p) {
  return {p[0], p[1], p[2], p[3], p[1], p[4], p[3], p[5]};
}

// Returns test::patch() in two nodes, with three targets: floats, sparse floats, and normalised integers.
GltfParts weighed_patch() {
  GltfParts p = test::patch();
  std::vector<float> lift, lean;
  for (int i = 0; i < 8; ++i) {
    lift.insert(lift.end(), {0, 1, 0});
    lean.insert(lean.end(), {0.3F, 0, -0.2F});
  }
  std::vector<std::int16_t> back(24, 0);
  for (std::size_t i = 0; i < 24; i += 3) back[i] = -32767;
  const std::size_t up = p.accessor(lift, 5126, "VEC3", 3), leaning = p.accessor(lean, 5126, "VEC3", 3);
  const std::size_t whole = p.accessor(back, 5122, "VEC3", 3);
  p.json["accessors"][whole]["normalized"] = true;
  const std::size_t where = p.view(std::vector<std::uint16_t>{5}), what = p.view(std::vector<float>{0, 0, 4});
  const std::size_t few = p.json["accessors"].size();
  p.json["accessors"].push_back({{"componentType", 5126},
                                 {"count", 8},
                                 {"type", "VEC3"},
                                 {"sparse",
                                  {{"count", 1},
                                   {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                                   {"values", {{"bufferView", what}}}}}});
  auto& mesh = p.json["meshes"][0];
  mesh["primitives"][0]["targets"] = {
      {{"POSITION", up}, {"NORMAL", leaning}}, {{"POSITION", few}}, {{"POSITION", whole}}};
  mesh["weights"] = {0.5, 0.25, 1};
  p.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {9, 0, 0}}, {"weights", {1, 0, -1}}}};
  p.json["scenes"] = {{{"nodes", {0, 1}}}};
  return p;
}

std::vector<Point> shape_of_weighed_patch() {
  return {{-1, 0.5, 0}, {0, 0.5, 0}, {-1, 1.5, 0}, {0, 1.5, 0}, {1, 0.5, 1}, {1, 1.5, 0},
          {10, 1, 0},   {11, 1, 0},  {10, 2, 0},   {11, 2, 0},  {12, 1, 0},  {12, 2, 0}};
}

}  // namespace

TEST_CASE("default_weights_of_nodes_and_meshes_shape_the_model") {
  for (const bool binary : {true, false}) {
    const GltfParts parts = weighed_patch();
    const ReadResult r = test::read_kept(binary ? parts.glb() : parts.text(), binary ? "glb" : "gltf");
    check_near(r.surface.positions, shape_of_weighed_patch());
    CHECK(r.warnings.empty());
    const Vec3 n = r.attributes->normals.at(0);
    CHECK(n[0] / n[2] == doctest::Approx(0.15 / 0.9));
    CHECK(norm(n) == doctest::Approx(1));
    CHECK(r.original->morphs()->at_target(0)[0] == Point{0, 1, 0});
  }
  GltfParts still = weighed_patch();
  still.json["meshes"][0]["weights"] = {0, 0};
  still.json["nodes"][1].erase("weights");
  const ReadResult r = test::read_kept(still.glb(), "glb");
  CHECK(r.surface.positions[4] == Point{2, 0, 0});
}

TEST_CASE("vertices_separated_or_joined_by_default_weights_are_not_welded") {
  GltfParts parts = test::patch();
  std::vector<float> open(24, 0);
  open[3] = -1;
  open[0] = 1;  // exchanges vertices 0 and 1; vertex 4 stays at x = 1
  const std::size_t delta = parts.accessor(open, 5126, "VEC3", 3);
  parts.primitive()["targets"] = {{{"POSITION", delta}}};
  parts.json["meshes"][0]["weights"] = {0.5};
  const ReadResult r = test::read_kept(parts.glb(), "glb");
  REQUIRE(r.surface.positions.size() == 7);
  CHECK(r.surface.positions[0] == Point{0.5, 0, 0});
  CHECK(r.surface.positions[1] == Point{0.5, 0, 0});
  CHECK(r.original->morphs()->at_target(0)[0] == Point{1, 0, 0});
}

TEST_CASE("a_deformed_model_is_right_at_the_default_weights_of_its_targets") {
  const test::TemporaryFolder folder;
  const ReadResult r = test::put_and_read(folder / "a.glb", weighed_patch().glb());
  write(folder / "rest.glb", {r.surface, r.surface.positions, {}}, r.original.get(), {});
  CHECK(test::file_bytes(folder / "rest.glb") == test::file_bytes(folder / "a.glb"));
  std::vector<Point> posed = raised(r.surface, 0.5);
  posed[11] = r.surface.positions[11];
  write(folder / "b.glb", {r.surface, posed, {}}, r.original.get(), {});
  const MorphJudge judge(folder / "b.glb"), before(folder / "a.glb");
  check_near(read(folder / "b.glb").surface.positions, posed, 1e-5);
  CHECK(judge.model.nodes[1].weights == before.model.nodes[1].weights);
  const std::vector<Point> first(posed.begin(), posed.begin() + 6);
  GltfParts plain = test::patch();  // will have the shape of node 0, but no targets
  const auto shown = before.shown(0, "POSITION");
  const auto leaning = before.shown(0, "NORMAL");
  plain.primitive()["attributes"]["POSITION"] =
      plain.accessor(std::vector<float>(shown.begin(), shown.end()), 5126, "VEC3", 3);
  plain.primitive()["attributes"]["NORMAL"] =
      plain.accessor(std::vector<float>(leaning.begin(), leaning.end()), 5126, "VEC3", 3);
  const ReadResult p = test::put_and_read(folder / "plain.glb", plain.glb());
  write(folder / "plain_b.glb", {p.surface, first, {}}, p.original.get(), {});
  const MorphJudge expected(folder / "plain_b.glb");
  const auto found = judge.shown(0, "NORMAL"), wanted = expected.shown(0, "NORMAL");
  const auto written = judge.floats(
      judge.primitive(static_cast<std::size_t>(judge.model.nodes[0].mesh), 0).attributes.at("NORMAL"));
  for (std::size_t i = 0; i < 24; i += 3) {
    const Vec3 a{found[i], found[i + 1], found[i + 2]}, b{wanted[i], wanted[i + 1], wanted[i + 2]};
    CHECK(norm((1 / norm(a)) * a - b) < 1e-6);
    CHECK(std::hypot(written[i], written[i + 1], written[i + 2]) == doctest::Approx(1));
  }
}

TEST_CASE("targets_of_a_deformed_model_turn_with_the_surface") {
  const test::TemporaryFolder folder;
  GltfParts parts = weighed_patch();
  parts.json["nodes"] = {{{"mesh", 0}, {"translation", {9, 0, 0}}, {"scale", {2, 2, 2}}}};
  parts.json["scenes"] = {{{"nodes", {0}}}};
  const ReadResult r = test::put_and_read(folder / "a.glb", parts.glb());
  std::vector<Point> posed, turned_targets;
  const auto turned = [](const Point& p) { return Point{-p[1], p[0], p[2]}; };
  for (const Point& p : r.surface.positions) posed.push_back(turned(p));
  write(folder / "b.glb", {r.surface, posed, {}}, r.original.get(), {});
  const ReadResult b = read(folder / "b.glb");
  check_near(b.surface.positions, posed, 1e-5);
  const auto before = r.original->morphs(), now = b.original->morphs();
  for (std::size_t t = 0; t < 3; ++t) {
    std::vector<Point> wanted;
    for (const Point& p : before->at_target(t)) wanted.push_back(turned(p));
    check_near(now->at_target(t), wanted, 1e-5);
  }
  const MorphJudge old_file(folder / "a.glb"), new_file(folder / "b.glb");
  const auto lean = old_file.floats(old_file.primitive(0, 0).targets[0].at("NORMAL")),
             leans = new_file.floats(new_file.primitive(0, 0).targets[0].at("NORMAL"));
  for (std::size_t i = 0; i < lean.size(); i += 3) {
    CHECK(leans[i] == doctest::Approx(-lean[i + 1]));
    CHECK(leans[i + 1] == doctest::Approx(lean[i]));
    CHECK(leans[i + 2] == doctest::Approx(lean[i + 2]));
  }
}

TEST_CASE("keys_become_targets_and_other_content_is_kept") {
  const test::TemporaryFolder folder;
  const GltfParts parts = test::patch();
  for (const char* name : {"a.glb", "a.gltf"}) {
    const ReadResult r =
        test::put_and_read(folder / name, mentions(name, "glb") ? parts.glb() : parts.text());
    CHECK(r.original->morphs() == nullptr);
    const Wave wave(r.surface);
    const auto out = folder / (std::string("out-") + name);
    CHECK(test::write_morphs(out, {r.surface, r.surface.positions, {}}, r.original.get(), wave.animation)
              .empty());
    const MorphJudge judge(out);
    REQUIRE(judge.model.animations.size() == 1);
    CHECK(judge.model.animations[0].name == "wave");
    CHECK(judge.floats(judge.model.animations[0].samplers.at(0).input) ==
          std::vector<float>{0, 0.5F, 1, 1.5F});
    REQUIRE(judge.primitive(0, 0).targets.size() == 2);  // keys at rest need no target
    for (std::size_t key = 0; key < 4; ++key) {
      check_near(judge.shown(0, 0, "POSITION", key), of_patch(wave.positions[key]));
      const auto w = judge.weights(0, key);
      CHECK(w == std::vector<float>{key == 1 ? 1.0F : 0, key == 2 ? 1.0F : 0});
    }
    const auto normals = judge.shown(0, 0, "NORMAL", 1);
    CHECK(normals[0] == doctest::Approx(-0.5 / std::hypot(1, 0.5)));   // normal of the left quad
    CHECK(normals[15] == doctest::Approx(-1.5 / std::hypot(1, 1.5)));  // normal of the right quad
    for (std::size_t k = 0; k < 3; ++k) CHECK(normals[3 + k] == doctest::Approx(normals[12 + k]));  // seam
    CHECK(judge.model.meshes[0].extras.Get("targetNames").Get(1).Get<std::string>() == "key 2");
    const ReadResult again = read(out);
    CHECK(again.surface.positions == r.surface.positions);
    const auto clip = again.original->morphs();
    REQUIRE(clip);
    CHECK(clip->name() == "wave");
    CHECK(clip->seconds() == std::vector<double>{0, 0.5, 1, 1.5});
    CHECK(clip->targets() == std::vector<std::string>{"key 1", "key 2"});
    CHECK(clip->notes().empty());
    for (std::size_t key = 0; key < 4; ++key) check_near(clip->at_key(key), wave.positions[key]);
    check_near(clip->at_target(1), wave.positions[2]);
    CHECK(judge.model.materials.at(0).name == "paint");
    CHECK(judge.model.asset.extras.Get("kept").Get<std::string>() == "as it is");
    CHECK(
        judge.model.accessors.at(static_cast<std::size_t>(judge.primitive(0, 0).attributes.at("TEXCOORD_0")))
            .count == 8);
  }
}

TEST_CASE("few_moved_vertices_make_sparse_targets_and_unmoved_meshes_get_none") {
  const test::TemporaryFolder folder;
  write(folder / "a.glb", test::sphere(3));
  const ReadResult r = read(folder / "a.glb");
  test::MorphAnimation animation{"dent", {{0, "", r.surface.positions}, {1, "", {}}}, false};
  std::vector<Point> posed = r.surface.positions;
  posed[3][0] += 1;
  animation.keys[1].positions = posed;
  test::write_morphs(folder / "b.glb", {r.surface, r.surface.positions, {}}, r.original.get(), animation);
  const MorphJudge judge(folder / "b.glb");
  const auto& target = judge.primitive(0, 0).targets.at(0);
  CHECK(target.count("NORMAL") == 0);
  const auto& accessor = judge.model.accessors.at(static_cast<std::size_t>(target.at("POSITION")));
  CHECK(accessor.sparse.isSparse);
  CHECK(accessor.sparse.count == 1);
  CHECK(accessor.maxValues == std::vector<double>{1, 0, 0});
  CHECK(std::filesystem::file_size(folder / "b.glb") < std::filesystem::file_size(folder / "a.glb") + 2000);
  check_near(read(folder / "b.glb").original->morphs()->at_key(1), posed);
}

TEST_CASE("targets_and_animations_of_the_file_stay_and_are_widened") {
  const test::TemporaryFolder folder;
  GltfParts parts = test::patch();
  std::vector<float> lift;
  for (int i = 0; i < 8; ++i) lift.insert(lift.end(), {0, 1, 0});
  const std::size_t delta = parts.accessor(lift, 5126, "VEC3", 3);
  auto& mesh = parts.json["meshes"][0];
  mesh["primitives"][0]["targets"] = {{{"POSITION", delta}}};
  mesh["weights"] = {0.25};
  parts.json["nodes"][0]["weights"] = {0.5};
  const std::size_t input = parts.accessor(std::vector<float>{0, 2, 3}, 5126, "SCALAR", 1);
  const std::size_t output = parts.accessor(std::vector<float>{0, 1, 0.5F}, 5126, "SCALAR", 1);
  parts.json["animations"] = {
      {{"name", "lift"},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
       {"samplers", {{{"input", input}, {"output", output}}}}}};
  const ReadResult r = test::put_and_read(folder / "a.glb", parts.glb());
  const auto before = r.original->morphs();
  REQUIRE(before);
  CHECK(before->seconds() == std::vector<double>{0, 2, 3});
  CHECK(before->at_key(2)[5] == Point{2, 1.5, 0});
  const Wave wave(r.surface);
  const auto notes = test::write_morphs(folder / "b.glb", {r.surface, r.surface.positions, {}},
                                        r.original.get(), wave.animation);
  CHECK(mentions(notes.at(0), "1 animation of the file stays"));
  const MorphJudge judge(folder / "b.glb");
  REQUIRE(judge.model.animations.size() == 2);
  CHECK(judge.weights(0, 1, 0) == std::vector<float>{1, 0, 0});
  CHECK(judge.weights(0, 2, 0) == std::vector<float>{0.5F, 0, 0});
  CHECK(judge.weights(0, 2, 1) == std::vector<float>{0.5F, 0, 1});
  CHECK(judge.model.nodes[0].weights == std::vector<double>{0.5, 0, 0});
  CHECK(judge.model.meshes[0].extras.Get("targetNames").Get(0).Get<std::string>() == "target 1");
  check_near(judge.shown(0, 0, "POSITION", 1, 1), of_patch(wave.positions[1]));
  const auto clip = read(folder / "b.glb").original->morphs();
  CHECK(clip->name() == "lift");
  CHECK(clip->targets().size() == 3);
  CHECK(mentions(clip->notes().at(0), "only the first of 2 animations of weights is used"));
}

TEST_CASE("meshes_of_turned_scaled_and_shared_nodes_morph_where_they_are") {
  const test::TemporaryFolder folder;
  GltfParts parts = test::patch();
  parts.json["nodes"] = {
      {{"mesh", 0}},
      {{"mesh", 0}, {"translation", {5, 0, 0}}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {2, 1, 3}}},
      {{"mesh", 0}, {"translation", {0, 9, 0}}}};
  parts.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
  const ReadResult r = test::put_and_read(folder / "a.glb", parts.glb());
  REQUIRE(r.surface.positions.size() == 18);
  std::vector<Point> posed = r.surface.positions;
  for (std::size_t i = 0; i < 12; ++i) posed[i][1] += 0.5 * posed[i][0] * posed[i][0];
  const test::MorphAnimation animation{"a", {{0, "rest", r.surface.positions}, {1, "posed", posed}}};
  const auto notes =
      test::write_morphs(folder / "b.glb", {r.surface, r.surface.positions, {}}, r.original.get(), animation);
  CHECK(mentions(notes.at(0), "shared meshes were copied "));
  const auto clip = read(folder / "b.glb").original->morphs();
  REQUIRE(clip);
  check_near(clip->at_key(0), r.surface.positions, 1e-5);
  check_near(clip->at_key(1), posed, 1e-5);
  const MorphJudge judge(folder / "b.glb");
  CHECK(judge.model.animations.at(0).channels.size() == 2);
  CHECK(judge.weights(2, 0).empty());  // node 2 does not move
}

TEST_CASE("models_of_other_formats_become_glb_with_targets") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a.obj",
                 "o left\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                 "f 1/1 2/2 3/3 4/4\no right\nv 2 0 0\nv 3 0 0\nv 3 1 0\nf 5 6 7\n");
  const ReadResult r = read(folder / "a.obj");
  const Wave wave(r.surface);
  for (const char* name : {"b.glb", "b.gltf"}) {
    const Content content{r.surface, r.surface.positions, r.comments, r.attributes.get()};
    test::write_morphs(folder / name, content, r.original.get(), wave.animation);
    const MorphJudge judge(folder / name);
    for (std::size_t key = 0; key < 4; ++key) {
      const std::span all(wave.positions[key]);
      check_near(judge.shown(0, 0, "POSITION", key), all.first(4));
      check_near(judge.shown(1, 0, "POSITION", key), all.subspan(4));
    }
    CHECK(judge.model.nodes.at(1).name == "right");
    CHECK(judge.model.animations.at(0).channels.size() == 2);
    const auto turned = judge.shown(1, 0, "NORMAL", 1), flat = judge.shown(1, 0, "NORMAL", 0);
    CHECK(flat[2] == doctest::Approx(1));
    CHECK(turned[0] / turned[2] == doctest::Approx(-2.5));  // z = 0.5 * x^2, from x = 2 to x = 3
    const auto clip = read(folder / name).original->morphs();
    check_near(clip->at_key(2), wave.positions[2]);
  }
  CHECK_THROWS_WITH_AS(test::write_morphs(folder / "b.obj", {r.surface, r.surface.positions, {}},
                                          r.original.get(), wave.animation),
                       doctest::Contains("cannot store morph targets"), base::Error);
}

TEST_CASE("computed_normals_are_continuous_across_texture_seams") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a.obj",
                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 0.5 0\n"
                 "f 1/1 2/2 3/2 4/1\nf 2/3 5/1 6/1 3/3\n");
  const ReadResult r = read(folder / "a.obj");
  const Wave wave(r.surface);
  test::write_morphs(folder / "b.glb", {r.surface, r.surface.positions, {}, r.attributes.get()},
                     r.original.get(), wave.animation);
  const MorphJudge judge(folder / "b.glb");
  const auto places = judge.shown(0, 0, "POSITION", 1), normals = judge.shown(0, 0, "NORMAL", 1);
  std::map<std::vector<double>, std::vector<double>> at;
  std::size_t split = 0;
  for (std::size_t i = 0; i < places.size(); i += 3) {
    const std::vector<double> n(&normals[i], &normals[i] + 3);
    const auto [found, added] = at.try_emplace({places[i], places[i + 1], places[i + 2]}, n);
    CHECK(found->second == n);
    split += !added;
  }
  CHECK(split == 2);
}

TEST_CASE("invalid_animations_are_rejected_and_nothing_is_written") {
  const test::TemporaryFolder folder;
  const Surface cube = test::cube();
  const std::vector<Point> rest = cube.positions, far(8, Point{1e300, 0, 0});
  const Content content{cube, cube.positions, {}};
  const auto refused = [&](std::vector<test::MorphKey> keys) {
    try {
      test::write_morphs(folder / "a.glb", content, nullptr, {"a", std::move(keys)});
    } catch (const base::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(mentions(refused({}), "the animation has no keys"));
  CHECK(mentions(refused({{0, "", rest}, {0, "", rest}}), "key 1: the time"));
  CHECK(mentions(refused({{std::nan(""), "", rest}}), "key 0: the time"));
  CHECK(mentions(refused({{0, "", far}}), "the position of vertex 0 is invalid"));
  CHECK(folder.entries() == 0);
  base::Progress progress;
  progress.cancel();
  std::vector<Point> moved = rest;
  moved[0][0] = 7;
  CHECK_THROWS_AS(test::write_morphs(folder / "a.glb", content, nullptr, {"a", {{0, "", moved}}}, &progress),
                  base::Cancelled);
  {
    const test::FullDisk full(300);
    CHECK_THROWS_AS(test::write_morphs(folder / "a.glb", content, nullptr, {"a", {{0, "", moved}}}),
                    base::Error);
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("stepped_and_cubic_weights_are_read_and_invalid_ones_rejected") {
  GltfParts parts = test::patch();
  std::vector<float> lift;
  for (int i = 0; i < 8; ++i) lift.insert(lift.end(), {0, 0, 1});
  const std::size_t delta = parts.accessor(lift, 5126, "VEC3", 3);
  parts.primitive()["targets"] = {{{"POSITION", delta}}, {{"POSITION", delta}}};
  const std::size_t input = parts.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
  const std::size_t cubic =
      parts.accessor(std::vector<float>{9, 9, 0, 1, 9, 9, 9, 9, 2, 3, 9, 9}, 5126, "SCALAR", 1);
  const std::size_t plain = parts.accessor(std::vector<float>{0, 1, 2, 3}, 5126, "SCALAR", 1);
  const std::size_t back = parts.accessor(std::vector<float>{1, 0}, 5126, "SCALAR", 1);
  const std::size_t nan = parts.accessor(std::vector<float>{0, std::nanf(""), 2, 3}, 5126, "SCALAR", 1);
  const auto clip_of = [&](std::size_t in, std::size_t out, const char* interpolation) {
    parts.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", in}, {"output", out}, {"interpolation", interpolation}}}}}};
    return test::read_kept(parts.glb(), "glb").original->morphs();
  };
  for (const char* interpolation : {"LINEAR", "STEP", "CUBICSPLINE"}) {
    const auto clip = clip_of(input, *interpolation == 'C' ? cubic : plain, interpolation);
    CHECK(clip->at_key(0)[0] == Point{0, 0, 1});
    CHECK(clip->at_key(1)[0] == Point{0, 0, 5});
    // Weights at 0.25 s, by the Hermite polynomials; the sum of both targets is the height.
    CHECK(clip->at(0.25)[0][2] == doctest::Approx(*interpolation == 'L'   ? 2
                                                  : *interpolation == 'S' ? 1
                                                                          : 3.3125));
    CHECK(clip->curves() == std::vector{*interpolation == 'L'   ? MorphCurve::linear
                                        : *interpolation == 'S' ? MorphCurve::held
                                                                : MorphCurve::other});
    CHECK(clip->notes().empty());
    CHECK(clip->targets() == std::vector<std::string>{"target 1", "target 2"});
    const auto warnings = test::read_kept(parts.glb(), "glb").warnings;
    REQUIRE(warnings.size() == 1);
    CHECK(mentions(warnings[0], "the animation of morph targets is ignored"));
  }
  CHECK_THROWS_WITH_AS(clip_of(back, plain, "LINEAR"), doctest::Contains("do not increase"), base::Error);
  CHECK_THROWS_WITH_AS(clip_of(input, nan, "LINEAR"), doctest::Contains("not finite"), base::Error);
  CHECK_THROWS_WITH_AS(clip_of(input, cubic, "LINEAR"),
                       doctest::Contains("12 weights for 2 times and 2 targets"), base::Error);
  CHECK_THROWS_AS(clip_of(99, plain, "LINEAR"), base::Error);
  parts.json["accessors"][delta]["count"] = 7;
  const auto short_one = clip_of(input, plain, "LINEAR");
  CHECK_THROWS_WITH_AS(short_one->at_key(0), doctest::Contains("7 differences for 8 positions"), base::Error);
}

TEST_CASE("far_floats_of_a_file_round_moved_and_animated_positions_and_the_notes_state_the_error") {
  const test::TemporaryFolder folder;
  test::GltfParts parts = test::patch();
  std::vector<float> far = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 2, 0, 0, 1, 1, 0, 2, 1, 0};
  for (std::size_t i = 0; i < far.size(); ++i) far[i] += i % 3 == 1 ? 5411987.0f : 431234.0f;
  parts.primitive()["attributes"]["POSITION"] = parts.accessor(far, 5126, "VEC3", 3);
  const ReadResult r = test::put_and_read(folder / "far.glb", parts.glb());
  std::vector<mesh::Point> moved = r.surface.positions;
  for (mesh::Point& p : moved) p[1] += 0.2;  // floats are 0.5 apart there
  const auto stated = [](const std::vector<std::string>& notes) {
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].starts_with("the number type of the file rounds coordinates by up to 0.2 ("));
  };
  stated(write(folder / "moved.glb", {r.surface, moved, {}}, r.original.get(), {}));
  CHECK(read(folder / "moved.glb").surface.positions == r.surface.positions);
  stated(test::write_morphs(folder / "played.glb", {r.surface, r.surface.positions, {}}, r.original.get(),
                            {"a", {{0, "", r.surface.positions}, {1, "", moved}}}));
}
