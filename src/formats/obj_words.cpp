#include "formats/obj_words.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>

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

}  // namespace

ObjWord small_obj_word(std::string_view word) {
  if (word == "v") return vertex;
  if (word == "f") return face;
  if (word == "vt") return texture_point;
  if (word == "vn") return normal;
  for (const auto& [rarer, kind] : rarer_words) {
    if (word == rarer) return kind;
  }
  return std::ranges::find(other_words, word) == std::end(other_words) ? unknown : other;
}

ObjWord obj_word(std::string_view word) {
  const ObjWord found = small_obj_word(word);
  if (found != unknown || word.size() > 10) return found;
  return small_obj_word(lower_case(word));
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

}  // namespace viete::formats
