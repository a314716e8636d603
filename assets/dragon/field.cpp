#include "dragon/field.h"

#include <utility>

namespace viete::dragon {
namespace {

constexpr double kFar = 10;

/// The smaller of both, rounded where they differ by less than blend (quadratic).
double smooth_min(double a, double b, double blend) {
  const double overlap = std::max(blend - std::abs(a - b), 0.0);
  return std::min(a, b) - overlap * overlap / (4 * blend);
}

}  // namespace

void Field::join(std::unique_ptr<Part> part, double blend) {
  add(std::move(part), blend, false);
}

void Field::carve(std::unique_ptr<Part> part, double blend) {
  add(std::move(part), blend, true);
}

void Field::add(std::unique_ptr<Part> part, double blend, bool carves) {
  Box box = part->box();
  entries_.push_back({std::move(part), blend, carves, box});
}

Box Field::box() const {
  Box all;
  for (const Entry& entry : entries_) {
    if (entry.carves) continue;
    all.add(entry.box.low, entry.blend);
    all.add(entry.box.high, entry.blend);
  }
  return all;
}

std::vector<int> Field::near(Vec3 p, double radius) const {
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(entries_.size()); ++i) {
    if (entries_[i].box.contains(p, radius + entries_[i].blend)) found.push_back(i);
  }
  return found;
}

double Field::value(Vec3 p, std::span<const int> parts) const {
  double value = kFar;
  for (int i : parts) {
    const Entry& entry = entries_[i];
    const double distance = entry.part->distance(p);
    value =
        entry.carves ? -smooth_min(-value, distance, entry.blend) : smooth_min(value, distance, entry.blend);
  }
  return value;
}

Vec3 Field::gradient(Vec3 p, std::span<const int> parts, double step) const {
  const auto slope = [&](Vec3 direction) {
    return (value(p + direction * step, parts) - value(p - direction * step, parts)) / (2 * step);
  };
  return {slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})};
}

}  // namespace viete::dragon
