#include "base/numbered_files.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace viete::base {

namespace fs = std::filesystem;

namespace {

constexpr int most_digits = 18;  // every number with at most 18 digits fits into 64 bits
constexpr std::string_view decimal = "0123456789";

struct NumberPlace {
  std::size_t begin = 0, end = 0;
  int digits = 1;
};

std::vector<NumberPlace> places_in(std::string_view name) {
  std::vector<NumberPlace> places;
  for (std::size_t at = 0; (at = name.find('#', at)) != name.npos; at = places.back().end) {
    const std::size_t end = std::min(name.find_first_not_of('#', at), name.size());
    places.push_back({at, end, static_cast<int>(std::min<std::size_t>(end - at, most_digits))});
  }
  return places;
}

}  // namespace

NumberedName::NumberedName(fs::path folder, std::string before, int digits, std::string after)
    : folder_(std::move(folder)), before_(std::move(before)), after_(std::move(after)), digits_(digits) {}

NumberedName::NumberedName(const fs::path& pattern) : folder_(pattern.parent_path()) {
  const std::string name = pattern.filename().string();
  const auto places = places_in(name);
  if (places.size() != 1)
    throw Error(pattern.string(),
                places.empty() ? "its name has no placeholder for the frame number"
                               : "its name has more than one placeholder for the frame number",
                "write the number as ####, for example frame_####" + fs::path(name).extension().string());
  before_ = name.substr(0, places[0].begin);
  after_ = name.substr(places[0].end);
  digits_ = places[0].digits;
}

bool NumberedName::is_pattern(const fs::path& path) {
  return !places_in(path.filename().string()).empty();
}

std::optional<NumberedName> NumberedName::of_file(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t last = stem.find_last_of(decimal);
  if (last == stem.npos) return std::nullopt;
  const std::size_t before = stem.find_last_not_of(decimal, last);
  const std::size_t first = before == stem.npos ? 0 : before + 1;
  const std::size_t count = last + 1 - first;
  if (count > most_digits) return std::nullopt;
  const auto of = [&](std::size_t digits) {
    return NumberedName(file.parent_path(), stem.substr(0, first), static_cast<int>(digits),
                        stem.substr(last + 1) + file.extension().string());
  };
  const bool padded = stem[first] == '0' || of(count).find().size() > of(1).find().size();
  return of(padded ? count : 1);
}

fs::path NumberedName::file(std::int64_t number) const {
  return folder_ / (before_ + formatted("%0*lld", digits_, static_cast<long long>(number)) + after_);
}

std::optional<std::int64_t> NumberedName::number(const std::string& name) const {
  if (name.size() <= before_.size() + after_.size() || !name.starts_with(before_) || !name.ends_with(after_))
    return std::nullopt;
  const std::string text = name.substr(before_.size(), name.size() - before_.size() - after_.size());
  std::int64_t number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return file(number).filename() == name ? std::optional(number) : std::nullopt;
}

std::vector<NumberedFile> NumberedName::find() const {
  std::vector<NumberedFile> found;
  std::error_code code;
  fs::directory_iterator at(folder_.empty() ? fs::path(".") : folder_, code);
  for (const fs::directory_iterator end; !code && at != end; at.increment(code)) {
    const std::string name = at->path().filename().string();
    if (const auto n = number(name)) found.push_back({*n, folder_ / name});
  }
  if (code && code != std::errc::no_such_file_or_directory)
    throw Error(folder_.string(), "cannot be read: " + code.message(), "check the folder's permissions");
  std::ranges::sort(found, {}, &NumberedFile::number);
  return found;
}

std::string NumberedName::pattern() const {
  return (folder_ / (before_ + std::string(static_cast<std::size_t>(digits_), '#') + after_)).string();
}

}  // namespace viete::base
