#include "dragon/polygonise.h"

#include <unordered_map>

namespace viete::dragon {
namespace {

constexpr int kBlock = 8;          // cells along the edge of a block
constexpr double kSteepest = 1.6;  // the field changes by no more than this per unit of length

class Polygoniser {
public:
  Polygoniser(const Field& field, double spacing);
  Mesh run();

private:
  using Block = std::array<int, 3>;  // counted in blocks along x, y, z
  struct Ball {
    Vec3 center;
    double radius;
  };

  Vec3 place(int i, int j, int k) const { return origin_ + Vec3{i * spacing_, j * spacing_, k * spacing_}; }
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * size_[1] + j) * size_[0] + i;
  }
  Vec3 place(std::size_t at) const;
  Ball ball_about(Block block) const;
  bool may_cross(Block block) const;
  void sample(Block block);
  bool crosses_side(Block block, int axis, int high) const;
  void follow(Block block);
  void cut_block(Block block);
  void cut_tetrahedron(const std::array<std::size_t, 4>& corner);
  std::uint32_t crossing(std::size_t a, std::size_t b);
  void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c, Vec3 outward);

  const Field& field_;
  double spacing_;
  Vec3 origin_;
  std::array<int, 3> size_, blocks_;
  std::vector<float> values_;
  std::vector<char> sampled_;  // blocks
  std::vector<Block> active_;
  std::unordered_map<std::uint64_t, std::uint32_t> crossings_;
  Mesh mesh_;
};

Polygoniser::Polygoniser(const Field& field, double spacing) : field_(field), spacing_(spacing) {
  const Box box = field.box();
  origin_ = box.low - Vec3{2 * spacing, 2 * spacing, 2 * spacing};
  const std::array<double, 3> extent{box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z};
  for (int axis = 0; axis < 3; ++axis) {
    blocks_[axis] = static_cast<int>((extent[axis] / spacing + 4) / kBlock) + 1;
    size_[axis] = blocks_[axis] * kBlock + 1;
  }
  sampled_.assign(static_cast<std::size_t>(blocks_[0]) * blocks_[1] * blocks_[2], 0);
  values_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], 1.0F);
}

Vec3 Polygoniser::place(std::size_t at) const {
  const int i = static_cast<int>(at % size_[0]);
  const int j = static_cast<int>(at / size_[0] % size_[1]);
  return place(i, j, static_cast<int>(at / size_[0] / size_[1]));
}

/// Can the surface pass through the block, judged by the field in its middle?
bool Polygoniser::may_cross(Block block) const {
  const auto [center, reach] = ball_about(block);
  const std::vector<int> parts = field_.near(center, kSteepest * reach);
  return !parts.empty() && std::abs(field_.value(center, parts)) <= kSteepest * reach;
}

Polygoniser::Ball Polygoniser::ball_about(Block block) const {
  const double half = 0.5 * kBlock * spacing_;
  const Vec3 corner = place(block[0] * kBlock, block[1] * kBlock, block[2] * kBlock);
  return {corner + Vec3{half, half, half}, half * 1.7320508075688772};
}

/// Fills the values of a block, once.
void Polygoniser::sample(Block block) {
  char& done = sampled_[(static_cast<std::size_t>(block[2]) * blocks_[1] + block[1]) * blocks_[0] + block[0]];
  if (done) return;
  done = 1;
  active_.push_back(block);
  const auto [center, reach] = ball_about(block);
  const std::vector<int> parts = field_.near(center, kSteepest * reach);
  for (int k = block[2] * kBlock; k <= (block[2] + 1) * kBlock; ++k) {
    for (int j = block[1] * kBlock; j <= (block[1] + 1) * kBlock; ++j) {
      for (int i = block[0] * kBlock; i <= (block[0] + 1) * kBlock; ++i) {
        values_[index(i, j, k)] = static_cast<float>(field_.value(place(i, j, k), parts));
      }
    }
  }
}

