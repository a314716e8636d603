#include "mesh/formats/obj_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <utility>

namespace viete::mesh {

namespace {

using enum ObjWord;

// Sorted.
constexpr auto rarer_words = std::to_array<std::pair<std::string_view, ObjWord>>({
    {"bevel", other},
    {"bmat", other},
    {"bsp", other},
    {"bzp", other},
    {"c_interp", other},
    {"call", other},
    {"cdc", other},
    {"cdp", other},
    {"con", other},
    {"csh", other},
    {"cstype", other},
    {"ctech", other},
    {"curv", free_form},
    {"curv2", other},
    {"d_interp", other},
    {"deg", other},
    {"end", other},
    {"fo", face},  // how faces were called before version 3.0
    {"g", group},
    {"hole", other},
    {"l", other},
    {"lod", other},
    {"maplib", other},
    {"mg", other},
    {"mtllib", material_library},
    {"o", object},
    {"p", other},
    {"parm", other},
    {"res", other},
    {"s", smoothing},
    {"scrv", other},
    {"shadow_obj", other},
    {"sp", other},
    {"stech", other},
    {"step", other},
    {"surf", free_form},
    {"trace_obj", other},
    {"trim", other},
    {"usemap", other},
    {"usemtl", use_material},
    {"vp", other},
});
static_assert(std::is_sorted(rarer_words.begin(), rarer_words.end()));

// Behind a slash; an empty one is 0.
bool take_index(std::string_view& rest, std::int64_t& index) {
  if (rest.empty() || rest.front() == '/') return true;
  const char* const from = rest.data() + (rest.front() == '+' ? 1 : 0);
  const auto [to, code] = std::from_chars(from, rest.data() + rest.size(), index);
  rest.remove_prefix(static_cast<std::size_t>(to - rest.data()));
  return code == std::errc() && index != 0;
}

}  // namespace

ObjWord small_obj_word(std::string_view word) {
  if (word == "v") return vertex;
  if (word == "f") return face;
  if (word == "vt") return texture_point;
  if (word == "vn") return normal;
  const auto found = std::lower_bound(rarer_words.begin(), rarer_words.end(), word,
                                      [](const auto& entry, std::string_view w) { return entry.first < w; });
  return found != rarer_words.end() && found->first == word ? found->second : unknown;
}

ObjWord obj_word(std::string_view word) {
  const ObjWord found = small_obj_word(word);
  if (found != unknown || word.size() > 10) return found;
  std::string small(word);
  for (char& c : small) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  return small_obj_word(small);
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

}  // namespace viete::mesh
