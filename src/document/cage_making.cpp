#include "document/cage_making.h"

#include <utility>

#include "document/elements.h"
#include "document/pose_edit.h"
#include "formats/format_table.h"

namespace viete::document {

namespace fs = std::filesystem;

constexpr EditStep make_cage{EditKind::cage};

bool shows_generated(const Document& document, const CageMaking& making) {
  return making.made && document.cage() == making.made;
}

bool can_replace_generated(const Document& document, const CageMaking& making) {
  return shows_generated(document, making) && document.history().last_step() == make_cage;
}

void put_generated(Document& document, CageMaking& making, OpenedSurface surface,
                   std::shared_ptr<const pose::Cage> cage, std::vector<std::string> notes) {
  const bool again = shows_generated(document, making);
  record_step(document, "make cage", make_cage, again);
  pose::Pose pose = pose::rest_pose(*cage);
  making.made = cage;
  making.notes = std::move(notes);
  if (!again) making.lost.clear();
  if (const std::string lost = lost_sets(document.groups(), {}); !lost.empty())
    making.lost.push_back("Selection sets of the previous cage were removed: " + lost +
                          "; undo restores them");
  if (const std::string lost = drop_poses(document, *cage); !lost.empty())
    making.lost.push_back("Poses of the previous cage were removed: " + lost + "; undo restores them");
  document.changed_source() = {};
  document.replace_cage(std::move(surface), std::move(cage), std::move(pose));
}

void cancel_making(Document& document, CageMaking& making) {
  while (making.made && document.cage() != making.before && document.history().can_undo()) undo(document);
  making = {.wish = making.wish};
}

fs::path cage_beside(const fs::path& model) {
  const std::string stem = model.stem().string();
  for (const std::string& name : {stem + "_cage", stem + ".cage", stem + "-cage", std::string("cage")})
    for (const formats::Format& format : formats::all_formats()) {
      if (!format.keeps_order) continue;
      const fs::path file = model.parent_path() / (name + "." + std::string(format.extension));
      std::error_code ignored;
      if (file != model && fs::is_regular_file(file, ignored)) return file;
    }
  return {};
}

}  // namespace viete::document
