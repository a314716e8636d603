#include "workspace/pose_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pose/maps.h"

namespace viete::workspace {

namespace {

using mesh::Point, mesh::Vec3;

using Corners = std::span<const std::uint32_t>;

constexpr Vec3 to_light{-0.42, 0.68, 0.6};  // unit vector
constexpr double shade = 0.62, span_of_light = 0.38;

std::vector<Point> upright(std::span<const Point> points, document::UpAxis up) {
  std::vector<Point> all(points.begin(), points.end());
  if (up == document::UpAxis::z)
    for (Point& p : all) p = {p[0], p[2], -p[1]};
  if (up == document::UpAxis::minus_y)
    for (Point& p : all) p = {p[0], -p[1], -p[2]};
  return all;
}

// An orthographic view along -z, after rotations about the up axis and about the right axis.
class PictureView {
public:
  // The picture shows the points of `rest` and of `posed`. Y is up.
  PictureView(const std::vector<Point>& rest, const std::vector<Point>& posed) {
    std::vector<Point> points;
    for (const auto* all : {&rest, &posed})
      for (const Point& p : *all) points.push_back(seen(p));
    const mesh::Bounds box = mesh::bounds(points);
    middle_ = box.center();
    const glm::vec2 room = pose_picture_size - 2 * margin;
    scale_ = std::min(room.x / (box.high[0] - box.low[0]), room.y / (box.high[1] - box.low[1]));
  }

  // Coordinates in the view: right, up, towards the viewer.
  Vec3 seen(const Point& p) const { return pose::times(turn_, p); }
  glm::vec2 at(const Point& p) const {
    const Vec3 s = seen(p);
    return 0.5f * pose_picture_size + glm::vec2(scale_ * (s[0] - middle_[0]), -scale_ * (s[1] - middle_[1]));
  }

private:
  static constexpr float margin = 3;

  static sym3::Mat3<double> turn() {
    constexpr double yaw = -32 * std::numbers::pi / 180, pitch = 18 * std::numbers::pi / 180;
    const double c = std::cos(yaw), s = std::sin(yaw), d = std::cos(pitch), t = std::sin(pitch);
    return {c, 0, s, t * s, d, -t * c, -d * s, t, d * c};
  }

  sym3::Mat3<double> turn_ = turn();
  Point middle_{0, 0, 0};
  double scale_ = 1;
};

// The normal of a polygon in the view. The length is twice the area.
Vec3 normal_of(const PictureView& view, Corners corners, std::span<const Point> at) {
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3 first = view.seen(at[corners[0]]);
    sum = sum + mesh::cross(view.seen(at[corners[i - 1]]) - first, view.seen(at[corners[i]]) - first);
  }
  return sum;
}

double nearness(const PictureView& view, Corners corners, std::span<const Point> at) {
  double sum = 0;
  for (const auto v : corners) sum += view.seen(at[v])[2];
  return sum / static_cast<double>(corners.size());
}

// The brightness of a face with this normal in view coordinates.
float lightness(const Vec3& normal) {
  const double lit = mesh::dot(normal, to_light) / mesh::norm(normal);
  return static_cast<float>(shade + span_of_light * std::clamp(lit, -0.6, 1.0));
}

// The front-facing polygons of the model with their brightness, sorted from back to front.
std::vector<PictureShape> lit_model(const PictureView& view, const mesh::Surface& model,
                                    std::span<const Point> at) {
  constexpr double seen_from_the_side = 1e-9;
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const Corners corners = model.polygon(p);
    if (normal_of(view, corners, at)[2] > seen_from_the_side)
      found.emplace_back(nearness(view, corners, at), p);
  }
  std::ranges::sort(found);
  std::vector<PictureShape> shapes;
  for (const auto& [near, p] : found) {
    const Corners corners = model.polygon(p);
    PictureShape& shape = shapes.emplace_back();
    for (const auto v : corners) shape.points.push_back(view.at(at[v]));
    std::ranges::reverse(shape.points);
    const auto last = model.polygon_starts[p + 1] - 1;
    for (const auto& [i, j, k] : mesh::clipped_of(model, p))
      shape.triangles.push_back({last - i, last - j, last - k});
    shape.tone = lightness(normal_of(view, corners, at));
  }
  return shapes;
}

constexpr int pixels_per_point = 2, shades = 7;

// Draws shaded triangles with a depth buffer.
class Raster {
public:
  // `t` contains the corners: x and y in pixels, z towards the viewer. Small triangles cover one pixel.
  void add(const std::array<mesh::Vec3, 3>& t, float tone) {
    const auto [low_x, high_x] = std::minmax({t[0][0], t[1][0], t[2][0]});
    const auto [low_y, high_y] = std::minmax({t[0][1], t[1][1], t[2][1]});
    const double z = (t[0][2] + t[1][2] + t[2][2]) / 3;
    if (high_x - low_x < 1 && high_y - low_y < 1) return put(low_x, low_y, z, tone);
    for (int y = first(low_y); y <= last(high_y, height); ++y)
      for (int x = first(low_x); x <= last(high_x, width); ++x)
        if (covers(t, x + 0.5, y + 0.5)) put(x, y, z, tone);
  }

