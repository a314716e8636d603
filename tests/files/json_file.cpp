#include "files/json_codec.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <string>

#include "base/error.h"
#include "support/files.h"
#include "support/folder.h"

using namespace viete;
using namespace viete::files;
using nlohmann::json;
using nlohmann::ordered_json;

TEST_CASE("json_is_laid_out_one_key_or_point_a_line") {
  const ordered_json value = {
      {"b", {1, 2}}, {"a", {{"points", {{0.5, 1}, {2, 3}}}}}, {"none", ordered_json::array()}};
  CHECK(readable(value, "f") ==
        "{\n  \"b\": [1,2],\n  \"a\": {\n    \"points\": [\n      [0.5,1],\n      [2,3]\n    ]\n  },\n  "
        "\"none\": []\n}\n");
  CHECK(ordered_json::parse(readable(value, "f")) == value);
}

TEST_CASE("numbers_come_back_with_the_same_bits") {
  const test::TemporaryFolder folder;
  const std::vector<double> numbers = {
      0.1, -0.0, 1e-300, 12345678.9, 1.0 / 3, 5e-324, 1.7976931348623157e308};
  test::put_file(folder / "n", readable({{"n", numbers}}, "f"));
  const json back = read_json(folder / "n");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    CHECK(std::bit_cast<std::uint64_t>(back["n"][i].get<double>()) ==
          std::bit_cast<std::uint64_t>(numbers[i]));
  }
}

TEST_CASE("a_mistake_is_named_with_its_line_and_a_missing_file_as_such") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "broken", "{\n  \"a\": 1,\n  \"b\" 2\n}");
  CHECK(test::problem_of([&] { read_json(folder / "broken"); }).find("broken:3: this is not valid JSON") !=
        std::string::npos);
  test::put_file(folder / "huge", "{\"a\": [1, -1e999]}");
  CHECK(test::problem_of([&] {
          read_json(folder / "huge");
        }).find("huge: the file contains a number that is too large") != std::string::npos);
  CHECK(test::problem_of([&] { read_json(folder / "none"); }).find("no such file") != std::string::npos);
  CHECK_THROWS_AS(readable({{"a", "\xff"}}, "f"), base::Error);
}

TEST_CASE("foreign_files_are_refused_before_memory_is_allocated") {
  const test::TemporaryFolder folder;
  const auto said = [&](const std::string& text) {
    test::put_file(folder / "bomb", text);
    return test::problem_of([&] {
      const json whole = read_json(folder / "bomb");
      (void)JsonReader(whole, "bomb").at("model").text();
    });
  };
  for (const char* open : {"[", "{\"a\":", "[{\"a\":"}) {
    std::string deep;
    while (deep.size() < 1 << 20) deep += open;
    CHECK(said(deep).find("bomb: lists and objects are nested more than 32 levels deep") !=
          std::string::npos);
  }
  const std::string name = said("{\"model\": \"" + std::string(1 << 20, 'x') + "\"}");
  CHECK(name == "bomb: model: the text has 1048576 bytes, at most 12288 are allowed; correct it in the file");
  test::put_file(folder / "long", "");
  std::filesystem::resize_file(folder / "long", most_json_bytes + 1);  // of zeros that take no disk
  CHECK(test::problem_of([&] { read_json(folder / "long"); }).find("134217729 bytes exceed the limit of") !=
        std::string::npos);
  CHECK_MESSAGE(test::problem_of([&] {
                  readable({{"a", std::string(most_json_bytes, 'x')}}, "f");
                }).find("exceed the limit") != std::string::npos,
                "nor is it written");
}

TEST_CASE("a_wrong_type_names_file_and_key_and_both_types") {
  const json whole = {
      {"camera", {{"distance", "far"}, {"target", {1, 2}}}}, {"list", {1, -2, 3.5}}, {"null", nullptr}};
  const JsonReader json(whole, "s.viete");
  CHECK(test::problem_of([&] { json.at("camera").at("distance").number(); }) ==
        "s.viete: camera.distance: expected a number, found a text; correct it in the file");
  CHECK(test::problem_of([&] {
          json.at("camera").at("target").numbers<3>();
        }).find("camera.target: expected a list of 3 numbers, found a list of length 2") !=
        std::string::npos);
  CHECK(test::problem_of([&] { json.at("list").item(1).index(); }).find("list[1]") != std::string::npos);
  CHECK(test::problem_of([&] { json.at("list").item(2).index(); }).find("whole number") != std::string::npos);
  CHECK(test::problem_of([&] { json.at("list").boolean(); }).find("true or false") != std::string::npos);
  CHECK(test::problem_of([&] { json.at("gone"); }).find("\"gone\" is missing") != std::string::npos);
  CHECK(test::problem_of([&] { json.at("list").find("x"); }).find("an object") != std::string::npos);
  CHECK_FALSE(json.find("null").has_value());
  CHECK_FALSE(json.find("gone").has_value());
}

TEST_CASE("names_of_files_come_back_to_the_byte_also_where_they_are_not_utf_8") {
  const test::TemporaryFolder folder;
  const std::string all_bytes = [] {
    std::string bytes;
    for (int c = 1; c < 256; ++c) bytes += static_cast<char>(c);
    return bytes;
  }();
  for (const std::string& name : {std::string("plain 100%.obj"), std::string("caf\xc3\xa9.obj"),
                                  std::string("caf\xe9 100%.obj"), all_bytes, std::string()}) {
    CAPTURE(path_json(name).dump());
    test::put_file(folder / "n", readable({{"name", path_json(name)}}, "f"));
    const json back = read_json(folder / "n");
    CHECK(JsonReader(back, "n").at("name").path() == name);
  }
  CHECK(path_json("caf\xc3\xa9 %.obj").is_string());
  CHECK(path_json("caf\xe9 %.obj").dump() == R"({"percent_encoded":"caf%E9%20%25.obj"})");
  for (const char* wrong :
       {R"({"percent_encoded": "a%2"})", R"({"percent_encoded": "%zz"})", R"({"b": 1})", "7"}) {
    CAPTURE(wrong);
    const json value = json::parse(wrong);
    CHECK_THROWS_AS(JsonReader(value, "n").path(), base::Error);
  }
}
