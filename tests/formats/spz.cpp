#include <zlib.h>

#include <cmath>

#include "base/error.h"
#include "formats/captures.h"
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

// Independent of the code under test: zlib's functions for whole buffers.
std::string zipped(const std::string& content) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string out(deflateBound(&stream, static_cast<uLong>(content.size())) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

std::string unzipped(const std::string& bytes) {
  std::string out(1 << 20, '\0');
  z_stream stream{};
  REQUIRE(inflateInit2(&stream, 16 + MAX_WBITS) == Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  REQUIRE(inflate(&stream, Z_FINISH) == Z_STREAM_END);
  out.resize(out.size() - stream.avail_out);
  inflateEnd(&stream);
  return out;
}

std::string header(std::uint32_t version, std::uint32_t count, int degree, int fractional_bits) {
  std::string bytes = "NGSP";
  test::append(bytes, version);
  test::append(bytes, count);
  for (const int byte : {degree, fractional_bits, 0, 0}) bytes += static_cast<char>(byte);
  return bytes;
}

// Any bytes are a valid content.
std::string content(std::uint32_t version, std::uint32_t count, int degree) {
  const int row = 16 + (version == 2 ? 3 : 4) + 3 * degree * (degree + 2);
  std::string bytes = header(version, count, degree, 12);
  for (std::uint32_t i = 0; i < count * static_cast<std::uint32_t>(row); ++i)
    bytes += static_cast<char>((i * 2654435761U) >> 24);
  return bytes;
}

bool near(double a, double b, double tolerance = 1e-6) {
  return std::abs(a - b) <= tolerance;
}

}  // namespace

// The numbers follow by hand from the README of the specification; see read_spz() for the axes.
TEST_CASE("spz_numbers_are_those_of_the_specification") {
  for (const std::uint32_t version : {2U, 3U}) {
    std::string bytes = header(version, 1, 1, 8);
    bytes += std::string("\x80\x01\0\0\xFF\xFF\x01\0\0", 9);  // 384, -256 and 1 of 2^-8
    bytes += '\x80';                                          // alpha 128 of 255
    bytes += std::string("\0\x80\xFF", 3);
    bytes += std::string("\0\xA0\xFF", 3);
    if (version == 2) {
      bytes += std::string("\xFF\x80\x7F", 3);  // x = 1, and nearly 0 for y and z
    } else {
      // The largest is w (3); then x = sqrt(1/2), y = 0, z = -sqrt(1/2) 256 / 511.
      test::append(bytes, std::uint32_t{3U << 30 | 511U << 20 | 0U << 10 | (512U | 256U)});
    }
    bytes += std::string("\xC0\x40\x80\x00\xFF\x90\x20\x30\x50", 9);  // y, z, x: red, green, blue
    const ReadResult r = test::read_text(zipped(bytes), "spz");
    CHECK(r.format == "SPZ version " + std::to_string(version));
    CHECK(r.surface.positions[0] == Point{1.5, 1, -1 / 256.0});
    REQUIRE(r.splats);
    const Splats& s = *r.splats;
    CHECK(near(s.opacities[0], std::log(128.0 / 127)));
    CHECK(near(s.colors[0][0], -0.5 / 0.15));
    CHECK(near(s.colors[0][2], 0.5 / 0.15));
    CHECK(s.log_scales[0] == std::array<float, 3>{-10, 0, 5.9375F});
    const auto& q = s.rotations[0];
    if (version == 2) {
      CHECK(near(q[1], 1));
      CHECK(near(q[2], -1 / 255.0));
      CHECK(near(q[3], 1 / 255.0));
    } else {
      const double z = std::sqrt(0.5) * 256 / 511;
      CHECK(near(q[0], std::sqrt(0.5 - z * z)));
      CHECK(near(q[1], std::sqrt(0.5)));
      CHECK(q[2] == 0);
      CHECK(near(q[3], z));
    }
    CHECK(s.degree == 1);
    // y and z change their signs. Red: 192, 0, 32 of 128.
    CHECK(s.harmonics ==
          std::vector<float>{-0.5F, 1, -0.75F, 0.5F, -127 / 128.0F, -0.625F, 0, -0.125F, -0.375F});
  }
}

TEST_CASE("unmoved_spz_keeps_every_byte") {
  for (const std::uint32_t version : {2U, 3U})
    for (int degree = 0; degree <= 4; ++degree) {
      const std::string bytes = zipped(content(version, 50, degree) + "extensions");
      const ReadResult r = test::read_kept(bytes, "spz");
      CHECK(r.splats->degree == std::min(degree, 3));
      CHECK(r.splats->size() == 50);
      CHECK(std::ranges::any_of(r.warnings, [](const auto& w) {
              return mentions(w, "harmonics above degree 3");
            }) == (degree == 4));
      CHECK(posed_bytes(r, r.surface.positions, nullptr) == bytes);
      CHECK(posed_bytes(r, r.surface.positions, r.splats.get()) == bytes);
    }
}

TEST_CASE("posed_spz_changes_only_bytes_of_numbers_that_differ") {
  for (const std::uint32_t version : {2U, 3U})
    for (int degree = 0; degree <= 4; ++degree) {
      const std::string packed = content(version, 20, degree);
      const ReadResult r = test::read_kept(zipped(packed + "tail"), "spz");
      std::vector<Point> positions = r.surface.positions;
      Splats splats = *r.splats;
      positions[3] = {1.5, -2.25, 0.125};
      splats.rotations[4] = {0.8F, 0, -0.6F, 0};
      splats.log_scales[5] = {-4, -80, 80};
      splats.opacities[6] = 0;
      splats.log_scales[7][0] = std::nanf("");
      if (degree > 0) splats.harmonics[3 * splats.bands() * 8] = 0.5F;
      const std::string again = unzipped(posed_bytes(r, positions, &splats));
      std::string wanted = packed + "tail";
      const auto put = [&](std::size_t at, std::string_view bytes) {
        wanted.replace(at, bytes.size(), bytes);
      };
      put(16 + 27, std::string_view("\0\x18\0\0\x24\0\0\xFE\xFF", 9));
      const std::size_t alphas = 16 + 180, scales = alphas + 80, rotations = scales + 60;
      const std::size_t width = version == 2 ? 3 : 4, harmonics = rotations + 20 * width;
      put(alphas + 6, "\x80");
      put(scales + 15, std::string_view("\x60\0\xFF", 3));
      if (version == 2) {
        put(rotations + 12, "\x80\xCC\x80");  // x 0, y 0.6, z 0: 127.5 (1 + 0.6) = 204
      } else {
        std::string word;  // largest w; y: 511 * 0.6 / sqrt(1/2) = 433.6
        test::append(word, std::uint32_t{3U << 30 | 434U << 10});
        put(rotations + 16, word);
      }
      if (degree > 0) put(harmonics + 8U * 3U * static_cast<std::size_t>(degree * (degree + 2)), "\x40");
      CHECK(again == wanted);
      const ReadResult back = test::read_text(zipped(again), "spz");
      CHECK(back.surface.positions == positions);
    }
}

TEST_CASE("split_splats_of_spz_repeat_their_source") {
  const std::string packed = content(3, 3, 4);
  const ReadResult r = test::read_kept(zipped(packed), "spz");
  const std::vector<std::uint32_t> sources = {2, 0, 0, 1};
  std::vector<Point> positions;
  for (const std::uint32_t s : sources) positions.push_back(r.surface.positions[s]);
  const std::string again = unzipped(posed_bytes(r, positions, nullptr, sources));
  REQUIRE(again.size() == 16 + 4 * (20 + 72));
  std::size_t from = 16, to = 16;
  CHECK(again.substr(0, 16) == header(3, 4, 4, 12));
  for (const std::size_t size : {9, 1, 3, 3, 4, 72}) {
    for (std::size_t v = 0; v < 4; ++v)
      CHECK(again.substr(to + size * v, size) == packed.substr(from + size * sources[v], size));
    from += 3 * size;
    to += 4 * size;
  }
}

TEST_CASE("captures_convert_between_ply_and_spz_within_the_precision_of_spz") {
  const test::TemporaryFolder folder;
  CapturePly ply;
  ply.count = 300;
  ply.with(45).value = [](std::size_t v, std::size_t p) {
    return std::sin(static_cast<float>(7 * v + p * p)) * (p < 3 ? 2.9F : 0.95F);
  };
  const ReadResult r = test::read_kept(ply.bytes(), "ply");
  const auto notes = write(folder / "a.spz", {r.surface, r.surface.positions, {}, nullptr, r.splats.get()},
                           r.original.get(), {});
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "left out of the SPZ file: comments");
  const ReadResult spz = read(folder / "a.spz");
  REQUIRE(spz.splats);
  const Splats &a = *r.splats, &b = *spz.splats;
  REQUIRE(b.size() == 300);
  REQUIRE(b.degree == 3);
  for (std::size_t v = 0; v < 300; ++v) {
    double sum = 0, size = 0, dot = 0;
    for (const float x : a.rotations[v]) sum += x * x;
    for (std::size_t i = 0; i < 4; ++i) dot += a.rotations[v][i] * b.rotations[v][i] / std::sqrt(sum);
    for (const float x : b.rotations[v]) size += x * x;
    CHECK(near(size, 1, 1e-6));
    CHECK(std::abs(dot) > 1 - 1e-5);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(near(r.surface.positions[v][i], spz.surface.positions[v][i], 5e-7));  // 2.9 in 23 bits
      CHECK(near(a.log_scales[v][i], b.log_scales[v][i], 0.032));
      CHECK(near(a.colors[v][i], b.colors[v][i], 0.014));
    }
    CHECK(near(a.opacities[v], b.opacities[v], 0.011));
  }
  for (std::size_t k = 0; k < a.harmonics.size(); ++k) CHECK(near(a.harmonics[k], b.harmonics[k], 0.0040));
  write(folder / "b.ply", {spz.surface, spz.surface.positions, {}, nullptr, spz.splats.get()},
        spz.original.get(), {});
  const ReadResult back = read(folder / "b.ply");
  CHECK(back.surface.positions == spz.surface.positions);
  CHECK(back.splats->rotations == b.rotations);
  CHECK(back.splats->harmonics == b.harmonics);
  CHECK(is_certainly_spz(Beginning(folder / "a.spz")));
}

