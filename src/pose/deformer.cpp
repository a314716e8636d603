#include "pose/deformer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "base/error.h"

namespace viete::pose {

namespace {

constexpr base::Choice weights_table[] = {
    {"inverse", "Inverse distance", "1/d^2, where d is the distance to the cage element"},
    {"cutoff", "Cut-off", "(1 - d/radius)^2 at the distance d up to the radius, then 0"},
    {"harmonic", "Harmonic",
     "harmonic functions on the model's surface, largest at the vertices nearest to the cage element"},
    {"biharmonic", "Biharmonic",
     "biharmonic functions on the model's surface, smoother than harmonic; negative values become 0"},
    {"mean-value", "Mean value (MVC)", "mean value coordinates of the cage's vertices"},
};

constexpr base::Choice blend_table[] = {
    {"srl", "Log space",
     "sums the logarithms of rotations and of stretches; both act around the blended centre"},
    {"mls-affine", "Least squares (MLS)", "fits an affine transformation by least squares"},
    {"mls-similarity", "Least squares, similarity", "fits a rotation and a uniform scale by least squares"},
    {"mls-rigid", "Least squares, rigid", "fits a rotation by least squares"},
    {"linear", "Linear (LBS)", "weighted mean of the transformations"},
};

}  // namespace

std::string_view name(Elements elements) {
  return elements == Elements::face ? "triangles" : "vertices";
}

std::span<const base::Choice> choices(Weights) {
  return weights_table;
}
std::span<const base::Choice> choices(Blend) {
  return blend_table;
}
bool fits_points(Blend blend) {
  return blend == Blend::mls_affine || blend == Blend::mls_similarity || blend == Blend::mls_rigid;
}
Elements elements_of(Weights weights, Blend blend) {
  return weights == Weights::mean_value || fits_points(blend) ? Elements::point : Elements::face;
}

std::optional<std::string_view> conflict(const Deformer& deformer) {
  if (deformer.weighting.weights == Weights::mean_value && deformer.blend != Blend::linear)
    return "mean value weights need the linear blend";
  if (deformer.stitched() && !deformer.has_maps())
    return "these weights or this blend use the cage's vertices, but ARAP needs its triangles";
  return std::nullopt;
}

bool fits(const PartialChoice& choice, const Deformer& deformer) {
  return choice.weights.value_or(deformer.weighting.weights) == deformer.weighting.weights &&
         choice.blend.value_or(deformer.blend) == deformer.blend;
}

std::vector<Deformer> valid_deformers() {
  std::vector<Deformer> all;
  for (const Weights weights : base::all_values<Weights>())
    for (const Blend blend : base::all_values<Blend>()) {
      const Deformer deformer{{elements_of(weights, blend), weights}, blend};
      if (!conflict(deformer)) all.push_back(deformer);
    }
  return all;
}

std::string text(const Deformer& deformer) {
  return std::string(base::entry_of(deformer.weighting.weights).word) + ", " +
         std::string(base::entry_of(deformer.blend).word) + (deformer.stitched() ? ", arap" : "");
}

namespace {

constexpr base::Choice presets_table[] = {
    {"smooth", "Smooth", "best for most models: weights along the surface, blended in log space"},
    {"paper", "As published", "as in the paper: inverse-distance weights, blended in log space"},
    {"mean-value", "Mean value",
     "mean value coordinates: exact for affine poses, but rotated parts lose volume"},
    {"rigid", "Rigid", "rigid least squares: rotates without stretching, so details keep their size"},
    {"arap", "As rigid as possible",
     "solves for the most rigid surface: preserves details best, but frames are slower"},
    {"local", "Local", "weights end at a radius: vertices beyond it stay at rest"},
};

constexpr Deformer preset_deformers[] = {
    {.weighting = {Elements::face, Weights::biharmonic}},
    {},
    {.weighting = {Elements::point, Weights::mean_value}, .blend = Blend::linear},
    {.weighting = {Elements::point, Weights::biharmonic}, .blend = Blend::mls_rigid},
    {.weighting = {Elements::face, Weights::biharmonic}, .iterations = 1},
    {.weighting = {Elements::face, Weights::cut_off}},
};

}  // namespace

std::span<const base::Choice> choices(Preset) {
  return presets_table;
}

Deformer deformer_of(Preset preset, const Deformer& now) {
  Deformer deformer = preset_deformers[static_cast<std::size_t>(preset)];
  deformer.amounts = now.amounts;
  return deformer;
}

std::optional<Preset> preset_of(const Deformer& deformer) {
  for (const Preset preset : base::all_values<Preset>()) {
    const Deformer of_preset = deformer_of(preset);
    if (deformer.weighting.weights == of_preset.weighting.weights && deformer.blend == of_preset.blend &&
        deformer.stitched() == of_preset.stitched())
      return preset;
  }
  return std::nullopt;
}

Deformer default_deformer() {
  return deformer_of(Preset::smooth);
}

Deformer complete(const PartialChoice& choice, const Deformer& preferred) {
  Deformer deformer = preferred;
  deformer.iterations = 0;
  deformer.weighting.weights = choice.weights.value_or(preferred.weighting.weights);
  deformer.blend = choice.blend.value_or(preferred.blend);
  if (conflict(deformer) && !choice.blend) deformer.blend = Blend::linear;
  if (conflict(deformer) && !choice.weights) deformer.weighting.weights = Weights::inverse;
  if (const auto reason = conflict(deformer))
    throw base::Error("", "these weights and this blend cannot be combined: " + std::string(*reason),
                      "omit one of them; it is then chosen automatically");
  deformer.weighting.elements = elements_of(deformer.weighting.weights, deformer.blend);
  if (deformer.has_maps()) deformer.iterations = preferred.iterations;
  return deformer;
}

namespace {

using Need = NumberEntry::Need;
constexpr Need has_radius{[](const Deformer&deformer) { return deformer.weighting.partial(); },
                          "these weights have no radius", "omit it, or choose the weights cutoff"},
    has_maps{[](const Deformer&deformer) { return deformer.has_maps(); },
             "this deformer ignores the cage's rotation and stretch",
             "omit it, or choose another deformer or blend"},
    is_stitched{[](const Deformer&deformer) { return deformer.stitched(); }, "this setting needs ARAP",
                "omit it, or choose the deformer arap"};

constexpr std::array numbers_table = {
    NumberEntry{{"radius", "Radius", "Distance at which weights end, relative to the cage's size"},
                [](Deformer& deformer) -> double& { return deformer.weighting.radius; },
                &AskedDeformer::radius,
                has_radius,
                0.001,
                10},
    NumberEntry{{"rotation", "Rotation", "Scale the blended rotation"},
                [](Deformer& deformer) -> double& { return deformer.amounts.rotation; },
                &AskedDeformer::rotation,
                has_maps,
                0,
                2},
    NumberEntry{{"stretch", "Stretch", "Scale the blended stretch"},
                [](Deformer& deformer) -> double& { return deformer.amounts.stretch; },
                &AskedDeformer::stretch,
                has_maps,
                0,
                2},
    NumberEntry{
        {"attach", "Attach", "ARAP: attach vertices within this distance of the cage, relative to its size"},
        [](Deformer& deformer) -> double& { return deformer.holding.radius; },
        &AskedDeformer::attach,
        is_stitched},
    NumberEntry{{"hold", "Hold", "ARAP: pull each vertex towards the position that it has without ARAP"},
                [](Deformer& deformer) -> double& { return deformer.holding.weight; },
                &AskedDeformer::hold,
                is_stitched},
};

[[noreturn]] void refuse(std::string_view setting, const Need& need) {
  throw base::Error(std::string(setting), std::string(need.problem), std::string(need.advice));
}

}  // namespace

std::span<const NumberEntry> all_numbers() {
  return numbers_table;
}
const NumberEntry& number(std::string_view word) {
  return *std::ranges::find(numbers_table, word, &NumberEntry::word);
}

double NumberEntry::percent(Deformer deformer) const {
  return std::round(1e8 * of(deformer)) / 1e6;
}
std::string text_of_percent(double fraction) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, std::round(1e8 * fraction) / 1e6).ptr) +
         " %";
}

