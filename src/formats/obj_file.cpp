#include "formats/obj_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"

namespace viete::formats {

namespace {

using enum ObjWord;

constexpr std::pair<std::string_view, ObjWord> rarer_words[] = {{"g", group},
                                                                {"o", object},
                                                                {"s", smoothing},
                                                                {"usemtl", use_material},
                                                                {"mtllib", material_library},
                                                                {"curv", free_form},
                                                                {"surf", free_form},
                                                                {"fo", face}};  // `f` before version 3.0

constexpr std::string_view other_words[] = {
    "bevel", "bmat",   "bsp",       "bzp",   "c_interp", "call", "cdc",  "cdp",        "con",
    "csh",   "cstype", "ctech",     "curv2", "d_interp", "deg",  "end",  "hole",       "l",
    "lod",   "maplib", "mg",        "p",     "parm",     "res",  "scrv", "shadow_obj", "sp",
    "stech", "step",   "trace_obj", "trim",  "usemap",   "vp"};

// Reads an index after a slash. If there is no index, leaves `index`. If the text is invalid, returns false.
bool take_index(std::string_view& rest, std::int64_t& index) {
  if (rest.empty() || rest.front() == '/') return true;
  const char* const from = rest.data() + (rest.front() == '+' ? 1 : 0);
  const auto [to, code] = std::from_chars(from, rest.data() + rest.size(), index);
  rest.remove_prefix(static_cast<std::size_t>(to - rest.data()));
  return code == std::errc() && index != 0;
}

namespace fs = std::filesystem;

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
    if (count == 0) return;
    if (count < 3) rgb[2] = rgb[count - 1];
    if (count < 2) rgb[1] = rgb[0];
    for (std::size_t i = 0; i < 3; ++i) color[i] = static_cast<float>(std::clamp(rgb[i], 0.0, 1.0));
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

  // Sets the properties that depend on several statements.
  void end_material() {
    if (found_.empty()) return;
    auto& [material, maps, ignored] = found_.back();
    if (const auto exponent = numbers_.find("Ns"); exponent != numbers_.end())
      material.roughness = roughness_of_exponent(exponent->second);
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
  const Source line{"", "", names};
  TextCursor text(line, {});
  while (!text.at_line_end() && paths.size() < 64) paths.push_back(base::path_beside(folder, text.word()));
  return paths;
}

}  // namespace

ObjWord small_obj_word(std::string_view word) {
  if (word == "v") return vertex;
  if (word == "f") return face;
  if (word == "vt") return texture_point;
  if (word == "vn") return normal;
  for (const auto& [rarer, kind] : rarer_words)
    if (word == rarer) return kind;
  return std::ranges::find(other_words, word) == std::end(other_words) ? unknown : other;
}

ObjWord obj_word(std::string_view word) {
  const ObjWord found = small_obj_word(word);
  if (found != unknown || word.size() > 10) return found;
  return small_obj_word(base::lower_case(word));
}

ObjIndices obj_indices(std::string_view rest) {
  ObjIndices indices;
  if (rest.empty()) return indices;
  rest.remove_prefix(1);
  bool good = take_index(rest, indices.texture_point);
  if (good && !rest.empty()) {
    rest.remove_prefix(1);
    indices.normal_word = rest;
    good = take_index(rest, indices.normal) && rest.empty();
  }
  return good ? indices : ObjIndices{0, 0, {}, false};
}

float roughness_of_exponent(double exponent) {
  return static_cast<float>(1 - std::sqrt(std::clamp(exponent, 0.0, 1000.0) / 1000));
}

float exponent_of_roughness(float roughness) {
  return 1000 * (1 - roughness) * (1 - roughness);
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
        if (!attributes.materials.empty()) builder.warn(source.name + ": material library " + error.what());
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
    builder.warn(source.name + ": " + base::counted(missing, "material") +
                 " not found in the material libraries; default colour used");
  return {{files.begin(), files.end()}, std::move(ignored)};
}

}  // namespace viete::formats
