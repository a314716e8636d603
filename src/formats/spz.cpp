#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "base/worker_pool.h"
#include "formats/codecs.h"
#include "formats/surface_builder.h"

namespace viete::formats {

namespace {

constexpr std::size_t spz_header_bytes = 16;
constexpr std::size_t most_bytes_of_extensions = 1 << 26;
constexpr int most_fractional_bits = 23;
constexpr double largest_fixed = 8388607;  // 2^23 - 1
constexpr float color_scale = 0.15F;
constexpr float half_angle = 0.70710678F;  // the largest value of the three smallest numbers of a quaternion

// Signs that convert positions and quaternions (w x y z) between the axes of SPZ and of PLY.
constexpr std::array<int, 3> axis_signs{1, -1, -1};
constexpr std::array<int, 4> quaternion_signs{1, 1, -1, -1};
// The same for harmonics, each -1 if the harmonic is odd in y z together: y z x, xy yz .. xz .., ...
constexpr std::array<int, 15> harmonic_signs{-1, -1, 1, -1, 1, 1, -1, 1, -1, 1, -1, -1, 1, -1, 1};

// Decompresses gzip.
class Gunzip {
public:
  explicit Gunzip(std::string_view bytes) : rest_(bytes) {
    constexpr int gzip = 16;
    works_ = inflateInit2(&stream_, gzip + MAX_WBITS) == Z_OK;
  }
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;
  ~Gunzip() { inflateEnd(&stream_); }

  // Appends `most` bytes, or fewer at the end of the content or of the file, or if the file is damaged.
  void read(std::size_t most, std::string& to) {
    constexpr std::size_t portion = 1 << 18;
    while (works_ && !ended_ && most > 0) {
      if (stream_.avail_in == 0) feed(portion);
      const std::size_t room = std::min(portion, most), size = to.size();
      to.resize(size + room);
      stream_.next_out = reinterpret_cast<Bytef*>(to.data() + size);
      stream_.avail_out = static_cast<uInt>(room);
      const int result = inflate(&stream_, Z_NO_FLUSH);
      ended_ = result == Z_STREAM_END;
      works_ = result == Z_OK || ended_;
      to.resize(size + room - stream_.avail_out);
      most -= to.size() - size;
    }
  }

  bool ended() const { return ended_; }

private:
  void feed(std::size_t portion) {
    const std::string_view next = rest_.substr(0, portion);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(next.data()));
    stream_.avail_in = static_cast<uInt>(next.size());
    rest_.remove_prefix(next.size());
  }

  z_stream stream_{};
  std::string_view rest_;
  bool works_ = false, ended_ = false;
};

void write_gzip(std::string_view content, TextWriter& out) {
  z_stream stream{};
  constexpr int gzip = 16, memory = 8;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip + MAX_WBITS, memory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, deflateEnd);
  std::array<char, 1 << 16> portion;
  std::size_t done = 0;
  for (int result = Z_OK; result == Z_OK;) {
    if (stream.avail_in == 0) {
      const std::string_view next = content.substr(done, portion.size());
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(next.data()));
      stream.avail_in = static_cast<uInt>(next.size());
      done += next.size();
    }
    stream.next_out = reinterpret_cast<Bytef*>(portion.data());
    stream.avail_out = static_cast<uInt>(portion.size());
    result = deflate(&stream, done == content.size() ? Z_FINISH : Z_NO_FLUSH);
    out.text({portion.data(), portion.size() - stream.avail_out});
    out.element_done(done, content.size());
  }
}

// The header of a file, and the offsets of its arrays: positions, alphas, colours, scales, rotations,
// harmonics.
struct SpzLayout {
  std::uint32_t version = 3;
  std::size_t count = 0;
  int file_degree = 0;  // 0 to 4
  int fractional_bits = 12;
  std::uint8_t flags = 0;