Deformer deformer_of(const AskedDeformer& asked, const Deformer& now, bool chosen) {
  Deformer deformer = asked.preset ? deformer_of(*asked.preset, now) : now;
  PartialChoice choice = asked.choice;
  if (asked.radius && !chosen && !asked.preset && !choice.weights) choice.weights = Weights::cut_off;
  if (choice.any()) deformer = complete(choice, deformer);
  if (asked.arap && !deformer.stitched()) deformer.iterations = 1;
  if (asked.iterations && !deformer.stitched()) refuse("iterations", is_stitched);
  deformer.iterations = asked.iterations.value_or(deformer.iterations);
  for (const NumberEntry& number : numbers_table) {
    const std::optional<double>& value = asked.*number.asked;
    if (!value) continue;
    if (!number.need.met(deformer)) refuse(number.word, number.need);
    number.of(deformer) = *value;
  }
  if (const auto reason = conflict(deformer))
    throw base::Error("arap", std::string(*reason), "omit it, or choose another deformer or blend");
  return deformer;
}

EngineKind engine_for(const Deformer& deformer, sym3::Method method, bool all_staged) {
  if (deformer.stitched()) return EngineKind::stitched;
  const bool fuses = !deformer.exponential() || (method == sym3::Method::fast && !all_staged);
  return fuses ? EngineKind::fused : EngineKind::staged;
}

}  // namespace viete::pose
