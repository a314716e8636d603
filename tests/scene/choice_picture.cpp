// Chooser pictures: one for each entry, all different, and showing correct data.
#include "scene/pictures/choice_picture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "deform/cage.h"

using namespace viete;
using deform::Blend, deform::Weights;
using scene::choice_picture, scene::ChoicePicture, scene::Ink;
using scene::even, scene::lattice_surface;

namespace {

std::size_t count(const ChoicePicture& picture, Ink ink) {
  return static_cast<std::size_t>(std::ranges::count(picture.shapes, ink, &scene::PictureShape::ink));
}

bool inside(const glm::vec2& p) {
  return p.x >= 0 && p.y >= 0 && p.x <= scene::choice_picture_size.x && p.y <= scene::choice_picture_size.y;
}

void check_shape(const scene::PictureShape& shape) {
  CHECK(shape.points.size() >= 2);
  CHECK(std::ranges::all_of(shape.points, inside));  // false for NaN
  CHECK(std::ranges::all_of(shape.tones, [](float t) { return t >= 0 && t <= 1; }));
  if (shape.ink == Ink::model) CHECK(shape.tones.size() == 1);
  if (shape.ink == Ink::weight) CHECK(shape.tones.size() == shape.points.size());
}

// One for each entry, all different.
template <class Entry>
void check_pictures(std::span<const Entry> table) {
  std::vector<ChoicePicture> seen;
  for (const Entry& e : table) {
    CAPTURE(e.name);
    const ChoicePicture picture = choice_picture(e.value);
    CHECK_FALSE(picture.caption.empty());
    CHECK(count(picture, Ink::model) + count(picture, Ink::weight) > 50);
    CHECK(count(picture, Ink::cage) >= 10);  // edges of quads
    for (const auto& shape : picture.shapes) check_shape(shape);
    CHECK(picture == choice_picture(e.value));
    CHECK(std::ranges::find(seen, picture) == seen.end());
    seen.push_back(picture);
  }
}

// The largest weight where a condition is met.
template <class Where>
float most(const ChoicePicture& picture, Where where) {
  float result = 0;
  for (const auto& shape : picture.shapes) {
    if (shape.ink != Ink::weight) continue;
    for (std::size_t i = 0; i < shape.points.size(); ++i) {
      if (where(shape.points[i])) result = std::max(result, shape.tones[i]);
    }
  }
  return result;
}

float on_the_other_prong(Weights weights) {
  return most(choice_picture(weights), [](const glm::vec2& p) {
    return p.y > 0.55f * scene::choice_picture_size.y && p.x > 0.5f * scene::choice_picture_size.x;
  });
}

// The model's area on screen in square pixels.
double covered(const ChoicePicture& picture) {
  double sum = 0;
  for (const auto& shape : picture.shapes) {
    if (shape.ink != Ink::model) continue;
    for (std::size_t i = 0; i < shape.points.size(); ++i) {
      const glm::vec2 a = shape.points[i], b = shape.points[(i + 1) % shape.points.size()];
      sum += 0.5 * (a.x * b.y - a.y * b.x);
    }
  }
  return sum;
}

double volume_of(const mesh::Surface& s) {
  double sum = 0;
  for (const auto& [a, b, c] : s.triangles)
    sum += mesh::dot(s.positions[a], mesh::cross(s.positions[b], s.positions[c])) / 6;
  return sum;
}

}  // namespace

TEST_CASE("each_entry_of_a_chooser_has_a_picture_of_its_own_the_same_each_time") {
  check_pictures(deform::all_weights());
  check_pictures(deform::all_blends());
}

TEST_CASE("pictures_of_weights_show_what_reaches_across_the_gap") {
  const auto everywhere = [](const glm::vec2&) { return true; };
  for (const auto& e : deform::all_weights()) CHECK(most(choice_picture(e.value), everywhere) > 0.8f);
  CHECK(on_the_other_prong(Weights::inverse) > 0.15f);
  CHECK(on_the_other_prong(Weights::cut_off) > 0.15f);
  CHECK(on_the_other_prong(Weights::harmonic) < 0.02f);
  CHECK(on_the_other_prong(Weights::biharmonic) < 0.02f);
}

TEST_CASE("pictures_of_blends_show_what_caves_in_and_what_does_not_grow") {
  const double whole = covered(choice_picture(Blend::srl));
  CHECK(covered(choice_picture(Blend::linear)) < 0.97 * whole);
  CHECK(covered(choice_picture(Blend::mls_rigid)) < 0.9 * whole);
}

TEST_CASE("a_picture_is_kept_once_it_is_made") {
  scene::ChoicePictures pictures;
  const ChoicePicture& first = pictures.of(Weights::inverse);
  CHECK(first == choice_picture(Weights::inverse));
  CHECK(pictures.of(Blend::srl) == choice_picture(Blend::srl));
  CHECK(&pictures.of(Weights::inverse) == &first);
}

TEST_CASE("a_lattice_is_closed_and_outward_with_shared_corners") {
  const mesh::Surface bar = lattice_surface({even(-3, 3, 6), even(-1, 1, 2), {0, 0.5, 3}});
  CHECK(bar.positions.size() == 7 * 3 * 3 - 5);  // without those inside
  CHECK(bar.polygon_count() == 2 * (6 * 2 + 6 * 2 + 2 * 2));
  CHECK(volume_of(bar) == doctest::Approx(6 * 2 * 3));
  CHECK(deform::make_cage(bar).closed);
}

TEST_CASE("cells_that_are_not_filled_are_left_out") {
  const auto fork = [](int x, int y, int) { return x == 0 || y != 1; };
  const mesh::Surface surface = lattice_surface({even(0, 3, 3), even(0, 3, 3), even(0, 1, 1)}, fork);
  CHECK(volume_of(surface) == doctest::Approx(7));
  const deform::Cage cage = deform::make_cage(surface);
  CHECK(cage.closed);
  CHECK(cage.roots.size() == 1);
  const auto ends = [](int x, int, int) { return x != 1; };
  CHECK(
      deform::make_cage(lattice_surface({even(0, 3, 3), even(0, 1, 1), even(0, 1, 1)}, ends)).roots.size() ==
      2);
}

TEST_CASE("even_steps_end_exactly_at_the_upper_bound") {
  CHECK(even(-3.2, 3.2, 3).front() == -3.2);
  CHECK(even(-3.2, 3.2, 3).back() == 3.2);
  CHECK(even(0, 1, 4) == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
}
