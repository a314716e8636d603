#include "app/output.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include "base/atomic_file.h"
#include "base/error.h"
#include "deform/binding_file.h"
#include "mesh/source.h"
#include "mesh/write.h"
#include "scene/session.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

// By device and number where both are there, so that no link hides it; else by name.
bool same_file(const fs::path& a, const fs::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code code;
  const bool same = fs::equivalent(a, b, code);
  return code ? fs::weakly_canonical(a, code) == fs::weakly_canonical(b, code) : same;
}

std::string beginning(const fs::path& file) {
  std::string bytes(512, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

bool holds(const fs::path& file, Content content) {
  const std::string bytes = beginning(file);
  switch (content) {
    case Content::surface: return !scene::is_session(file);
    case Content::binding: return deform::is_binding(bytes);
    case Content::picture: return bytes.starts_with("\x89PNG\r\n\x1a\n");
    case Content::animation: return !scene::is_session(file);
    case Content::json: return mesh::extension_of(file) == "json";
    case Content::svg: break;
  }
  return bytes.find("<svg") != std::string::npos;
}

const char* name_of(Content content) {
  constexpr const char* names[] = {"a surface",   "a saved binding", "a PNG picture",
                                   "a JSON file", "an SVG picture",  "an animation"};
  return names[static_cast<std::size_t>(content)];
}

}  // namespace

void check_output(const fs::path& file, Content content, const std::vector<fs::path>& inputs, bool force) {
  if (file.empty()) return;
  if (content == Content::surface) mesh::check_format(file);
  base::check_replaceable(file);
  if (force) return;
  const bool read = std::any_of(inputs.begin(), inputs.end(),
                                [&](const fs::path& input) { return same_file(input, file); });
  if (read)
    throw base::Error(file.string(), "this file is one of those that are read, and would be replaced",
                      "choose another name, or add --force");
  std::error_code code;
  if (const auto size = fs::file_size(file, code); code || size == 0 || holds(file, content)) return;
  throw base::Error(file.string(),
                    std::string("there is a file of this name already, which is not ") + name_of(content),
                    "choose another name, or add --force");
}

void BenchFiles::check(std::vector<fs::path> inputs) const {
  inputs.push_back(plot);
  check_output(json, Content::json, inputs, force);
  inputs.back() = json;
  check_output(plot, Content::svg, inputs, force);
}

}  // namespace viete::app
