# cmake -DOUTPUT=x.cpp -DSHADERS="a.vert;b.frag" -P embed_shaders.cmake: writes the shaders to a C++ file as strings.
set(rows "")
foreach(path IN LISTS SHADERS)
  get_filename_component(name "${path}" NAME)
  file(READ "${path}" text)
  string(APPEND rows "    {\"${name}\", R\"GLSL(${text})GLSL\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Made by embed_shaders.cmake from the files in shaders/.
#include \"render/gl.h\"

#include \"base/error.h\"

namespace viete::render {

namespace {

struct ShaderFile {
  std::string_view name, text;
};

constexpr ShaderFile files[] = {
${rows}};

}  // namespace

std::string_view shader_text(std::string_view file) {
  for (const ShaderFile& entry : files) {
    if (entry.name == file) return entry.text;
  }
  throw base::Error(std::string(file), \"unknown shader name\");
}

}  // namespace viete::render
")