  std::size_t harmonics() const { return static_cast<std::size_t>(file_degree * (file_degree + 2)); }
  std::size_t rotation_bytes() const { return version == 2 ? 3 : 4; }
  std::size_t alphas() const { return spz_header_bytes + 9 * count; }
  std::size_t colors() const { return alphas() + count; }
  std::size_t scales() const { return colors() + 3 * count; }
  std::size_t rotations() const { return scales() + 3 * count; }
  std::size_t first_harmonic() const { return rotations() + rotation_bytes() * count; }
  std::size_t end() const { return first_harmonic() + 3 * harmonics() * count; }
};

SpzLayout spz_layout(const Source& source, const std::string& header) {
  if (header.size() < spz_header_bytes)
    throw base::Error(source.name, "the file ends within its header", "export or copy it again");
  SpzLayout layout;
  layout.version = base::number_of_bytes<std::uint32_t>(header.data() + 4);
  layout.count = base::number_of_bytes<std::uint32_t>(header.data() + 8);
  layout.file_degree = static_cast<std::uint8_t>(header[12]);
  layout.fractional_bits = static_cast<std::uint8_t>(header[13]);
  layout.flags = static_cast<std::uint8_t>(header[14]);
  if (layout.version != 2 && layout.version != 3)
    throw base::Error(source.name,
                      "this is a capture in SPZ version " + std::to_string(layout.version) +
                          ", only versions 2 and 3 can be read",
                      "export it as SPZ version 3 or as PLY");
  if (layout.file_degree > 4 || layout.fractional_bits > most_fractional_bits)
    throw base::Error(source.name,
                      "the header announces harmonics of degree " + std::to_string(layout.file_degree) +
                          " and " + std::to_string(layout.fractional_bits) + " fractional bits",
                      "it seems to be damaged: export or copy it again");
  constexpr std::size_t best_ratio = 1032;  // of deflate
  const std::size_t room =
      best_ratio * source.bytes.size() / (layout.end() / std::max(layout.count, std::size_t{1}));
  if (layout.count > room)
    throw base::Error(source.name,
                      "the header announces " + base::counted(layout.count, "splat") +
                          ", the file has room for at most " + std::to_string(room),
                      "it seems to be truncated: export or copy it again");
  return layout;
}

std::uint8_t spz_byte(float x) {
  return x > 0 ? static_cast<std::uint8_t>(std::min(std::round(x), 255.0F)) : std::uint8_t{0};
}

float unsigned_at(const char* at) {
  return static_cast<float>(static_cast<std::uint8_t>(*at));
}

// A signed number of 24 bits.
std::int32_t fixed_at(const char* at) {
  const auto byte = [&](int i) { return static_cast<std::uint32_t>(static_cast<std::uint8_t>(at[i])); };
  return static_cast<std::int32_t>((byte(0) | byte(1) << 8 | byte(2) << 16) << 8) >> 8;
}

void put_fixed(std::int32_t value, char* to) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<char>(value >> 8 * i & 255);
}

using Quaternion = std::array<float, 4>;  // w x y z

// Version 2 stores x y z as bytes, for a positive w.
Quaternion quaternion_of_bytes(const char* at) {
  Quaternion q;
  float rest = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    q[i + 1] = unsigned_at(at + i) / 127.5F - 1;
    rest -= q[i + 1] * q[i + 1];
  }
  q[0] = std::sqrt(std::max(0.0F, rest));
  return q;
}

void put_quaternion(const Quaternion& q, char* to) {
  const float scale = q[0] < 0 ? -127.5F : 127.5F;
  for (std::size_t i = 0; i < 3; ++i) to[i] = static_cast<char>(spz_byte(scale * q[i + 1] + 127.5F));
}

// The place in (w x y z) of number i of (x y z w), the order of version 3.
constexpr std::size_t wxyz(std::size_t i) {
  return (i + 1) % 4;
}

// Version 3 stores the index of the largest number, which is positive, in two bits, then a sign bit and nine
// bits for each of the others.
Quaternion quaternion_of_word(std::uint32_t word) {
  Quaternion q;
  const std::size_t largest = word >> 30;
  float rest = 1;
  for (std::size_t i = 4; i-- > 0;) {
    if (i == largest) continue;
    const float size = half_angle * static_cast<float>(word & 511) / 511;
    q[wxyz(i)] = (word & 512) != 0 ? -size : size;
    rest -= size * size;
    word >>= 10;
  }
  q[wxyz(largest)] = std::sqrt(std::max(0.0F, rest));
  return q;
}

