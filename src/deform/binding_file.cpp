#include "deform/binding_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/checksum.h"
#include "mesh/content_key.h"

namespace viete::deform {

namespace fs = std::filesystem;

namespace {

constexpr std::array<char, 16> format = {"viete binding\n"};
// Another one whenever the same model and cage give other weights, or other files.
constexpr std::uint32_t current_version = 4;
constexpr std::uint32_t byte_order = 0x01020304;

struct Header {
  std::array<char, 16> words = format;
  std::uint32_t order_of_bytes = byte_order, version = current_version;
  std::uint64_t model = 0, cage = 0, order = 0;  // checksums
  std::uint16_t elements = 0, weights = 0;
  std::uint32_t storage = 0;
  std::uint64_t failed = 0;
  double radius = 0, tolerance = 0;
  std::uint32_t since_03 = 0;  // not Weighting::as_before
  std::uint32_t shared = 0;
  std::uint64_t content = 0, itself = 0;  // checksums of what follows, and of what stands before
};
static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) == 104);

template <class Choice>
std::uint16_t number(Choice choice) {
  return static_cast<std::uint16_t>(choice);
}

void put_numbers(const Weighting& weighting, Header& header) {
  header.elements = number(weighting.elements);
  header.weights = number(weighting.weights);
  header.radius = weighting.used_radius();
  header.since_03 = weighting.changed_in_03() && !weighting.as_before;
}

template <class T>
std::uint64_t checksum(const std::vector<T>& values) {
  base::Checksum sum;
  sum.add(values.data(), values.size() * sizeof(T));
  return sum.value();
}

std::uint64_t checksum(const Header& header) {
  base::Checksum sum;
  sum.add(&header, offsetof(Header, itself));
  return sum.value();
}

// In the order of the file.
template <class Binding>
auto floats(Binding& b) {
  return std::array{std::span(b.offsets), std::span(b.shares), std::span(b.weights), std::span(b.factors),
                    std::span(b.skeleton)};
}

std::vector<std::uint32_t> ranks_of(const TiledBinding& b) {
  std::vector<std::uint32_t> ranks;
  for (const auto& f : b.factored) ranks.push_back(f.dense ? 0 : f.rank);
  for (std::size_t leaf = 0; b.has_lists() && leaf < b.leaves.count(); ++leaf)
    ranks.push_back(static_cast<std::uint32_t>(b.list(leaf).size()));
  return ranks;
}

std::uint64_t checksum(const TiledBinding& b, const std::vector<std::uint32_t>& ranks) {
  base::Checksum sum;
  sum.add(ranks.data(), ranks.size() * sizeof ranks[0]);
  sum.add(b.listed.data(), b.listed.size() * sizeof b.listed[0]);
  for (const auto part : floats(b)) sum.add(part.data(), part.size_bytes());
  sum.add(b.sample.data(), b.sample.size() * sizeof b.sample[0]);
  return sum.value();
}

class Reader {
public:
  Reader(const fs::path& file, base::Progress* progress) : file_(file), progress_(progress) {
    std::error_code code;
    if (!fs::is_regular_file(file, code)) fail("there is no such file", "check the path");
    left_ = size_ = fs::file_size(file, code);
    in_.open(file, std::ios::binary);
    if (code || !in_) fail("cannot be opened", "check its permissions");
  }

  Header header() {
    Header h{};
    if (left_ < sizeof h) fail("this is no saved binding");
    read(&h, sizeof h);
    if (h.words != format) fail("this is no saved binding");
    if (h.order_of_bytes != byte_order) fail("was saved on a machine with another order of bytes");
    if (h.version != current_version) {
      fail("is of version " + std::to_string(h.version) + ", this program reads version " +
           std::to_string(current_version));
    }
    if (h.itself != checksum(h)) fail("is damaged");
    return h;
  }

  void read(void* to, std::size_t bytes) {
    constexpr std::size_t portion = 4 << 20;
    for (std::size_t done = 0; done < bytes; done += portion) {
      const std::size_t count = std::min(portion, bytes - done);
      if (!in_.read(static_cast<char*>(to) + done, static_cast<std::streamsize>(count)))
        fail("cannot be read to its end");
      left_ -= count;
      if (progress_) progress_->report(static_cast<double>(size_ - left_) / static_cast<double>(size_));
    }
  }

  // What a header says is not believed before the bytes are there.
  void expect(std::uintmax_t bytes) const {
    if (left_ == bytes) return;
    fail("is " + std::string(left_ < bytes ? "cut short" : "too long") + ": " + std::to_string(left_) +
         " bytes where " + std::to_string(bytes) + " belong");
  }
  std::uintmax_t left() const { return left_; }

  [[noreturn]] void fail(const std::string& problem,
                         const std::string& advice = "save it anew with viete bind") const {
    throw base::Error(file_.string(), problem, advice);
  }
  [[noreturn]] void stale(const std::string& why) const {
    throw StaleBinding(file_.string(), "is stale: " + why, "save it anew with viete bind");
  }

private:
  fs::path file_;
  base::Progress* progress_;
  std::ifstream in_;
  std::uintmax_t size_ = 0, left_ = 0;
};

