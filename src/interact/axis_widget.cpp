#include "interact/axis_widget.h"

#include <algorithm>

namespace viete::interact {

namespace {

constexpr float reach = 32, margin = 12, named_ball = 9, plain_ball = 7;  // in logical pixels
constexpr float smallest_view = 160;

}  // namespace

document::StandardView AxisBall::view(document::UpAxis up) const {
  using V = document::StandardView;
  constexpr V views[3][3][2] = {{{V::left, V::right}, {V::bottom, V::top}, {V::back, V::front}},
                                {{V::left, V::right}, {V::front, V::back}, {V::bottom, V::top}},
                                {{V::left, V::right}, {V::top, V::bottom}, {V::front, V::back}}};
  return views[static_cast<std::size_t>(up)][axis][positive ? 1 : 0];
}

const AxisBall* AxisWidget::ball(const glm::vec2& cursor) const {
  const auto found = std::find_if(balls.rbegin(), balls.rend(), [&](const AxisBall& ball) {
    return glm::distance(cursor, ball.at) <= ball.radius + 2;
  });
  return found == balls.rend() ? nullptr : &*found;
}

std::optional<AxisWidget> axis_widget(const document::Camera& camera, const document::Viewport& v) {
  if (std::min(v.size.x, v.size.y) < smallest_view) return std::nullopt;
  AxisWidget widget;
  widget.center = {v.origin.x + v.size.x - axes_radius - margin, v.origin.y + axes_radius + margin};
  for (int i = 0; i < 6; ++i) {
    const bool positive = i < 3;
    glm::vec3 d(0);
    d[i % 3] = positive ? 1.0f : -1.0f;
    const glm::vec2 side(glm::dot(d, camera.right()), -glm::dot(d, camera.up()));
    widget.balls[i] = {i % 3, positive, widget.center + reach * side, -glm::dot(d, camera.forward()),
                       positive ? named_ball : plain_ball};
  }
  std::stable_sort(widget.balls.begin(), widget.balls.end(),
                   [](const AxisBall& a, const AxisBall& b) { return a.nearness < b.nearness; });
  return widget;
}

void look_from(document::Camera& camera, const AxisBall& ball) {
  AxisBall side = ball;
  if (ball.nearness > 0.9999f) side.positive = !side.positive;
  camera.look(side.view(camera.pose().up));
}

}  // namespace viete::interact
