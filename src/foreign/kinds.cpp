#include "foreign/kinds.h"

#include <algorithm>

#include "base/file_bytes.h"
#include "formats/format_table.h"

namespace viete::foreign {

std::span<const Kind> all_kinds() {
  static constexpr Kind kinds[] = {
      {"fbx", "FBX"},       {"dae", "Collada"},   {"zae", "Collada"},   {"3ds", "3DS"},
      {"blend", "Blender"}, {"x", "DirectX"},     {"lwo", "LightWave"}, {"lws", "LightWave"},
      {"lxo", "Modo"},      {"3mf", "3MF"},       {"amf", "AMF"},       {"x3d", "X3D"},
      {"x3db", "X3D"},      {"wrl", "VRML"},      {"m3d", "M3D"},       {"ms3d", "MilkShape"},
      {"ogex", "OpenGEX"},  {"iqm", "IQM"},       {"ase", "ASE"},       {"ac", "AC3D"},
      {"b3d", "Blitz3D"},   {"cob", "trueSpace"}, {"scn", "trueSpace"}, {"dxf", "DXF"},
      {"hmp", "HMP"},       {"ifc", "IFC"},       {"irr", "Irrlicht"},  {"irrmesh", "Irrlicht"},
      {"md2", "MD2"},       {"md3", "MD3"},       {"md5mesh", "MD5"},   {"mdc", "MDC"},
      {"mdl", "MDL"},       {"ndo", "Nendo"},     {"nff", "NFF"},       {"pmx", "PMX"},
      {"q3o", "Quick3D"},   {"q3s", "Quick3D"},   {"sib", "Silo"},      {"smd", "SMD"},
      {"ter", "Terragen"},  {"xgl", "XGL"},       {"zgl", "XGL"}};
  return kinds;
}

std::string model_formats() {
  return formats::format_names(formats::holds_surface, ", ") + ", FBX and others";
}

std::string a_mesh() {
  return "Mesh (" + model_formats() + ")";
}

const Kind* kind_of(const std::filesystem::path& file) {
  const auto found = std::ranges::find(all_kinds(), base::extension_of(file), &Kind::extension);
  return found == all_kinds().end() ? nullptr : &*found;
}

}  // namespace viete::foreign
