// The fuzzer of all formats. The name of the corpus folder, the first argument, selects the check. The
// functions below are called by libFuzzer if VIETE_LIBFUZZER is set, otherwise by driver.cpp.
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "base/error.h"
#include "formats/materials.h"
#include "formats/obj_file.h"
#include "formats/point_cache.h"
#include "fuzz/checks.h"

namespace {

using namespace viete;
using fuzz::require;

// The result must be materials with valid numbers.
void check_materials(std::string_view bytes) {
  const formats::Source source{"fuzz", "mtl", bytes, nullptr, nullptr, "/folder"};
  const auto materials = formats::read_mtl(source);
  require(materials.size() <= bytes.size());
  for (const auto& m : materials) {
    for (const float x : m.material.base_color) require(x >= 0 && x <= 1);
    for (const formats::MaterialNumber& property : formats::material_numbers)
      require(m.material.*property.number >= 0 && m.material.*property.number <= 1);
    for (const formats::MaterialImage& property : formats::material_images)
      require(m.material.*property.image == mesh::none || m.material.*property.image < m.maps.size());
    for (const auto& map : m.maps) require(map.is_absolute());
  }
}

// The result must be frames of finite numbers or base::Error.
void check_point_cache(std::string_view bytes) {
  const std::size_t size = bytes.size();
  try {
    const formats::PointCache cache("fuzz", std::string(bytes));
    const formats::PointCacheHead& head = cache.head();
    require(head.points > 0 && head.frames > 0);
    require(head.points <= size && head.frames <= size && 12 * head.points * head.frames <= size);
    require(head.seconds.size() == (head.format == formats::PointCacheFormat::mdd ? head.frames : 0));
    require(std::isfinite(head.start) && std::isfinite(head.rate) && head.rate > 0);
    for (const std::size_t i : {std::size_t{0}, head.frames - 1}) {
      const auto points = cache.frame(i);
      require(points.size() == head.points);
      for (const auto& p : points) require(std::isfinite(p[0] + p[1] + p[2]));
    }
  } catch (const base::Error& error) {
    require(!error.place().empty());
    require(std::string(error.what()).find("cannot be read completely") == std::string::npos);
  }
}

using Check = std::function<void(std::string_view)>;

Check reads(fuzz::Reader* reader, std::size_t placed = 0) {
  return [=](std::string_view bytes) { fuzz::check_reader(reader, placed, bytes); };
}

// The corpus has uncompressed contents, because changes of compressed bytes only break the checksum.
void check_spz(std::string_view bytes) {
  fuzz::check_reader(formats::read_spz, 0, bytes);
  std::string packed(bytes.size() + 1024, '\0');
  z_stream stream{};
  require(deflateInit2(&stream, 1, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  require(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  fuzz::check_reader(formats::read_spz, bytes.size(), packed);
}

const std::map<std::string, Check> checks = {{"obj", reads(formats::read_obj)},
                                             {"ply", reads(formats::read_ply)},
                                             {"off", reads(formats::read_off)},
                                             {"stl", reads(formats::read_stl)},
                                             {"spz", check_spz},
                                             {"gltf", reads(formats::read_gltf, 1 << 22)},
                                             {"mtl", check_materials},
                                             {"point_cache", check_point_cache},
                                             {"image", fuzz::check_picture}};

Check check;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  for (int i = 1; i < *count && !check; ++i) {
    const auto found = checks.find(std::filesystem::path((*arguments)[i]).filename().string());
    if (found != checks.end()) check = found->second;
  }
  if (check) return 0;
  std::fprintf(stderr, "usage: %s FOLDER/corpus/FORMAT; the folder's name must be a format\n",
               (*arguments)[0]);
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check({reinterpret_cast<const char*>(data), size});
  return 0;
}
