#include "formats/point_cache.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;

namespace {

// Returns the coordinates of a frame. The coordinates of all frames are 0, 0.25, 0.5, 0.75 and so on.
std::vector<float> cache_frame(std::size_t frame, std::size_t points = 2) {
  std::vector<float> values(3 * points);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(3 * points * frame + i) / 4;
  return values;
}

PointCacheHead cache_head(PointCacheFormat format, std::size_t frames, std::size_t points = 2) {
  PointCacheHead head{format, points, frames, 5, 0.5F};
  for (std::size_t i = 0; i < frames && format == PointCacheFormat::mdd; ++i)
    head.seconds.push_back(static_cast<float>(i) / 8);
  return head;
}

void write_cache(const std::filesystem::path& path, const PointCacheHead& head) {
  std::vector<float> positions;
  write_point_cache(path, head, [&](std::size_t i) {
    return std::span<const float>(positions = cache_frame(i, head.points));
  });
}

std::string cache_refusal(const std::string& bytes) {
  try {
    PointCache("given", bytes);
  } catch (const base::Error& error) {
    CHECK(error.place().starts_with("given"));
    CHECK(!error.advice().empty());
    return error.what();
  }
  return {};
}

void put_cache_word(std::string& bytes, std::size_t at, std::initializer_list<unsigned> values) {
  for (const unsigned value : values) bytes[at++] = static_cast<char>(value);
}

}  // namespace

TEST_CASE("pc2_is_little_endian_with_a_header") {
  const test::TemporaryFolder folder;
  write_cache(folder / "a.pc2", cache_head(PointCacheFormat::pc2, 3));
  const std::string bytes = test::file_bytes(folder / "a.pc2");
  REQUIRE(bytes.size() == 32 + 3 * 24);
  const char head[] =
      "POINTCACHE2\0"
      "\x01\0\0\0"
      "\x02\0\0\0"
      "\0\0\xA0\x40"  // 5
      "\0\0\0\x3F"    // 0.5
      "\x03\0\0\0";
  CHECK(bytes.substr(0, 32) == std::string(head, 32));
  CHECK(bytes.substr(32 + 4, 4) == std::string("\0\0\x80\x3E", 4));  // 0.25
}

TEST_CASE("mdd_is_big_endian_with_the_time_of_every_frame") {
  const test::TemporaryFolder folder;
  write_cache(folder / "a.mdd", cache_head(PointCacheFormat::mdd, 3));
  const std::string bytes = test::file_bytes(folder / "a.mdd");
  REQUIRE(bytes.size() == 8 + 3 * 4 + 3 * 24);
  CHECK(bytes.substr(0, 8) == std::string("\0\0\0\x03\0\0\0\x02", 8));
  CHECK(bytes.substr(12, 4) == std::string("\x3E\0\0\0", 4));        // 0.125 s
  CHECK(bytes.substr(20 + 4, 4) == std::string("\x3E\x80\0\0", 4));  // 0.25
}

TEST_CASE("caches_are_read_as_they_were_written") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.pc2", "a.mdd"}) {
    const auto head = cache_head(*point_cache_format(name), 4, 3);
    write_cache(folder / name, head);
    const PointCache cache(folder / name);
    CHECK(cache.warnings().empty());
    CHECK(cache.head().format == head.format);
    CHECK(cache.head().points == 3);
    REQUIRE(cache.head().frames == 4);
    CHECK(cache.head().seconds == head.seconds);
    if (head.format == PointCacheFormat::pc2) CHECK(cache.head().start == 5);
    if (head.format == PointCacheFormat::pc2) CHECK(cache.head().rate == 0.5F);
    for (std::size_t i = 4; i-- > 0;) {
      const auto expected = cache_frame(i, 3);
      const auto points = cache.frame(i);
      REQUIRE(points.size() == 3);
      for (std::size_t k = 0; k < 9; ++k) CHECK(points[k / 3][k % 3] == static_cast<double>(expected[k]));
    }
    const std::string bytes = test::file_bytes(folder / name);
    CHECK(PointCache("in memory", bytes).frame(2) == cache.frame(2));
  }
  CHECK_FALSE(point_cache_format("a.obj"));
  CHECK(point_cache_format("A.PC2") == PointCacheFormat::pc2);
}