std::uint32_t word_of(const Quaternion& q) {
  std::size_t largest = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (std::abs(q[wxyz(i)]) > std::abs(q[wxyz(largest)])) largest = i;
  const bool negates = q[wxyz(largest)] < 0;
  auto word = static_cast<std::uint32_t>(largest);
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const float x = negates ? -q[wxyz(i)] : q[wxyz(i)];
    const float size = std::min(std::round(511 * std::abs(x) / half_angle), 511.0F);
    word = word << 10 | (x < 0 ? 512U : 0U) | static_cast<std::uint32_t>(size);
  }
  return word;
}

// Returns the quaternion with length 1, or no rotation for an invalid quaternion.
Quaternion unit_quaternion(const Quaternion& q) {
  double size = 0;
  for (const float x : q) size = std::max(size, std::abs(double{x}));
  double sum = 0;
  for (const float x : q) sum += (x / size) * (x / size);
  if (!(size > 0) || !std::isfinite(sum)) return {1, 0, 0, 0};
  Quaternion unit;
  for (std::size_t i = 0; i < 4; ++i) unit[i] = static_cast<float>(q[i] / (size * std::sqrt(sum)));
  return unit;
}

// The numbers of all splats, with the axes of PLY.
mesh::Splats unpacked_spz(const SpzLayout& layout, const char* bytes) {
  mesh::Splats splats;
  splats.degree = std::min(layout.file_degree, 3);
  splats.resize(layout.count);
  const std::size_t bands = splats.bands();
  base::for_blocks(layout.count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const float alpha = std::clamp(unsigned_at(bytes + layout.alphas() + v), 0.25F, 254.75F) / 255;
      splats.opacities[v] = std::log(alpha / (1 - alpha));
      for (std::size_t i = 0; i < 3; ++i) {
        splats.colors[v][i] = (unsigned_at(bytes + layout.colors() + 3 * v + i) / 255 - 0.5F) / color_scale;
        splats.log_scales[v][i] = unsigned_at(bytes + layout.scales() + 3 * v + i) / 16 - 10;
      }
      const char* const rotation = bytes + layout.rotations() + layout.rotation_bytes() * v;
      splats.rotations[v] = layout.version == 2
                                ? quaternion_of_bytes(rotation)
                                : quaternion_of_word(base::number_of_bytes<std::uint32_t>(rotation));
      for (std::size_t i = 0; i < 4; ++i) splats.rotations[v][i] *= static_cast<float>(quaternion_signs[i]);
      const char* const harmonics = bytes + layout.first_harmonic() + 3 * layout.harmonics() * v;
      for (std::size_t color = 0; color < 3; ++color)
        for (std::size_t j = 0; j < bands; ++j)
          splats.harmonics[3 * bands * v + bands * color + j] =
              static_cast<float>(harmonic_signs[j]) * (unsigned_at(harmonics + 3 * j + color) / 128 - 1);
    }
  });
  return splats;
}

// Makes the uncompressed content of a file.
class SpzPacker {
public:
  SpzPacker(const std::string& name, const SpzLayout& layout, const Content& content)
      : name_(name), layout_(layout), content_(content), bytes_(layout.end(), '\0') {
    std::string header = "NGSP";
    for (const auto number : {layout.version, static_cast<std::uint32_t>(layout.count)}) {
      const auto raw = base::bytes_of_number(number);
      header.append(raw.data(), raw.size());
    }
    for (const int byte : {layout.file_degree, layout.fractional_bits, int{layout.flags}, 0})
      header += static_cast<char>(byte);
    bytes_.replace(0, spz_header_bytes, header);
  }

