#include "base/made_files.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "support/folder.h"

using namespace viete;
using base::MadeFiles;
using State = MadeFiles::State;

namespace {

struct Sequence {
  test::TemporaryFolder folder;
  base::NumberedName name{folder / "a_##.obj"};

  void put(int number, const std::string& bytes) const { test::put_file(name.file(number), bytes); }
  State state(MadeFiles::Planned file) const { return MadeFiles(name).state(file); }
};

}  // namespace

TEST_CASE("what_is_not_in_the_record_is_of_somebody_else") {
  const Sequence s;
  CHECK(s.state({1, 7}) == State::missing);
  s.put(1, "of a user");
  CHECK(s.state({1, 7}) == State::foreign);
}

TEST_CASE("a_record_that_cannot_be_read_is_an_error") {
  const Sequence s;
  std::filesystem::create_directory(s.name.pattern() + ".made");
  CHECK_THROWS_WITH_AS(MadeFiles(s.name), doctest::Contains("cannot be read"), base::Error);
}

TEST_CASE("a_file_that_was_made_is_whole_until_it_or_its_inputs_change") {
  const Sequence s;
  MadeFiles made(s.name);
  const MadeFiles::Planned file{1, 7};
  made.begin(std::span(&file, 1));
  CHECK(s.state(file) == State::missing);
  s.put(1, "frame");
  CHECK(s.state(file) == State::ours);  // it may be the one of before, or half of what was to be
  made.add(file);
  CHECK(s.state(file) == State::whole);
  CHECK(s.state({1, 8}) == State::ours);
  s.put(1, "frame, edited");
  CHECK(s.state(file) == State::foreign);
  s.put(1, "frbme");  // as long
  CHECK(s.state(file) == State::foreign);
  s.put(1, "frame");
  CHECK(s.state(file) == State::whole);
}

TEST_CASE("a_record_that_is_cut_or_damaged_trusts_nothing_that_it_does_not_say") {
  const Sequence s;
  MadeFiles made(s.name);
  const MadeFiles::Planned files[] = {{1, 7}, {2, 7}};
  for (const auto& file : files) {
    s.put(int(file.number), "frame");
    made.add(file);
  }
  const std::string record = test::file_bytes(made.record());
  for (std::size_t size = 0; size <= record.size(); ++size) {
    test::put_file(made.record(), record.substr(0, size));
    const auto first_line = record.find('\n');
    CHECK(s.state(files[0]) == (size >= first_line ? State::whole : State::foreign));
    CHECK(s.state(files[1]) == (size >= record.size() - 1 ? State::whole : State::foreign));
    MadeFiles again(s.name);  // goes on behind the torn line
    again.add(files[1]);
    CHECK(s.state(files[1]) == State::whole);
  }
  test::put_file(made.record(), "made 1 7\nmade x\n\x01\xff\n" + record);
  CHECK(s.state(files[1]) == State::whole);
}

TEST_CASE("two_programs_add_to_one_record") {
  const Sequence s;
  MadeFiles a(s.name), b(s.name);
  s.put(1, "one"), s.put(2, "two");
  a.add({1, 7}), b.add({2, 7}), a.add({1, 9});
  CHECK(s.state({1, 9}) == State::whole);
  CHECK(s.state({2, 7}) == State::whole);
}

TEST_CASE("a_record_that_cannot_be_written_is_said") {
  const Sequence s;
  std::filesystem::create_directory(s.name.pattern() + ".made");
  s.put(1, "one");
  CHECK_THROWS_AS(MadeFiles(s.name).add({1, 7}), base::Error);
}

TEST_CASE("a_file_is_whole_with_all_that_it_leads_to") {
  const Sequence s;
  const MadeFiles::Planned file{1, 7};
  const std::filesystem::path beside[] = {s.folder / "a 1.bin", s.folder / "in" / "x.png"};
  std::filesystem::create_directory(s.folder / "in");
  for (const auto& path : beside) test::put_file(path, "bytes");
  s.put(1, "frame");
  MadeFiles made(s.name);
  made.add(file, beside);
  CHECK(made.state(file) == State::whole);
  CHECK(s.state(file) == State::whole);
  for (const auto& path : beside) {
    std::filesystem::remove(path);
    CHECK(made.state(file) == State::ours);
    CHECK(s.state(file) == State::ours);
    test::put_file(path, "bytes");
  }
  CHECK(s.state(file) == State::whole);
  MadeFiles(s.name).add(file);  // made anew, and by itself
  std::filesystem::remove(beside[0]);
  CHECK(s.state(file) == State::whole);
}
