#include "app/output.h"

namespace viete::app {

void BenchFiles::check(const FilesInUse& inputs) const {
  check_output(json, Content::json, inputs, force);
  FilesInUse all = inputs;
  all.add(json, "the numbers");
  check_output(plot, Content::svg, all, force);
}

}  // namespace viete::app
