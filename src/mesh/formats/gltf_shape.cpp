#include "mesh/formats/gltf_shape.h"

#include <initializer_list>

#include "base/error.h"

namespace viete::mesh {

namespace {

class GltfShape {
public:
  GltfShape(const std::string& name, const GltfJson& document) : name_(name), document_(document) {}

  void check() const {
    whole_number("", document_, "scene");
    each("", document_, "scenes", "scene ",
         [&](auto& at, auto& scene) { whole_numbers(at, scene, "nodes"); });
    each("", document_, "nodes", "node ", [&](auto& at, auto& node) { check_node(at, node); });
    each("", document_, "meshes", "mesh ", [&](auto& at, auto& mesh) {
      require(at, mesh, "primitives", !member_of(mesh, "primitives").is_null(), "there");
      each(at, mesh, "primitives", ", primitive ", [&](auto& in, auto& p) { check_primitive(in, p); });
    });
    each("", document_, "accessors", "accessor ", [&](auto& at, auto& a) { check_accessor(at, a); });
    each("", document_, "bufferViews", "buffer view ", [&](auto& at, auto& view) {
      for (const char* key : {"buffer", "byteOffset", "byteLength", "byteStride"})
        whole_number(at, view, key);
    });
    for (const char* key :
         {"buffers", "images", "materials", "textures", "samplers", "animations", "skins", "cameras"})
      each("", document_, key, "", [](auto&, auto&) {});
  }

private:
  void check_node(const std::string& at, const GltfJson& node) const {
    whole_number(at, node, "mesh");
    whole_number(at, node, "skin");
    whole_numbers(at, node, "children");
    for (const char* key : {"matrix", "translation", "rotation", "scale"}) {
      for (const GltfJson& value : list(at, node, key, "numbers"))
        require(at, node, key, value.is_number(), "a list of numbers");
    }
  }

  void check_primitive(const std::string& at, const GltfJson& primitive) const {
    accessors(at, primitive, "attributes");
    accessor(at, "indices", member_of(primitive, "indices"));
    whole_number(at, primitive, "material");
    whole_number(at, primitive, "mode");
    each(at, primitive, "targets", ", target ", [&](auto& in, auto& target) {
      for (const auto& [key, value] : target.items()) accessor(in, key, value);
    });
  }

  void check_accessor(const std::string& at, const GltfJson& a) const {
    for (const char* key : {"bufferView", "byteOffset", "componentType", "count"}) whole_number(at, a, key);
    check_view(at, a);
    const GltfJson& sparse = object(at, a, "sparse");
    whole_number(at, sparse, "count");
    for (const char* part : {"indices", "values"}) {
      const GltfJson& json = object(at, sparse, part);
      for (const char* key : {"bufferView", "byteOffset", "componentType"}) whole_number(at, json, key);
      check_view(at, json);
    }
  }

  void check_view(const std::string& at, const GltfJson& of) const {
    const auto view = count_of(of, "bufferView");
    if (view && *view >= list_of(document_, "bufferViews").size())
      fail(at, "refers to buffer view " + std::to_string(*view) + ", which is not there");
  }

  void accessors(const std::string& at, const GltfJson& of, const char* key) const {
    for (const auto& [attribute, value] : object(at, of, key).items()) accessor(at, attribute, value);
  }

  void accessor(const std::string& at, const std::string& key, const GltfJson& value) const {
    if (value.is_null()) return;
    const auto index = count_of(value);
    if (!index) fail(at, "\"" + key + "\" should be the number of an accessor");
    const std::size_t count = list_of(document_, "accessors").size();
    if (*index >= count)
      fail(at, "\"" + key + "\" refers to accessor " + std::to_string(*index) + ", the file has " +
                   std::to_string(count));
  }

  void whole_number(const std::string& at, const GltfJson& of, const char* key) const {
    const GltfJson& value = member_of(of, key);
    require(at, of, key, value.is_null() || count_of(value), "a whole number that is not negative");
  }

  void whole_numbers(const std::string& at, const GltfJson& of, const char* key) const {
    for (const GltfJson& value : list(at, of, key, "whole numbers"))
      require(at, of, key, count_of(value).has_value(), "a list of whole numbers that are not negative");
  }

  const GltfJson& list(const std::string& at, const GltfJson& of, const char* key, const char* what) const {
    require(at, of, key, !has(of, key) || member_of(of, key).is_array(), std::string("a list of ") + what);
    return list_of(of, key);
  }

  const GltfJson& object(const std::string& at, const GltfJson& of, const char* key) const {
    static const GltfJson empty = GltfJson::object();
    require(at, of, key, !has(of, key) || member_of(of, key).is_object(), "an object");
    return has(of, key) ? member_of(of, key) : empty;
  }

  template <class Check>
  void each(const std::string& at, const GltfJson& of, const char* key, const char* element,
            const Check& check) const {
    const GltfJson& entries = list(at, of, key, "objects");
    for (std::size_t i = 0; i < entries.size(); ++i) {
      require(at, of, key, entries[i].is_object(), "a list of objects");
      const std::string place = at + element + std::to_string(i);
      check(place, entries[i]);
    }
  }

  static bool has(const GltfJson& of, const char* key) { return of.is_object() && of.contains(key); }

  void require(const std::string& at, const GltfJson& of, const char* key, bool good,
               const std::string& form) const {
    if (!good || (has(of, key) && member_of(of, key).is_null()))
      fail(at, "\"" + std::string(key) + "\" should be " + form);
  }

  [[noreturn]] void fail(const std::string& at, const std::string& problem) const {
    throw base::Error(at.empty() ? name_ : name_ + ": " + at, problem, "export the model again");
  }

  const std::string& name_;
  const GltfJson& document_;
};

}  // namespace

void check_gltf(const std::string& name, const GltfJson& document) {
  GltfShape(name, document).check();
}

}  // namespace viete::mesh
