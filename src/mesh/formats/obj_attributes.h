// Collects what an OBJ file says besides vertices and faces.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/obj_words.h"
#include "mesh/formats/surface_builder.h"
#include "mesh/formats/text_cursor.h"

namespace viete::mesh {

/// What cannot be read here is told as a warning and taken as if it were not there: it never makes a file
/// unreadable.
class ObjAttributes {
public:
  explicit ObjAttributes(const Source& source) : source_(source) {}

  /// What stands behind x y z: a weight, a colour, or nothing.
  void behind_position(TextCursor& text, std::size_t vertex);
  std::size_t normal_count() const { return found_.normals.size(); }
  void texture_point(TextCursor& text);
  void normal(TextCursor& text);

  /// Behind the vertex index of a corner that the builder is about to be given as its number `corner`.
  void corner(std::size_t corner, std::string_view behind_vertex);
  /// Behind the builder's end_polygon().
  void end_polygon(const Surface& surface);

  void object(std::string_view name);
  void group(std::string_view name);
  void smoothing(std::string_view value);
  void use_material(std::string_view name);
  void library(std::string_view names);

  /// Null where the file has nothing of all this. Reads the material libraries.
  std::shared_ptr<const Attributes> finish(SurfaceBuilder& builder);

private:
  void put(std::vector<std::uint32_t>& indices, std::size_t corner, std::int64_t index, std::size_t count);
  void check(std::vector<std::uint32_t>& indices, std::size_t count);
  void finish_colors(std::size_t vertices);
  void finish_groups();
  void tell_bad(SurfaceBuilder& builder) const;

  const Source& source_;
  Attributes found_;
  Group state_;  // of the faces that follow
  bool changed_ = true;
  std::size_t polygons_ = 0;
  std::size_t bad_indices_ = 0, bad_numbers_ = 0, groups_left_out_ = 0;
  std::map<std::string, std::uint32_t, std::less<>> materials_;
  std::vector<std::string> libraries_;
};

}  // namespace viete::mesh
