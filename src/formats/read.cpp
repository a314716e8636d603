#include "formats/read.h"

#include <new>
#include <ranges>

#include "base/error.h"
#include "base/file_bytes.h"
#include "formats/codecs.h"
#include "formats/format_table.h"

namespace viete::formats {

namespace {

ReadResult by_extension(const Source& source) {
  refuse_foreign(source.name, source.bytes);
  const Format* named = format_by_extension(source.extension);
  if (named && named->may_be_binary) return named->read(source);
  const bool binary = looks_binary(source.bytes);
  if (!binary && looks_like_obj(source)) return read_obj(source);
  if (!binary && named && named->read) return named->read(source);
  throw base::Error(source.name, "the file is not " + format_names(holds_surface),
                    "export the model in one of these formats");
}

}  // namespace

ReadResult read(const Source& source) {
  try {
    // The order is reversed, so that STL comes before OFF and PLY: a binary STL may start with any text.
    for (const Format& format : std::views::reverse(all_formats()))
      if (format.recognised && format.recognised(source)) return format.read(source);
    return by_extension(source);
  } catch (const std::bad_alloc&) {
    throw base::Error(source.name, "the model does not fit into memory",
                      "simplify the model or use a computer with more memory");
  }
}

ReadResult read(const std::filesystem::path& path, base::Progress* progress, bool played) {
  const auto bytes = std::make_shared<const base::FileBytes>(path, progress);
  const auto folder = std::filesystem::absolute(path).parent_path();
  return read(
      Source{path.string(), base::extension_of(path), bytes->view(), progress, bytes, folder, played});
}

}  // namespace viete::formats