TEST_CASE("invalid_splats_are_written_as_valid_spz") {
  Splats s;
  s.log_scales = {{std::nanf(""), INFINITY, -INFINITY}};
  s.rotations = {{0, 0, 0, 0}};
  s.opacities = {-INFINITY};
  s.colors = {{std::nanf(""), 1e30F, -1e30F}};
  const mesh::Surface surface = test::read_text("v 0 0 0\n", "obj").surface;
  const ReadResult r = test::read_text(written_text([&](TextWriter& out) {
                                         write_spz({surface, surface.positions, {}, nullptr, &s}, out);
                                       }),
                                       "spz");
  CHECK(r.surface.positions == surface.positions);
  CHECK(r.splats->log_scales[0] == std::array<float, 3>{-10, 5.9375F, -10});
  CHECK(near(r.splats->rotations[0][0], 1));
  CHECK(near(1 / (1 + std::exp(-r.splats->opacities[0])), 0.001, 1e-4));
}

TEST_CASE("hostile_spz_files_are_refused_before_memory_is_allocated") {
  const std::string bomb = zipped(header(3, 4'000'000'000U, 3, 12) + std::string(1 << 20, '\0'));
  test::check_refusals("spz",
                       {{bomb, "announces 4000000000 splats, the file has room for at most"},
                        {zipped(header(3, 1, 0, 12) + std::string(100 << 20, '\0')), "damaged or ends early"},
                        {zipped(header(3, 0, 0, 12)), "no vertices"},
                        {zipped(header(1, 1, 0, 12)), "SPZ version 1, only versions 2 and 3"},
                        {zipped(header(4, 1, 0, 12)), "SPZ version 4, only versions 2 and 3"},
                        {zipped(header(3, 1, 5, 12)), "harmonics of degree 5"},
                        {zipped(header(3, 1, 0, 24)), "24 fractional bits"},
                        {zipped("NGSP"), "ends within its header"},
                        {zipped("other"), "a compressed file (gzip)"}});
}

TEST_CASE("truncated_or_damaged_spz_files_are_refused") {
  const std::string bytes = zipped(content(3, 5, 1));
  for (std::size_t size = 20; size < bytes.size(); ++size)
    CHECK(!test::refusal(bytes.substr(0, size), "spz").empty());
  std::string damaged = bytes;
  damaged[damaged.size() - 6] ^= 1;  // the checksum
  CHECK(mentions(test::refusal(damaged, "spz"), "damaged or ends early"));
  const std::string packed = content(3, 5, 1);
  for (std::size_t size = 16; size < packed.size(); ++size)
    CHECK(!test::refusal(zipped(packed.substr(0, size)), "spz").empty());
}

TEST_CASE("spz_positions_beyond_the_range_of_the_file_are_refused") {
  const ReadResult r = test::read_kept(zipped(content(3, 5, 0)), "spz");
  std::vector<Point> positions = r.surface.positions;
  positions[2][1] = 1e5;
  CHECK_THROWS_WITH_AS(posed_bytes(r, positions, r.splats.get()),
                       doctest::Contains("splat 2: the coordinate 100000 exceeds the range of this SPZ file"),
                       base::Error);
}
