#include "bench/cage.h"

#include <cstdio>
#include <functional>
#include <string>

#include "base/clock.h"
#include "base/quantity.h"
#include "bench/bars.h"
#include "bench/lazy_cage.h"
#include "bench/table.h"
#include "cages/closeness.h"
#include "cages/make.h"
#include "mesh/formats/read.h"

namespace viete::bench {

namespace {

class CageRuns {
public:
  explicit CageRuns(const mesh::Surface& model) : model_(model) {}

  // Prints a row, and returns what the cage is like.
  cages::Closeness add(const std::string& name, std::size_t asked,
                       const std::function<mesh::Surface()>& make) {
    const double start = base::thread_seconds();
    const mesh::Surface cage = make();
    const double seconds = base::thread_seconds() - start;
    if (cage.triangles.empty()) {
      std::printf("  %5zu  %-22s none that encloses\n", asked, name.c_str());
      return {};
    }
    const cages::Closeness close = cages::closeness(cage, model_, pool_);
    std::printf("  %5zu  %-22s %9zu %8.2f s %8.3f %9.2f %% %9.2f %%\n", asked, name.c_str(),
                cage.triangles.size(), seconds, close.volume, 100 * close.mean, 100 * close.most);
    rows_.push_back({{"asked", asked},
                     {"name", name},
                     {"triangles", cage.triangles.size()},
                     {"seconds", seconds},
                     {"volume", close.volume},
                     {"mean", close.mean},
                     {"most", close.most}});
    return close;
  }
  base::WorkerPool& pool() { return pool_; }
  const nlohmann::json& rows() const { return rows_; }

private:
  const mesh::Surface& model_;
  base::WorkerPool pool_{1};
  nlohmann::json rows_ = nlohmann::json::array();
};

}  // namespace

void bench_cage(const CageOptions& options) {
  const mesh::Surface model = mesh::read(options.model).surface;
  std::printf(
      "cage: %s triangles; one thread, its processor time; volume by the model's, distances of its "
      "diagonal\n  asked  way                    triangles      time   volume        mean        most\n",
      base::with_thousands(model.triangles.size()).c_str());
  CageRuns runs(model);
  Bars bars;
  for (const std::size_t triangles : {60, 200, 600}) {
    const auto make = [&](cages::Effort effort) {
      return [&, effort] {
        const cages::Wish wish{.triangles = triangles, .effort = effort};
        return cages::make(model, wish, runs.pool()).surface;
      };
    };
    const auto full = runs.add("viete cage", triangles, make(cages::Effort::full));
    runs.add("its preview", triangles, make(cages::Effort::preview));
    const auto lazy =
        runs.add("offset and decimate", triangles, [&] { return lazy_cage(model, triangles, runs.pool()); });
    if (lazy.mean > 0)
      bars.check(std::to_string(triangles) + " triangles, mean distance: lazy / ours", lazy.mean / full.mean,
                 1, true);
  }
  write_json(options.json, {{"figure", "cage"}, {"results", runs.rows()}, {"bars", bars.rows}});
}

}  // namespace viete::bench
