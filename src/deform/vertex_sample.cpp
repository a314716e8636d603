#include "deform/vertex_sample.h"

namespace viete::deform {

std::vector<sym3::Sym3<double>> sample_stretches(const Weigher& weigher, const Binding& binding,
                                                 std::span<const MapLog> logs, std::size_t limit,
                                                 base::Progress* progress) {
  constexpr std::size_t portion = 1024;
  std::vector<sym3::Sym3<double>> sample;
  if (logs.empty()) return sample;
  const std::size_t count = std::min(binding.vertices, limit);
  sample.reserve(count);
  visit_sample(weigher, binding, count, [&](std::size_t, const std::vector<double>& weights) {
    if (progress && sample.size() % portion == 0) {
      progress->report(static_cast<double>(sample.size()) / static_cast<double>(count));
    }
    sym3::Sym3<double> m{};
    for (std::size_t j = 0; j < weights.size(); ++j) {
      const double w = weights[j];
      const auto& x = logs[j].stretch;
      m = {m.xx + w * x.xx, m.xy + w * x.xy, m.xz + w * x.xz, m.yy + w * x.yy, m.yz + w * x.yz, m.zz + w * x.zz};
    }
    sample.push_back(m);
  });
  return sample;
}

}  // namespace viete::deform
