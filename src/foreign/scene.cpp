#include "foreign/scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <type_traits>

#include "formats/text_writer.h"

namespace viete::foreign {

namespace {

using formats::Attributes;
using Indices = std::vector<std::uint32_t>;

// Changes with every change of the members below.
constexpr std::string_view signature = "viete scene 1\n";

// Calls stream(member) for each member. The same functions describe writing and reading.
template <class Stream>
void members(Stream& stream, formats::ImageFile& image) {
  std::string path = image.path.string(), bytes = image.bytes ? *image.bytes : "";
  stream(path, bytes, image.name);
  image.path = path;
  if (!bytes.empty()) image.bytes = std::make_shared<const std::string>(std::move(bytes));
}

template <class Stream>
void members(Stream& stream, formats::Material& material) {
  stream(material.name, material.base_color, material.base_color_image, material.repeats);
}

template <class Stream>
void members(Stream& stream, formats::Group& group) {
  stream(group.first_polygon, group.object, group.name, group.material, group.smooth);
}

template <class Stream>
void members(Stream& stream, Target& target) {
  stream(target.name, target.positions);
}

template <class Stream>
void members(Stream& stream, Scene& scene) {
  Attributes& a = scene.attributes;
  stream(scene.failure, scene.positions, scene.corners, scene.polygon_starts, scene.targets, scene.notes,
         scene.ignored);
  stream(a.texture_points, a.corner_texture, a.normals, a.corner_normal, a.colors, a.groups, a.materials,
         a.images);
}

// Numbers and arrays of numbers, which are stored as in memory.
template <class T>
constexpr bool is_plain = std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>;

class Writer {
public:
  template <class... Members>
  void operator()(Members&... all) {
    (put(all), ...);
  }

  std::string bytes{signature};

private:
  template <class T>
  void put(T& value) {
    if constexpr (is_plain<T>) {
      raw(&value, sizeof value);
    } else {
      members(*this, value);
    }
  }
  void put(bool value) { raw(&value, 1); }
  template <class T>
  void list(T& values) {
    const std::uint64_t count = values.size();
    raw(&count, sizeof count);
    if constexpr (is_plain<typename T::value_type>) {
      raw(values.data(), values.size() * sizeof(typename T::value_type));
    } else {
      for (auto& value : values) put(value);
    }
  }
  template <class T>
  void put(std::vector<T>& values) {
    list(values);
  }
  void put(std::string& text) { list(text); }
  void raw(const void* from, std::size_t count) { bytes.append(static_cast<const char*>(from), count); }
};

class Reader {
public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {
    if (!bytes.starts_with(signature)) throw DamagedScene("the output has no signature");
    rest_.remove_prefix(signature.size());
  }

  template <class... Members>
  void operator()(Members&... all) {
    (take(all), ...);
  }

  void finish() const {
    if (!rest_.empty()) throw DamagedScene("the output has surplus bytes");
  }

private:
  template <class T>
  void take(T& value) {
    if constexpr (is_plain<T>) {
      raw(&value, sizeof value);
    } else {
      members(*this, value);
    }
  }
  void take(bool& value) {
    unsigned char byte = 0;
    raw(&byte, 1);
    value = byte != 0;
  }
  // Each element takes at least `least` bytes.
  std::size_t count(std::size_t least) {
    std::uint64_t count = 0;
    raw(&count, sizeof count);
    if (count > rest_.size() / least) throw DamagedScene("the output ends early");
    return static_cast<std::size_t>(count);
  }
  template <class T>
  void list(T& values) {
    using Value = typename T::value_type;
    if constexpr (is_plain<Value>) {
      values.resize(count(sizeof(Value)));
      raw(values.data(), values.size() * sizeof(Value));
    } else {
      constexpr std::size_t least = sizeof(std::uint64_t);  // the length of a name
      for (std::size_t left = count(least); left > 0; --left) take(values.emplace_back());
    }
  }
  template <class T>
  void take(std::vector<T>& values) {
    list(values);
  }
  void take(std::string& text) { list(text); }
  void raw(void* to, std::size_t count) {
    if (count > rest_.size()) throw DamagedScene("the output ends early");
    if (count > 0) std::memcpy(to, rest_.data(), count);
    rest_.remove_prefix(count);
  }

  std::string_view rest_;
};

void require(bool valid, const char* what) {
  if (!valid) throw DamagedScene(std::string("invalid ") + what);
}

template <class Values>
void require_finite(const Values& values, const char* what) {
  for (const auto& value : values)
    for (const auto number : value) require(std::isfinite(number), what);
}

void require_places(const std::vector<mesh::Point>& positions) {
  require(std::ranges::all_of(positions, [](const mesh::Point& p) { return formats::is_place(p); }),
          "positions");
}

void require_below(const Indices& indices, std::size_t count, bool may_be_none, const char* what) {
  for (const std::uint32_t i : indices) require(i < count || (may_be_none && i == mesh::none), what);
}

// Checks texture points or normals: one index per corner, or no values.
template <class Values>
void require_of_corners(const Values& values, const Indices& of_corner, std::size_t corners,
                        const char* what) {
  require(of_corner.size() == (values.empty() ? 0 : corners), what);
  require_below(of_corner, values.size(), true, what);
  require_finite(values, what);
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
  for (std::size_t i = 0; i < a.groups.size(); ++i) {
    const formats::Group& group = a.groups[i];
    require(group.first_polygon < polygons, "groups");
    require(i == 0 || a.groups[i - 1].first_polygon <= group.first_polygon, "groups");
    require(group.material < a.materials.size() || group.material == mesh::none, "materials");
  }
  for (const formats::Material& m : a.materials) {
    require(m.base_color_image < a.images.size() || m.base_color_image == mesh::none, "images");
    for (const float x : m.base_color) require(x >= 0 && x <= 1, "colours");
  }
}

void check(const Scene& scene) {
  const Attributes& a = scene.attributes;
  require_places(scene.positions);
  check_polygons(scene);
  require_of_corners(a.texture_points, a.corner_texture, scene.corners.size(), "texture points");
  require_of_corners(a.normals, a.corner_normal, scene.corners.size(), "normals");
  require(a.colors.empty() || a.colors.size() == scene.positions.size(), "colours");
  for (const formats::Color& color : a.colors)
    for (const float x : color) require(x >= 0 && x <= 1, "colours");
  check_groups(a, scene.polygon_starts.size() - 1);
  for (const Target& target : scene.targets) {
    require(target.positions.size() == scene.positions.size(), "morph targets");
    require_places(target.positions);
  }
}

}  // namespace

std::string bytes_of(Scene scene) {
  Writer writer;
  members(writer, scene);
  return std::move(writer.bytes);
}

Scene scene_of(std::string_view bytes) {
  Reader reader(bytes);
  Scene scene;
  members(reader, scene);
  reader.finish();
  if (scene.failure.empty()) check(scene);
  return scene;
}

}  // namespace viete::foreign
