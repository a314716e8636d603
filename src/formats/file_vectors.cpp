#include "formats/file_vectors.h"

#include <charconv>
#include <cmath>
#include <deque>

#include "base/error.h"

namespace viete::formats {

namespace {

constexpr std::size_t nowhere = no_places[0];

// Iterates over the changed numbers of one list, in file order.
class Changes {
public:
  Changes(const FileVectors& vectors, const VectorFile& file, const Source& source, const mesh::Surface& rest,
          std::span<const mesh::Point> positions, Digits digits)
      : vectors_(vectors),
        file_(file),
        source_(source),
        rest_(rest),
        positions_(positions),
        are_positions_(vectors.kind == FileVectors::Kind::positions),
        printed_(digits) {
    printed_.keep(are_positions_ ? 6 : 5, are_positions_ ? mesh::bounds(rest.positions).diagonal() : 1);
    if (file.text) learn();
    if (!are_positions_) follow();
    if (vectors.count > 0) {
      std::size_t row = 0;  // becomes the first row that has places
      while (row + 1 < vectors.count && vectors.places(row) == no_places) ++row;
      std::ranges::sort(axes_, {}, [order = vectors.places(row)](std::size_t axis) { return order[axis]; });
    }
    advance();
  }

  // Returns the offset of the current number, or `nowhere` at the end.
  std::size_t place() const { return place_; }

  void replace(Rewriter& rewriter) {
    rewriter.replace(at(place_, type_), words_);
    advance();
  }

  // Returns the largest rounding of a position by its number type.
  double rounding() const { return rounding_; }

private:
  std::string_view at(std::size_t place, base::NumberType type) const {
    const std::string_view rest = source_.bytes.substr(place);
    return file_.text ? TextCursor(rest).rest_of_word() : rest.substr(0, size_of(type));
  }

  // Returns the vector in a row, or zero for a row without places. Components that are not numbers are NaN.
  mesh::Vec3 direction(std::size_t row) const {
    const FileVectors::Places places = vectors_.places(row);
    if (places == no_places) return {0, 0, 0};
    mesh::Vec3 v;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string_view word = at(places[k], vectors_.types[k]);
      v[k] = file_.text ? number_in(word).value_or(std::nan(""))
                        : base::number_of_bytes(word.data(), vectors_.types[k], file_.order);
    }
    return v;
  }

  void learn() {
    constexpr std::size_t enough = 10'000;
    for (std::size_t row = 0; row < std::min(enough, vectors_.count); ++row) {
      const FileVectors::Places places = vectors_.places(row);
      if (places == no_places || !mesh::is_direction(direction(row))) continue;
      for (const std::size_t place : places) printed_.learn(at(place, base::NumberType::float64));
    }
  }

  // Computes the directions after the deformation.
  void follow() {
    for (std::size_t row = 0; row < vectors_.count; ++row) before_.push_back(direction(row));
    std::vector<std::uint32_t> of_corner = rest_.corners, of_vertex;
    if (vectors_.rows == FileVectors::Rows::faces) {
      for (std::size_t c = 0; c < of_corner.size(); ++c) of_corner[c] = vectors_.row_of_corner(c);
    } else {
      of_vertex = mesh::first_numbers(rest_.positions.size());
    }
    const auto deformed =
        vectors_.kind == FileVectors::Kind::normals ? mesh::deformed_normals : mesh::deformed_tangents;
    now_ = deformed(rest_, positions_, before_, of_corner, of_vertex);
    mesh::keep_lengths(before_, now_);
  }

  std::pair<mesh::Vec3, mesh::Vec3> values(std::size_t row) const {
    if (!are_positions_) return {before_[row], now_[row]};
    const std::size_t v = vectors_.rows == FileVectors::Rows::corners ? rest_.corners[row] : row;
    return {rest_.positions[v], positions_[v]};
  }

