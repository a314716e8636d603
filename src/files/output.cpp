#include "files/output.h"

#include <algorithm>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/numbered_files.h"
#include "base/text.h"
#include "document/document.h"
#include "formats/format_table.h"
#include "formats/source.h"

namespace viete::files {

namespace fs = std::filesystem;

namespace {

bool is_session_text(std::string_view bytes) {
  return formats::text_in_json(bytes, {"format"}) == "viete session";
}

bool may_be_replaced(const fs::path& file, const formats::Beginning& beginning, Content content) {
  const std::string_view bytes = beginning.bytes();
  switch (content) {
    case Content::surface:
    case Content::animation: {
      const formats::Format* named = formats::find_format(file);
      const formats::Format* found = formats::format_of_content(file, beginning);
      return found && named && found->name == named->name;
    }
    case Content::picture: return bytes.starts_with("\x89PNG\r\n\x1a\n");
    case Content::json: return !formats::text_in_json(bytes, {"figure"}).empty();
    case Content::session: return is_session_text(bytes);
    case Content::film:
      return bytes.substr(0, 8).ends_with("ftyp") || bytes.starts_with("\x1a\x45\xdf\xa3") ||
             bytes.starts_with("GIF8");
    case Content::page: break;
  }
  return bytes.substr(0, 512).find(R"(content="viete report")") != bytes.npos;
}

std::string name_of(const fs::path& file, Content content) {
  constexpr const char* names[] = {
      "", "a PNG picture", "Viete measurements", "", "a session", "a report page", "a film"};
  const std::string name = names[static_cast<std::size_t>(content)];
  if (!name.empty()) return name;
  const formats::Format* format = formats::find_format(file);
  return format ? std::string(format->name) : "an animation";
}

std::string name_of_found(const fs::path& file, const formats::Beginning& beginning) {
  if (beginning.bytes().empty()) return "not readable";
  if (is_session_text(beginning.bytes())) return name_of(file, Content::session);
  if (const formats::Format* format = formats::format_of_content(file, beginning))
    return std::string(format->name);
  return std::string(formats::name_of_content(beginning.bytes()));
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why, const fs::path& named, Force force) {
  const std::string name = named.stem().string() + "-2" + named.extension().string();
  const fs::path other = base::unused_name(named.parent_path() / name);
  throw base::Error(file.string(), why,
                    "choose another name, such as " + other.filename().string() +
                        (force == Force::offered ? ", or add --force" : ""));
}

[[noreturn]] void refuse_in_use(const fs::path& file, const std::string& what, const fs::path& named,
                                Force force) {
  refuse(file, "this is an input file (" + what + ") and would be replaced", named, force);
}

}  // namespace

void check_output(const fs::path& file, Content content, const document::FilesInUse& files, Force force) {
  if (file.empty()) return;
  if (content == Content::surface) formats::surface_format(file);
  const std::string* used = force == Force::given ? nullptr : files.find(file);
  if (used) refuse_in_use(file, *used, file, force);
  base::remove_leftovers_beside(file);
  base::check_replaceable(file);
  std::error_code code;
  const auto size = fs::file_size(file, code);
  if (force == Force::given || code || size == 0) return;
  const formats::Beginning beginning(file);
  if (may_be_replaced(file, beginning, content)) return;
  refuse(file,
         "this file is " + name_of_found(file, beginning) + ", not " + name_of(file, content) +
             ", and would be replaced",
         file, force);
}

void check_output(const fs::path& file, const FrameSteps& frames, const document::FilesInUse& files,
                  Force force) {
  if (!base::NumberedName::is_pattern(file))
    return check_output(file, is_film(file) ? Content::film : Content::animation, files, force);
  base::remove_leftovers_beside(file);
  const base::NumberedName name(file);
  for (int frame = frames.first; frame <= frames.last; frame += frames.step)
    if (const std::string* used = files.find(name.file(frame)))
      refuse_in_use(name.file(frame), *used, file, Force::none);
}

bool is_film(const fs::path& file) {
  return std::ranges::count(film_formats, base::extension_of(file)) > 0;
}

void check_frames_are_new(const base::NumberedName& name, std::span<const int> frames, Force force) {
  if (force == Force::given) return;
  std::error_code code;
  std::vector<fs::path> there;
  for (const int frame : frames)
    if (const fs::path file = name.file(frame); fs::exists(fs::symlink_status(file, code)))
      there.push_back(file);
  if (there.empty()) return;
  const std::size_t more = there.size() - 1;
  throw base::Error(there.front().string(),
                    "this file already exists and would be replaced" +
                        (more > 0 ? ", and " + base::with_thousands(more) + " more files" : std::string()),
                    std::string("choose another name, or move the files") +
                        (force == Force::offered ? ", or add --force" : ""));
}

fs::path proposed_name(const fs::path& file, const document::FilesInUse& files) {
  return base::unused_name(file, [&](const fs::path& taken) { return !files.find(taken); });
}

void add_surface(document::FilesInUse& files, const fs::path& file, const formats::Original* original,
                 const formats::Attributes* attributes, std::string_view what) {
  files.add(file, what);
  const std::string part = "used by " + std::string(what);
  if (original)
    for (const fs::path& other : original->files_beside()) files.add(other, part);
  if (!attributes) return;
  for (const formats::ImageFile& image : attributes->images) files.add(image.path, part);
}

void add_document(document::FilesInUse& files, const document::Document& document, std::string_view own) {
  const auto add = [&](const document::OpenedSurface& surface, std::string_view what) {
    const bool is_own = own == what;  // if true, adds only the files that this file uses
    add_surface(files, is_own ? fs::path() : surface.path, surface.original.get(), surface.attributes.get(),
                what);
  };
  add(document.model(), document::the_model);
  add(document.cage_file(), document::the_cage);
  for (const document::FileInUse& file : document.also_read())
    if (file.what != own) files.add(file.path, file.what);
}

}  // namespace viete::files
