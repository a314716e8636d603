// Reads foreign files with Assimp, for the program viete-import.
#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/file_bytes.h"
#include "base/picture.h"
#include "base/text.h"
#include "foreign/readers.h"
#include "formats/materials.h"

namespace viete::foreign {

namespace fs = std::filesystem;

namespace {

using Matrix = aiMatrix4x4t<double>;
using Vector = aiVector3t<double>;

// Opens only the file itself, and regular files in its folder and below.
class FolderFiles final : public Assimp::IOSystem {
public:
  explicit FolderFiles(const fs::path& file)
      : file_(fs::weakly_canonical(file)), folder_(base::folder_of(file)) {}

  char getOsSeparator() const override { return files_.getOsSeparator(); }
  bool Exists(const char* file) const override { return is_allowed(file); }
  Assimp::IOStream* Open(const char* file, const char*) override {  // never for writing
    return is_allowed(file) ? files_.Open(file, "rb") : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { files_.Close(stream); }

  bool is_allowed(const fs::path& file) const {
    std::error_code code;
    return base::is_file_below(folder_, file) || fs::weakly_canonical(file, code) == file_;
  }

private:
  fs::path file_, folder_;
  Assimp::DefaultIOSystem files_;  // final since Assimp 6
};

// Numbers keys 0, 1, ... in the order of their first use. Equal keys get the same number.
class Numbering {
public:
  Numbering& add(const aiVector3D& v) {
    const float numbers[] = {v.x + 0.0F, v.y + 0.0F, v.z + 0.0F};  // -0 becomes 0
    key_.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    return *this;
  }
  Numbering& add(std::uint32_t index) {
    key_.append(reinterpret_cast<const char*>(&index), sizeof index);
    return *this;
  }
  // Returns the number of the added parts, and true if the key is new.
  std::pair<std::uint32_t, bool> number() {
    const auto [at, is_new] = numbers_.emplace(std::move(key_), static_cast<std::uint32_t>(numbers_.size()));
    key_.clear();
    return {at->second, is_new};
  }

private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::string key_;
};

template <class T>
bool is_finite(const aiVector3t<T>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The matrix of cofactors maps normals, even if the matrix is singular. If it mirrors, faces are turned over,
// and normals stay on the outside.
Vector mapped_normal(const Matrix& m, const Vector& n) {
  const Vector x(m.a1, m.b1, m.c1), y(m.a2, m.b2, m.c2), z(m.a3, m.b3, m.c3);
  return ((y ^ z) * n.x + (z ^ x) * n.y + (x ^ y) * n.z) * (m.Determinant() < 0 ? -1.0 : 1.0);
}

float in_range(float x) {
  return x > 0 ? std::min(x, 1.0F) : 0;  // NaN becomes 0
}

formats::Color color_of(const aiColor4D& c) {
  return {in_range(c.r), in_range(c.g), in_range(c.b), in_range(c.a)};
}

// Converts materials and their textures, each when a mesh uses it.
class MaterialReader {
public:
  MaterialReader(const aiScene& scene, const fs::path& file, const FolderFiles& files,
                 formats::Attributes& attributes)
      : scene_(scene),
        folder_(base::folder_of(file)),
        like_blender_(base::extension_of(file) == "fbx" || base::extension_of(file) == "blend"),
        files_(files),
        attributes_(attributes) {}

  // Returns an index into Attributes::materials, or mesh::none. Assimp adds a material to meshes without one.
  std::uint32_t use(unsigned index) {
    if (index >= scene_.mNumMaterials) return mesh::none;
    if (scene_.mMaterials[index]->GetName() == aiString(AI_DEFAULT_MATERIAL_NAME)) return mesh::none;
    const auto [at, is_new] = used_.emplace(index, static_cast<std::uint32_t>(attributes_.materials.size()));
    if (is_new) attributes_.materials.push_back(material_of(*scene_.mMaterials[index]));
    return at->second;
  }

  std::vector<std::string> missing_images() const { return {missing_.begin(), missing_.end()}; }

private:
  // Formats name the same properties differently. The first one that is found counts.
  formats::Material material_of(const aiMaterial& from) {
    using formats::Material;
    Material material;
    aiString name;
    if (from.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) material.name = name.C_Str();
    take_image(from, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}, material,
               &Material::base_color_image);
    take_image(from, {aiTextureType_METALNESS}, material, &Material::metallic_image);
    take_image(from, {aiTextureType_DIFFUSE_ROUGHNESS}, material, &Material::roughness_image);
    if (like_blender_) take_image(from, {aiTextureType_SHININESS}, material, &Material::roughness_image);
    take_image(from, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA}, material, &Material::normal_image);
    take_image(from, {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE}, material,
               &Material::emission_image);
    take_numbers(from, material);
    take_colors(from, material);
    return material;
  }

