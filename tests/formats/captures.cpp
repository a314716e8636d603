#include "formats/captures.h"

#include <cmath>
#include <limits>

#include "formats/codecs.h"
#include "formats/write.h"

using namespace viete;
using namespace viete::formats;
using viete::mesh::Point;
using viete::mesh::Splats;
using viete::test::CapturePly;
using viete::test::mentions;
using viete::test::posed_bytes;

namespace {

constexpr const char* ply_formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

CapturePly capture(const char* format, std::size_t harmonics = 45) {
  CapturePly ply;
  ply.format = format;
  return ply.with(harmonics);
}

bool warns(const ReadResult& read, const std::string& text) {
  return std::ranges::any_of(read.warnings, [&](const std::string& w) { return mentions(w, text); });
}

}  // namespace

TEST_CASE("ply_captures_give_splats_in_every_format_order_and_degree") {
  for (const char* format : ply_formats)
    for (const int degree : {0, 1, 2, 3}) {
      CapturePly ply = capture(format, static_cast<std::size_t>(3 * degree * (degree + 2)));
      ply.names.insert(ply.names.begin(), "confidence");
      ply.names.emplace_back("label");
      std::ranges::reverse(ply.names);
      const ReadResult r = test::read_kept(ply.bytes(), "ply");
      REQUIRE(r.splats);
      const Splats& s = *r.splats;
      CHECK(s.degree == degree);
      CHECK(s.size() == ply.count);
      CHECK(s.harmonics.size() == 3 * s.bands() * ply.count);
      CHECK(r.original->capture() == Capture::splats);
      CHECK(r.warnings.empty());
      CHECK(!r.attributes);  // normals of captures mean nothing
      for (std::size_t v = 0; v < ply.count; ++v) {
        CHECK(r.surface.positions[v] ==
              Point{ply.value(v, ply.at("x")), ply.value(v, ply.at("y")), ply.value(v, ply.at("z"))});
        CHECK(s.opacities[v] == ply.value(v, ply.at("opacity")));
        CHECK(s.log_scales[v][2] == ply.value(v, ply.at("scale_2")));
        CHECK(s.rotations[v][1] == ply.value(v, ply.at("rot_1")));
        CHECK(s.colors[v][0] == ply.value(v, ply.at("f_dc_0")));
        for (std::size_t k = 0; k < 3 * s.bands(); ++k)
          CHECK(s.harmonics[3 * s.bands() * v + k] == ply.value(v, ply.at("f_rest_" + std::to_string(k))));
      }
    }
}

TEST_CASE("unmoved_ply_captures_keep_every_byte") {
  for (const char* format : ply_formats) {
    CapturePly ply = capture(format, 9);
    ply.names.emplace_back("label");
    ply.after = "element camera 1\nproperty uchar a\nproperty uchar b\n";
    ply.tail = std::string(format) == "ascii" ? "65 66\n" : "AB";
    const std::string bytes = ply.bytes();
    const ReadResult r = test::read_kept(bytes, "ply");
    CHECK(posed_bytes(r, r.surface.positions, nullptr) == bytes);
    CHECK(posed_bytes(r, r.surface.positions, r.splats.get()) == bytes);
  }
}

TEST_CASE("posed_ply_captures_change_only_numbers_that_differ") {
  for (const char* format : ply_formats) {
    CapturePly ply = capture(format, 24);
    ply.names.insert(ply.names.begin() + 1, "label");
    ply.before += "element lens 1\nproperty uchar f\n";
    ply.lead = std::string(format) == "ascii" ? "66\n" : "B";
    ply.after = "element camera 1\nproperty uchar a\n";
    ply.tail = std::string(format) == "ascii" ? "65\n" : "A";
    const ReadResult r = test::read_kept(ply.bytes(), "ply");
    std::vector<Point> positions = r.surface.positions;
    Splats splats = *r.splats;
    positions[1] = {7.5, -0.25, 3};
    splats.rotations[1] = {0.5F, 0.25F, -0.5F, 0.75F};
    splats.log_scales[2][1] = -3.25F;
    splats.harmonics[2 * 24 + 5] = 0.625F;
    splats.colors[3][2] = std::nanf("");  // an invalid number keeps the number in the file
    CapturePly wanted = ply;
    wanted.value = [&](std::size_t v, std::size_t p) {
      const std::string& name = ply.names[p];
      if (v == 1 && name.size() == 1) return static_cast<float>(positions[1][name[0] - 'x']);
      if (v == 1 && name.starts_with("rot_")) return splats.rotations[1][name[4] - '0'];
      if (v == 2 && name == "scale_1") return -3.25F;
      if (v == 2 && name == "f_rest_5") return 0.625F;
      return ply.value(v, p);
    };
    CHECK(posed_bytes(r, positions, &splats) == wanted.bytes());
  }
}

