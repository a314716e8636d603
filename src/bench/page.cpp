#include "bench/page.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/assets.h"
#include "base/text.h"
#include "sym3/kernel.h"

namespace viete::bench {

std::string paragraph(std::string_view text, std::string_view kind) {
  const std::string attribute = kind.empty() ? "" : " class=\"" + std::string(kind) + "\"";
  return "<p" + attribute + ">" + escaped(text) + "</p>\n";
}

std::string html(const Table& table) {
  const auto opened = [&](const char* tag, std::size_t column, const char* scope) {
    const bool is_word = column == 0 || std::ranges::count(table.words, table.columns[column]) > 0;
    return std::string("<") + tag + (*scope ? std::string(" scope=\"") + scope + "\"" : "") +
           (is_word ? "" : " class=\"n\"") + ">";
  };
  std::string text = "<div class=\"wide\" tabindex=\"0\"><table><thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    text += opened("th", c, "col") + escaped(table.columns[c]) + "</th>";
  text += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      const char* tag = c == 0 ? "th" : "td";
      text += opened(tag, c, c == 0 ? "row" : "") + escaped(row[c]) + "</" + tag + ">";
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string figure(std::string_view title, std::string_view svg) {
  return "<figure role=\"group\"><figcaption>" + escaped(title) + "</figcaption>\n" + std::string(svg) +
         "</figure>\n";
}

namespace {

std::string date_now() {
  using namespace std::chrono;
  const auto now = floor<minutes>(system_clock::now());
  const auto day = floor<days>(now);
  const year_month_day date(day);
  const hh_mm_ss time(now - day);
  return base::formatted("%04d-%02u-%02u %02d:%02d UTC", int(date.year()), unsigned(date.month()),
                         unsigned(date.day()), int(time.hours().count()), int(time.minutes().count()));
}

// The colours of the plots and the colours that replace them in the dark theme.
constexpr const char* dark_colors[][2] = {
    {"#ffffff", "none"},    {"#1f2933", "#e3e7ec"}, {"#6b7785", "#9aa5b1"}, {"#e4e8ec", "#2b333c"},
    {"#cfd6dd", "#3b4651"}, {"#9aa5b1", "#6b7785"}, {"#c77700", "#f0a13a"}, {"#0072b2", "#56b4e9"},
    {"#009e73", "#3fc79a"}, {"#b3589a", "#d98cc4"}, {"#3a3f9e", "#9499f0"}};

std::string head(const std::string& title) {
  std::string style = std::string(page_style()) + "@media screen and (prefers-color-scheme:dark){";
  for (const auto& [light, dark] : dark_colors)
    for (const std::string property : {"fill", "stroke"})
      style += "svg [" + property + "=\"" + light + "\"]{" + property + ":" + dark + "}";
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"generator\" content=\"viete report\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
         escaped(title) + "</title>\n<link rel=\"icon\" href=\"data:,\"/>\n<style>" + style +
         "}\n</style>\n</head>\n";
}

std::string header(const Figures& figures, const Made& made, const std::vector<Section>& sections) {
  std::string text =
      "<header>\n<h1>Matrix exponentials and deformation</h1>\n" +
      paragraph("Measured by Viete on " + made.processor + ", " + made.date +
                ". The report shows the three figures of the paper and five others. The times of a table "
                "are measured in turns, so ratios are more reliable than absolute times.") +
      summary_of(figures) + "<nav aria-label=\"Contents\"><ol>\n";
  for (const Section& s : sections)
    text += "<li><a href=\"#" + s.id + "\">" + escaped(s.title) + "</a></li>\n";
  return text + "<li><a href=\"#made\">How it was measured</a></li>\n</ol></nav>\n</header>\n";
}

std::string html(const Section& section) {
  std::string text = "<section id=\"" + section.id + "\">\n" + paragraph(section.origin, "origin") + "<h2>" +
                     escaped(section.title) + "</h2>\n";
  if (!section.seen.empty()) text += paragraph(section.seen, "seen");
  if (!section.why.empty()) text += paragraph(section.why, "why");
  text += section.body;
  for (const std::string& command : section.commands)
    text += "<pre class=\"command\"><code>" + escaped(command) + "</code></pre>\n";
  return text + "</section>\n";
}

std::string footer(const Made& made, const nlohmann::json& json) {
  Table table{{"", "here"}, {}, {"here"}};
  for (const auto& [what, value] : made.facts) table.rows.push_back({what, value});
  return "<footer id=\"made\">\n<h2>How it was measured</h2>\n" +
         paragraph(
             "Times are medians over rounds, in processor time of one thread. Each round measures all rows "
             "of a table, so other programs slow all rows equally. On a busy computer, ratios vary by a "
             "third from run to run. Random inputs have a fixed seed.") +
         html(table) +
         "<details class=\"raw\"><summary>All numbers, as in report.json</summary>\n<pre class=\"raw\">" +
         escaped(json.dump(1)) + "</pre></details>\n</footer>\n";
}

}  // namespace

Made made_here(const std::string& command, double seconds) {
  std::string processor = base::os::processor_name();
  if (processor.empty()) processor = "an unnamed processor";
  processor += ", " + base::counted(std::thread::hardware_concurrency(), "thread");
  const std::string date = date_now();
  return {date,
          processor,
          {{"Computer", processor},
           {"Memory", base::memory_size(base::os::total_memory().value_or(0))},
           {"System", base::os::system_name()},
           {"Program", std::string("viete ") + app::version() + ", " + app::build_type()},
           {"Kernel of the vector code", std::string(sym3::kernel_name())},
           {"Measured", date + ", in " + base::few_digits(seconds) + " s"},
           {"Command", command}}};
}

nlohmann::json report_json(const Figures& figures, const Made& made) {
  nlohmann::json json = to_json(figures);
  json["figure"] = "report";
  for (const auto& [what, value] : made.facts) json["made"][what] = value;
  return json;
}

std::string report_page(const Figures& figures, const Made& made) {
  const std::vector<Section> sections = sections_of(figures);
  std::string text =
      head("Viete: a report of " + made.date) + "<body>\n" + header(figures, made, sections) + "<main>\n";
  for (const Section& section : sections) text += html(section);
  return text + "</main>\n" + footer(made, report_json(figures, made)) + "</body>\n</html>\n";
}

}  // namespace viete::bench
