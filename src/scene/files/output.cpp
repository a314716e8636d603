#include "scene/files/output.h"

#include <fstream>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/numbered_files.h"
#include "deform/binding_file.h"
#include "mesh/formats/format_table.h"
#include "mesh/formats/source.h"
#include "mesh/formats/write.h"
#include "scene/document/document.h"
#include "scene/files/session.h"

namespace viete::scene {

namespace fs = std::filesystem;

namespace {

std::string beginning_of(const fs::path& file) {
  std::string bytes(512, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

bool holds_content(const fs::path& file, Content content) {
  const std::string bytes = beginning_of(file);
  switch (content) {
    case Content::surface:
    case Content::animation: return !is_session(file);
    case Content::binding: return deform::is_binding(bytes);
    case Content::picture: return bytes.starts_with("\x89PNG\r\n\x1a\n");
    case Content::json: return mesh::extension_of(file) == "json";
    case Content::session:
      return mesh::FileBytes(file, nullptr).view().find(R"("viete session")") != std::string_view::npos;
    case Content::page: return bytes.find(R"(content="viete report")") != std::string::npos;
    case Content::distances: return bytes.starts_with("Pf\n");
    case Content::svg: break;
  }
  return bytes.find("<svg") != std::string::npos;
}

const char* name_of_content(Content content) {
  constexpr const char* names[] = {"a surface",    "a saved binding", "a PNG picture",
                                   "a JSON file",  "an SVG picture",  "distances (PFM)",
                                   "an animation", "a session",       "a page of a report"};
  return names[static_cast<std::size_t>(content)];
}

// "dragon-2.obj", where nothing is of this name.
[[noreturn]] void refuse(const fs::path& file, const std::string& why, const fs::path& named, Force force) {
  const std::string name = named.stem().string() + "-2" + named.extension().string();
  const fs::path other = base::unused_name(named.parent_path() / name);
  throw base::Error(file.string(), why,
                    "choose another name, such as " + other.filename().string() +
                        (force == Force::offered ? ", or add --force" : ""));
}

[[noreturn]] void refuse_in_use(const fs::path& file, const std::string& what, const fs::path& named,
                                Force force) {
  refuse(file, "this file is one of those that are read (" + what + "), and would be replaced", named, force);
}

}  // namespace

void check_output(const fs::path& file, Content content, const FilesInUse& files, Force force) {
  if (file.empty()) return;
  if (content == Content::surface) mesh::surface_format(file);
  const std::string* used = force == Force::given ? nullptr : files.find(file);
  if (used) refuse_in_use(file, *used, file, force);
  base::remove_leftovers_beside(file);
  base::check_replaceable(file);
  std::error_code code;
  const auto size = fs::file_size(file, code);
  if (force == Force::given || code || size == 0 || holds_content(file, content)) return;
  refuse(file, std::string("there is a file of this name already, which is not ") + name_of_content(content),
         file, force);
}

void check_output(const fs::path& file, const FrameSteps& frames, const FilesInUse& files, Force force) {
  if (!base::NumberedName::is_pattern(file)) return check_output(file, Content::animation, files, force);
  base::remove_leftovers_beside(file);
  const base::NumberedName name(file);
  for (int frame = frames.first; frame <= frames.last; frame += frames.step)
    if (const std::string* used = files.find(name.file(frame)))
      refuse_in_use(name.file(frame), *used, file, Force::none);
}

fs::path proposed_name(const fs::path& file, const FilesInUse& files) {
  return base::unused_name(file, [&](const fs::path& taken) { return !files.find(taken); });
}

void add_surface(FilesInUse& files, const fs::path& file, const mesh::Original* original,
                 const mesh::Attributes* attributes, std::string_view what) {
  files.add(file, what);
  const std::string part = "what " + std::string(what) + " leads to";
  if (original)
    for (const fs::path& other : original->files_beside()) files.add(other, part);
  if (!attributes) return;
  for (const mesh::ImageFile& image : attributes->images) files.add(image.path, part);
}

void add_document(FilesInUse& files, const Document& document, std::string_view own) {
  const auto add = [&](const OpenedSurface& surface, std::string_view what) {
    const bool anew = own == what;  // but not what it leads to
    add_surface(files, anew ? fs::path() : surface.path, surface.original.get(), surface.attributes.get(),
                what);
  };
  add(document.model, the_model);
  add(document.cage_file, the_cage);
  for (const FileInUse& file : document.also_read)
    if (file.what != own) files.add(file.path, file.what);
}

}  // namespace viete::scene
