#include "formats/source.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <span>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/os.h"
#include "base/worker_pool.h"

namespace viete::formats {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view begins, what, advice;
};

constexpr auto unpack = "unpack it first"sv, utf8 = "save it as UTF-8 or ASCII"sv,
               export_it = "export it as OBJ, PLY, OFF, STL, glTF or SPZ from a program that opens it"sv,
               export_splats = "export it as PLY without compression, or as SPZ version 3"sv,
               download = "download the model file, not the web page about it"sv;

// File types that start with Signature::begins, in upper or lower case.
constexpr Signature signatures[] = {
    {"version https://git-lfs.github.com/spec/"sv, "a Git LFS pointer, not the file itself"sv,
     "fetch the file itself with `git lfs pull`"sv},
    {"/annex/objects/"sv, "a git-annex pointer, not the file itself"sv,
     "fetch the file itself with `git annex get`"sv},
    {"\x1F\x8B"sv, "a compressed file (gzip)"sv, "unpack it first, with gunzip"sv},
    {"PK\3\4"sv, "a compressed file (zip, as 3MF and USDZ are)"sv, "unpack it first, with unzip"sv},
    {"PK\5\6"sv, "an empty compressed file (zip)"sv, "download or copy it again"sv},
    {"7z\xBC\xAF\x27\x1C"sv, "a compressed file (7z)"sv, unpack},
    {"Rar!\x1A\7"sv, "a compressed file (rar)"sv, unpack},
    {"BZh"sv, "a compressed file (bzip2)"sv, "unpack it first, with bunzip2"sv},
    {"\xFD"
     "7zXZ"sv,
     "a compressed file (xz)"sv, "unpack it first, with unxz"sv},
    {"\x28\xB5\x2F\xFD"sv, "a compressed file (zstd, as newer .blend files are)"sv,
     "unpack it first, with unzstd, or export it from its program"sv},
    {"\xFF\xFE\0\0"sv, "UTF-32 text"sv, utf8},
    {"\0\0\xFE\xFF"sv, "UTF-32 text"sv, utf8},
    {"\xFF\xFE"sv, "UTF-16 text"sv, utf8},
    {"\xFE\xFF"sv, "UTF-16 text"sv, utf8},
    {"<!DOCTYPE html"sv, "a web page"sv, download},
    {"<html"sv, "a web page"sv, download},
    {"<head"sv, "a web page"sv, download},
    {"Kaydara FBX Binary"sv, "an FBX file"sv, export_it},
    {"; FBX"sv, "an FBX file"sv, export_it},
    {"PXR-USDC"sv, "a USD file"sv, export_it},
    {"#usda"sv, "a USD file"sv, export_it},
    {"BLENDER-v"sv, "a Blender file"sv, export_it},
    {"BLENDER_v"sv, "a Blender file"sv, export_it},
    {"BLENDER17"sv, "a Blender file"sv, export_it},
    {"Ogawa"sv, "an Alembic file"sv, export_it},
    {"\x89HDF"sv, "an HDF5 file, as older Alembic files are"sv, export_it},
    {"//Maya ASCII"sv, "a Maya scene"sv, export_it},
    {"FOR4"sv, "a Maya scene"sv, export_it},
    {"FOR8"sv, "a Maya scene"sv, export_it},
    {"3D Geometry File Format"sv, "a Rhino file"sv, export_it},
    {"ISO-10303-21"sv, "a STEP file"sv, export_it},
    {"#VRML"sv, "a VRML file"sv, export_it},
    {"#X3D"sv, "an X3D file"sv, export_it},
    {"# vtk DataFile"sv, "a VTK file"sv, export_it},
    {"$MeshFormat"sv, "a Gmsh file"sv, export_it},
    {"\x7F"
     "ELF"sv,
     "a program (ELF)"sv, "open a model file"sv},
    {"NGSP"sv, "a capture (Gaussian splats) in SPZ version 4 or later"sv, export_splats},
    {"DRACO"sv, "a Draco file"sv, export_it},
    {"POINTCACHE2"sv, "a point cache (PC2), animated positions of a model"sv,
     "open its model first, then import the cache as keys"sv},
    {"%PDF-"sv, "a PDF document"sv, export_it},
    {"\x89PNG"sv, "a picture (PNG)"sv, "open the model instead"sv},
    {"\xFF\xD8\xFF"sv, "a picture (JPEG)"sv, "open the model instead"sv},
    {"GIF8"sv, "a picture (GIF)"sv, "open the model instead"sv},
};

