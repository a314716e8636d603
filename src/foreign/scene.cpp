#include "foreign/scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>

#include "formats/materials.h"
#include "formats/text_writer.h"

namespace viete::foreign {

namespace {

using formats::Attributes;
using Indices = std::vector<std::uint32_t>;

// Changes with every change of the members below.
constexpr std::string_view signature = "viete scene 2\n";

// Numbers and arrays of numbers, which are stored as in memory.
template <class T>
constexpr bool is_plain = std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>;

// Writes values to `bytes`, or reads them. Lists begin with their size.
class Stream {
public:
  Stream() = default;
  explicit Stream(std::string_view from) : reads_(true), rest_(from) {}

  template <class... Values>
  void operator()(Values&... all) {
    (value(all), ...);
  }

  std::string bytes;
  bool at_end() const { return rest_.empty(); }

private:
  template <class T>
  void value(T& value) {
    if constexpr (is_plain<T>)
      raw(&value, sizeof value);
    else
      members(*this, value);
  }
  void value(bool& value) {
    unsigned char byte = value ? 1 : 0;
    raw(&byte, 1);
    value = byte != 0;
  }
  template <class T>
  void value(std::vector<T>& values) {
    list(values);
  }
  void value(std::string& text) { list(text); }

  template <class List>
  void list(List& values) {
    using Value = typename List::value_type;
    constexpr bool plain = is_plain<Value>;
    constexpr std::size_t least = plain ? sizeof(Value) : sizeof(std::uint64_t);  // bytes of an element
    std::uint64_t count = values.size();
    raw(&count, sizeof count);
    if (reads_ && count > rest_.size() / least) throw DamagedScene("the output ends early");
    values.resize(static_cast<std::size_t>(count));
    if constexpr (plain)
      raw(values.data(), values.size() * sizeof(Value));
    else
      for (auto& element : values) value(element);
  }

  void raw(void* memory, std::size_t count) {
    if (!reads_) {
      bytes.append(static_cast<const char*>(memory), count);
      return;
    }
    if (count > rest_.size()) throw DamagedScene("the output ends early");
    rest_.copy(static_cast<char*>(memory), count);
    rest_.remove_prefix(count);
  }

  bool reads_ = false;
  std::string_view rest_;
};

// The functions members() list what is stored.
void members(Stream& stream, formats::ImageFile& image) {
  std::string path = image.path.string(), bytes = image.bytes ? *image.bytes : "";
  stream(path, bytes, image.name);
  image.path = path;
  if (!bytes.empty()) image.bytes = std::make_shared<const std::string>(std::move(bytes));
}

void members(Stream& stream, formats::Material& m) {
  stream(m.name, m.base_color, m.metallic, m.roughness, m.emission, m.is_translucent, m.repeats);
  for (const formats::MaterialImage& property : formats::material_images) stream(m.*property.image);
}

void members(Stream& stream, formats::Group& g) {
  stream(g.first_polygon, g.object, g.name, g.material, g.smooth);
}

void members(Stream& stream, Target& target) {
  stream(target.name, target.positions);
}

void members(Stream& stream, Scene& s) {
  Attributes& a = s.attributes;
  stream(s.failure, s.positions, s.corners, s.polygon_starts, s.targets, s.notes, s.ignored);
  stream(a.texture_points, a.corner_texture, a.normals, a.corner_normal, a.colors, a.groups, a.materials,
         a.images);
}

void require(bool valid, const char* what) {
  if (!valid) throw DamagedScene(std::string("invalid ") + what);
}

void require_below(const Indices& indices, std::size_t count, bool may_be_none, const char* what) {
  for (const std::uint32_t i : indices) require(i < count || (may_be_none && i == mesh::none), what);
}

void require_places(const std::vector<mesh::Point>& positions) {
  for (const mesh::Point& p : positions) require(formats::is_place(p), "positions");
}

void require_color(const formats::Color& color) {
  for (const float x : color) require(x >= 0 && x <= 1, "colours");
}

// Checks texture points or normals: finite values, and one index per corner, or no values.
template <class Values>
void require_of_corners(const Values& values, const Indices& of_corner, std::size_t corners,
                        const char* what) {
  require(of_corner.size() == (values.empty() ? 0 : corners), what);
  require_below(of_corner, values.size(), true, what);
  for (const auto& value : values)
    for (const auto number : value) require(std::isfinite(number), what);
}

void check_polygons(const Scene& scene) {
  const Indices& starts = scene.polygon_starts;
  require(scene.positions.size() < mesh::none && scene.corners.size() < mesh::none, "sizes");
  require(!starts.empty() && starts.front() == 0 && starts.back() == scene.corners.size(), "polygons");
  for (std::size_t p = 0; p + 1 < starts.size(); ++p)
    require(starts[p] < starts[p + 1] && starts[p + 1] - starts[p] >= 3, "polygons");
  require_below(scene.corners, scene.positions.size(), false, "corners");
}

void check_groups(const Attributes& a, std::size_t polygons) {
  require(a.groups.empty() || a.groups.front().first_polygon == 0, "groups");
  require(std::ranges::is_sorted(a.groups, {}, &formats::Group::first_polygon), "groups");
  for (const formats::Group& group : a.groups) {
    require(group.first_polygon < polygons, "groups");
    require_below({group.material}, a.materials.size(), true, "materials");
  }
  for (const formats::Material& material : a.materials) {
    for (const formats::MaterialImage& property : formats::material_images)
      require_below({material.*property.image}, a.images.size(), true, "images");
    require_color(material.base_color);
    require_color(material.emission);
    require_color({material.metallic, material.roughness});
  }
}

void check(const Scene& scene) {
  const Attributes& a = scene.attributes;
  require_places(scene.positions);
  check_polygons(scene);
  require_of_corners(a.texture_points, a.corner_texture, scene.corners.size(), "texture points");
  require_of_corners(a.normals, a.corner_normal, scene.corners.size(), "normals");
  require(a.colors.empty() || a.colors.size() == scene.positions.size(), "colours");
  std::ranges::for_each(a.colors, require_color);
  check_groups(a, scene.polygon_starts.size() - 1);
  for (const Target& target : scene.targets) {
    require(target.positions.size() == scene.positions.size(), "morph targets");
    require_places(target.positions);
  }
}

}  // namespace

std::string bytes_of(Scene scene) {
  Stream stream;
  stream.bytes = signature;
  members(stream, scene);
  return std::move(stream.bytes);
}

Scene scene_of(std::string_view bytes) {
  if (!bytes.starts_with(signature)) throw DamagedScene("the output has no signature");
  Stream stream(bytes.substr(signature.size()));
  Scene scene;
  members(stream, scene);
  if (!stream.at_end()) throw DamagedScene("the output has surplus bytes");
  if (scene.failure.empty()) check(scene);
  return scene;
}

}  // namespace viete::foreign