TEST_CASE("truncated_and_hostile_caches_are_rejected_before_allocation") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.pc2", "a.mdd"}) {
    write_cache(folder / name, cache_head(*point_cache_format(name), 3));
    const std::string bytes = test::file_bytes(folder / name);
    CHECK(cache_refusal(bytes) == "");
    for (std::size_t size = 0; size < bytes.size(); ++size) CHECK(cache_refusal(bytes.substr(0, size)) != "");
    const std::size_t counts[] = {bytes[0] == 'P' ? 16UL : 0UL, bytes[0] == 'P' ? 28UL : 4UL};
    for (const std::size_t at : counts) {
      for (const unsigned byte : {0xFFU, 0x7FU, 0U}) {  // negative, about two billion, 0
        std::string bad = bytes;
        put_cache_word(bad, at, {byte, byte, byte, byte});
        CHECK(cache_refusal(bad) != "");
      }
    }
    std::string both = bytes;
    for (const std::size_t at : counts) put_cache_word(both, at, {0x7F, 0x7F, 0x7F, 0x7F});
    CHECK(cache_refusal(both) != "");
  }
  CHECK(test::mentions(cache_refusal(test::file_bytes(folder / "a.pc2").substr(0, 60)),
                       "the file is truncated: it contains 1 of 3 frames of 2 points"));
  CHECK(test::mentions(cache_refusal("version https://git-lfs.github.com/spec/v1\noid"), "Git LFS pointer"));
  CHECK(test::mentions(cache_refusal("v 1 2 3\nv 4 5 6\n"), "check that it is the right file"));
  CHECK_THROWS_AS(PointCache(folder / "none.pc2"), base::Error);
  CHECK_THROWS_AS(PointCache(folder.path()), base::Error);
}

TEST_CASE("non_finite_numbers_are_reported_by_frame_and_point") {
  const test::TemporaryFolder folder;
  write_cache(folder / "a.pc2", cache_head(PointCacheFormat::pc2, 3));
  std::string bytes = test::file_bytes(folder / "a.pc2");
  put_cache_word(bytes, 32 + 24 + 16, {0, 0, 0x80, 0x7F});  // an infinite number
  const PointCache cache("given", bytes);
  CHECK(cache.frame(0).size() == 2);
  CHECK_THROWS_WITH_AS(cache.frame(1), doctest::Contains("given: frame 1: the position of point 1 is not"),
                       base::Error);
  put_cache_word(bytes, 24, {0, 0, 0xC0, 0x7F});  // a NaN rate
  bytes += "more";
  const PointCache odd("given", bytes);
  CHECK(odd.head().rate == 1);
  CHECK(odd.warnings().size() == 2);
  write_cache(folder / "a.mdd", cache_head(PointCacheFormat::mdd, 3));
  bytes = test::file_bytes(folder / "a.mdd");
  put_cache_word(bytes, 12, {0x7F, 0xC0, 0, 0});
  CHECK(test::mentions(cache_refusal(bytes), "frame 1: the time is not finite"));
}

TEST_CASE("failed_cache_write_keeps_the_old_file") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a.pc2", "older");
  const auto head = cache_head(PointCacheFormat::pc2, 2);
  const auto refused = [&](const std::vector<float>& frame, const char* why) {
    CHECK_THROWS_WITH_AS(
        write_point_cache(folder / "a.pc2", head, [&](std::size_t) { return std::span(frame); }),
        doctest::Contains(why), base::Error);
  };
  refused(cache_frame(0, 3), "frame 0: there are 3 points for 2");
  auto bad = cache_frame(0);
  bad[4] = std::numeric_limits<float>::infinity();
  refused(bad, "frame 0: the position of vertex 1");
  {
    const test::FullDisk full(40);
    CHECK_THROWS_AS(write_cache(folder / "a.pc2", head), base::Error);
  }
  for (const auto& none : {cache_head(PointCacheFormat::pc2, 0), cache_head(PointCacheFormat::pc2, 1, 0)})
    CHECK_THROWS_AS(write_cache(folder / "a.pc2", none), base::Error);
  auto timeless = cache_head(PointCacheFormat::mdd, 2);
  timeless.seconds.pop_back();
  CHECK_THROWS_AS(write_cache(folder / "a.mdd", timeless), base::Error);
  CHECK(test::file_bytes(folder / "a.pc2") == "older");
  CHECK(folder.entries() == 1);
}
