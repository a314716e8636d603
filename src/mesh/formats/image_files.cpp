#include "mesh/formats/image_files.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/picture.h"
#include "base/text.h"
#include "mesh/formats/conversion.h"
#include "mesh/formats/source.h"

namespace viete::mesh {

namespace {

namespace fs = std::filesystem;

// How files of this content are called; empty: no picture that is known here.
std::string_view picture_extension(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr auto known = std::to_array<std::pair<std::string_view, std::string_view>>(
      {{"\x89PNG"sv, ".png"}, {"\xFF\xD8"sv, ".jpg"}, {"BM"sv, ".bmp"}, {"GIF8"sv, ".gif"}});
  for (const auto& [beginning, extension] : known) {
    if (bytes.starts_with(beginning)) return extension;
  }
  if (bytes.starts_with("RIFF"sv) && bytes.substr(0, 12).ends_with("WEBP"sv)) return ".webp";
  if (bytes.substr(0, 8).ends_with("KTX 20"sv)) return ".ktx2";
  return {};
}

// A name of any origin as that of a file: no folders, no blanks, nothing that a shell or an MTL would take
// for something else.
std::string file_stem(const std::string& name, const std::string& otherwise) {
  const fs::path path(name);
  const bool has_extension = path.extension().string().size() <= 5;
  std::string stem;
  for (const char c : has_extension ? path.stem().string() : path.filename().string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       static_cast<unsigned char>(c) >= 128 || (!stem.empty() && (c == '-' || c == '.'));
    if (plain || (!stem.empty() && stem.back() != '_')) stem.push_back(plain ? c : '_');
  }
  std::size_t most = 80;
  if (stem.size() > most) {
    while ((static_cast<unsigned char>(stem[most]) & 0xC0) == 0x80) --most;  // within a letter of UTF-8
    stem.resize(most);
  }
  while (!stem.empty() && (stem.back() == '_' || stem.back() == '.')) stem.pop_back();
  return stem.empty() ? otherwise : stem;
}

std::string called(const ImageFile& image) {
  return image.path.empty() ? image.name : image.path.string();
}

void leave_out(std::uint32_t image, Attributes& attributes) {
  for (Material& m : attributes.materials) {
    if (m.base_color_image == image) m.base_color_image = none;
  }
}

// Throws base::Error where it cannot be had.
std::string bytes_of(const ImageFile& image) {
  if (image.bytes) return *image.bytes;
  if (image.path.empty()) throw base::Error(image.name, "is not in the file");
  return std::string(FileBytes(image.path, nullptr, most_image_bytes).view());
}

// As glTF takes it; says so where it had to be made.
std::string png_or_jpeg(const ImageFile& image, std::vector<std::string>& notes) {
  std::string bytes = bytes_of(image);
  const std::string_view extension = picture_extension(bytes);
  if (extension == ".png" || extension == ".jpg") return bytes;
  const base::Picture picture = base::decode_picture(called(image), bytes);
  notes.push_back(called(image) + " became PNG, since glTF takes PNG and JPEG alone");
  return base::encode_png(called(image), picture.width, picture.height, picture.channels, picture.bytes);
}

bool holds_exactly(const fs::path& path, std::string_view bytes) {
  std::error_code code;
  return fs::file_size(path, code) == bytes.size() && !code && FileBytes(path, nullptr).view() == bytes;
}

std::string list_of_names(const std::set<std::string>& names) {
  std::string list;
  std::size_t left = 8;
  for (const std::string& name : names) {
    if (left-- == 0) return list + " ...";
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

}  // namespace

FilesBeside::FilesBeside(const fs::path& model) : model_(model), folder_(model.parent_path()) {}

FilesBeside::~FilesBeside() {
  std::error_code ignored;
  for (const fs::path& path : written_) fs::remove(path, ignored);
}

std::string FilesBeside::put(const std::string& name, std::string_view bytes) {
  const fs::path path =
      base::unused_name(folder_ / name, [&](const fs::path& taken) { return holds_exactly(taken, bytes); });
  std::error_code code;
  if (!fs::exists(path, code)) {
    base::replace_file(path, bytes);
    written_.push_back(path);
  }
  return path.filename().string();
}

bool FilesBeside::copy(const fs::path& file, const fs::path& name) {
  const FileBytes bytes(file, nullptr);
  const fs::path path = folder_ / name;
  std::error_code code;
  if (fs::exists(fs::symlink_status(path, code)))
    return fs::is_regular_file(path, code) && holds_exactly(path, bytes.view());
  fs::create_directories(path.parent_path(), code);  // or writing says what is wrong
  base::replace_file(path, bytes.view());
  written_.push_back(path);
  return true;
}

std::vector<std::string> copy_companions(const Companions& companions, FilesBeside& beside) {
  if (fs::weakly_canonical(companions.folder) == folder_of(beside.model())) return {};
  std::set<std::string> copied, others, stayed;
  for (const fs::path& file : companions.files) {
    const fs::path name = file.lexically_relative(companions.folder);
    std::error_code code;
    if (!fs::is_regular_file(file, code)) continue;  // who shows it has said so
    if (name.empty() || *name.begin() == "..") {
      stayed.insert(file.string());
    } else {
      (beside.copy(file, name) ? copied : others).insert(name.string());
    }
  }
  std::vector<std::string> notes;
  if (!copied.empty()) notes.push_back("copied beside it, where it looks for them: " + list_of_names(copied));
  if (!others.empty())
    notes.push_back("other files of these names are beside it already, and stayed: " + list_of_names(others));
  if (!stayed.empty())
    notes.push_back("stayed where they are, and it may not find them: " + list_of_names(stayed));
  return notes;
}

fs::path folder_of(const fs::path& file) {
  return fs::weakly_canonical(fs::absolute(file).parent_path());
}

fs::path way_to(const fs::path& file, const fs::path& folder) {
  return (folder_of(file) / file.filename()).lexically_relative(folder);
}

std::string stayed_note(const std::string& what, const fs::path& file) {
  return what + " stayed where the model was read from, and " + file.filename().string() +
         " leads there: move them together";
}

std::vector<std::string> take_images_within(Attributes& attributes) {
  std::vector<std::string> notes;
  for (const std::uint32_t i : used_images(attributes)) {
    ImageFile& image = attributes.images[i];
    try {
      image.bytes = std::make_shared<const std::string>(png_or_jpeg(image, notes));
    } catch (const base::Error& error) {
      notes.push_back(std::string(error.what()) + "; the texture is left out");
      leave_out(i, attributes);
    }
  }
  return notes;
}

std::vector<std::string> put_images_beside(FilesBeside& beside, Attributes& attributes) {
  std::vector<std::string> notes;
  std::set<std::string> written;
  std::size_t elsewhere = 0;
  const fs::path folder = folder_of(beside.model());
  for (const std::uint32_t i : used_images(attributes)) {
    ImageFile& image = attributes.images[i];
    if (!image.path.empty()) {
      image.path = way_to(image.path, folder);
      elsewhere += *image.path.begin() == "..";
      continue;
    }
    const std::string_view extension = image.bytes ? picture_extension(*image.bytes) : std::string_view();
    if (extension.empty()) {
      notes.push_back(image.name + " is no picture that is known here; the texture is left out");
      leave_out(i, attributes);
      continue;
    }
    const std::string stem = file_stem(image.name, beside.model().stem().string());
    image.path = beside.put(stem + std::string(extension), *image.bytes);
    written.insert(image.path.string());
  }
  if (!written.empty())
    notes.push_back(base::counted(written.size(), "image") + " of the file " +
                    (written.size() == 1 ? "is" : "are") + " beside it now: " + list_of_names(written));
  if (elsewhere > 0) notes.push_back(stayed_note(base::counted(elsewhere, "image"), beside.model()));
  return notes;
}

}  // namespace viete::mesh