  // Copies the rows of another content, which has other counts.
  void copy(const SpzLayout& from, const std::string& bytes) {
    using Array = std::pair<std::size_t (SpzLayout::*)() const, std::size_t>;  // offset, bytes of each splat
    const Array arrays[] = {{&SpzLayout::alphas, 1},
                            {&SpzLayout::colors, 3},
                            {&SpzLayout::scales, 3},
                            {&SpzLayout::rotations, from.rotation_bytes()},
                            {&SpzLayout::first_harmonic, 3 * from.harmonics()}};
    bytes_[spz_header_bytes - 1] = bytes[spz_header_bytes - 1];  // reserved
    for (std::size_t v = 0; v < layout_.count; ++v) {
      const std::size_t source = source_of(v);
      bytes_.replace(spz_header_bytes + 9 * v, 9, bytes, spz_header_bytes + 9 * source, 9);
      for (const auto& [offset, size] : arrays)
        bytes_.replace((layout_.*offset)() + size * v, size, bytes, (from.*offset)() + size * source, size);
    }
  }

  // Packs positions and splats that differ from `before`, or all if `before` is null. Numbers that are not
  // finite keep the byte of `before`.
  void pack(const mesh::Splats* before) {
    for (std::size_t v = 0; v < layout_.count; ++v) {
      const std::size_t source = source_of(v);
      pack_position(v, before ? &content_.surface.positions[source] : nullptr);
      if (content_.splats) pack_splat(*content_.splats, v, before, source);
    }
  }

  std::string take() { return std::move(bytes_); }

private:
  std::size_t source_of(std::size_t v) const { return content_.sources.empty() ? v : content_.sources[v]; }
  static bool changes(float now, const float* before) {
    return !before || (now != *before && std::isfinite(now));
  }

  void pack_position(std::size_t v, const mesh::Point* before) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = content_.positions[v][i];
      if (before && x == (*before)[i]) continue;
      const double fixed = std::round(std::ldexp(axis_signs[i] * x, layout_.fractional_bits));
      if (!(std::abs(fixed) <= largest_fixed))
        throw base::Error(Source{name_, "", ""}.place("splat", v),
                          base::formatted("the coordinate %.6g exceeds the range of this SPZ file", x),
                          "save as .ply");
      put_fixed(static_cast<std::int32_t>(fixed), &bytes_[spz_header_bytes + 9 * v + 3 * i]);
    }
  }

  void pack_splat(const mesh::Splats& now, std::size_t v, const mesh::Splats* before, std::size_t source) {
    const auto put = [&](std::size_t at, float value) { bytes_[at] = static_cast<char>(spz_byte(value)); };
    if (changes(now.opacities[v], before ? &before->opacities[source] : nullptr))
      put(layout_.alphas() + v, 255 / (1 + std::exp(-now.opacities[v])));
    for (std::size_t i = 0; i < 3; ++i) {
      const float color = now.colors[v][i], scale = now.log_scales[v][i];
      if (changes(color, before ? &before->colors[source][i] : nullptr))
        put(layout_.colors() + 3 * v + i, 255 * (color_scale * color + 0.5F));
      if (changes(scale, before ? &before->log_scales[source][i] : nullptr))
        put(layout_.scales() + 3 * v + i, 16 * (scale + 10));
    }
    if (!before || now.rotations[v] != before->rotations[source]) pack_rotation(v, now.rotations[v]);
    const std::size_t bands = now.bands();
    for (std::size_t color = 0; color < 3; ++color)
      for (std::size_t j = 0; j < bands; ++j) {
        const std::size_t k = bands * color + j;
        const float harmonic = now.harmonics[3 * bands * v + k];
        if (changes(harmonic, before ? &before->harmonics[3 * bands * source + k] : nullptr))
          put(layout_.first_harmonic() + 3 * layout_.harmonics() * v + 3 * j + color,
              128 * (static_cast<float>(harmonic_signs[j]) * harmonic + 1));
      }
  }

  void pack_rotation(std::size_t v, const Quaternion& rotation) {
    Quaternion q = unit_quaternion(rotation);
    for (std::size_t i = 0; i < 4; ++i) q[i] *= static_cast<float>(quaternion_signs[i]);
    char* const to = &bytes_[layout_.rotations() + layout_.rotation_bytes() * v];
    if (layout_.version == 2) return put_quaternion(q, to);
    std::ranges::copy(base::bytes_of_number(word_of(q)), to);
  }

  const std::string& name_;
  const SpzLayout& layout_;
  const Content& content_;
  std::string bytes_;
};

