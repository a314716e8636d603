// Keeps a glTF file in memory, and writes it again.
#include "formats/gltf_original.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

#include "base/encoding.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"
#include "formats/gltf_morphs.h"

namespace viete::formats {

namespace {

namespace fs = std::filesystem;

std::size_t padded_to_four(std::size_t size) {
  return (size + 3) / 4 * 4;
}

void put_chunk(std::string_view bytes, std::string_view kind, char padding, TextWriter& out) {
  constexpr std::size_t portion = 1 << 20;
  out.little_endian(static_cast<std::uint32_t>(padded_to_four(bytes.size()))).text(kind);
  for (std::size_t at = 0; at < bytes.size(); at += portion) {
    out.text(bytes.substr(at, portion));
    out.element_done(std::min(at + portion, bytes.size()), bytes.size());
  }
  out.text(std::string(padded_to_four(bytes.size()) - bytes.size(), padding));
}

// Percent-encodes a relative path: "a b" becomes "a%20b".
std::string encoded_uri(std::string_view path) {
  return base::percent_encoded(path, [](char c) {
    constexpr std::string_view plain = "-._~/!$&'()*+,;=@";
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           plain.find(c) != std::string_view::npos;
  });
}

template <class Is>
bool any_primitive(const GltfJson& document, const Is& is) {
  for (const GltfJson& mesh : list_of(document, "meshes")) {
    const GltfJson& all = list_of(mesh, "primitives");
    if (std::any_of(all.begin(), all.end(), is)) return true;
  }
  return false;
}

// Custom data of other programs. The names of morph targets are no such data.
bool has_extras(const GltfJson& json) {
  if (!json.is_structured()) return false;
  for (const auto& [key, value] : json.items()) {
    const bool are_names = value.is_object() && value.size() == 1 && value.contains("targetNames");
    if (key == "extras" && json.is_object() ? !value.empty() && !are_names : has_extras(value)) return true;
  }
  return false;
}

// Returns true for extensions whose content is in the surface and its attributes.
bool is_read(const std::string& extension) {
  constexpr std::string_view read[] = {"KHR_texture_transform", "KHR_mesh_quantization", "EXT_texture_webp",
                                       "KHR_texture_basisu", "KHR_materials_unlit"};
  return std::ranges::find(read, extension) != std::end(read);
}

class GltfOriginal final : public Original {
public:
  GltfOriginal(const Source& source, GltfFile file, GltfMap map)
      : Original("glTF", source),
        file_(std::make_shared<const GltfFile>(std::move(file))),
        map_(std::make_shared<const GltfMap>(std::move(map))) {
    if (is_gltf_capture(file_->document)) capture_ = Capture::points;
  }

  std::vector<std::string> beyond_attributes() const override {
    const GltfJson& document = file_->document;
    std::vector<std::string> found;
    for (const char* key : {"animations", "skins", "cameras"})
      if (!list_of(document, key).empty()) found.emplace_back(key);
    const auto add = [&](const char* what, const auto& is) {
      if (any_primitive(document, is)) found.emplace_back(what);
    };
    add("morph targets", [](const GltfJson& p) { return !list_of(p, "targets").empty(); });
    add("tangents", [](const GltfJson& p) { return accessor_of(p, "TANGENT") >= 0; });
    add("second texture coordinates", [](const GltfJson& p) { return accessor_of(p, "TEXCOORD_1") >= 0; });
    add("points and lines", [](const GltfJson& p) {
      const auto mode = count_of(p, "mode");
      return mode && *mode < 4;
    });
    const auto occluded = [](const GltfJson& m) { return m.contains("occlusionTexture"); };
    if (std::ranges::any_of(list_of(document, "materials"), occluded))
      found.emplace_back("occlusion textures");
    if (file_->has_other_coordinates) found.emplace_back("textures with coordinates of their own");
    if (!text_of(member_of(document, "asset"), "copyright").empty()) found.emplace_back("copyright");
    if (has_extras(document)) found.emplace_back("extras");
    for (const GltfJson& extension : list_of(document, "extensionsUsed"))
      if (extension.is_string() && !is_read(extension))
        found.push_back("extension " + extension.get<std::string>());
    return found;
  }

