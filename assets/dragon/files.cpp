#include "dragon/files.h"

#include <bit>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace viete::dragon {

void append_little_endian(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 255);
}

namespace {

void append(std::string& bytes, const std::vector<Vec3>& positions) {
  for (const Vec3& p : positions) {
    for (double x : {p.x, p.y, p.z})
      append_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
  }
}

}  // namespace

void write_whole(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::path beside = path;
  beside += ".part";
  std::ofstream stream(beside, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw std::runtime_error(beside.string() + ": cannot be written");
  std::filesystem::rename(beside, path);
}

void write_ply(const std::filesystem::path& path, const Mesh& mesh, const std::string& comment) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment " + comment + "\nelement vertex " +
                      std::to_string(mesh.positions.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(mesh.triangles.size()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  append(bytes, mesh.positions);
  for (const auto& corner : mesh.triangles) {
    bytes += '\3';
    for (std::uint32_t v : corner) append_little_endian(bytes, v);
  }
  write_whole(path, bytes);
}

void write_pc2(const std::filesystem::path& path, const std::vector<Vec3>& positions) {
  std::string bytes("POINTCACHE2", 12);
  const auto points = static_cast<std::uint32_t>(positions.size());
  const std::uint32_t zero = std::bit_cast<std::uint32_t>(0.0F), one = std::bit_cast<std::uint32_t>(1.0F);
  for (std::uint32_t word : {1U, points, zero, one, 1U}) append_little_endian(bytes, word);
  append(bytes, positions);
  write_whole(path, bytes);
}

void write_obj(const std::filesystem::path& path, const Mesh& mesh, const std::string& comment) {
  std::string text = "# " + comment + "\n";
  char line[96];
  for (const Vec3& p : mesh.positions) {
    std::snprintf(line, sizeof line, "v %.4f %.4f %.4f\n", p.x, p.y, p.z);
    text += line;
  }
  for (const auto& corner : mesh.triangles) {
    std::snprintf(line, sizeof line, "f %u %u %u\n", corner[0] + 1, corner[1] + 1, corner[2] + 1);
    text += line;
  }
  write_whole(path, text);
}

}  // namespace viete::dragon
