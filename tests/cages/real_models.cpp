#include <doctest/doctest.h>

#include "cages/judge.h"
#include "cages/make.h"
#include "formats/read.h"
#include "support/data.h"

using namespace viete;
using namespace viete::test;

namespace {

std::vector<std::filesystem::path> real_models() {
  std::vector<std::filesystem::path> all;
  const auto data = shared_data();
  if (data.empty()) return all;
  for (const auto& folder : std::filesystem::directory_iterator(data))
    for (const char* name : {"mesh.obj", "mesh.ply"}) {
      const auto path = folder.path() / name;
      if (std::filesystem::exists(path) && std::filesystem::file_size(path) < 10'000'000) all.push_back(path);
    }
  std::ranges::sort(all);
  return all;
}

}  // namespace

TEST_CASE("real_models_get_cages_of_every_size" * doctest::test_suite(if_present)) {
  base::WorkerPool pool(2);
  for (const auto& path : real_models()) {
    const auto model = std::make_shared<const mesh::Surface>(formats::read(path).surface);
    cages::Maker maker(model);
    for (const std::size_t triangles : {60, 200, 600}) {
      CAPTURE(path);
      CAPTURE(triangles);
      const cages::Wish wish{.triangles = triangles};
      for (const std::string& complaint : complaints(maker.make(wish, pool), *model, wish))
        FAIL_CHECK(complaint);
    }
  }
}

TEST_CASE("automatic_cages_are_no_larger_than_manual_ones" * doctest::test_suite(if_present)) {
  base::WorkerPool pool(2);
  const struct {
    const char* name;
    std::size_t triangles;
    double volume;  // the volume of the manual cage divided by the volume of the model
  } by_hand[] = {
      {"armadillo-man", 216, 2.04}, {"octopus", 102, 2.43}, {"horse", 98, 2.80}, {"hand", 82, 2.32}};
  for (const auto& [name, triangles, volume] : by_hand) {
    CAPTURE(name);
    const auto path = shared_data(std::string(name) + "/mesh.obj");
    if (path.empty()) return;
    const mesh::Surface model = formats::read(path).surface;
    const auto made = cages::make(model, {.triangles = triangles}, pool);
    CHECK(mesh::summarize(made.surface).volume < volume * mesh::summarize(model).volume);
  }
}
