#include "program/driver.h"
#include "support/pictures.h"
#include "support/stage.h"

using namespace viete;
using test::Driver;
using ContextKind = platform::OffscreenContext::Kind;

namespace {

render::Image picture_by(ContextKind kind) {
  Driver d(Driver::default_options(), test::WithPixels{kind});
  d.open_dragon();
  d.workspace().view.options.panels = false;
  d.settle();
  return d.picture();
}

}  // namespace

TEST_CASE("osmesa_and_egl_give_the_same_picture" * doctest::test_suite(test::if_present)) {
  if (!test::available(ContextKind::osmesa) || !test::available(ContextKind::driver)) return;
  CHECK(test::difference(picture_by(ContextKind::osmesa), picture_by(ContextKind::driver), 2) < 0.001);
}