  void take_image(const aiMaterial& from, std::initializer_list<aiTextureType> types,
                  formats::Material& material, std::uint32_t formats::Material::*image) {
    for (const aiTextureType type : types) {
      aiString file;
      aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
      if (material.*image != mesh::none ||
          from.GetTexture(type, 0, &file, nullptr, nullptr, nullptr, nullptr, modes) != AI_SUCCESS)
        continue;
      material.*image = image_of(file.C_Str());
      if (image == &formats::Material::base_color_image)
        material.repeats = modes[0] != aiTextureMapMode_Clamp;
    }
  }

  void take_numbers(const aiMaterial& from, formats::Material& material) const {
    float exponent = 0;
    if (from.Get(AI_MATKEY_SHININESS, exponent) == AI_SUCCESS && exponent > 0)
      material.roughness = 1 - std::sqrt(exponent) / 10;
    if (like_blender_) (void)from.Get(AI_MATKEY_REFLECTIVITY, material.metallic);
    (void)from.Get(AI_MATKEY_METALLIC_FACTOR, material.metallic);
    (void)from.Get(AI_MATKEY_ROUGHNESS_FACTOR, material.roughness);
    // A texture replaces the number.
    if (material.metallic_image != mesh::none) material.metallic = 1;
    if (material.roughness_image != mesh::none) material.roughness = 1;
    material.metallic = in_range(material.metallic);
    material.roughness = in_range(material.roughness);
  }

  // A texture replaces the colour: many programs leave an unused colour in the file.
  void take_colors(const aiMaterial& from, formats::Material& material) const {
    aiColor4D color(1, 1, 1, 1);
    const bool is_colored = material.base_color_image != mesh::none ||
                            from.Get(AI_MATKEY_BASE_COLOR, color) == AI_SUCCESS ||
                            from.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS;
    float opacity = 1;
    if (from.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS && opacity > 0) color.a = opacity;
    aiString opacities, colors;
    material.is_translucent = from.GetTexture(aiTextureType_OPACITY, 0, &opacities) == AI_SUCCESS &&
                              from.GetTexture(aiTextureType_DIFFUSE, 0, &colors) == AI_SUCCESS &&
                              opacities == colors;
    if (is_colored) material.base_color = file_color(color);
    aiColor4D light(0, 0, 0, 1);
    if (material.emission_image != mesh::none)
      light = {1, 1, 1, 1};
    else
      (void)from.Get(AI_MATKEY_COLOR_EMISSIVE, light);
    material.emission = file_color(light);
  }

  formats::Color file_color(const aiColor4D& from) const {
    formats::Color color = color_of(from);
    for (std::size_t k = 0; like_blender_ && k < 3; ++k) color[k] = formats::srgb_of_linear(color[k]);
    return color;
  }

  std::uint32_t image_of(const std::string& name) {
    const auto next = static_cast<std::uint32_t>(attributes_.images.size());
    const auto [at, is_new] = images_.emplace(name, next);
    if (!is_new) return at->second;
    if (auto image = find_image(name)) {
      attributes_.images.push_back(*std::move(image));
    } else {
      missing_.insert(name);
      at->second = mesh::none;
    }
    return at->second;
  }

  // Paths in files are often absolute, from another computer.
  std::optional<formats::ImageFile> find_image(const std::string& name) const {
    if (const aiTexture* texture = scene_.GetEmbeddedTexture(name.c_str())) return embedded(*texture, name);
    const fs::path path = base::path_beside(folder_, name);
    for (const fs::path& candidate :
         {path, folder_ / path.filename(), folder_ / "textures" / path.filename()})
      if (files_.is_allowed(candidate))
        return formats::ImageFile{candidate, nullptr, path.filename().string()};
    return std::nullopt;
  }

