#include "formats/materials.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/picture.h"
#include "base/text.h"
#include "formats/text_writer.h"

namespace viete::formats {

namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

using Images = std::span<const MaterialImage>;
constexpr Images all_images = material_images, base_color_images = all_images.first(1),
                 normal_images = all_images.subspan(3, 1);
static_assert(base_color_images[0].image == &Material::base_color_image);
static_assert(normal_images[0].image == &Material::normal_image);

// The first bytes of image files, and their extensions. TGA has no signature.
constexpr std::string_view png_mark = "\x89PNG\r\n\x1A\n", jpeg_mark = "\xFF\xD8\xFF";
constexpr std::pair<std::string_view, std::string_view> image_kinds[] = {
    {png_mark, "png"},   {jpeg_mark, "jpg"},      {jpeg_mark, "jpeg"},   {"BM"sv, "bmp"},
    {"RIFF"sv, "webp"},  {"II*\0"sv, "tif"},      {"II*\0"sv, "tiff"},   {"MM\0*"sv, "tif"},
    {"MM\0*"sv, "tiff"}, {"GIF8"sv, "gif"},       {"DDS "sv, "dds"},     {"8BPS"sv, "psd"},
    {"v/1\1"sv, "exr"},  {"#?RADIANCE"sv, "hdr"}, {"\xABKTX"sv, "ktx2"}, {""sv, "tga"}};

std::string place_of(const ImageFile& image) {
  return image.path.empty() ? image.name : image.path.string();
}

// Returns the extension of image files with these bytes: the given one, if it fits.
std::string_view image_extension(const ImageFile& image, std::string_view bytes, std::string_view given) {
  std::string_view found;
  for (const auto& [begin, extension] : image_kinds) {
    if (!bytes.starts_with(begin)) continue;
    if (extension == given) return extension;
    if (found.empty() && !begin.empty()) found = extension;
  }
  if (found.empty())
    throw base::Error(place_of(image), "this is not an image", "save the picture as PNG or JPEG");
  return found;
}

std::string bytes_of(const ImageFile& image) {
  if (image.bytes) return *image.bytes;
  if (image.path.empty())
    throw base::Error(place_of(image), "the image is missing", "export the model again");
  return std::string(base::FileBytes(image.path, nullptr, most_image_bytes).view());
}

base::Picture decoded(const ImageFile& image) {
  return base::decode_picture(place_of(image), *image.bytes);
}

void set_bytes(ImageFile& image, std::string bytes) {
  image.bytes = std::make_shared<const std::string>(std::move(bytes));
}

// Calls use(). If this throws base::Error, adds a message and returns false.
bool is_usable(std::vector<std::string>& notes, const std::function<void()>& use) {
  try {
    use();
    return true;
  } catch (const base::Error& error) {
    notes.push_back(std::string("left out an image: ") + error.what());
    return false;
  }
}

// Calls use(image) once for each image of these properties. If this throws base::Error, removes the image
// from the properties and adds a message.
void for_images(Attributes& a, Images properties, std::vector<std::string>& notes,
                const std::function<void(ImageFile&)>& use) {
  std::map<std::uint32_t, bool> usable;
  for (Material& m : a.materials)
    for (const MaterialImage& property : properties) {
      std::uint32_t& image = m.*property.image;
      if (image == mesh::none) continue;
      const auto [at, is_new] = usable.try_emplace(image);
      if (is_new) at->second = is_usable(notes, [&] { use(a.images[image]); });
      if (!at->second) image = mesh::none;
    }
}

// Some files have grey images of heights instead of normals.
void refuse_heights(const ImageFile& image) {
  const base::Picture picture = decoded(image);
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4)
    if (picture.rgba[i] != picture.rgba[i + 1] || picture.rgba[i] != picture.rgba[i + 2]) return;
  throw base::Error(place_of(image), "contains heights instead of normals", "convert them to normals");
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
    base::Picture picture;
    if (i != mesh::none) is_usable(notes, [&] { picture = decoded(a.images[i]); });
    return picture;
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
std::string file_name(const ImageFile& image, std::string_view bytes) {
  const fs::path path = image.path.empty() ? fs::path(image.name) : image.path;
  std::string name = base::cut(path.filename().string(), 100);
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 32 || "\\/:*?\"<>|#"sv.find(c) != std::string_view::npos) c = '_';
  if (name.empty()) name = "image";
  const std::string given = base::extension_of(name);
  const std::string_view extension = image_extension(image, bytes, given);
  return given == extension ? name : name + "." + std::string(extension);
}

// Returns the path relative to the folder. If the file is not in the folder or below, or if libraries cannot
// contain its name, returns nullopt.
std::optional<std::string> relative_to(const fs::path& folder, const fs::path& file) {
  if (file.empty() || !base::is_file_below(folder, file)) return std::nullopt;
  const std::string name =
      (base::folder_of(file) / file.filename()).lexically_relative(folder).generic_string();
  const bool is_kept = name == name_in_library(name) && name.find('\\') == std::string::npos;
  return is_kept ? std::optional(name) : std::nullopt;
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

std::string name_in_library(const std::string& name) {
  std::string line = TextWriter::one_line(name);
  std::ranges::replace(line, '#', '_');
  return line;
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
  std::map<std::string, int> numbers;  // how often each name was numbered
  for (Material& m : a.materials) {
    std::string name = name_in_library(m.name);
    if (name.empty()) name = "material";
    m.name = name;
    for (int& number = numbers[name]; !taken.insert(m.name).second;)
      m.name = name + "-" + std::to_string(++number + 1);
  }
}

std::vector<std::string> embed_images(Attributes& a) {
  std::vector<std::string> notes;
  for_images(a, all_images, notes, [](ImageFile& image) {
    set_bytes(image, bytes_of(image));
    if (!image.bytes->starts_with(png_mark) && !image.bytes->starts_with(jpeg_mark))
      set_bytes(image, base::encode_png(place_of(image), decoded(image)));
  });
  for_images(a, normal_images, notes, refuse_heights);
  combine_images(a, notes);
  return notes;
}

std::vector<std::string> put_images_beside(const fs::path& model, bool all, Attributes& a,
                                           base::FilesTogether& files) {
  std::vector<std::string> notes;
  const fs::path folder = base::folder_of(model);
  for_images(a, all ? all_images : base_color_images, notes, [&](ImageFile& image) {
    if (const auto name = relative_to(folder, image.path)) return void(image.name = *name);
    const std::string bytes = bytes_of(image);
    image.name = files.put_new(folder / file_name(image, bytes), bytes).filename().string();
  });
  return notes;
}

}  // namespace viete::formats
