#include "app/inputs.h"

#include <doctest/doctest.h>

#include <CLI/CLI.hpp>

#include "support/text.h"

using namespace viete;
using app::Inputs;
using app::Use;
using test::mentions;

namespace {

Inputs parsed(Use use, const std::string& arguments) {
  CLI::App command;
  Inputs inputs{use};
  app::add_input_options(command, inputs);
  command.parse(arguments, false);
  app::check_usage(inputs);
  return inputs;
}

std::string refusal(Use use, const std::string& arguments) {
  return test::problem_of([&] { parsed(use, arguments); });
}

}  // namespace

TEST_CASE("every_use_requires_its_inputs") {
  CHECK(refusal(Use::window, "").empty());
  CHECK(refusal(Use::picture, "a.obj").empty());
  CHECK(refusal(Use::file, "a.obj c.obj --pose p.obj").empty());
  CHECK(mentions(refusal(Use::picture, ""), "MODEL"));
  CHECK(mentions(refusal(Use::animation, "a.obj"), "CAGE"));
  CHECK(mentions(refusal(Use::file, "a.obj --pose p.obj"), "CAGE"));
  CHECK(mentions(refusal(Use::file, "a.obj c.obj"), "--pose"));
}

TEST_CASE("a_session_names_its_cage_and_pose_itself") {
  for (const Use use : {Use::window, Use::picture, Use::file, Use::animation}) {
    CHECK(refusal(use, "s.viete").empty());
    CHECK(mentions(refusal(use, "s.viete c.obj"), "CAGE: the session s.viete has its own"));
  }
  CHECK(mentions(refusal(Use::file, "s.viete --pose p.obj"), "--pose: the session s.viete has its own"));
}

TEST_CASE("files_of_a_session_can_be_located_and_no_others") {
  for (const Use use : {Use::window, Use::picture, Use::file, Use::animation}) {
    const auto inputs = parsed(use, "s.viete --model m.ply --cage c.obj");
    CHECK(inputs.request().located.model == "m.ply");
    CHECK(inputs.request().located.cage == "c.obj");
  }
  CHECK(mentions(refusal(Use::picture, "a.obj --model m.ply"), "--model: requires a session"));
  CHECK(mentions(refusal(Use::animation, "a.obj c.obj --cage d.obj"), "--cage: requires a session"));
}

TEST_CASE("every_method_that_has_a_name_is_taken_and_none_is_asked_for_by_itself") {
  CHECK_FALSE(parsed(Use::picture, "a.obj").settings.any());
  for (const auto method :
       {sym3::Method::diag, sym3::Method::sd, sym3::Method::improved_sd, sym3::Method::fast}) {
    const auto inputs = parsed(Use::picture, "a.obj --method " + std::string(sym3::name(method)));
    CHECK(inputs.settings.method == method);
  }
}

TEST_CASE("arap_takes_a_number_of_iterations_or_one") {
  const auto iterations = [](const std::string& words) {
    return pose::deformer_of(parsed(Use::picture, "a.obj " + words).settings, {}).iterations;
  };
  CHECK(iterations("") == 0);
  CHECK(iterations("--arap") == 1);
  CHECK(iterations("--arap --iterations 20") == 20);
  CHECK(iterations("--iterations 4 --arap") == 4);
  CHECK(iterations("--deformer arap --iterations 4") == 4);
  CHECK_THROWS_WITH(iterations("--iterations 4"), doctest::Contains("needs ARAP"));
  for (const char* bad : {"0", "21", "-1", "1.5", "many"})
    CHECK(mentions(refusal(Use::picture, std::string("a.obj --arap --iterations ") + bad), "1 to 20"));
  CHECK_THROWS_AS(parsed(Use::picture, "a.obj --arap --weights mean-value"), base::Error);
}

TEST_CASE("settings_that_do_not_go_together_are_told_before_anything_is_opened") {
  CHECK_THROWS_AS(parsed(Use::picture, "a.obj --blend srl --weights mean-value"), base::Error);
  CHECK_THROWS_AS(parsed(Use::picture, "a.obj --weights mean-value --radius 3"), base::Error);
  CHECK(refusal(Use::picture, "s.viete --radius 3").empty());
}
