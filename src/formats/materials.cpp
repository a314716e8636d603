#include "formats/materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
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
#include "formats/codecs.h"
#include "formats/text_cursor.h"
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

// The extensions of image files. Other files are not copied.
constexpr std::string_view image_extensions[] = {"png",  "jpg", "jpeg", "bmp", "tga", "tif", "tiff",
                                                 "webp", "gif", "dds",  "exr", "hdr", "psd", "ktx2"};
// The extensions for images that are embedded without an extension, and their first bytes.
constexpr std::string_view png_mark = "\x89PNG\r\n\x1A\n", jpeg_mark = "\xFF\xD8\xFF";
constexpr std::pair<std::string_view, std::string_view> marks[] = {
    {"png", png_mark}, {"jpg", jpeg_mark}, {"webp", "RIFF"}};

std::string place_of(const ImageFile& image) {
  return image.path.empty() ? image.name : image.path.string();
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
  if (std::ranges::count(image_extensions, base::extension_of(name)) > 0) return name;
  for (const auto& [extension, mark] : marks)
    if (bytes.starts_with(mark)) return name + "." + std::string(extension);
  throw base::Error(place_of(image), "this is not an image", "save the picture as PNG or JPEG");
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

constexpr std::size_t most_library_bytes = 64 << 20;

// Returns the maximum number of arguments of a map option, or 0 for an unknown option.
std::size_t option_words(std::string_view option) {
  constexpr auto one =
      std::to_array<std::string_view>({"-blendu", "-blendv", "-bm", "-boost", "-cc", "-clamp", "-colorspace",
                                       "-imfchan", "-texres", "-type"});
  if (option == "-mm") return 2;
  if (option == "-o" || option == "-s" || option == "-t") return 3;
  return std::find(one.begin(), one.end(), option) == one.end() ? 0 : 1;
}

class MtlReader {
public:
  explicit MtlReader(const Source& source) : source_(source), text_(source, obj_rules) {}

  std::vector<MtlMaterial> read() {
    for (; text_.next_filled_line(); text_.next_line()) statement(text_.word());
    end_material();
    return std::move(found_);
  }

private:
  void statement(std::string_view word) {
    if (word == "newmtl") {
      end_material();
      found_.emplace_back().material.name = text_.rest_of_line();
      numbers_.clear();
      opacities_ = mesh::none;
      return;
    }
    if (found_.empty()) return;
    Material& m = found_.back().material;
    if (word == "Kd") {
      color(m.base_color);
    } else if (word == "Ke") {
      color(m.emission);
    } else if (word == "d" || word == "Tr") {
      if (const auto value = number_in(text_.word()))
        m.base_color[3] = static_cast<float>(std::clamp(word == "d" ? *value : 1 - *value, 0.0, 1.0));
    } else if (word == "Ns" || word == "Pr" || word == "Pm") {
      if (const auto value = number_in(text_.word())) numbers_.emplace(word, *value);
    } else if (is_map(word)) {
      map(word);
    }
  }

  static bool is_map(std::string_view word) {
    constexpr auto others = std::to_array<std::string_view>({"bump", "disp", "decal", "refl", "norm"});
    return word.starts_with("map_") || std::find(others.begin(), others.end(), word) != others.end();
  }

  // Reads up to three components. Repeats the last for missing components. Ignores spectral and CIE colours.
  void color(Color& color) {
    std::array<double, 3> rgb{};
    const std::size_t count = text_.numbers(rgb);
    for (std::size_t i = 0; i < 3 && count > 0; ++i)
      color[i] = static_cast<float>(std::clamp(rgb[std::min(i, count - 1)], 0.0, 1.0));
  }

  // Returns null for other maps.
  static const MaterialImage* property_of(std::string_view word) {
    if (word == "bump" || word == "map_bump" || word == "norm") word = "map_Bump";
    for (const MaterialImage& property : material_images)
      if (property.mtl.substr(0, property.mtl.find(' ')) == word) return &property;
    return nullptr;
  }

  void map(std::string_view word) {
    for (;;) {
      TextCursor ahead = text_;
      const std::string_view option = ahead.word();
      const std::size_t words = option_words(option);
      if (words == 0) break;
      text_ = ahead;
      map_option(option, words, word == "map_Kd");
    }
    const std::string_view name = text_.rest_of_line();
    if (name.empty()) return;
    take_map(word, base::path_beside(source_.folder, name));
  }

  // `norm` replaces a bump map.
  void take_map(std::string_view word, fs::path path) {
    MtlMaterial& m = found_.back();
    const auto map = static_cast<std::uint32_t>(m.maps.size());
    m.maps.push_back(std::move(path));
    const MaterialImage* const property = property_of(word);
    if (word == "map_d")
      opacities_ = map;
    else if (!property)
      m.ignored.emplace(word);
    else if (m.material.*property->image == mesh::none || property->mtl == word || word == "norm")
      m.material.*property->image = map;
  }

  void map_option(std::string_view option, std::size_t words, bool of_base_color) {
    for (std::size_t i = 0; i < words; ++i) {
      TextCursor ahead = text_;
      const std::string_view value = ahead.word();
      if (words == 3 && i > 0 && !number_in(value)) return;
      text_ = ahead;
      if (option == "-clamp" && of_base_color) found_.back().material.repeats = value != "on";
    }
  }

  // Sets the properties that depend on several statements. Converts the exponent Ns like Blender 3.4.
  void end_material() {
    if (found_.empty()) return;
    auto& [material, maps, ignored] = found_.back();
    if (const auto exponent = numbers_.find("Ns"); exponent != numbers_.end())
      material.roughness =
          static_cast<float>(1 - std::sqrt(std::clamp(exponent->second, 0.0, 1000.0) / 1000));
    for (const MaterialNumber& property : material_numbers) {
      if (material.*property.image != mesh::none) material.*property.number = 1;
      if (const auto given = numbers_.find(property.mtl); given != numbers_.end())
        material.*property.number = static_cast<float>(std::clamp(given->second, 0.0, 1.0));
    }
    if (opacities_ == mesh::none) return;
    const std::uint32_t image = material.base_color_image;
    material.is_translucent = image != mesh::none && maps[image] == maps[opacities_];
    if (!material.is_translucent) ignored.emplace("map_d");
  }

  const Source& source_;
  TextCursor text_;
  std::vector<MtlMaterial> found_;
  // The next members belong to the current material.
  std::map<std::string, double, std::less<>> numbers_;
  std::uint32_t opacities_ = mesh::none;  // the index of map_d
};

std::vector<MtlMaterial> materials_in(const fs::path& path) {
  const base::FileBytes bytes(path, nullptr, most_library_bytes);
  return read_mtl(Source{path.string(), "mtl", bytes.view(), nullptr, nullptr, path.parent_path()});
}

// If `names` is the name of an existing file or has no blanks, returns one path, otherwise one path per word.
std::vector<fs::path> library_paths(const fs::path& folder, std::string_view names) {
  std::error_code code;
  const fs::path whole = base::path_beside(folder, names);
  const bool single = names.find_first_of(" \t") == std::string_view::npos;
  if (single || names.size() > 4096 || fs::exists(whole, code)) return {whole};
  std::vector<fs::path> paths;
  TextCursor text(names);
  while (!text.at_line_end() && paths.size() < 64) paths.push_back(base::path_beside(folder, text.word()));
  return paths;
}

void put_color(std::string_view statement, const Color& color, TextWriter& out) {
  out.text(statement);
  for (std::size_t k = 0; k < 3; ++k) out.text(" ").number(color[k]);
  out.text("\n");
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
  std::exception_ptr failure;  // an image that cannot be written is no reason to leave it out
  const fs::path folder = base::folder_of(model);
  for_images(a, all ? all_images : base_color_images, notes, [&](ImageFile& image) {
    if (const auto name = relative_to(folder, image.path)) return void(image.name = *name);
    const std::string bytes = bytes_of(image);
    const fs::path path = folder / file_name(image, bytes);
    try {
      image.name = files.put_new(path, bytes).filename().string();
    } catch (const base::Error&) {
      failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
  return notes;
}

std::vector<MtlMaterial> read_mtl(const Source& source) {
  return MtlReader(source).read();
}

MaterialFiles read_materials(const Source& source, const std::vector<std::string>& libraries,
                             Attributes& attributes, SurfaceBuilder& builder) {
  if (source.folder.empty()) return {};
  constexpr std::size_t most_libraries = 64, most_files = 4096;
  std::map<std::string, MtlMaterial, std::less<>> library;
  std::set<fs::path> files;
  std::size_t count = 0;
  bool all_read = true;
  for (const std::string& names : libraries)
    for (const fs::path& path : library_paths(source.folder, names)) {
      if (files.size() >= most_files || !files.insert(path).second || ++count > most_libraries) continue;
      try {
        for (MtlMaterial& m : materials_in(path)) {
          files.insert(m.maps.begin(), m.maps.end());
          library.emplace(std::string(m.material.name), std::move(m));
        }
      } catch (const base::Error& error) {
        all_read = false;
        if (!attributes.materials.empty()) builder.warn("material library " + std::string(error.what()));
      }
    }
  std::size_t missing = 0;
  std::set<std::string> ignored;
  std::map<fs::path, std::uint32_t> images;
  for (Material& material : attributes.materials) {
    const auto found = library.find(material.name);
    if (found == library.end()) {
      ++missing;
      continue;
    }
    material = found->second.material;
    ignored.merge(found->second.ignored);
    for (const MaterialImage& property : material_images) {
      std::uint32_t& index = material.*property.image;
      if (index == mesh::none) continue;
      const fs::path& path = found->second.maps[index];
      const auto [at, added] = images.emplace(path, static_cast<std::uint32_t>(attributes.images.size()));
      if (added) attributes.images.push_back({path, nullptr, path.filename().string()});
      index = at->second;
    }
  }
  if (missing > 0 && all_read && !libraries.empty())
    builder.warn(base::counted(missing, "material") +
                 " not found in the material libraries; default colour used");
  return {{files.begin(), files.end()}, std::move(ignored)};
}

void write_mtl(const Attributes& a, TextWriter& out) {
  for (const Material& m : a.materials) {
    out.text("newmtl ").text(m.name).text("\n");
    put_color("Kd", m.base_color, out);
    put_color("Ke", m.emission, out);
    out.text("d ").number(m.base_color[3]).text("\n");
    out.text("Ns ").number(1000 * (1 - m.roughness) * (1 - m.roughness)).text("\n");  // as in end_material()
    for (const MaterialNumber& property : material_numbers)
      out.text(property.mtl).text(" ").number(m.*property.number).text("\n");
    const std::string_view clamp = m.repeats ? "" : " -clamp on";
    const auto map = [&](std::string_view statement, std::uint32_t image) {
      if (image != mesh::none)
        out.text(statement).text(clamp).text(" ").text(a.images[image].name).text("\n");
    };
    for (const MaterialImage& property : material_images) map(property.mtl, m.*property.image);
    map("norm", m.normal_image);
    if (m.is_translucent) map("map_d", m.base_color_image);
  }
}

}  // namespace viete::formats