/// Does the surface leave the block through the side across an axis, low (0) or high (1)?
bool Polygoniser::crosses_side(Block block, int axis, int high) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Block at = {block[0] * kBlock, block[1] * kBlock, block[2] * kBlock};
  at[axis] += high * kBlock;
  const bool inside = values_[index(at[0], at[1], at[2])] < 0;
  for (int a = 0; a <= kBlock; ++a) {
    for (int b = 0; b <= kBlock; ++b) {
      Block node = at;
      node[u] += a, node[v] += b;
      if ((values_[index(node[0], node[1], node[2])] < 0) != inside) return true;
    }
  }
  return false;
}

/// Follows the surface from a block into the blocks beside it, so that it has no edge where the guess was
/// wrong.
void Polygoniser::follow(Block block) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int high : {0, 1}) {
      Block beside = block;
      beside[axis] += high ? 1 : -1;
      if (beside[axis] < 0 || beside[axis] >= blocks_[axis]) continue;
      if (crosses_side(block, axis, high)) sample(beside);
    }
  }
}

void Polygoniser::cut_block(Block block) {
  static constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  const std::array<std::size_t, 3> stride{1, static_cast<std::size_t>(size_[0]),
                                          static_cast<std::size_t>(size_[0]) * size_[1]};
  for (int k = block[2] * kBlock; k < (block[2] + 1) * kBlock; ++k) {
    for (int j = block[1] * kBlock; j < (block[1] + 1) * kBlock; ++j) {
      for (int i = block[0] * kBlock; i < (block[0] + 1) * kBlock; ++i) {
        for (const auto& order : kOrders) {
          std::array<std::size_t, 4> corner{index(i, j, k), 0, 0, 0};
          for (int step = 0; step < 3; ++step) corner[step + 1] = corner[step] + stride[order[step]];
          cut_tetrahedron(corner);
        }
      }
    }
  }
}

void Polygoniser::cut_tetrahedron(const std::array<std::size_t, 4>& corner) {
  std::array<std::size_t, 4> inside{}, outside{};
  int in = 0, out = 0;
  for (std::size_t c : corner) values_[c] < 0 ? inside[in++] = c : outside[out++] = c;
  if (in == 0 || out == 0) return;
  Vec3 outward;
  for (int i = 0; i < in; ++i) {
    for (int j = 0; j < out; ++j) outward = outward + place(outside[j]) - place(inside[i]);
  }
  // One crossing after the other: their order is the order of the vertices.
  std::array<std::uint32_t, 4> cut{};
  if (in == 2) {
    for (int i = 0; i < 4; ++i) cut[i] = crossing(inside[i / 2], outside[(i + 1) / 2 % 2]);
    emit(cut[0], cut[2], cut[3], outward);
  } else {
    for (int i = 0; i < 3; ++i)
      cut[i] = in == 1 ? crossing(inside[0], outside[i]) : crossing(inside[i], outside[0]);
  }
  emit(cut[0], cut[1], cut[2], outward);
}

std::uint32_t Polygoniser::crossing(std::size_t a, std::size_t b) {
  if (a > b) std::swap(a, b);
  const std::uint64_t key = (static_cast<std::uint64_t>(a) << 32) | (b - a);
  const auto [entry, fresh] = crossings_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
  if (fresh) {
    const double va = values_[a], vb = values_[b];
    mesh_.positions.push_back(lerp(place(a), place(b), std::clamp(va / (va - vb), 0.02, 0.98)));
  }
  return entry->second;
}

void Polygoniser::emit(std::uint32_t a, std::uint32_t b, std::uint32_t c, Vec3 outward) {
  const Vec3 pa = mesh_.positions[a], pb = mesh_.positions[b], pc = mesh_.positions[c];
  if (dot(cross(pb - pa, pc - pa), outward) < 0) std::swap(b, c);
  mesh_.triangles.push_back({a, b, c});
}

Mesh Polygoniser::run() {
  for (int k = 0; k < blocks_[2]; ++k) {
    for (int j = 0; j < blocks_[1]; ++j) {
      for (int i = 0; i < blocks_[0]; ++i) {
        if (may_cross({i, j, k})) sample({i, j, k});
      }
    }
  }
  for (std::size_t i = 0; i < active_.size(); ++i) follow(Block(active_[i]));
  for (const Block& block : active_) cut_block(block);
  return std::move(mesh_);
}

}  // namespace

Mesh polygonise(const Field& field, double spacing) {
  return Polygoniser(field, spacing).run();
}

}  // namespace viete::dragon
