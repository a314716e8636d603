// The accuracy of the active method, in the panel and in the view.
#include "program/driver.h"

using namespace viete;
using test::Driver;

namespace {

void open_posed_dragon(Driver& d) {
  auto& options = d.workspace().view.options;
  options.cage = options.grid = options.axes = options.hints = false;
  d.open_dragon("pose_alert", test::bundled_dragon);
}

// The sum of the colours of all pixels in the view, without pixels of the background.
struct Shown {
  double red = 0, blue = 0;
  int pixels = 0;
};

Shown shown(Driver& d, const render::Image& empty) {
  const auto picture = d.picture();
  Shown sum;
  for (int y = 0; y < 660; ++y) {      // the rows above the legend
    for (int x = 330; x < 955; ++x) {  // the columns without timings, because timings differ in every run
      const auto p = picture.pixel(x, y);
      if (p == empty.pixel(x, y)) continue;
      sum.red += p[0];
      sum.blue += p[2];
      ++sum.pixels;
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("the_error_on_the_mesh_is_dark_where_a_method_is_exact_and_bright_where_it_is_not") {
  Driver d(test::with_pixels);
  open_posed_dragon(d);
  d.workspace().view.options.model = false;
  d.settle();
  const auto empty = d.picture();
  d.workspace().view.options.model = true;
  d.settle();
  const Shown plain = shown(d, empty);

  d.workspace().view.options.field = analysis::Field::exp_error;
  d.settle();
  const Shown exact = shown(d, empty);
  const auto& map = d.workspace().view.split.views[0].shown.stats;
  CHECK(map.vertices == 50000);
  CHECK(map.method == sym3::Method::fast);
  CHECK(map.most < -14);
  CHECK(map.median <= map.most);
  CHECK(exact.pixels > 20000);
  CHECK(exact.blue > exact.red);  // blue means a small error
  CHECK(plain.red > plain.blue);  // without a map, the model is reddish

  d.click("method_sd");
  d.settle();
  const Shown rough = shown(d, empty);
  CHECK(map.method == sym3::Method::sd);
  CHECK(map.most > -14);
  const double rough_red = rough.red / rough.pixels, exact_red = exact.red / exact.pixels;
  CHECK(rough_red > 1.1 * exact_red);

  d.workspace().view.options.field = analysis::Field::none;
  d.click("method_fast");
  d.move({700, 20});
  d.settle();
  const Shown again = shown(d, empty);
  CHECK(again.red / again.pixels == doctest::Approx(plain.red / plain.pixels).epsilon(0.01));
  d.workspace().view.options.field = analysis::Field::exp_error;
  d.choose("weights", "weights_mean_value");
  d.settle();
  CHECK(workspace::shown_field(d.workspace()) == analysis::Field::none);
}