  void advance() {
    place_ = nowhere;
    while (place_ == nowhere && next_ < 3 * vectors_.count) {
      const std::size_t row = next_ / 3, axis = axes_[next_ % 3];
      ++next_;
      const auto [before, now] = values(row);
      if (before[axis] == now[axis] || !mesh::changed(before, now)) continue;
      type_ = vectors_.types[axis];
      std::array<char, 400> room_before;
      const auto words = written(now[axis], room_);
      if (!words)
        throw base::Error(source_.place(vectors_.element, row),
                          "the new value exceeds the range of its number type in this file",
                          "save in another format, or scale the model");
      if (are_positions_) rounding_ = std::max(rounding_, std::abs(stored(now[axis]) - now[axis]));
      if (words == written(before[axis], room_before)) continue;
      words_ = *words;
      place_ = vectors_.places(row)[axis];
    }
  }

  // Returns the value after conversion to the number type of the file.
  double stored(double value) const {
    return with_type(type_, [&](auto number) {
      if (std::is_integral_v<decltype(number)>) return std::round(value);
      return static_cast<double>(static_cast<decltype(number)>(value));
    });
  }

  std::optional<std::string_view> written(double value, std::span<char> room) const {
    return number_in_file(value, type_, {file_.text, file_.order}, printed_, room);
  }

  const FileVectors& vectors_;
  const VectorFile& file_;
  const Source& source_;
  const mesh::Surface& rest_;
  std::span<const mesh::Point> positions_;
  bool are_positions_;
  Printed printed_;
  std::vector<mesh::Vec3> before_, now_;      // directions before and after the deformation
  std::array<std::size_t, 3> axes_{0, 1, 2};  // sorted by the places of the numbers in a row
  std::size_t next_ = 0, place_ = nowhere;
  base::NumberType type_ = base::NumberType::float64;  // type of the number at place_
  std::string_view words_;                             // new text or bytes of the number at place_
  std::array<char, 400> room_;
  double rounding_ = 0;
};

class VectorOriginal final : public Original {
public:
  VectorOriginal(const Source& source, VectorFile file)
      : Original(file.format, source), file_(std::move(file)) {
    companions_ = std::move(file_.companions);
    capture_ = file_.capture;
  }

  std::vector<std::string> beyond_attributes() const override { return file_.beyond_attributes; }

  std::vector<std::string> write(const Content& content, TextWriter& out) const override {
    const Source source = this->source();
    std::deque<Changes> all;
    for (const FileVectors& vectors : file_.vectors)
      all.emplace_back(vectors, file_, source, content.surface, content.positions, out.digits());
    Rewriter rewriter(bytes_, out);
    for (;;) {
      const auto next = std::ranges::min_element(all, {}, &Changes::place);
      if (next == all.end() || next->place() == nowhere) break;
      next->replace(rewriter);
    }
    rewriter.finish();
    double rounding = 0;
    for (const Changes& changes : all) rounding = std::max(rounding, changes.rounding());
    return rounding_notes(rounding, mesh::bounds(content.positions).diagonal());
  }

private:
  VectorFile file_;
};

}  // namespace

std::optional<std::string_view> number_in_file(double value, base::NumberType type, const NumberForm& form,
                                               const Printed& printed, std::span<char> room) {
  return with_type(type, [&](auto number) -> std::optional<std::string_view> {
    using Number = decltype(number);
    constexpr bool whole = std::is_integral_v<Number>;
    if (whole) {
      value = std::round(value);
      const double beyond = std::ldexp(1.0, std::numeric_limits<Number>::digits);
      if (!(value >= double(std::numeric_limits<Number>::lowest()) && value < beyond)) return std::nullopt;
    }
    number = static_cast<Number>(value);
    if (!std::isfinite(static_cast<double>(number))) return std::nullopt;
    if (form.text) {
      if (!whole) return printed.print(value, room);
      const char* const end = std::to_chars(room.data(), room.data() + room.size(), number).ptr;
      return std::string_view(room.data(), static_cast<std::size_t>(end - room.data()));
    }
    std::ranges::copy(base::bytes_of_number(number, form.order), room.begin());
    return std::string_view(room.data(), sizeof number);
  });
}

FileVectors::Places places_of_three(TextCursor& text) {
  FileVectors::Places places;
  for (std::size_t& place : places) {
    if (text.at_line_end()) return no_places;
    place = text.offset();
    text.word();
  }
  return places;
}

std::shared_ptr<const Original> original_of(const Source& source, VectorFile file) {
  return source.owner ? std::make_shared<const VectorOriginal>(source, std::move(file)) : nullptr;
}

}  // namespace viete::formats