TEST_CASE("split_splats_repeat_the_other_properties_of_their_source") {
  for (const char* format : ply_formats) {
    CapturePly ply = capture(format, 0);
    ply.names.emplace_back("label");
    const ReadResult r = test::read_kept(ply.bytes(), "ply");
    const std::vector<std::uint32_t> sources = {0, 1, 1, 2, 3, 3, 3};
    std::vector<Point> positions;
    Splats splats;
    for (const std::uint32_t s : sources) {
      positions.push_back(r.surface.positions[s]);
      splats.log_scales.push_back(r.splats->log_scales[s]);
      splats.rotations.push_back(r.splats->rotations[s]);
      splats.opacities.push_back(r.splats->opacities[s]);
      splats.colors.push_back(r.splats->colors[s]);
    }
    positions[2][1] = 11.5;
    CapturePly wanted = ply;
    wanted.count = sources.size();
    wanted.value = [&](std::size_t v, std::size_t p) {
      return v == 2 && ply.names[p] == "y" ? 11.5F : ply.value(sources[v], p);
    };
    CHECK(posed_bytes(r, positions, &splats, sources) == wanted.bytes());
  }
}

TEST_CASE("unusual_numbers_of_splats_are_read_and_come_back") {
  const float special[] = {
      std::nanf(""), INFINITY, -INFINITY, 0, -0.0F, 80, -80, 1e-42F, std::numeric_limits<float>::max()};
  for (const char* format : ply_formats) {
    CapturePly ply = capture(format, 9);
    ply.count = std::size(special);
    ply.value = [&](std::size_t v, std::size_t p) { return p < 3 ? static_cast<float>(v) : special[v]; };
    const ReadResult r = test::read_kept(ply.bytes(), "ply");
    CHECK(std::isnan(r.splats->log_scales[0][0]));
    CHECK(r.splats->rotations[3] == std::array<float, 4>{0, 0, 0, 0});
    CHECK(r.splats->log_scales[5][2] == 80);
    CHECK(r.splats->log_scales[6][1] == -80);
    CHECK(posed_bytes(r, r.surface.positions, r.splats.get()) == ply.bytes());
    ply.value = [](std::size_t, std::size_t p) { return p == 1 ? std::nanf("") : 0.0F; };
    CHECK(mentions(test::refusal(ply.bytes(), "ply"), "not a finite number"));
  }
}

TEST_CASE("numbers_of_splats_may_have_any_type") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar opacity\nproperty double scale_0\nproperty int scale_1\nproperty half_a\n";
  CHECK(!test::refusal(text, "ply").empty());
  const std::string bytes =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar opacity\nproperty double scale_0\nproperty int scale_1\nproperty short "
      "scale_2\nproperty "
      "char rot_0\nproperty float rot_1\nproperty float rot_2\nproperty float rot_3\nend_header\n"
      "0 0 0 3 -4.125 -5 -6 1 0 0 0\n 1.50 0 0 4 -4.5 -5 -6 1 0 0 0\n";
  const ReadResult r = test::read_kept(bytes, "ply");
  CHECK(r.splats->log_scales[0] == std::array<float, 3>{-4.125F, -5, -6});
  CHECK(warns(r, "no colours (f_dc_0 to f_dc_2)"));
  CHECK(r.splats->colors[1] == std::array<float, 3>{0, 0, 0});
  Splats splats = *r.splats;
  splats.log_scales[1] = {-4.25F, -5.75F, -6};
  splats.opacities[0] = 7;
  std::string wanted = bytes;
  wanted.replace(wanted.find("0 0 0 3 "), 8, "0 0 0 7 ");
  wanted.replace(wanted.find("-4.5 -5 -6"), 7, "-4.25 -6");
  CHECK(posed_bytes(r, r.surface.positions, &splats) == wanted);
  splats.opacities[1] = 300;
  CHECK_THROWS_WITH_AS(posed_bytes(r, r.surface.positions, &splats),
                       doctest::Contains("the new value of opacity exceeds the range"), base::Error);
}