  std::vector<fs::path> files_beside() const override {
    std::vector<fs::path> files;
    for (const GltfBuffer& buffer : file_->buffers) files.push_back(buffer.path);
    for (const GltfImage& image : file_->images) files.push_back(image.file.path);
    return files;
  }

  std::vector<std::string> write_file(const fs::path& path, const Content& content, Digits,
                                      base::Progress* progress, const MorphMotion* motion) const override {
    const bool binary = base::extension_of(path) == "glb";
    if (!motion && file_->binary == binary && has_no_external_files() && copies(content)) {
      base::replace_file(path, bytes_);
      return {};
    }
    GltfRewritten result =
        rewritten_gltf(*file_, *map_, content.surface, content.positions, motion, progress);
    base::FilesTogether files;
    put_images(path, result, files);
    if (!binary && !file_->other_chunks.empty())
      result.notes.push_back("unknown GLB chunks are left out: .gltf files cannot contain chunks");
    put_buffers(path, binary, result, files);
    files.put(path, [&](const base::ByteSink& sink) {
      TextWriter out(sink, progress);
      put(result, binary, out);
      out.finish();
    });
    files.replace();
    return std::move(result.notes);
  }

  std::shared_ptr<const MorphClip> morphs() const override { return gltf_morphs(file_, map_); }

private:
  bool copies(const Content& content) const { return !bytes_.empty() && content.is_at_rest(); }

  bool has_no_external_files() const {
    return std::ranges::none_of(file_->buffers,
                                [](const GltfBuffer& b) { return b.home == GltfBuffer::Home::beside; }) &&
           std::ranges::all_of(file_->images, [](const GltfImage& i) { return i.uri.empty(); });
  }

  // In a GLB, the first buffer is the binary chunk and has no URI. All other buffers keep their URIs.
  void put(GltfRewritten& result, bool binary, TextWriter& out) const {
    const auto& buffers = result.buffers;
    for (std::size_t i = 0; i < buffers.size(); ++i)
      result.document["buffers"][i]["byteLength"] = buffers[i].size();
    if (!binary) return void(out.text(result.document.dump(2)).text("\n"));
    if (!buffers.empty()) result.document["buffers"][0].erase("uri");
    write_glb_chunks(result.document.dump(), buffers.empty() ? std::string_view() : buffers.front(),
                     file_->other_chunks, out);
  }

  // For a GLB, embeds all buffers except the first, which is the binary chunk. For a .gltf, embeds the
  // buffers that were embedded, and writes all others to external files.
  void put_buffers(const fs::path& path, bool binary, GltfRewritten& result,
                   base::FilesTogether& files) const {
    std::set<fs::path> beside;
    for (std::size_t i = binary ? 1 : 0; i < result.buffers.size(); ++i) {
      GltfJson& uri = result.document["buffers"][i]["uri"];
      if (binary || file_->buffers[i].home == GltfBuffer::Home::text) {
        uri = embedded_gltf_uri(result.buffers[i]);
        continue;
      }
      const fs::path name = name_beside(path, beside);
      beside.insert(name);
      files.put(name, [&](const base::ByteSink& sink) { sink(result.buffers[i]); });
      uri = encoded_uri(name.filename().string());
    }
    if (beside.empty()) return;
    std::string names;
    for (const fs::path& name : beside) names += (names.empty() ? "" : ", ") + name.string();
    result.notes.push_back(
        (beside.size() == 1 ? "the buffer was written to " : "the buffers were written to ") + names);
  }