  static formats::ImageFile embedded(const aiTexture& texture, const std::string& name) {
    std::string bytes;
    if (texture.mHeight == 0) {  // an encoded image of mWidth bytes
      bytes.assign(reinterpret_cast<const char*>(texture.pcData), texture.mWidth);
    } else {
      base::Picture picture{static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), {}};
      const std::span texels(texture.pcData, std::size_t{texture.mWidth} * texture.mHeight);
      for (const aiTexel& t : texels) picture.rgba.insert(picture.rgba.end(), {t.r, t.g, t.b, t.a});
      bytes = base::encode_png(name, picture);
    }
    const std::string shown = texture.mFilename.length > 0 ? texture.mFilename.C_Str() : name;
    return {{},
            std::make_shared<const std::string>(std::move(bytes)),
            base::path_beside({}, shown).filename().string()};
  }

  const aiScene& scene_;
  fs::path folder_;
  bool like_blender_;  // true for formats whose colours and numbers are written like in Blender 3.4
  const FolderFiles& files_;
  formats::Attributes& attributes_;
  std::map<unsigned, std::uint32_t> used_;
  std::map<std::string, std::uint32_t> images_;
  std::set<std::string> missing_;
};

std::string name_of_target(const aiMesh& mesh, unsigned target) {
  std::string name = mesh.mAnimMeshes[target]->mName.C_Str();
  // Assimp 5.4 joins the names of an FBX channel and of its shape, which are usually equal.
  if (const std::size_t half = name.size() / 2; name == name.substr(0, half) + "." + name.substr(0, half))
    name.resize(half);
  return name.empty() ? "target " + std::to_string(target + 1) : name;
}

// Converts the meshes of all nodes to one scene.
class SceneReader {
public:
  SceneReader(const aiScene& from, const fs::path& file, const FolderFiles& files)
      : from_(from), materials_(from, file, files, scene_.attributes) {
    scene_.polygon_starts.push_back(0);
  }

  void add(const aiNode& node, const Matrix& parent) {
    const Matrix map = parent * Matrix(node.mTransformation);
    if (node.mNumMeshes > 0) add_meshes(node, map);
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], map);
  }

  void note(std::string text) { scene_.notes.push_back(std::move(text)); }

  Scene finish() {
    finish_attributes();
    finish_notes();
    return std::move(scene_);
  }