// XML file types that have the root element Signature::begins in their first 4096 bytes.
constexpr Signature elements[] = {{"<COLLADA"sv, "a COLLADA file"sv, export_it},
                                  {"<X3D"sv, "an X3D file"sv, export_it},
                                  {"<VTKFile"sv, "a VTK file"sv, export_it},
                                  {"<amf"sv, "an AMF file"sv, export_it},
                                  {"<model"sv, "a part of a 3MF file"sv, export_it},
                                  {"<svg"sv, "a drawing (SVG)"sv, export_it},
                                  {"<html"sv, "a web page"sv, download},
                                  {"<Error"sv, "an error message of a server"sv, download}};

// Captures whose kind is known only by the extension. Some are zip archives.
constexpr Signature captures[] = {
    {"splat"sv, "a capture (Gaussian splats) in a .splat file"sv, export_splats},
    {"ksplat"sv, "a capture (Gaussian splats) in a .ksplat file"sv, export_splats},
    {"sog"sv, "a capture (Gaussian splats) in a .sog file"sv, export_splats},
    {"lcc"sv, "a capture (Gaussian splats) in an .lcc file"sv, export_splats}};

bool begins(std::string_view bytes, std::string_view signature) {
  return base::lower_case(bytes.substr(0, signature.size())) == base::lower_case(signature);
}

bool holds(std::string_view bytes, std::string_view signature) {
  return base::lower_case(bytes).find(base::lower_case(signature)) != std::string::npos;
}

const Signature* signature_of(std::string_view bytes) {
  static constexpr Signature xml{"", "text in XML or HTML"sv, export_it};
  const auto find = [&](std::span<const Signature> all, const auto& is) -> const Signature* {
    const auto found = std::ranges::find_if(all, [&](const Signature& s) { return is(bytes, s.begins); });
    return found == all.end() ? nullptr : &*found;
  };
  if (const Signature* found = find(signatures, begins)) return found;
  bytes = bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), bytes.size()));
  if (!bytes.starts_with('<')) return nullptr;
  bytes = bytes.substr(0, 4096);
  if (const Signature* found = find(signatures, begins)) return found;
  const Signature* found = find(elements, holds);
  return found ? found : &xml;
}

}  // namespace

std::string Source::place(std::string_view element, std::size_t index) const {
  return name + ": " + std::string(element) + " " + std::to_string(index);
}

Beginning::Beginning(const fs::path& file) {
  constexpr std::size_t enough = 1 << 20;
  std::error_code code;
  const auto size = fs::file_size(file, code);
  if (!code) file_size_ = size;
  bytes_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(file_size_, enough)));
  std::ifstream in(file, std::ios::binary);
  in.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  bytes_.resize(static_cast<std::size_t>(in.gcount()));
}

Source Beginning::whole_lines() const {
  const std::size_t last = is_whole_file() ? bytes_.size() : bytes_.find_last_of("\r\n");
  return {"", "", bytes().substr(0, last)};
}

void refuse_foreign(const std::string& name, std::string_view bytes) {
  if (bytes.empty()) throw base::Error(name, "the file is empty", "export or copy it again");
  if (bytes.find_first_not_of('\0') == std::string_view::npos)
    throw base::Error(name, "the file contains only zero bytes, probably after an interrupted write",
                      "export or copy it again");
  const Signature* is = signature_of(bytes);
  const auto capture = std::ranges::find(captures, base::extension_of(name), &Signature::begins);
  if (capture != std::end(captures) && (!is || bytes.starts_with("PK"))) is = capture;
  if (is) throw base::Error(name, "this is " + std::string(is->what), std::string(is->advice));
}

bool looks_binary(std::string_view bytes) {
  bytes = bytes.substr(0, 4096);
  return std::any_of(bytes.begin(), bytes.end(),
                     [](unsigned char c) { return c < 32 && (c < 8 || c > 13) && c != 26 && c != 27; });
}

std::string_view name_of_content(std::string_view beginning) {
  if (const Signature* is = signature_of(beginning)) return is->what;
  if (looks_binary(beginning)) return "binary data";
  const auto first = beginning.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return first != std::string_view::npos && beginning[first] == '{' ? "JSON" : "text";
}

std::string text_in_json(std::string_view beginning, std::initializer_list<std::string_view> keys) {
  using Json = nlohmann::json;
  std::string found;
  std::size_t known = 0;  // number of leading keys that match the parser's current path
  const auto visit = [&](int depth, Json::parse_event_t event, const Json& parsed) {
    const auto level = static_cast<std::size_t>(depth);
    if (event == Json::parse_event_t::key) {
      known = std::min(known, level - 1);
      if (known == level - 1 && level <= keys.size() &&
          parsed.get_ref<const std::string&>() == keys.begin()[level - 1])
        known = level;
      return known == level;
    }
    if (event == Json::parse_event_t::value && known == keys.size() && level == known && parsed.is_string())
      found = parsed.get<std::string>();
    return event == Json::parse_event_t::object_start && level == known;
  };
  const Json ignored = Json::parse(beginning.begin(), beginning.end(), visit, false);
  return found;
}

}  // namespace viete::formats
