#include "program/driver.h"
#include "support/pictures.h"
#include "support/stage.h"

using namespace viete;
using test::Driver;
using Kind = platform::OffscreenContext::Kind;

namespace {

render::Image picture_by(Kind kind) {
  Driver d(Driver::default_options(), test::WithPixels{kind});
  d.open_dragon();
  d.workspace().view.panels = false;
  d.settle();
  return d.picture();
}

}  // namespace

TEST_CASE("osmesa_and_egl_give_the_same_picture" * doctest::test_suite(test::if_present)) {
  if (!test::available(Kind::osmesa) || !test::available(Kind::egl)) return;
  CHECK(test::difference(picture_by(Kind::osmesa), picture_by(Kind::egl), 2) < 0.001);
}
