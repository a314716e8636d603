#include "app/inputs.h"

#include "formats/format_table.h"
#include "support/files.h"

using namespace viete;
using app::check_output;
using app::Content;

namespace fs = std::filesystem;

TEST_CASE("an_input_is_written_over_only_by_force_whatever_it_is_called") {
  const test::TemporaryFolder files;
  test::put_file(files / "a.obj", "v 0 0 0\n");
  fs::create_symlink(files / "a.obj", files / "link.obj");
  fs::create_symlink("link.obj", files / "link_of_link.obj");
  fs::create_directory_symlink(files.path(), files / "folder");
  for (const char* name : {"a.obj", "./a.obj", "link.obj", "link_of_link.obj", "folder/a.obj"}) {
    CHECK_THROWS_AS(check_output(files / name, Content::surface, {files / "a.obj"}, false), base::Error);
    CHECK_THROWS_AS(check_output(files / "a.obj", Content::surface, {files / name}, false), base::Error);
    CHECK_NOTHROW(check_output(files / name, Content::surface, {files / "a.obj"}, true));
  }
  CHECK_NOTHROW(check_output(files / "a.obj", Content::surface, {{}, files / "gone.obj"}, false));
}

TEST_CASE("a_result_takes_the_place_of_its_kind_only") {
  const test::TemporaryFolder files;
  const std::string pc2("POINTCACHE2\0\1\0\0\0\1\0\0\0\0\0\0\0\0\0\x80?\1\0\0\0", 32);
  const struct {
    const char* name;
    std::string bytes;
    Content content;
    bool allowed;
  } rows[] = {
      {"a.png", "", Content::picture, true},
      {"a.png", "\x89PNG\r\n\x1a\nrest", Content::picture, true},
      {"a.png", "\x89PNG\r\n\x1a\nrest", Content::json, false},
      {"a.png", "Dear all", Content::picture, false},
      {"a.viete", "Dear all", Content::session, false},
      {"a.viete", R"({"format": "viete session", "version": 1, "model": "a.obj"})", Content::session, true},
      {"a.mdd", std::string("\0\0\0\1\0\0\0\1", 8) + std::string(16, '\0'), Content::animation, true},
      {"a.pc2", pc2 + std::string(12, '\0'), Content::animation, true}};
  for (const auto& [name, bytes, content, allowed] : rows) {
    CAPTURE(bytes);
    test::put_file(files / name, bytes);
    const std::string problem = test::problem_of([&] { check_output(files / name, content, {}, false); });
    CHECK(problem.empty() == allowed);
    CHECK_NOTHROW(check_output(files / name, content, {}, true));
  }
  CHECK_NOTHROW(check_output({}, Content::json, {}, false));
  CHECK_NOTHROW(check_output(files / "new.png", Content::picture, {}, false));
  CHECK_FALSE(fs::exists(files / "new.png"));
  test::put_file(files / "letter.png", "Dear all");
  CHECK_THROWS_WITH_AS(
      check_output(files / "letter.png", Content::picture, {}, false),
      doctest::Contains("letter.png: this file is text, not a PNG picture, and would be replaced"),
      base::Error);
}

TEST_CASE("files_of_others_are_kept_whatever_their_name_is") {
  const test::TemporaryFolder files;
  const std::pair<std::string, const char*> contents[] = {
      {"\x89PNG\r\n\x1a\nrest", "a picture (PNG)"},
      {std::string("\x7F"
                   "ELF\2\1\1\0\0",
                   9),
       "a program (ELF)"},
      {"PK\3\4rest", "a compressed file (zip"},
      {"#include <stdio.h>\nint main() {\nv = 1;\nf(v);\n}\n", "text"},
      {"Dear all,\nv 1 2 3\nis a vertex\n", "text"},
      {R"({"name": "a package", "version": "2.0.0"})", "JSON"},
      {R"({"format": "viete session", "version": 1, "model": "a.obj"})", "a session"},
      {std::string("\0\1\2\3\4\5\6\7", 8), "binary data"},
      {"<!DOCTYPE html><svg></svg>", "a web page"}};
  const auto refused = [&](const fs::path& file, Content content) {
    return test::problem_of([&] { check_output(file, content, {}, files::Force::none); });
  };
  for (const auto& [bytes, name] : contents) {
    const auto check = [&](const std::string& ending, Content content) {
      const fs::path file = files / ("a." + ending);
      test::put_file(file, bytes);
      const std::string problem = refused(file, content);
      CHECK_MESSAGE(problem.find(std::string("this file is ") + name) != std::string::npos,
                    ending << ": " << problem);
      CHECK_NOTHROW(check_output(file, content, {}, files::Force::given));
    };
    for (const char* ending : {"obj", "ply", "off", "stl", "glb", "gltf"}) check(ending, Content::surface);
    for (const char* ending : {"pc2", "mdd", "glb"}) check(ending, Content::animation);
    for (const Content content : {Content::json, Content::page}) check("json", content);
  }
}

