#include "bench/svg.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "bench/plot.h"

using namespace viete;

namespace {

std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("marks_of_xml_in_a_text_are_written_out") {
  bench::Svg svg(100, 50, "#ffffff");
  svg.text({1, 2}, "a < b & c");
  const std::string document = svg.document();
  CHECK(document.find("a &lt; b &amp; c") != std::string::npos);
  CHECK(document.ends_with("</svg>\n"));
}

TEST_CASE("a_plot_has_its_bars_and_curves_by_name") {
  bench::Plot plot;
  plot.title = "Times", plot.subtitle = "of exp", plot.bars_title = "bars", plot.curves_title = "curves";
  plot.bars = {{"Diag", 500, "#000000"}, {"Fast", 5, "#0072b2"}};
  plot.curves = {{"Fast, planes", "#0072b2", false, {{1024, 3}, {1e6, 5}}}};
  const std::string document = bench::draw_plot(plot);
  for (const char* text : {"Times", "Diag", "Fast, planes", "500"})
    CHECK_MESSAGE(document.find(text) != std::string::npos, text);
  CHECK(count_of("<svg", document) == 1);
}
