#include "dragon/splats.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dragon/files.h"
#include "dragon/quaternion.h"

namespace viete::dragon {
namespace {

using Color = std::array<double, 3>;

/// Natural logarithm of a positive number by its series: the C library's differ from machine to machine.
double logarithm(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent), t = (mantissa - 1) / (mantissa + 1);
  double sum = 0, power = t;
  for (int k = 1; k < 60; k += 2, power *= t * t) sum += power / k;
  return 2 * sum + exponent * 0.693147180559945309417;
}

/// A number in [0, 1) that looks random.
double noise(std::size_t splat, std::size_t purpose) {
  std::uint64_t x = splat * 0x9E3779B97F4A7C15U + purpose * 0xD1B54A32D192ED03U;
  for (const int shift : {30, 27, 31}) x = (x ^ x >> shift) * 0xBF58476D1CE4E5B9U;
  return static_cast<double>(x >> 11) / 9007199254740992.0;
}

/// Real spherical harmonics of degrees 1 to 3 in a unit direction, with the signs of captures.
std::array<double, 15> harmonics(Vec3 d) {
  const double x = d.x, y = d.y, z = d.z, xx = x * x, yy = y * y, zz = z * z;
  return {-0.4886025119029199 * y,
          0.4886025119029199 * z,
          -0.4886025119029199 * x,
          1.0925484305920792 * x * y,
          -1.0925484305920792 * y * z,
          0.31539156525252005 * (2 * zz - xx - yy),
          -1.0925484305920792 * x * z,
          0.5462742152960396 * (xx - yy),
          -0.5900435899266435 * y * (3 * xx - yy),
          2.890611442640554 * x * y * z,
          -0.4570457994644658 * y * (4 * zz - xx - yy),
          0.3731763325901154 * z * (2 * zz - 3 * xx - 3 * yy),
          -0.4570457994644658 * x * (4 * zz - xx - yy),
          1.445305721320277 * z * (xx - yy),
          -0.5900435899266435 * x * (xx - 3 * yy)};
}

/// Distance to the nearest whole number, 0 to 0.5.
double ripple(double x) {
  return std::abs(x - std::floor(x) - 0.5);
}

/// Green back with darker stripes, a light belly, red wing tips, lit from above.
Color color_of(Vec3 p, Vec3 normal, Vec3 light) {
  const double belly = smooth_step(0.1, 0.8, -normal.y), tips = smooth_step(0.45, 0.95, std::abs(p.z));
  const double stripes = 0.8 + 0.5 * ripple(9 * p.x) * (1 - belly);
  const double shade = 0.35 + 0.35 * (1 + dot(normal, light));
  const Color back{0.16, 0.50, 0.36}, front{0.85, 0.76, 0.50}, wing{0.72, 0.26, 0.20};
  Color color;
  for (std::size_t i = 0; i < 3; ++i)
    color[i] = shade * stripes * lerp(lerp(back[i], front[i], belly), wing[i], tips);
  return color;
}

/// A rotation from z to the normal, after a turn about z.
Quaternion rotation(Vec3 normal, double degrees) {
  const bool opposite = normal.z < -0.9999;
  const Quaternion arc{opposite ? 0 : 1 + normal.z, opposite ? Vec3{1, 0, 0} : Vec3{-normal.y, normal.x, 0}};
  return arc * about({0, 0, 1}, degrees);
}

std::vector<Vec3> vertex_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.positions[a];
    const Vec3 normal = cross(mesh.positions[b] - p, mesh.positions[c] - p);
    for (const std::uint32_t v : {a, b, c}) normals[v] = normals[v] + normal;
  }
  return normals;
}

class SplatFile {
public:
  SplatFile(const Mesh& mesh, std::size_t count) : mesh_(mesh), normals_(vertex_normals(mesh)) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 p = mesh.positions[a];
      areas_.push_back(0.5 * length(cross(mesh.positions[b] - p, mesh.positions[c] - p)));
      area_ += areas_.back();
    }
    spacing_ = std::sqrt(area_ / static_cast<double>(count));
    step_ = area_ / static_cast<double>(count);
  }

  /// Adds the next splat. Splats are evenly distributed by area.
  void add(std::size_t i) {
    const double place = (static_cast<double>(i) + 0.5) * step_;
    while (passed_ + areas_[triangle_] < place && triangle_ + 1 < areas_.size())
      passed_ += areas_[triangle_++];
    double u = noise(i, 0), v = noise(i, 1);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const auto& [a, b, c] = mesh_.triangles[triangle_];
    const auto blend = [&](const std::vector<Vec3>& all) {
      return all[a] * (1 - u - v) + all[b] * u + all[c] * v;
    };
    splat(i, blend(mesh_.positions), normalized(blend(normals_)));
  }

  std::string bytes;

private:
  void splat(std::size_t i, Vec3 p, Vec3 normal) {
    const Vec3 light = normalized({0.3, 0.8, 0.5});
    const Color color = color_of(p, normal, light);
    // Seen against the mirrored light, the surface shines.
    const auto lobe = harmonics(light - normal * (2 * dot(normal, light)));
    put({p.x, p.y, p.z, 0, 0, 0});
    for (const double channel : color) put({(channel - 0.5) / 0.28209479177387814});
    for (int channel = 0; channel < 3; ++channel)
      for (std::size_t k = 0; k < lobe.size(); ++k) put({(k < 3 ? 0.2 : k < 8 ? 0.1 : 0.05) * lobe[k]});
    const bool faint = i % 25 == 24;
    put({faint ? -4 + 3 * noise(i, 2) : 2.5 + 3 * noise(i, 2)});
    for (const double size : {0.8, 0.6, 0.1}) put({logarithm(size * spacing_ * (0.7 + 0.6 * noise(i, 3)))});
    const Quaternion q = rotation(normal, 360 * noise(i, 4)) * (0.5 + noise(i, 5));
    put({q.w, q.v.x, q.v.y, q.v.z});
  }

  void put(std::initializer_list<double> numbers) {
    for (const double x : numbers)
      append_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
  }

  const Mesh& mesh_;
  std::vector<Vec3> normals_;
  std::vector<double> areas_;
  double area_ = 0, spacing_ = 0, step_ = 0, passed_ = 0;
  std::size_t triangle_ = 0;
};

}  // namespace

std::string splats_file(const Mesh& mesh, std::size_t count, const std::string& comment) {
  SplatFile file(mesh, count);
  file.bytes = "ply\nformat binary_little_endian 1.0\ncomment " + comment + "\nelement vertex " +
               std::to_string(count) + "\n";
  const auto properties = [&](const std::string& name, int numbers) {
    for (int i = 0; i < numbers; ++i) file.bytes += "property float " + name + std::to_string(i) + "\n";
  };
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    file.bytes += std::string("property float ") + name + "\n";
  properties("f_dc_", 3);
  properties("f_rest_", 45);
  file.bytes += "property float opacity\n";
  properties("scale_", 3);
  properties("rot_", 4);
  file.bytes += "end_header\n";
  for (std::size_t i = 0; i < count; ++i) file.add(i);
  return std::move(file.bytes);
}

}  // namespace viete::dragon
