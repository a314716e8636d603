#include "mesh/formats/foreign_content.h"

#include <doctest/doctest.h>

#include "mesh/formats/point_cache.h"
#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;
using viete::test::holds;

TEST_CASE("files_of_other_kinds_are_refused_with_what_they_are") {
  const std::string lfs = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a2146\nsize 12345\n";
  const std::pair<std::string, const char*> files[] = {
      {lfs, "Git LFS pointer, which stands for the file; fetch the file itself with `git lfs pull`"},
      {"/annex/objects/SHA256E-s1--a.obj\n", "git annex get"},
      {std::string("\x1F\x8B\x08\0\0", 5), "gzip"},
      {"PK\3\4....", "zip"},
      {std::string("\xFF\xFEv\0 \0", 6), "UTF-16"},
      {std::string("\xFE\xFF\0v\0 ", 6), "UTF-16"},
      {std::string("v\0 \0001\0 \0002\0", 10), "UTF-16"},
      {std::string("\0v\0 \0001\0 \0002", 10), "UTF-16"},
      {"<!doctype HTML>\n<html><body>Not found", "a web page; download the file itself"},
      {"\xEF\xBB\xBF\n  <HTML>", "a web page"},
      {"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"\">", "a COLLADA file"},
      {"<?xml version=\"1.0\"?>\n<something>", "XML"},
      {"Kaydara FBX Binary  ", "an FBX file"},
      {"; FBX 7.3.0 project file\n", "an FBX file"},
      {"#usda 1.0\n", "a USD file"},
      {"PXR-USDC", "a USD file"},
      {"BLENDER-v300", "a Blender file"},
      {"\x28\xB5\x2F\xFD....", "zstd"},
      {"\x89PNG\r\n", "a picture"},
      {std::string("POINTCACHE2\0", 12), "a point cache"},
      {std::string(3000, '\0'), "nothing but zeros"},
      {"", "the file is empty"}};
  for (const auto& [bytes, what] : files) {
    for (const char* extension : {"obj", "ply", "off", "stl", "glb", "gltf", ""}) {
      const std::string said = test::refusal(bytes, extension);
      CHECK_MESSAGE(holds(said, what), extension << ": " << said);
    }
  }
  for (const char* bytes :
       {"v 1 2 3\n", "# version https://git-lfs.github.com/spec/v1\n", "{\"a\": 1}", "solid a\n"})
    CHECK_NOTHROW(refuse_foreign("given", bytes));
}

TEST_CASE("a_pointer_in_the_place_of_a_point_cache_is_named") {
  const std::string lfs = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a2146\nsize 12345\n";
  CHECK_THROWS_WITH_AS(PointCache("given.mdd", lfs), doctest::Contains("Git LFS pointer"), base::Error);
}