  std::vector<PictureShape> rows() const {
    std::vector<PictureShape> rows;
    for (int y = 0; y < height; ++y)
      for (int x = 0, end = 0; x < width; x = end) {
        const float tone = tones_[index(x, y)];
        while (end < width && tones_[index(end, y)] == tone) ++end;
        if (tone > 0) rows.push_back(row(x, end, y, tone));
      }
    return rows;
  }

private:
  static int first(double low) { return std::max(0, static_cast<int>(std::floor(low))); }
  static int last(double high, int size) { return std::min(size - 1, static_cast<int>(std::floor(high))); }
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * width + x); }

  static bool covers(const std::array<mesh::Vec3, 3>& t, double x, double y) {
    const auto side = [&](int i, int j) {
      return (t[j][0] - t[i][0]) * (y - t[i][1]) - (t[j][1] - t[i][1]) * (x - t[i][0]);
    };
    const double a = side(0, 1), b = side(1, 2), c = side(2, 0);
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
  }

  void put(double x, double y, double z, float tone) {
    const int column = static_cast<int>(std::floor(x)), line = static_cast<int>(std::floor(y));
    if (column < 0 || line < 0 || column >= width || line >= height) return;
    const std::size_t i = index(column, line);
    if (z > depth_[i]) {
      depth_[i] = z;
      tones_[i] = tone;
    }
  }

  static PictureShape row(int begin, int end, int y, float tone) {
    constexpr float point = 1.0f / pixels_per_point;
    const float x0 = point * static_cast<float>(begin), x1 = point * static_cast<float>(end);
    const float y0 = point * static_cast<float>(y), y1 = y0 + point;
    return {false, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, tone, {{0, 1, 2}, {0, 2, 3}}};
  }

  static constexpr int width = static_cast<int>(pose_picture_size.x) * pixels_per_point;
  static constexpr int height = static_cast<int>(pose_picture_size.y) * pixels_per_point;

  std::vector<double> depth_ = std::vector<double>(width * height, -std::numeric_limits<double>::infinity());
  std::vector<float> tones_ = std::vector<float>(width * height);  // 0: empty
};

// A shape of the model, scaled so that the model at rest fits too. Empty without triangles.
std::vector<PictureShape> shape_picture(const mesh::Surface& model, std::span<const mesh::Point> shape,
                                        document::UpAxis up) {
  if (model.triangles.empty()) return {};
  const std::vector<mesh::Point> at = upright(shape, up);
  const PictureView view(upright(model.positions, up), at);
  Raster raster;
  for (const auto& [a, b, c] : model.triangles) {
    const mesh::Vec3 p = view.seen(at[a]), q = view.seen(at[b]), r = view.seen(at[c]);
    const mesh::Vec3 normal = mesh::cross(q - p, r - p);
    if (!(mesh::norm(normal) > 0)) continue;
    const auto placed = [&](std::uint32_t v, double z) {
      const glm::vec2 on = static_cast<float>(pixels_per_point) * view.at(at[v]);
      return mesh::Vec3{on.x, on.y, z};
    };
    // Back faces are visible in open models. The normal must point to the viewer.
    const float light = lightness(normal[2] < 0 ? -1.0 * normal : normal);
    raster.add({placed(a, p[2]), placed(b, q[2]), placed(c, r[2])}, std::round(shades * light) / shades);
  }
  return raster.rows();
}

}  // namespace

std::vector<PictureShape> pose_picture(const mesh::Surface& cage, std::span<const mesh::Point> posed,
                                       document::UpAxis up) {
  constexpr std::size_t most_faces = 3000;  // thumbnails of larger cages are slow and illegible
  if (cage.polygon_count() > most_faces) return {};
  const std::vector<Point> at = upright(posed, up);
  return lit_model(PictureView(upright(cage.positions, up), at), cage, at);
}

const std::vector<PictureShape>& PosePictures::of(const document::Document& document,
                                                  const document::SharedPose& pose, document::UpAxis up) {
  if (document.cage() != cage_ || document.model().surface != model_ || up != up_) pictures_.clear();
  cage_ = document.cage();
  model_ = document.model().surface;
  up_ = up;
  Picture& picture = pictures_[pose.get()];
  if (picture.pose) return picture.shapes;
  picture.pose = pose;
  picture.shapes = cage_ && !pose->shape
                       ? pose_picture(cage_->surface, pose->cage.positions, up)
                       : shape_picture(*model_, pose->shape ? *pose->shape : model_->positions, up);
  return picture.shapes;
}

void PosePictures::tidy() {
  std::erase_if(pictures_, [](const auto& entry) { return entry.second.pose.use_count() == 1; });
}

}  // namespace viete::workspace
