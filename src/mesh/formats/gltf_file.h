// A glTF file taken apart: its JSON and the bytes that this leads to.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/gltf_json.h"
#include "mesh/formats/source.h"

namespace viete::mesh {

struct GltfBuffer {
  enum class Home { chunk, text, beside };  ///< the GLB's binary chunk; base64 in the JSON; a file beside
  Home home = Home::chunk;
  std::filesystem::path path;  ///< of the file beside
  std::string bytes;           ///< as many as the JSON says there are
};

/// Where an image of the JSON leads.
struct GltfImage {
  ImageFile file;   ///< its name is empty where the JSON gives none
  std::string uri;  ///< of a file beside, as it is written; otherwise empty
};

struct GltfFile {
  std::string name;  ///< how messages call it
  bool binary = false;
  GltfJson document;  ///< checked, see check_gltf(); without the bytes of buffers that lie in it
  std::vector<GltfBuffer> buffers;
  std::vector<GltfImage> images;
  std::vector<std::string> warnings;  ///< one line each
  std::string other_chunks;           ///< of a GLB: those of kinds that are not known here, with their heads
};

/// glTF 2.0, as text or as GLB. Buffers beside are read within its folder only, images are not opened. Throws
/// base::Error if anything that the surface needs is missing, compressed, or not as it claims to be.
GltfFile take_apart(const Source& source);

/// "a b" is "a%20b", as paths of files beside are written.
std::string encoded_uri(std::string_view path);

}  // namespace viete::mesh
