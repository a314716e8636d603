// Any surface as an OBJ file, with what a file said of it besides.
#include "mesh/formats/conversion.h"
#include "mesh/formats/obj.h"
#include "mesh/formats/printed.h"

namespace viete::mesh {

namespace {

class ObjOutput {
public:
  ObjOutput(const Content& content, TextWriter& out)
      : surface_(content.surface), positions_(content.positions), a_(content.attributes), out_(out) {
    all_ = positions_.size() + surface_.polygon_count();
  }

  void vertices() {
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      out_.text("v ");
      print_point(positions_[v], out_);
      if (a_ && !a_->colors.empty()) color(a_->colors[v]);
      out_.text("\n");
      out_.element_done(++done_, all_);
    }
    if (!a_) return;
    for (const Vec2& t : a_->texture_points) {
      out_.text("vt ").number(t[0]).text(" ").number(t[1]).text("\n");
      out_.element_done(done_, all_);
    }
    for (const Vec3& n : a_->normals) {
      out_.text("vn ").point(n).text("\n");
      out_.element_done(done_, all_);
    }
    if (is_flat(*a_)) out_.text("s off\n");
  }

  void faces() {
    for (std::size_t p = 0; p < surface_.polygon_count(); ++p) {
      out_.text("f");
      for (auto c = surface_.polygon_starts[p]; c < surface_.polygon_starts[p + 1]; ++c) corner(c);
      out_.text("\n");
      out_.element_done(++done_, all_);
    }
  }

private:
  void color(const Color& c) {
    const std::size_t channels = c[3] == 1 ? 3 : 4;
    for (std::size_t i = 0; i < channels; ++i) out_.text(" ").number(c[i]);
  }

  void corner(std::size_t c) {
    out_.text(" ").number(std::uint64_t{surface_.corners[c]} + 1);
    const std::uint32_t texture = a_ && !a_->corner_texture.empty() ? a_->corner_texture[c] : none;
    const std::uint32_t normal = a_ && !a_->corner_normal.empty() ? a_->corner_normal[c] : none;
    if (texture == none && normal == none) return;
    out_.text("/");
    if (texture != none) out_.number(std::uint64_t{texture} + 1);
    if (normal != none) out_.text("/").number(std::uint64_t{normal} + 1);
  }

  const Surface& surface_;
  std::span<const Point> positions_;
  const Attributes* a_;
  TextWriter& out_;
  std::size_t done_ = 0, all_ = 0;
};

}  // namespace

void write_obj(const Content& content, TextWriter& out) {
  out.comments("# ", content.comments);
  ObjOutput output(content, out);
  output.vertices();
  output.faces();
}

}  // namespace viete::mesh