TEST_CASE("a_surface_takes_the_place_of_one_in_the_same_format_only") {
  const test::TemporaryFolder files;
  const mesh::Surface surface = test::cube(1);
  for (const formats::Format& from : formats::all_formats()) {
    if (!from.write || from.stores_only_splats()) continue;
    formats::write(files / ("from." + std::string(from.extension)), surface);
    for (const formats::Format& to : formats::all_formats()) {
      if (!to.write) continue;
      const fs::path file = files / ("to." + std::string(to.extension));
      fs::copy_file(files / ("from." + std::string(from.extension)), file,
                    fs::copy_options::overwrite_existing);
      CAPTURE(from.extension);
      CAPTURE(to.extension);
      if (from.name == to.name) {
        CHECK_NOTHROW(check_output(file, Content::surface, {}, files::Force::none));
      } else {
        const std::string problem =
            "this file is " + std::string(from.name) + ", not " + std::string(to.name) + ", and";
        CHECK_THROWS_WITH_AS(check_output(file, Content::surface, {}, files::Force::none),
                             doctest::Contains(problem.c_str()), base::Error);
      }
    }
  }
}

TEST_CASE("a_refusal_names_the_files_kind_and_another_name") {
  const test::TemporaryFolder files;
  test::put_file(files / "a.obj", "v 0 0 0\n");
  test::put_file(files / "a-2.obj", "v 0 0 0\n");
  fs::create_hard_link(files / "a.obj", files / "second.obj");
  document::FilesInUse in_use;
  in_use.add(files / "second.obj", document::the_model);
  const auto refused = [&](const char* name, files::Force force) {
    return test::problem_of([&] { check_output(files / name, Content::surface, in_use, force); });
  };
  CHECK(refused("a.obj", files::Force::offered) ==
        (files / "a.obj").string() +
            ": this is an input file (the model) and would be replaced; choose another name, such as "
            "a-2-2.obj, or add --force");
  CHECK(refused("a.obj", files::Force::none).ends_with("such as a-2-2.obj"));
  CHECK(refused("gone/../a.obj", files::Force::none) != "");
  in_use.add(files / "not_there.obj", document::the_cage);
  CHECK(refused("./not_there.obj", files::Force::none).ends_with("such as not_there-2.obj"));
  CHECK(refused("a-2.obj", files::Force::none) == "");
}

TEST_CASE("a_numbered_result_never_overwrites_an_input") {
  const test::TemporaryFolder files;
  test::put_file(files / "f_07.obj", "v 0 0 0\n");
  document::FilesInUse in_use{files / "f_07.obj"};
  const fs::path pattern = files / "f_##.obj";
  for (const auto force : {files::Force::none, files::Force::given}) {
    CHECK_THROWS_WITH_AS(check_output(pattern, {1, 10}, in_use, force),
                         doctest::Contains("such as f_##-2.obj"), base::Error);
    CHECK_NOTHROW(check_output(pattern, {1, 6}, in_use, force));
    CHECK_NOTHROW(check_output(pattern, {1, 10, 4}, in_use, force));
  }
  CHECK_NOTHROW(check_output(pattern, files::FrameSteps{}, in_use, files::Force::none));
  CHECK_THROWS_AS(check_output(files / "f_07.obj", {1, 10}, in_use, files::Force::offered), base::Error);
}
