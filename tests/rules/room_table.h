// The table of rooms: the rooms and packages that each room may include.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace viete::rules {

struct Room {
  std::set<std::string> knows;            ///< other rooms whose headers this room may include
  std::set<std::string> packages;         ///< third-party packages that all files may include
  std::set<std::string> source_packages;  ///< third-party packages that only .cpp files may include
  bool in_python = false;                 ///< true if the room has no C++ code
};

/// Returns the rooms by their folder in src, which is also their namespace.
inline const std::map<std::string, Room>& rooms() {
  static const std::map<std::string, Room> table = {
      {"base", {{}, {}, {"stb"}}},
      {"sym3", {{}, {"eigen", "highway"}, {}}},
      {"library",
       {{"base", "sym3", "mesh", "formats", "foreign", "cages", "pose", "weights", "deform", "shapes",
         "document", "files"},
        {},
        {}}},
      {"blender", {{}, {}, {}, true}},
      {"python", {{"base", "sym3", "library"}, {"pybind11"}, {}}},
      {"mesh", {{"base"}, {}, {}}},
      {"formats", {{"base", "mesh"}, {"json"}, {"zlib"}}},
      {"foreign", {{"base", "mesh", "formats"}, {}, {"assimp", "draco", "meshoptimizer"}}},
      {"cages", {{"base", "mesh"}, {"openmesh"}, {}}},
      {"sparse", {{"base", "sym3", "mesh"}, {}, {"eigen", "highway"}}},
      {"pose", {{"base", "sym3", "mesh", "formats", "foreign"}, {}, {"eigen"}}},
      {"weights", {{"base", "sym3", "mesh", "sparse", "pose"}, {}, {"eigen", "highway"}}},
      {"deform", {{"base", "sym3", "mesh", "sparse", "pose", "weights"}, {}, {"eigen", "highway"}}},
      {"shapes", {{"base", "sym3", "mesh", "sparse", "pose", "weights"}, {}, {"eigen", "highway"}}},
      {"analysis", {{"base", "sym3", "mesh"}, {}, {}}},
      {"document",
       {{"base", "sym3", "mesh", "formats", "foreign", "cages", "pose", "weights", "shapes", "analysis"},
        {"glm"},
        {}}},
      {"interact", {{"base", "sym3", "mesh", "cages", "pose", "document"}, {"glm"}, {}}},
      {"files",
       {{"base", "sym3", "mesh", "formats", "foreign", "cages", "pose", "weights", "deform", "shapes",
         "analysis", "document"},
        {"glm", "json"},
        {}}},
      {"workspace",
       {{"base", "sym3", "mesh", "formats", "foreign", "pose", "analysis", "document", "interact", "files"},
        {"glm", "json"},
        {}}},
      {"render", {{"base"}, {"gl", "glm"}, {}}},
      {"ui", {{"base", "analysis", "document", "interact", "files", "workspace"}, {"imgui"}, {}}},
      {"platform", {{"base", "render"}, {"gl", "glm", "imgui"}, {"glfw"}}},
      {"app",
       {{"base", "sym3", "mesh", "formats", "foreign", "cages", "pose", "weights", "deform", "shapes",
         "analysis", "document", "interact", "files", "workspace", "render", "ui", "platform"},
        {"imgui", "cli11", "json", "glm"},
        {}}},
      {"bench",
       {{"base", "sym3", "mesh", "formats", "foreign", "pose", "weights", "deform", "shapes", "analysis",
         "document", "files", "app"},
        {"cli11", "json"},
        {"eigen", "highway"}}},
  };
  return table;
}

/// Returns the room of a file, given its path in src. If the file is not in a room, returns nullopt.
inline std::optional<std::string> room_of(const std::string& path) {
  const std::string folder = path.substr(0, path.find('/'));
  return rooms().count(folder) ? std::optional(folder) : std::nullopt;
}

/// True for headers of POSIX and Windows, and for <csignal>.
inline bool is_of_system(const std::string& include) {
  static const std::set<std::string> names{
      "aclapi.h", "csignal", "dirent.h", "dlfcn.h", "fcntl.h",  "io.h",       "malloc.h", "pthread.h",
      "pwd.h",    "sched.h", "signal.h", "spawn.h", "unistd.h", "shellapi.h", "shlobj.h", "termios.h"};
  return include.starts_with("sys/") || include.starts_with("win") || names.count(include) > 0;
}

/// Returns a cycle of files that include each other, or an empty list. `includes` lists for each file the
/// files that it includes. Paths have no extensions, so that a header and its source count as one file.
inline std::vector<std::string> find_cycle(const std::map<std::string, std::set<std::string>>& includes) {
  enum class State { entered, left };
  std::map<std::string, State> seen;
  std::vector<std::string> path;
  const auto visit = [&](const auto& self, const std::string& file) -> bool {
    path.push_back(file);
    seen[file] = State::entered;
    for (const auto& next : includes.at(file)) {
      if (next == file || !includes.count(next)) continue;
      const auto known = seen.find(next);
      if (known == seen.end() && self(self, next)) return true;
      if (known == seen.end() || known->second == State::left) continue;
      path.erase(path.begin(), std::find(path.begin(), path.end(), next));
      return true;
    }
    seen[file] = State::left;
    path.pop_back();
    return false;
  };
  for (const auto& [file, ignored] : includes)
    if (!seen.count(file) && visit(visit, file)) return path;
  return {};
}

/// Returns the package of an include. For headers of the standard library or the system, returns nullopt.
inline std::optional<std::string> package_of(const std::string& include) {
  static const std::vector<std::pair<std::string, std::string>> prefixes = {
      {"Eigen/", "eigen"},
      {"unsupported/Eigen/", "eigen"},
      {"hwy/", "highway"},
      {"OpenMesh/", "openmesh"},
      {"assimp/", "assimp"},
      {"draco/", "draco"},
      {"meshoptimizer", "meshoptimizer"},
      {"glm/", "glm"},
      {"nlohmann/", "json"},
      {"zlib.h", "zlib"},
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
  for (const auto& [prefix, package] : prefixes)
    if (include.rfind(prefix, 0) == 0) return package;
  return std::nullopt;
}

/// Returns every #include of a source text, in order. Ignores comments.
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

/// Replaces comments and strings by blanks.
inline std::string code_of(const std::string& text) {
  static const std::regex other(
      R"(//[^\n]*|'(\\.|[^'\\\n])'|/\*[^*]*\*+([^/*][^*]*\*+)*/|"(\\.|[^"\\\n])*")");
  return std::regex_replace(text, other, " ");
}

/// Returns names of other rooms that a file of `room` must not use, such as "pose::Stage" in ui.
inline std::vector<std::string> foreign_names(const std::string& room, const std::string& text) {
  static const std::regex qualified(R"((^|[^\w:])(?:viete::)?(\w+)::(\w+))");
  const std::string code = code_of(text);
  std::vector<std::string> found;
  for (std::sregex_iterator at(code.begin(), code.end(), qualified), end; at != end; ++at) {
    const std::string other = (*at)[2];
    if (!rooms().count(other) || other == room || rooms().at(room).knows.count(other)) continue;
    found.push_back(other + "::" + (*at)[3].str());
  }
  return found;
}

/// Returns the reason why a file of `room` must not include `include`, or nullopt if this include is allowed.
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
  if (const auto target = room_of(include)) {
    if (*target == room || rules.knows.count(*target)) return std::nullopt;
    return room + " may not know " + *target;
  }
  return std::nullopt;  // all rooms may include headers of the standard library and the system
}

}  // namespace viete::rules