TEST_CASE("incomplete_harmonics_are_kept_and_whole_bands_are_read") {
  const std::tuple<std::size_t, int, bool> counts[] = {{9, 1, false}, {12, 1, true}, {10, 0, true},
                                                       {72, 3, true}, {3, 0, true},  {0, 0, false}};
  for (const auto& [harmonics, degree, noted] : counts) {
    CapturePly ply = capture("binary_little_endian", harmonics);
    const ReadResult r = test::read_kept(ply.bytes(), "ply");
    CHECK(r.splats->degree == degree);
    CHECK(warns(r, "are kept, but neither drawn nor turned") == noted);
    CHECK(posed_bytes(r, r.surface.positions, r.splats.get()) == ply.bytes());
    if (degree > 0)  // green starts after all harmonics of red in the file
      CHECK(r.splats->harmonics[r.splats->bands()] ==
            ply.value(0, ply.at("f_rest_" + std::to_string(harmonics / 3))));
  }
}

TEST_CASE("truncated_captures_are_refused_at_every_boundary") {
  for (const char* format : ply_formats) {
    const std::string bytes = capture(format, 9).bytes();
    const bool ascii = std::string(format) == "ascii";  // the last number of a text can be cut unnoticed
    const std::size_t last = ascii ? bytes.find_last_of(' ', bytes.size() - 3) : bytes.size() - 1;
    for (std::size_t size = 4; size <= last; ++size)
      CHECK(!test::refusal(bytes.substr(0, size), "ply").empty());
  }
}

TEST_CASE("captures_of_kinds_that_are_not_read_are_refused_by_name") {
  const std::string binary("\1\2\0\3\4\0\0\0", 8);
  for (const char* extension : {"splat", "ksplat", "sog", "lcc"}) {
    const std::string found = test::refusal(binary, extension);
    CHECK_MESSAGE(mentions(found, std::string("a capture (Gaussian splats) in a")), found);
    CHECK_MESSAGE(mentions(found, std::string(".") + extension + " file"), found);
    CHECK(mentions(found, "export it as PLY"));
  }
  CHECK(mentions(test::refusal("PK\3\4meta.json", "sog"), "in a .sog file"));
  CHECK(mentions(test::refusal("version https://git-lfs.github.com/spec/v1", "splat"), "Git LFS pointer"));
  CHECK(mentions(test::refusal("NGSP" + binary, "spz"), "SPZ version 4 or later"));
  const std::string compressed =
      "ply\nformat binary_little_endian 1.0\nelement chunk 0\nproperty float min_x\nelement vertex 1\n"
      "property uint packed_position\nproperty uint packed_rotation\nproperty uint packed_scale\n"
      "property uint packed_color\nend_header\n" +
      std::string(16, 'x');
  CHECK(mentions(test::refusal(compressed, "ply"), "a capture (Gaussian splats) in a compressed PLY file"));
}

TEST_CASE("captures_in_formats_without_splats_are_points_and_a_note") {
  const test::TemporaryFolder folder;
  const ReadResult r = test::read_kept(capture("ascii").bytes(), "ply");
  for (const char* name : {"a.obj", "a.off", "a.glb"}) {
    const auto notes = write(folder / name, {r.surface, r.surface.positions, {}, nullptr, r.splats.get()},
                             r.original.get(), {});
    REQUIRE(notes.size() == 1);
    CHECK(mentions(notes[0], "sizes, rotations, opacities and colours of splats, comments"));
    CHECK_FALSE(mentions(notes[0], "f_rest"));
    CHECK(read(folder / name).surface.positions.size() == 4);
  }
  CHECK_THROWS_AS(write(folder / "a.stl", {r.surface, r.surface.positions, {}}, r.original.get(), {}),
                  base::Error);
  CHECK_THROWS_WITH_AS(write(folder / "a.spz", test::cube()),
                       doctest::Contains("SPZ stores only Gaussian splats"), base::Error);
  const auto moved = test::moved(r.surface, 2).positions;
  for (const char* name : {"b.ply", "b.obj", "b.spz"})
    CHECK_THROWS_WITH_AS(write(folder / name, {r.surface, moved, {}}, r.original.get(), {}),
                         doctest::Contains("a capture (Gaussian splats)"), base::Error);
}

TEST_CASE("captures_are_written_in_the_usual_order") {
  const ReadResult r = test::read_kept(capture("ascii", 24).bytes(), "ply");
  const std::string bytes = written_text([&](TextWriter& out) {
    write_ply({r.surface, r.surface.positions, {}, nullptr, r.splats.get()}, out);
  });
  CapturePly usual = capture("binary_little_endian", 24);
  usual.before.clear();
  usual.value = [value = usual.value](std::size_t v, std::size_t p) {
    return p > 2 && p < 6 ? 0 : value(v, p);
  };
  CHECK(bytes == usual.bytes());
}
