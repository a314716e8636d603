#include "formats/materials.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/picture.h"
#include "base/text.h"
#include "formats/source.h"
#include "formats/text_writer.h"

namespace viete::formats {

namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr std::string_view png_mark = "\x89PNG\r\n\x1A\n", jpeg_mark = "\xFF\xD8\xFF";

std::string place_of(const ImageFile& image) {
  return image.path.empty() ? image.name : image.path.string();
}

std::string bytes_of(const ImageFile& image) {
  if (image.bytes) return *image.bytes;
  if (image.path.empty())
    throw base::Error(place_of(image), "the image is missing", "export the model again");
  return std::string(base::FileBytes(image.path, nullptr, most_image_bytes).view());
}

void set_bytes(ImageFile& image, std::string bytes) {
  image.bytes = std::make_shared<const std::string>(std::move(bytes));
}

std::set<std::uint32_t> used_images(const Attributes& a, bool all) {
  std::set<std::uint32_t> used;
  for (const Material& material : a.materials)
    for (const MaterialImage& property : material_images)
      if (all || property.image == &Material::base_color_image) used.insert(material.*property.image);
  used.erase(mesh::none);
  return used;
}

void remove_image(Attributes& a, std::uint32_t image) {
  for (Material& material : a.materials)
    for (const MaterialImage& property : material_images)
      if (material.*property.image == image) material.*property.image = mesh::none;
}

// Calls use(image) for each used image. If this throws base::Error, removes the image from the materials.
// Returns messages.
std::vector<std::string> for_each_image(Attributes& a, bool all, const std::function<void(ImageFile&)>& use) {
  std::vector<std::string> notes;
  for (const std::uint32_t i : used_images(a, all)) {
    try {
      use(a.images[i]);
    } catch (const base::Error& error) {
      notes.push_back(std::string("left out an image: ") + error.what());
      remove_image(a, i);
    }
  }
  return notes;
}

// Decodes an image. If this is impossible, returns an empty picture, and adds a message.
base::Picture decoded(const ImageFile& image, std::vector<std::string>& notes) {
  try {
    return base::decode_picture(place_of(image), *image.bytes);
  } catch (const base::Error& error) {
    notes.push_back(std::string("left out an image: ") + error.what());
    return {};
  }
}

// True for heights, which some files have instead of normals. Also true for an empty picture.
bool is_grey(const base::Picture& picture) {
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4)
    if (picture.rgba[i] != picture.rgba[i + 1] || picture.rgba[i] != picture.rgba[i + 2]) return false;
  return true;
}

void remove_heights(Attributes& a, std::vector<std::string>& notes) {
  for (Material& m : a.materials) {
    if (m.normal_image == mesh::none) continue;
    const base::Picture picture = decoded(a.images[m.normal_image], notes);
    if (!is_grey(picture)) continue;
    if (!picture.rgba.empty())
      notes.push_back("left out an image: " + place_of(a.images[m.normal_image]) +
                      " contains heights instead of normals");
    m.normal_image = mesh::none;
  }
}

// Puts the green channel of one picture and the blue channel of the other into one image, as in glTF. An
// empty picture counts as white.
ImageFile combined(const base::Picture& roughness, const base::Picture& metallic) {
  const int width = std::max({roughness.width, metallic.width, 1});
  const int height = std::max({roughness.height, metallic.height, 1});
  base::Picture both{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto value = [&](const base::Picture& p, std::size_t channel) -> std::uint8_t {
        return p.rgba.empty() ? 255 : p.pixel(x * p.width / width, y * p.height / height)[channel];
      };
      both.rgba.insert(both.rgba.end(), {255, value(roughness, 1), value(metallic, 2), 255});
    }
  ImageFile image{{}, nullptr, "metallic and roughness"};
  set_bytes(image, base::encode_png(image.name, both));
  return image;
}

void combine_images(Attributes& a, std::vector<std::string>& notes) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made;
  const auto picture = [&](std::uint32_t i) {
    return i == mesh::none ? base::Picture{} : decoded(a.images[i], notes);
  };
  for (Material& m : a.materials) {
    if (m.roughness_image == m.metallic_image) continue;
    const auto [at, is_new] =
        made.try_emplace({m.roughness_image, m.metallic_image}, static_cast<std::uint32_t>(a.images.size()));
    if (is_new) a.images.push_back(combined(picture(m.roughness_image), picture(m.metallic_image)));
    m.roughness_image = m.metallic_image = at->second;
  }
}

// The name of a new file for the image. Names in files of other programs can contain anything.
fs::path file_name(const ImageFile& image, std::string_view bytes) {
  std::string text =
      base::cut((image.path.empty() ? fs::path(image.name) : image.path).filename().string(), 100);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || "\\/:*?\"<>|#"sv.find(c) != std::string_view::npos) c = '_';
  fs::path name = text.empty() ? "image" : text;
  if (!name.has_extension() && bytes.starts_with(png_mark)) name += ".png";
  if (!name.has_extension() && bytes.starts_with(jpeg_mark)) name += ".jpg";
  return name;
}

