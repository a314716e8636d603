#include "base/numbered_files.h"

#include "base/error.h"
#include "support/folder.h"

using namespace viete;
using base::NumberedFile;
using base::NumberedName;

TEST_CASE("a_pattern_names_the_files_of_a_sequence") {
  CHECK(NumberedName("a/frame_####.obj").file(7) == "a/frame_0007.obj");
  CHECK(NumberedName("#.ply").file(12345) == "12345.ply");
  CHECK(NumberedName("a_####.ply").file(-7) == "a_-007.ply");
  CHECK(NumberedName("a#b/c#.ply").file(3) == "a#b/c3.ply");  // the mark in the folder is not a placeholder
  CHECK(std::filesystem::path(NumberedName("x/a_###.obj").pattern()) == "x/a_###.obj");
}

TEST_CASE("a_pattern_without_one_place_for_the_number_is_refused_with_an_example") {
  for (const char* bad : {"frame.obj", "a#_#.obj", "####/a.obj", ""}) {
    try {
      NumberedName name{std::filesystem::path(bad)};
      FAIL_CHECK(bad);
    } catch (const base::Error& error) {
      CHECK(error.place() == bad);
      CHECK(error.advice().find("frame_####") != std::string::npos);
    }
  }
  CHECK(NumberedName::is_pattern("a_#.obj"));
  CHECK_FALSE(NumberedName::is_pattern("a_#/b.obj"));
}

TEST_CASE("numbers_are_read_back_only_from_generated_names") {
  const NumberedName name("frame_###.obj");
  for (const std::int64_t n : {0LL, 1LL, 999LL, 1000LL, 123456789012LL, -1LL, -12345LL})
    CHECK(name.number(name.file(n).string()) == n);
  for (const char* other : {"frame_1.obj", "frame_0001.obj", "frame_abc.obj", "frame_.obj", "frame_001.ply",
                            "frame_001.obj.bak", "frame_+01.obj", "frame_99999999999999999999.obj"})
    CHECK_MESSAGE(!name.number(other), other);
}

TEST_CASE("files_of_a_sequence_are_found_by_number") {
  const test::TemporaryFolder folder;
  const NumberedName name(folder / "f_##.obj");
  CHECK(name.find().empty());
  CHECK(NumberedName(folder / "none/f_##.obj").find().empty());
  for (const int n : {100, 2, 1, 4, 9, 8}) test::put_file(name.file(n), "x");
  for (const char* other : {"f_1.obj", "g_01.obj", "f_01.ply"}) test::put_file(folder / other, "x");
  const auto found = name.find();
  std::vector<std::int64_t> numbers;
  for (const NumberedFile& f : found) numbers.push_back(f.number);
  CHECK(numbers == std::vector<std::int64_t>{1, 2, 4, 8, 9, 100});
  CHECK(found[5].path == folder / "f_100.obj");
}

TEST_CASE("one_file_leads_to_its_sequence") {
  const test::TemporaryFolder folder;
  for (int n = 1; n <= 12; ++n) test::put_file(folder / ("wing" + std::to_string(n) + ".obj"), "x");
  CHECK(NumberedName::of_file(folder / "wing10.obj")->find().size() == 12);
  CHECK(NumberedName::of_file(folder / "wing2.obj")->find().size() == 12);
  for (int n = 1; n <= 12; ++n) test::put_file(NumberedName(folder / "v2_pose_###_a.obj").file(n), "x");
  CHECK(NumberedName::of_file(folder / "v2_pose_010_a.obj")->find().size() == 12);
  CHECK_FALSE(NumberedName::of_file(folder / "plain.obj"));
}
