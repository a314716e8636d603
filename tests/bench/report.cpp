#include <regex>
#include <sstream>

#include "base/text.h"
#include "bench/page.h"
#include "formats/write.h"
#include "support/data.h"
#include "support/shapes.h"
#include "support/text.h"
#include "support/xml.h"
#include "sym3/exp.h"

using namespace viete;
using namespace viete::bench;

namespace {

Figures small_figures() {
  const test::TemporaryFolder scratch;
  mesh::Surface ball = test::sphere(2);
  formats::write(scratch / "a & b.obj", ball);
  formats::write(scratch / "box.obj", test::moved(test::cube(), 1.5));
  for (auto& p : ball.positions) p[2] *= 2;
  formats::write(scratch / "shape_tall.obj", ball);
  const std::filesystem::path rest = scratch / "a & b.obj";
  base::Progress progress;
  Figures figures = measure_figures({rest, scratch / "box.obj", {}, rest, {scratch / "shape_tall.obj"}},
                                    {2000, 4, {8, 300}, 1}, progress);
  CHECK(progress.done() == doctest::Approx(1));
  return figures;
}

std::string row(const std::string& name, const std::string& value) {
  return "<th scope=\"row\">" + name + "</th><td class=\"n\">" + value + "</td>";
}

using Cells = std::vector<std::string>;

// Returns the cells of each row without marks for bold text.
std::vector<Cells> rows_of(const char* file) {
  std::ifstream in(test::source_dir() / file);
  REQUIRE(in);
  std::vector<Cells> rows;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("|")) continue;
    std::istringstream row(line.substr(1));
    rows.emplace_back();
    for (std::string cell; std::getline(row, cell, '|');)
      rows.back().push_back(std::regex_replace(cell, std::regex("^[ *]+|[ *]+$"), ""));
  }
  return rows;
}

nlohmann::json recorded_report() {
  std::ifstream in(test::source_dir() / "assets/report/figures.json");
  REQUIRE(in);
  return nlohmann::json::parse(in);
}

// Relative tolerances. The tables show errors with two digits, and times with mostly three digits.
constexpr double of_errors = 0.05, of_times = 0.015;

void check_number(const std::string& written, double recorded, double noise) {
  CHECK_MESSAGE(std::stod(written) == doctest::Approx(recorded).epsilon(noise), written);
}

double worst_recorded(const nlohmann::json& tables, const std::string& by, const std::string& method) {
  double worst = 0;
  for (const auto& table : tables)
    for (const auto& r : table["rows"])
      if (table["by"] == by || r["name"] == by)
        worst = std::max(worst, double(r["methods"][method]["worst"]));
  return worst;
}

void check_exponentials(const std::vector<Cells>& rows, const nlohmann::json& report) {
  const auto& results = report["exponentials"]["double"]["results"];
  for (const auto& result : results) {
    const auto method = sym3::method_from_name(std::string(result["name"]));
    const std::string name = method ? std::string(sym3::label(*method)) : "copy of the same bytes";
    const auto row = std::ranges::find_if(rows, [&](const Cells& c) { return c[0] == name && c.size() > 3; });
    REQUIRE_MESSAGE(row != rows.end(), name);
    INFO(name);
    check_number((*row)[2], result["ns"], of_times);
    if (!method) continue;
    check_number((*row)[3], double(results[0]["ns"]) / double(result["ns"]), of_times);
    check_number(row->back(), worst_recorded(report["accuracy"]["double"], "gap", name), of_errors);
    if (row->size() > 5)
      check_number((*row)[4], worst_recorded(report["accuracy"]["double"], "paper: M M^T", name), of_errors);
  }
}