// Returns the path relative to the folder, or nullopt if the file is not in the folder or below.
std::optional<std::string> relative_to(const fs::path& folder, const fs::path& file) {
  if (file.empty() || !base::is_file_below(folder, file)) return std::nullopt;
  return (base::folder_of(file) / file.filename()).lexically_relative(folder).generic_string();
}

// Calls set(polygon, group) for each polygon.
template <class Set>
void for_each_polygon(std::size_t polygons, const std::vector<Group>& groups, const Set& set) {
  std::size_t g = 0;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    while (g + 1 < groups.size() && groups[g + 1].first_polygon <= p) ++g;
    set(p, groups[g]);
  }
}

}  // namespace

float linear_of_srgb(float x) {
  return static_cast<float>(x <= 0.04045F ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

float srgb_of_linear(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

bool make_materials_of_colors(std::size_t polygons, Attributes& a) {
  constexpr std::size_t most_materials = 1000;
  if (!a.materials.empty() || a.polygon_colors.empty()) return false;
  std::map<Color, std::uint32_t> numbers;
  for (const Color& color : a.polygon_colors) {
    numbers.try_emplace(color, static_cast<std::uint32_t>(numbers.size()));
    if (numbers.size() > most_materials) return false;
  }
  a.materials.resize(numbers.size());
  for (const auto& [color, i] : numbers) a.materials[i] = {"color " + std::to_string(i + 1), color};
  const std::vector<Group> groups = a.groups.empty() ? std::vector<Group>(1) : std::exchange(a.groups, {});
  for_each_polygon(polygons, groups, [&](std::uint32_t p, Group group) {
    const bool starts = group.first_polygon == p;
    group.first_polygon = p;
    group.material = numbers[a.polygon_colors[p]];
    if (starts || p == 0 || a.groups.back().material != group.material) a.groups.push_back(std::move(group));
  });
  a.polygon_colors.clear();
  return true;
}

bool make_colors_of_materials(std::size_t polygons, Attributes& a) {
  const Color plain = Material{}.base_color;
  const auto has_color = [&](const Material& m) {
    return m.base_color_image == mesh::none && m.base_color != plain;
  };
  if (!a.colors.empty() || !a.polygon_colors.empty() || a.groups.empty() ||
      std::ranges::none_of(a.materials, has_color))
    return false;
  for_each_polygon(polygons, a.groups, [&](std::uint32_t, const Group& group) {
    a.polygon_colors.push_back(group.material == mesh::none ? plain : a.materials[group.material].base_color);
  });
  return true;
}

void complete_materials(Attributes& a) {
  const auto without = [](const Group& g) { return g.material == mesh::none; };
  if (std::ranges::any_of(a.groups, without)) {
    const auto added = static_cast<std::uint32_t>(a.materials.size());
    a.materials.emplace_back();
    for (Group& group : a.groups)
      if (without(group)) group.material = added;
  }
  std::set<std::string> taken;
  for (Material& m : a.materials) {
    std::string name = TextWriter::one_line(m.name);
    std::ranges::replace(name, '#', '_');
    if (name.empty()) name = "material";
    m.name = name;
    for (int i = 2; !taken.insert(m.name).second; ++i) m.name = name + "-" + std::to_string(i);
  }
}

std::vector<std::string> embed_images(Attributes& a) {
  auto notes = for_each_image(a, true, [](ImageFile& image) {
    std::string bytes = bytes_of(image);
    if (!bytes.starts_with(png_mark) && !bytes.starts_with(jpeg_mark))
      bytes = base::encode_png(place_of(image), base::decode_picture(place_of(image), bytes));
    set_bytes(image, std::move(bytes));
  });
  remove_heights(a, notes);
  combine_images(a, notes);
  return notes;
}

std::vector<std::string> put_images_beside(const fs::path& model, bool all, Attributes& a,
                                           base::FilesTogether& files) {
  const fs::path folder = base::folder_of(model);
  std::map<fs::path, std::string> put;
  return for_each_image(a, all, [&](ImageFile& image) {
    if (const auto name = relative_to(folder, image.path)) return void(image.name = *name);
    std::string bytes = bytes_of(image);
    const auto is_same = [&](const fs::path& file) { return base::FileBytes(file).view() == bytes; };
    const fs::path wanted = file_name(image, bytes);
    fs::path file = base::unused_name(folder / wanted, is_same);
    for (int i = 2; put.contains(file) && put[file] != bytes; ++i) {
      const std::string name = wanted.stem().string() + "-" + std::to_string(i) + wanted.extension().string();
      file = base::unused_name(folder / name, is_same);
    }
    image.name = file.filename().string();
    if (put.contains(file) || fs::exists(file)) return;
    files.put(file, [&](const base::ByteSink& sink) { sink(bytes); });
    put.emplace(std::move(file), std::move(bytes));
  });
}

}  // namespace viete::formats
