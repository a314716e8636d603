// The table of rooms: which room may include which, and which packages it may name.
#pragma once

#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace viete::rules {

struct Room {
  std::set<std::string> knows;            ///< rooms whose headers it may include, besides its own
  std::set<std::string> packages;         ///< third-party packages it may include anywhere
  std::set<std::string> source_packages;  ///< and those that only its .cpp files may include
};

inline const std::map<std::string, Room>& rooms() {
  static const std::map<std::string, Room> table = {
      {"base", {{}, {}, {"stb"}}},
      {"sym3", {{}, {"eigen", "highway"}, {}}},
      {"python", {{"sym3"}, {"pybind11"}, {}}},
      {"mesh", {{"base"}, {"json"}, {"openmesh", "tinygltf"}}},
      {"cages", {{"base", "mesh"}, {"openmesh"}, {"eigen"}}},
      {"deform", {{"base", "sym3", "mesh"}, {}, {"eigen", "highway"}}},
      {"scene", {{"base", "sym3", "mesh", "cages", "deform"}, {"glm", "json"}, {}}},
      {"render", {{"base"}, {"gl", "glm"}, {}}},
      {"ui", {{"base", "scene"}, {"imgui"}, {}}},
      {"platform", {{"base", "render"}, {"gl", "glm", "imgui"}, {"glfw"}}},
      {"bench", {{"base", "sym3", "mesh", "cages", "deform", "scene"}, {"json"}, {"eigen", "highway", "openmesh"}}},
      {"app",
       {{"base", "sym3", "mesh", "cages", "deform", "scene", "render", "ui", "platform", "bench"},
        {"imgui", "cli11", "json", "glm"},
        {}}},
  };
  return table;
}

/// The package that an include belongs to; none for the standard library and the system.
inline std::optional<std::string> package_of(const std::string& include) {
  static const std::vector<std::pair<std::string, std::string>> prefixes = {
      {"Eigen/", "eigen"},
      {"unsupported/Eigen/", "eigen"},
      {"hwy/", "highway"},
      {"OpenMesh/", "openmesh"},
      {"glm/", "glm"},
      {"nlohmann/", "json"},
      {"tiny_gltf", "tinygltf"},
      {"GL/", "gl"},
      {"EGL/", "gl"},
      {"KHR/", "gl"},
      {"GLES", "gl"},
      {"stb", "stb"},
      {"backends/imgui", "imgui_backends"},
      {"imgui", "imgui"},
      {"GLFW/", "glfw"},
      {"CLI/", "cli11"},
      {"doctest/", "doctest"},
      {"quadmath", "quadmath"},
      {"mpfr", "mpfr"},
      {"pybind11/", "pybind11"},
      {"boost/", "boost"},
      {"fmt/", "fmt"},
      {"X11/", "x11"},
  };
  for (const auto& [prefix, package] : prefixes) {
    if (include.rfind(prefix, 0) == 0) return package;
  }
  return std::nullopt;
}

/// Every #include of a source text, in order; comments do not count.
inline std::vector<std::string> includes_of(const std::string& text) {
  static const std::regex line_pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, line_pattern)) found.push_back(match[1]);
  }
  return found;
}

/// The text without comments and strings, which are blank.
inline std::string code_of(const std::string& text) {
  static const std::regex other(R"(//[^\n]*|/\*[^*]*\*+([^/*][^*]*\*+)*/|"(\\.|[^"\\\n])*")");
  return std::regex_replace(text, other, " ");
}

/// Names of other rooms that a file of `room` may not know: "deform::Link" in ui.
inline std::vector<std::string> foreign_names(const std::string& room, const std::string& text) {
  static const std::regex qualified(R"((^|[^\w:])(?:viete::)?(\w+)::(\w+))");
  const std::string code = code_of(text);
  std::vector<std::string> found;
  for (std::sregex_iterator at(code.begin(), code.end(), qualified), end; at != end; ++at) {
    const std::string other = (*at)[2];
    if (other == room || !rooms().count(other) || rooms().at(room).knows.count(other)) continue;
    found.push_back(other + "::" + (*at)[3].str());
  }
  return found;
}

/// Why a file of `room` may not include `include`, or nothing when it may.
inline std::optional<std::string> violation(const std::string& room, bool is_header,
                                            const std::string& include) {
  const Room& rules = rooms().at(room);
  if (const auto package = package_of(include)) {
    if (rules.packages.count(*package)) return std::nullopt;
    if (rules.source_packages.count(*package)) {
      if (!is_header) return std::nullopt;
      return "package " + *package + " belongs in .cpp files of " + room;
    }
    return room + " may not use package " + *package;
  }
  if (include.find("..") != std::string::npos) return "relative include " + include;
  const auto slash = include.find('/');
  const std::string target = include.substr(0, slash);
  if (slash != std::string::npos && rooms().count(target)) {
    if (target == room || rules.knows.count(target)) return std::nullopt;
    return room + " may not know " + target;
  }
  return std::nullopt;  // the standard library and the system
}

}  // namespace viete::rules