private:
  const aiMesh& mesh_at(unsigned index) const {
    if (index >= from_.mNumMeshes) throw std::runtime_error("a node refers to a missing mesh");
    return *from_.mMeshes[index];
  }

  // The meshes of a node are the parts of one object with different materials. Assimp splits vertices at
  // seams. Vertices of a node with equal positions, also in all targets, become one vertex.
  void add_meshes(const aiNode& node, const Matrix& map) {
    const std::span indices(node.mMeshes, node.mNumMeshes);
    for (const unsigned index : indices) add_targets(mesh_at(index));
    vertices_ = normals_ = texture_points_ = {};
    first_vertex_ = scene_.positions.size();
    first_normal_ = scene_.attributes.normals.size();
    first_texture_point_ = scene_.attributes.texture_points.size();
    for (const unsigned index : indices) {
      const aiMesh& mesh = mesh_at(index);
      add_group(node, mesh);
      add_vertices(mesh, map);
      add_polygons(mesh, map);
    }
    if (scene_.positions.size() >= mesh::none || scene_.corners.size() >= mesh::none)
      throw std::runtime_error("it has more than 4294967294 vertices or corners");
  }

  // Targets of several objects with the same name become one target.
  void add_targets(const aiMesh& mesh) {
    for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t)
      if (index_of_target(name_of_target(mesh, t)) == scene_.targets.size())
        scene_.targets.push_back({name_of_target(mesh, t), scene_.positions});
  }
  std::size_t index_of_target(const std::string& name) const {
    const auto found = std::ranges::find(scene_.targets, name, &Target::name);
    return static_cast<std::size_t>(found - scene_.targets.begin());
  }

  // Returns for each target the vertices of the mesh at full weight.
  std::vector<const aiVector3D*> vertices_of_targets(const aiMesh& mesh) const {
    std::vector<const aiVector3D*> vertices(scene_.targets.size(), mesh.mVertices);
    for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t) {
      const aiAnimMesh& from = *mesh.mAnimMeshes[t];
      if (from.mVertices && from.mNumVertices == mesh.mNumVertices)
        vertices[index_of_target(name_of_target(mesh, t))] = from.mVertices;
    }
    return vertices;
  }

  void add_group(const aiNode& node, const aiMesh& mesh) {
    const std::uint32_t material = materials_.use(mesh.mMaterialIndex);
    const auto first_polygon = static_cast<std::uint32_t>(scene_.polygon_starts.size() - 1);
    std::string object = node.mName.C_Str(), name = mesh.mName.C_Str();
    if (name == object) name.clear();
    scene_.attributes.groups.push_back({first_polygon, std::move(object), std::move(name), material});
  }

  void add_vertices(const aiMesh& mesh, const Matrix& map) {
    const auto targets = vertices_of_targets(mesh);
    const aiColor4D* const colors = mesh.mColors[0];
    const auto& known = scene_.attributes.colors;
    of_mesh_.clear();
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      vertices_.add(mesh.mVertices[v]);
      for (const aiVector3D* target : targets) vertices_.add(target[v]);
      const auto [index, is_new] = vertices_.number();
      of_mesh_.push_back(static_cast<std::uint32_t>(first_vertex_ + index));
      if (is_new)
        add_vertex(mesh, v, map, targets);
      else
        colors_lost_ += colors && known[of_mesh_.back()] != color_of(colors[v]);
    }
  }

  void add_vertex(const aiMesh& mesh, unsigned v, const Matrix& map,
                  const std::vector<const aiVector3D*>& targets) {
    const auto place = [&](const aiVector3D& p) {
      const Vector mapped = map * Vector(p);
      if (!is_finite(mapped))
        throw std::runtime_error("a vertex of " + std::string(mesh.mName.C_Str()) +
                                 " has no finite position");
      return mesh::Point{mapped.x, mapped.y, mapped.z};
    };
    scene_.positions.push_back(place(mesh.mVertices[v]));
    for (std::size_t t = 0; t < targets.size(); ++t)
      scene_.targets[t].positions.push_back(place(targets[t][v]));
    const bool colored = mesh.mColors[0];
    has_colors_ = has_colors_ || colored;
    scene_.attributes.colors.push_back(colored ? color_of(mesh.mColors[0][v]) : formats::Color{1, 1, 1, 1});
  }

  void add_polygons(const aiMesh& mesh, const Matrix& map) {
    formats::Attributes& a = scene_.attributes;
    const bool mirrors = map.Determinant() < 0;
    const auto texture_points = add_texture_points(mesh), normals = add_normals(mesh, map);
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
      lines_ += face.mNumIndices < 3;
      if (face.mNumIndices < 3) continue;
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        const unsigned v = face.mIndices[mirrors ? face.mNumIndices - 1 - i : i];
        if (v >= mesh.mNumVertices) throw std::runtime_error("a face refers to a missing vertex");
        scene_.corners.push_back(of_mesh_[v]);
        a.corner_texture.push_back(texture_points[v]);
        a.corner_normal.push_back(normals[v]);
      }
      scene_.polygon_starts.push_back(static_cast<std::uint32_t>(scene_.corners.size()));
    }
  }

  // Returns the texture point of each vertex of the mesh, or mesh::none.
  std::vector<std::uint32_t> add_texture_points(const aiMesh& mesh) {
    std::vector<std::uint32_t> indices(mesh.mNumVertices, mesh::none);
    const aiVector3D* const points = mesh.mTextureCoords[0];
    for (unsigned v = 0; points && v < mesh.mNumVertices; ++v) {
      if (!is_finite(points[v])) continue;
      const auto [index, is_new] = texture_points_.add({points[v].x, points[v].y, 0}).number();
      indices[v] = static_cast<std::uint32_t>(first_texture_point_ + index);
      if (is_new)
        scene_.attributes.texture_points.push_back(
            {static_cast<double>(points[v].x), static_cast<double>(points[v].y)});
    }
    return indices;
  }

  // Returns the normal of each vertex of the mesh, or mesh::none.
  std::vector<std::uint32_t> add_normals(const aiMesh& mesh, const Matrix& map) {
    std::vector<std::uint32_t> indices(mesh.mNumVertices, mesh::none);
    for (unsigned v = 0; mesh.mNormals && v < mesh.mNumVertices; ++v) {
      Vector n = mapped_normal(map, Vector(mesh.mNormals[v]));
      n.NormalizeSafe();
      if (!is_finite(n) || n.SquareLength() == 0) continue;
      const auto [index, is_new] = normals_.add(of_mesh_[v]).add(mesh.mNormals[v]).number();
      indices[v] = static_cast<std::uint32_t>(first_normal_ + index);
      if (is_new) scene_.attributes.normals.push_back({n.x, n.y, n.z});
    }
    return indices;
  }

  void finish_attributes() {
    formats::Attributes& a = scene_.attributes;
    if (!has_colors_) a.colors.clear();
    if (a.texture_points.empty()) a.corner_texture.clear();
    if (a.normals.empty()) a.corner_normal.clear();
    // Removes groups without polygons.
    std::vector<formats::Group> groups;
    for (std::size_t i = 0; i < a.groups.size(); ++i) {
      const std::size_t end =
          i + 1 < a.groups.size() ? a.groups[i + 1].first_polygon : scene_.polygon_starts.size() - 1;
      if (a.groups[i].first_polygon < end) groups.push_back(std::move(a.groups[i]));
    }
    a.groups = std::move(groups);
  }

  void finish_notes() {
    const std::span meshes(from_.mMeshes, from_.mNumMeshes);
    if (from_.HasAnimations()) scene_.ignored.emplace_back("animations");
    if (std::ranges::any_of(meshes, &aiMesh::HasBones)) scene_.ignored.emplace_back("skins");
    if (!scene_.ignored.empty()) note("ignored " + base::listed(scene_.ignored, " and "));
    if (!scene_.targets.empty())
      note(base::counted(scene_.targets.size(), "morph target") +
           " can be imported as shapes from this file");
    if (lines_ > 0) note("ignored " + base::counted(lines_, "face") + " with fewer than three corners");
    if (colors_lost_ > 0) note("vertices with several colours keep the first colour");
    if (const auto missing = materials_.missing_images(); !missing.empty())
      note("textures not found in the folder of the file: " + base::joined(missing, ", ", 8));
  }

  const aiScene& from_;
  Scene scene_;
  MaterialReader materials_;
  bool has_colors_ = false;
  std::size_t lines_ = 0, colors_lost_ = 0;
  // The node that is being converted: the vertices, normals and texture points of its meshes.
  Numbering vertices_, normals_, texture_points_;
  std::size_t first_vertex_ = 0, first_normal_ = 0, first_texture_point_ = 0;
  std::vector<std::uint32_t> of_mesh_;  // for each vertex of the current mesh, a vertex of the scene
};