void check_frames(Cells cells, const nlohmann::json& report, std::size_t faces) {
  constexpr const char* names[] = {frame_names::reference, frame_names::dense, frame_names::compressed,
                                   frame_names::dragged};
  for (const auto& t : report["frames"]) {
    const auto at =
        std::ranges::find(names, std::string(t["name"]), [](const char* n) { return std::string(n); });
    if (t["faces"] != faces || t["threads"] != 1 || at == std::end(names)) continue;
    const std::size_t column = static_cast<std::size_t>(at - std::begin(names));
    check_number(cells[column], t["cpu_ms"], of_times);
    if (cells.size() > 4 && (column == 1 || column == 2))
      check_number(cells[column + 3], t["error"], of_errors);
  }
}

}  // namespace

TEST_CASE("a_report_page_is_self_contained_xml_with_the_numbers_of_its_file") {
  const Figures figures = small_figures();
  const Made made = made_here("viete report -o <here>", 12);
  const std::string page = report_page(figures, made);
  CHECK(test::xml_problem(page) == "");
  CHECK(test::outside_of(page) == "");
  const std::string above = page.substr(0, page.find("<footer"));  // the footer contains NaN
  std::smatch number;
  CHECK_FALSE(std::regex_search(above, number, std::regex("[^a-z]-?(nan|inf)[^a-z]")));
  const auto json = report_json(figures, made);
  for (const auto& r : json["eigenvalues"]["results"])
    CHECK(test::mentions(page, row(r["name"], base::few_digits(r["ns"]))));
  for (const char* precision : {"double", "float"}) {
    for (const auto& r : json["exponentials"][precision]["results"]) {
      const auto method = sym3::method_from_name(std::string(r["name"]));
      const std::string name = method ? std::string(sym3::label(*method)) : std::string(r["name"]);
      CHECK(test::mentions(page, row(name, base::few_digits(r["ns"]))));
    }
    for (const auto& table : json["accuracy"][precision])
      for (const auto& r : table["rows"])
        CHECK(test::mentions(page, ">" + error_text(r["methods"]["Fast"]["worst"]) + "<"));
  }
  for (const auto& t : json["frames"])
    if (t["threads"] == 1 && t["name"] == "fused, dense")
      CHECK(test::mentions(page, ">" + base::few_digits(t["cpu_ms"]) + "<"));
  for (const auto& row : json["deformers"]["results"])
    CHECK(test::mentions(page, ">" + base::few_digits(row["frame_ms"]) + "<"));
  const auto& tall = json["shapes"][0];
  CHECK(tall["linear"]["volumes"].size() == 21);
  CHECK(double(tall["linear"]["volumes"][20]) == doctest::Approx(2));
  CHECK(test::mentions(page, row("tall", percent(100 * double(tall["log_space"]["volume"])))));
  for (const char* part :
       {"prefers-color-scheme:dark", "<dl class=\"tiles\">", " distorts least: ",
        "<figcaption>deviation of edge lengths halfway, %</figcaption>", "Description of the deformers"})
    CHECK_MESSAGE(test::mentions(page, part), part);
  const std::regex painted("(fill|stroke)=\"(#[0-9a-f]+)\"");
  for (std::sregex_iterator color(above.begin(), above.end(), painted), end; color != end; ++color) {
    const std::string dark = "svg [" + color->str(1) + "=\"" + color->str(2) + "\"]{";
    CHECK_MESSAGE(test::mentions(above, dark), dark);
  }
}

TEST_CASE("logarithmic_plots_skip_values_that_are_not_positive") {
  Plot plot;
  plot.curves = {{"Fast", "#0072b2", false, {{1e-16, 0}, {1e-8, 1e-16}, {1, 2e-16}}},
                 {"Diag", "#6b7785", false, {{1e-16, 1e-16}, {1, 0}}}};
  const std::string drawn = draw_curves(plot);
  CHECK(test::xml_problem(drawn) == "");
  CHECK(drawn.find("nan") == drawn.npos);
  CHECK(drawn.find("inf") == drawn.npos);
  CHECK(escaped("a < b & c") == "a &lt; b &amp; c");
}

TEST_CASE("paths_are_quoted_for_the_shell") {
  CHECK(shell_word("/a/b.obj") == "/a/b.obj");
  CHECK(shell_word("a b's.obj") == "'a b'\\''s.obj'");
}