void require_same(const Reader& reader, const Header& h, const mesh::Surface& model, const Cage& cage,
                  const Weighting& weighting) {
  const bool other_model = h.model != mesh::content_key(model),
             other_cage = h.cage != mesh::content_key(cage.surface);
  if (other_model && other_cage) reader.stale("model and cage are not those that it was made for");
  if (other_model) reader.stale("the model is not the one that it was made for");
  if (other_cage) reader.stale("the cage is not the one that it was made for");
  if (h.elements != number(weighting.elements) || h.weights != number(weighting.weights)) {
    reader.stale("it is not for elements " + std::string(name(weighting.elements)) + " with weights " +
                 std::string(entry(weighting.weights).name));
  }
  Header wanted = h;
  put_numbers(weighting, wanted);
  if (h.radius != wanted.radius) {
    reader.stale("it is for radius " + text_of_percent(h.radius) + ", not " +
                 text_of_percent(weighting.radius));
  }
  const auto with = [](bool yes, const char* what) {
    return std::string("its weights are ") + (yes ? "" : "not ") + what;
  };
  if (h.since_03 != wanted.since_03) reader.stale(with(!h.since_03, "those of before version 0.3"));
}

void set_ranks(const Reader& reader, const std::vector<std::uint32_t>& ranks, TiledBinding& b) {
  const auto handles = static_cast<std::uint32_t>(b.handles);
  for (const auto rank : ranks) {
    if (rank > handles) reader.fail("is damaged");
    b.factored.push_back({.rank = rank ? rank : handles, .dense = rank == 0});
  }
}

// Handles of each list ascend: what they index is there.
void read_lists(Reader& reader, const std::vector<std::uint32_t>& lengths, TiledBinding& b) {
  b.list_starts = {0};
  for (const auto length : lengths) {
    if (length > b.handles) reader.fail("is damaged");
    b.list_starts.push_back(b.list_starts.back() + length);
  }
  const std::size_t count = b.list_starts.back();
  if (reader.left() < count * sizeof b.listed[0]) reader.fail("is cut short");
  b.listed.resize(count);
  reader.read(b.listed.data(), count * sizeof b.listed[0]);
  for (std::size_t leaf = 0; leaf < lengths.size(); ++leaf) {
    const auto list = b.list(leaf);
    const bool ascending = std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
    if (!ascending || (!list.empty() && list.back() >= b.handles)) reader.fail("is damaged");
  }
}

// For weights or factors, once the file is as long as they are.
void make_room(const Reader& reader, TiledBinding& b) {
  const std::size_t weights = b.compressed()  ? 0
                              : b.has_lists() ? b.listed_weights()
                                              : b.leaves.slot_count() * b.handles;
  const auto [factors, skeleton] = b.lay_out_factors();
  if (entry(b.weighting.weights).on_surface)
    b.sample.resize(spread_vertices(b.leaves.vertices, error_sample).size() * b.handles);
  reader.expect(sizeof(float) * (b.offsets.size() + b.shares.size() + weights + factors + skeleton) +
                sizeof(double) * b.sample.size());
  base::require_memory(binding_memory(static_cast<double>(reader.left()), b.leaves.vertices, b.handles));
  b.weights.resize(weights);
  b.factors.resize(factors);
  b.skeleton.resize(skeleton);
}

}  // namespace

std::uint64_t binding_key(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
                          double tolerance) {
  Header key{
      .model = mesh::content_key(model), .cage = mesh::content_key(cage.surface), .tolerance = tolerance};
  put_numbers(weighting, key);
  return checksum(key);
}

void write_binding(const fs::path& file, const TiledBinding& b, const mesh::Surface& model, const Cage& cage,
                   base::Durability durability) {
  const auto ranks = ranks_of(b);
  Header h{.model = mesh::content_key(model),
           .cage = mesh::content_key(cage.surface),
           .order = checksum(b.leaves.order),
           .storage = static_cast<std::uint32_t>(b.storage()),
           .failed = b.failed,
           .tolerance = b.tolerance,
           .content = checksum(b, ranks)};
  put_numbers(b.weighting, h);
  h.shared = !b.shares.empty();
  h.itself = checksum(h);
  const auto bytes = [](const void* data, std::size_t size) {
    return std::string_view(static_cast<const char*>(data), size);
  };
  std::vector<std::string_view> parts = {bytes(&h, sizeof h),
                                         bytes(ranks.data(), ranks.size() * sizeof ranks[0])};
  parts.push_back(bytes(b.listed.data(), b.listed.size() * sizeof b.listed[0]));
  for (const auto part : floats(b)) parts.push_back(bytes(part.data(), part.size_bytes()));
  parts.push_back(bytes(b.sample.data(), b.sample.size() * sizeof b.sample[0]));
  base::replace_file(file, parts, durability);
}

bool is_binding(std::string_view beginning) {
  return beginning.starts_with(std::string_view(format.data(), format.size()));
}

TiledBinding read_binding(const fs::path& file, const mesh::Surface& model, const Cage& cage,
                          const Weighting& weighting, base::Progress* progress) {
  Reader reader(file, progress);
  const Header h = reader.header();
  require_same(reader, h, model, cage, weighting);
  TiledBinding b = lay_out(model, cage, weighting);
  if (h.order != checksum(b.leaves.order)) reader.stale("this program orders the vertices in another way");
  const auto storage = static_cast<Storage>(h.storage);
  std::vector<std::uint32_t> ranks(storage == Storage::dense ? 0 : b.leaves.count());
  if (reader.left() < ranks.size() * sizeof ranks[0]) reader.fail("is cut short");
  reader.read(ranks.data(), ranks.size() * sizeof ranks[0]);
  if (storage == Storage::factors) set_ranks(reader, ranks, b);
  if (storage == Storage::lists) read_lists(reader, ranks, b);
  if (!h.shared) b.shares.clear();
  make_room(reader, b);
  for (const auto part : floats(b)) reader.read(part.data(), part.size_bytes());
  reader.read(b.sample.data(), b.sample.size() * sizeof b.sample[0]);
  if (h.content != checksum(b, ranks)) reader.fail("is damaged");
  b.failed = h.failed;
  b.tolerance = h.tolerance;
  return b;
}

}  // namespace viete::deform