class SpzOriginal final : public Original {
public:
  SpzOriginal(const Source& source, const SpzLayout& layout, std::string content, std::string extensions,
              std::shared_ptr<const mesh::Splats> splats)
      : Original("SPZ", source),
        layout_(layout),
        content_(std::move(content)),
        extensions_(std::move(extensions)),
        splats_(std::move(splats)) {
    capture_ = Capture::splats;
  }

  std::vector<std::string> beyond_attributes() const override {
    return extensions_.empty() ? std::vector<std::string>{} : std::vector<std::string>{"extensions"};
  }

  std::vector<std::string> write(const Content& content, TextWriter& out) const override {
    if (content.is_at_rest() && !content.splats) {
      out.text(bytes_);
      return {};
    }
    SpzLayout layout = layout_;
    layout.count = content.positions.size();
    SpzPacker packer(name_, layout, content);
    packer.copy(layout_, content_);
    packer.pack(splats_.get());
    const std::string packed = packer.take();
    if (layout.count == layout_.count && packed == content_) {
      out.text(bytes_);
      return {};
    }
    write_gzip(packed + extensions_, out);
    return {};
  }

private:
  SpzLayout layout_;
  std::string content_;  // uncompressed
  std::string extensions_;
  std::shared_ptr<const mesh::Splats> splats_;
};

}  // namespace

ReadResult read_spz(const Source& source) {
  if (!looks_like_spz(source))
    throw base::Error(source.name, "is not an SPZ file", "check the extension, or export the capture again");
  Gunzip file(source.bytes);
  std::string content, extensions;
  file.read(spz_header_bytes, content);
  const SpzLayout layout = spz_layout(source, content);
  const std::size_t size = layout.end(), numbers = 11 + 3 * std::min(layout.harmonics(), std::size_t{15});
  base::require_memory(
      {static_cast<double>(size + layout.count * (sizeof(mesh::Point) + sizeof(float) * numbers)),
       base::counted(layout.count, "splat") + " take",
       "use a computer with more memory, or remove splats in another program", source.name});
  content.reserve(size);
  file.read(size - spz_header_bytes, content);
  file.read(most_bytes_of_extensions, extensions);
  if (content.size() < size || !file.ended())
    throw base::Error(source.name, "the compressed data is damaged or ends early", "export or copy it again");
  SurfaceBuilder builder(source);
  for (std::size_t v = 0; v < layout.count; ++v) {
    mesh::Point p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = axis_signs[i] *
             std::ldexp(fixed_at(content.data() + spz_header_bytes + 9 * v + 3 * i), -layout.fractional_bits);
    builder.position(p);
  }
  if (layout.file_degree > 3) builder.warn("harmonics above degree 3 are kept, but neither drawn nor turned");
  builder.splats(std::make_shared<const mesh::Splats>(unpacked_spz(layout, content.data())));
  ReadResult result = builder.finish("SPZ version " + std::to_string(layout.version));
  if (source.owner)
    result.original = std::make_shared<const SpzOriginal>(source, layout, std::move(content),
                                                          std::move(extensions), result.splats);
  return result;
}

bool looks_like_spz(const Source& source) {
  if (!source.bytes.starts_with("\x1F\x8B")) return false;
  std::string signature;
  Gunzip(source.bytes).read(4, signature);
  return signature == "NGSP";
}

bool is_certainly_spz(const Beginning& file) {
  return looks_like_spz({"", "", file.bytes()});
}

void write_spz(const Content& content, TextWriter& out) {
  double largest = 0;
  for (const mesh::Point& p : content.positions) largest = std::max(largest, mesh::largest_abs(p));
  SpzLayout layout;
  layout.count = content.positions.size();
  layout.file_degree = content.splats->degree;
  layout.fractional_bits = most_fractional_bits;
  while (layout.fractional_bits > 0 && std::ldexp(largest, layout.fractional_bits) > largest_fixed)
    --layout.fractional_bits;
  const std::string name = "SPZ file";
  SpzPacker packer(name, layout, content);
  packer.pack(nullptr);
  write_gzip(packer.take(), out);
}

}  // namespace viete::formats
