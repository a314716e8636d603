#include "base/error.h"

#include <doctest/doctest.h>

#include <string>

using viete::base::Error;

TEST_CASE("an_error_reads_place_problem_advice") {
  const Error error("dragon.obj:1042", "face refers to vertex 70000, the file has 50000",
                    "export the model again");
  CHECK(std::string(error.what()) ==
        "dragon.obj:1042: face refers to vertex 70000, the file has 50000; export the model again");
  CHECK(error.place() == "dragon.obj:1042");
}

TEST_CASE("place_and_advice_may_be_missing") {
  CHECK(std::string(Error("", "the disk is full").what()) == "the disk is full");
}