  // If the new file is in another folder, copies images from the folder of the old file and below, without
  // replacing files. Other images stay in place, and their relative URIs change.
  void put_images(const fs::path& path, GltfRewritten& result, base::FilesTogether& files) const {
    const fs::path from = base::folder_of(file_->name), to = base::folder_of(path);
    if (from == to) return;
    std::error_code ignored;
    std::size_t copied = 0, stayed = 0;
    for (std::size_t i = 0; i < file_->images.size(); ++i) {
      const GltfImage& image = file_->images[i];
      if (image.uri.empty() || image.file.path.empty()) continue;
      fs::path full = base::folder_of(image.file.path) / image.file.path.filename();
      const bool copies = base::is_file_below(from, full);
      if (copies) {
        const fs::path copy = to / full.lexically_relative(from);
        // If a folder is missing, put_new() throws.
        if (fs::is_directory(to, ignored)) fs::create_directories(copy.parent_path(), ignored);
        full = files.put_new(copy, base::FileBytes(full).view());
      }
      result.document["images"][i]["uri"] = encoded_uri(full.lexically_relative(to).generic_string());
      ++(copies ? copied : stayed);
    }
    if (copied > 0) result.notes.push_back("copied " + base::counted(copied, "image"));
    if (stayed > 0)
      result.notes.push_back(path.filename().string() + " refers to " + base::counted(stayed, "image") +
                             " outside the folder of the old file: keep them in place");
  }

  // Returns the first name of "out.bin", "out-2.bin", ... that is free or a buffer of the older result.
  fs::path name_beside(const fs::path& path, const std::set<fs::path>& taken) const {
    for (int i = 1;; ++i) {
      const std::string number = i == 1 ? "" : "-" + std::to_string(i);
      const fs::path name = path.parent_path() / (path.stem().string() + number + ".bin");
      std::error_code ignored;
      const bool is_there = fs::exists(fs::symlink_status(name, ignored));
      if (taken.count(name) == 0 && (!is_there || is_of_older_result(path, name))) return name;
    }
  }

  // Returns true if the old file at `path`, which will be replaced, refers to this buffer. Then the buffer
  // may be overwritten too. Returns false for buffers of the file that was read.
  bool is_of_older_result(const fs::path& path, const fs::path& buffer) const {
    std::error_code failed;
    for (const GltfBuffer& own : file_->buffers)
      if (!own.path.empty() && fs::equivalent(own.path, buffer, failed)) return false;
    if (!fs::is_regular_file(path, failed) || !fs::is_regular_file(buffer, failed)) return false;
    const base::FileBytes older(path);
    return older.view().find('"' + encoded_uri(buffer.filename().string()) + '"') != std::string_view::npos;
  }

  std::shared_ptr<const GltfFile> file_;
  std::shared_ptr<const GltfMap> map_;
};

}  // namespace

std::string embedded_gltf_uri(std::string_view bytes) {
  return "data:application/octet-stream;base64," + base::base64(bytes);
}

bool is_gltf_capture(const GltfJson& document) {
  return any_primitive(document, [](const GltfJson& p) {
    return !member_of(member_of(p, "extensions"), "KHR_gaussian_splatting").is_null();
  });
}

void write_glb_chunks(std::string_view json, std::string_view bytes, std::string_view others,
                      TextWriter& out) {
  const std::size_t binary = bytes.empty() ? 0 : 8 + padded_to_four(bytes.size());
  const std::size_t all = 20 + padded_to_four(json.size()) + binary + others.size();
  if (all > std::numeric_limits<std::uint32_t>::max())
    throw base::Error("", "the GLB file would exceed its limit of 4 GB", "save as .gltf or another format");
  out.text("glTF").little_endian(std::uint32_t{2}).little_endian(static_cast<std::uint32_t>(all));
  put_chunk(json, {"JSON", 4}, ' ', out);
  if (!bytes.empty()) put_chunk(bytes, {"BIN\0", 4}, '\0', out);
  out.text(others);
}

std::shared_ptr<const Original> gltf_original(const Source& source, GltfFile file, GltfMap map) {
  return std::make_shared<GltfOriginal>(source, std::move(file), std::move(map));
}

}  // namespace viete::formats
