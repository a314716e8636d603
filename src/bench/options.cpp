#include "bench/options.h"

#include "app/options.h"

namespace viete::bench {

using app::Content, app::FilesInUse;

void BenchFiles::check(const FilesInUse& inputs) const {
  app::check_output(json, Content::json, inputs, force);
  FilesInUse all = inputs;
  all.add(json, "the numbers");
  app::check_output(plot, Content::svg, all, force);
}

void add_rounds_option(CLI::App& app, std::size_t& rounds, const char* usual) {
  app::whole_in_range(app.add_option("--rounds", rounds, "Repetitions"), 1, 1000)->default_str(usual);
}

void add_bench_files(CLI::App& app, BenchFiles& files, bool has_plot) {
  app::add_file_option(app, "--json", files.json, "Also write the numbers to this file");
  if (has_plot) app::add_file_option(app, "--plot", files.plot, "Also draw them: an SVG file");
  app::add_force_option(app, files.force);
}

}  // namespace viete::bench