// Assimp 5.2 only reports the axes and the unit of an FBX file, and ignores that Blender's z axis is up.
// Returns the map to metres with y up. Sets `note` if this changes the model.
Matrix to_metres_with_y_up(const aiScene& from, const std::string& extension, std::string& note) {
  int axes[3] = {0, 1, 2}, signs[3] = {1, 1, 1};  // the axes to the right, up and to the front
  bool known = true;
  float centimetres = 100;
  if (extension == "blend") {
    axes[1] = 2;
    axes[2] = 1;
    signs[2] = -1;
  } else if (from.mMetaData && from.mMetaData->Get("UnitScaleFactor", centimetres)) {
    from.mRootNode->mTransformation = aiMatrix4x4();  // Assimp 5.4 turns the root, even to impossible axes
    constexpr const char* names[3] = {"CoordAxis", "UpAxis", "FrontAxis"};
    for (int row = 0; row < 3; ++row)
      known = known && from.mMetaData->Get(names[row], axes[row]) && axes[row] >= 0 && axes[row] < 3 &&
              from.mMetaData->Get(std::string(names[row]) + "Sign", signs[row]);
  }
  Matrix turn(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1), scale;
  for (int row = 0; known && row < 3; ++row) turn[row][axes[row]] = signs[row];
  if (turn.Determinant() != 1) turn = Matrix();
  if (turn != Matrix()) note = "turned so that y is up";
  const auto unit = static_cast<double>(centimetres);
  if (!(unit > 0) || !std::isfinite(unit) || unit == 100) return turn;
  note += base::formatted("%sconverted from units of %g cm to metres", note.empty() ? "" : ", ", unit);
  return Matrix::Scaling(Vector(0.01 * unit), scale) * turn;
}

}  // namespace

Scene scene_by_assimp(const fs::path& file) {
  Assimp::Importer importer;
  auto* const files = new FolderFiles(file);  // the importer owns this object
  importer.SetIOHandler(files);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const std::string extension = base::extension_of(file);
  if (!importer.IsExtensionSupported("." + extension))
    throw std::runtime_error("this version of Assimp has no reader for ." + extension);
  const aiScene* const from = importer.ReadFile(file.string(), 0);
  if (!from || !from->mRootNode) throw std::runtime_error(importer.GetErrorString());
  std::fputs("60 %\n", stderr);
  SceneReader reader(*from, file, *files);
  std::string note;
  reader.add(*from->mRootNode, to_metres_with_y_up(*from, extension, note));
  if (!note.empty()) reader.note(std::move(note));
  return reader.finish();
}

}  // namespace viete::foreign