// Returns the median and the worst value over the dragon's poses, relative to mean value coordinates.
std::pair<double, double> energy(const nlohmann::json& report, const char* deformer) {
  for (const auto& result : report["deformers"]["results"]) {
    if (result["deformer"] != deformer) continue;
    std::vector<double> all;
    for (const auto& pose : result["poses"]) all.push_back(pose["energy_to_mean_value"]);
    std::ranges::sort(all);
    return {all[all.size() / 2], all.back()};
  }
  FAIL("no deformer " << deformer);
  return {};
}

TEST_CASE("statements_of_the_manual_on_deformers_match_the_recorded_report") {
  const std::string manual = test::file_bytes(test::source_dir() / "assets/manual/figures.md");
  const auto said = [](const char* format, double a, double b) {
    char text[200];
    std::snprintf(text, sizeof text, format, a, b);
    return std::string(text);
  };
  const auto smooth = energy(recorded_report(), "smooth"), paper = energy(recorded_report(), "paper");
  CHECK(test::mentions(manual,
                       said("\n%.2f times that of mean value coordinates (median; worst pose: %.2f times)",
                            smooth.first, smooth.second)));
  CHECK(test::mentions(manual, said("\n%.1f times that of mean value coordinates (worst pose: %.1f times)",
                                    paper.first, paper.second)));
}

TEST_CASE("numbers_of_readme_and_manual_match_the_recorded_report") {
  const nlohmann::json report = recorded_report();
  CHECK(report["exponentials"]["double"]["count"] == 10'000'000);
  const auto readme = rows_of("README.md"), manual = rows_of("assets/manual/figures.md");
  check_exponentials(readme, report);
  check_exponentials(manual, report);
  for (const std::size_t faces : {50, 100, 300, 600}) {
    const auto row = std::ranges::find(manual, std::to_string(faces), [](const Cells& c) { return c[0]; });
    REQUIRE(row != manual.end());
    check_frames({row->begin() + 1, row->end()}, report, faces);
  }
}

TEST_CASE("every_case_runs_once_per_round_after_one_warm_up_and_can_be_cancelled") {
  std::string order;
  base::Progress progress;
  const auto results = measure_rounds(
      {{"a", 1, [&](std::size_t) { order += 'a'; }}, {"b", 10, [&](std::size_t) { order += 'b'; }, 2}}, 2,
      progress);
  CHECK(order == "abbabbabb");
  REQUIRE(results.size() == 2);
  CHECK(results[1].name == "b");
  CHECK(progress.done() == 1);
  const auto cancel = [&](std::size_t) { progress.cancel(); };
  CHECK_THROWS_AS(measure_rounds({{"a", 1, cancel}}, 100, progress), base::Cancelled);
}

TEST_CASE("limits_are_met_from_above_or_from_below") {
  Bars bars;
  bars.check("as fast", 5, 5, true);
  bars.check("too slow", 4.9, 5, true);
  bars.check("small enough", 4.9, 5, false);
  REQUIRE(bars.rows.size() == 3);
  CHECK(bars.rows[0]["met"] == true);
  CHECK(bars.rows[1]["met"] == false);
  CHECK(bars.rows[2]["met"] == true);
}

TEST_CASE("every_exp_method_works_in_double_and_float") {
  const sym3::Sym3<double> s{0.3, 0.1, -0.2, 0.4, 0.05, -0.1};
  const sym3::Sym3<float> f{0.3F, 0.1F, -0.2F, 0.4F, 0.05F, -0.1F};
  CHECK(exp_methods().size() >= 6);
  for (const auto& method : exp_methods()) {
    CHECK_MESSAGE(sym3::relative_error(method.in_double(s), s) < 1e-13, method.name);
    const auto e = method.in_float(f);
    CHECK_MESSAGE(sym3::relative_error({e.xx, e.xy, e.xz, e.yy, e.yz, e.zz}, s) < 1e-5, method.name);
  }
}
