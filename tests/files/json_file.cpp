#include "files/json_codec.h"

#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/text.h"

using namespace viete;
using namespace viete::files;
using nlohmann::json;
using nlohmann::ordered_json;
using test::mentions, test::problem_of;

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
  for (std::size_t i = 0; i < numbers.size(); ++i)
    CHECK(std::bit_cast<std::uint64_t>(back["n"][i].get<double>()) ==
          std::bit_cast<std::uint64_t>(numbers[i]));
}

TEST_CASE("a_mistake_is_named_with_its_line_and_a_missing_file_as_such") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "broken", "{\n  \"a\": 1,\n  \"b\" 2\n}");
  const auto problem = [&](const char* name) { return problem_of([&] { read_json(folder / name); }); };
  CHECK(mentions(problem("broken"), "broken:3: this is not valid JSON"));
  test::put_file(folder / "huge", "{\"a\": [1, -1e999]}");
  CHECK(mentions(problem("huge"), "huge: the file contains a number that is too large"));
  CHECK(mentions(problem("none"), "no such file"));
}

TEST_CASE("foreign_files_are_refused_before_memory_is_allocated") {
  const test::TemporaryFolder folder;
  const auto said = [&](const std::string& text) {
    test::put_file(folder / "bomb", text);
    return problem_of([&] {
      const json whole = read_json(folder / "bomb");
      (void)JsonReader(whole, "bomb").at("model").text();
    });
  };
  for (const char* open : {"[", "{\"a\":", "[{\"a\":"}) {
    std::string deep;
    while (deep.size() < 1 << 20) deep += open;
    CHECK(mentions(said(deep), "bomb: lists and objects are nested more than 32 levels deep"));
  }
  const std::string name = said("{\"model\": \"" + std::string(1 << 20, 'x') + "\"}");
  CHECK(name == "bomb: model: the text has 1048576 bytes, at most 12288 are allowed; correct it in the file");
  test::put_file(folder / "long", "");
  std::filesystem::resize_file(folder / "long", most_json_bytes + 1);  // a sparse file
  CHECK(mentions(problem_of([&] { read_json(folder / "long"); }), "134217729 bytes exceed the limit of"));
  const std::string written = problem_of([] { readable({{"a", std::string(most_json_bytes, 'x')}}, "f"); });
  CHECK(mentions(written, "exceed the limit"));
}

TEST_CASE("a_wrong_type_names_file_and_key_and_both_types") {
  const json whole = {
      {"camera", {{"distance", "far"}, {"target", {1, 2}}}}, {"list", {1, -2, 3.5}}, {"null", nullptr}};
  const JsonReader json(whole, "s.viete");
  CHECK(problem_of([&] { json.at("camera").at("distance").number(); }) ==
        "s.viete: camera.distance: expected a number, found a text; correct it in the file");
  CHECK(mentions(problem_of([&] { json.at("camera").at("target").numbers<3>(); }),
                 "camera.target: expected a list of 3 numbers, found a list of length 2"));
  CHECK(mentions(problem_of([&] { json.at("list").item(1).index(); }), "list[1]"));
  CHECK(mentions(problem_of([&] { json.at("list").item(2).index(); }), "whole number"));
  CHECK(mentions(problem_of([&] { json.at("list").boolean(); }), "true or false"));
  CHECK(mentions(problem_of([&] { json.at("gone"); }), "\"gone\" is missing"));
  CHECK(mentions(problem_of([&] { json.at("list").find("x"); }), "an object"));
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
