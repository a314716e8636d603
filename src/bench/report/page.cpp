#include "bench/report/page.h"

#include <algorithm>

#include "base/quantity.h"
#include "bench/plot.h"
#include "bench/published_shapes.h"
#include "bench/report/findings.h"
#include "bench/report/html.h"
#include "bench/report/sections.h"
#include "bench/report/style.h"
#include "bench/svg.h"

namespace viete::bench {

namespace {

using base::few_digits;

using Glance = std::vector<std::pair<std::string, std::string>>;

// What is worth knowing if nothing else is read: a value, and what it is of.
Glance glance_of(const Figures& figures) {
  const double diag = time_of(figures.exp.methods, "diag"), fast = time_of(figures.exp.methods, "fast");
  Glance glance = {
      {few_digits(diag / fast) + "\u00d7", "faster than Diag: exponentials by Fast, double, from memory"},
      {error_text(worst_of_clusters(figures.accuracy, "Fast")),
       "largest relative error of Fast where eigenvalues come close; Improved SD " +
           error_text(worst_of_clusters(figures.accuracy, "Improved SD"))}};
  const FrameTime* plain = frame_of(figures.frames, frame_names::reference, usual_faces);
  const FrameTime* ours = frame_of(figures.frames, frame_names::compressed, usual_faces);
  if (plain && ours)
    glance.push_back({base::milliseconds(ours->cpu_ms),
                      "a frame of " + base::with_thousands(ours->vertices) + " vertices in a cage of " +
                          std::to_string(usual_faces) + " triangles; plainly built " +
                          base::milliseconds(plain->cpu_ms)});
  if (const auto* most = most_lost(figures.shapes))
    glance.push_back({lost_volume((*most)["straight"]),
                      "of the volume is lost halfway to " + name_of_shape(*most) +
                          " on straight lines; in log space " + lost_volume((*most)["log_space"])});
  return glance;
}

std::string head(const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"generator\" content=\"viete report\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
         escaped(title) + "</title>\n<link rel=\"icon\" href=\"data:,\"/>\n<style>" + page_style() +
         "</style>\n</head>\n";
}

std::string header(const Figures& figures, const Made& made, const std::vector<Section>& sections) {
  std::string text =
      "<header>\n<h1>Exponentials, and what they move</h1>\n" +
      paragraph("What Viete measures on " + made.processor + ", " + made.date +
                ": the three figures of the paper behind it, and five of our own. Times of one table were "
                "taken in turns, so that ratios are worth more than nanoseconds.") +
      "<dl class=\"glance\">\n";
  for (const auto& [value, what] : glance_of(figures))
    text += "<div><dt>" + escaped(what) + "</dt><dd>" + escaped(value) + "</dd></div>\n";
  text += "</dl>\n<nav aria-label=\"Contents\"><ol>\n";
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
  for (const std::string& command : section.commands) text += command_line(command);
  return text + "</section>\n";
}

std::string footer(const Made& made, const nlohmann::json& json) {
  HtmlTable table{{"", "here"}, {}, {"here"}};
  for (const auto& [what, value] : facts_of(made)) table.rows.push_back({what, value});
  return "<footer id=\"made\">\n<h2>How it was measured</h2>\n" +
         paragraph(
             "Medians of interleaved rounds, in processor time of the calling thread, so that what else runs "
             "disturbs "
             "little, and all of a table alike. Ratios vary by a third from run to run on a machine that "
             "others "
             "use. Everything random has a fixed seed.") +
         html(table) +
         "<details class=\"raw\"><summary>All numbers, as in report.json</summary>\n<pre class=\"raw\">" +
         escaped(json.dump(1)) + "</pre></details>\n</footer>\n";
}

}  // namespace

nlohmann::json report_json(const Figures& figures, const Made& made) {
  nlohmann::json json = to_json(figures);
  json["figure"] = "report";
  json["made"] = to_json(made);
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
