// What each defect means for the deformation, in words.
#include "scene/document/checks.h"

namespace viete::scene {

namespace {

const char* cage_meaning(Defect defect) {
  switch (defect) {
    case Defect::self_intersection:
      return "The cage cuts through itself: near there the mesh follows both sheets at once, however far "
             "apart they "
             "are along the cage.";
    case Defect::open:
      return "The cage does not close here. Faces in log space need no closed cage; with mean value "
             "coordinates the "
             "mesh does not follow turns and stretches exactly.";
    case Defect::nonmanifold_edge:
      return "Every face acts as usual; where they turn far against each other it is open which one the mesh "
             "follows.";
    case Defect::pinched_vertex:
      return "Parts of the cage meet in this vertex alone: dragging it pulls all of them.";
    case Defect::misoriented:
      return "Some faces point outwards and some inwards. Faces in log space do not mind; mean value "
             "coordinates "
             "come out wrong: turn the faces one way.";
    case Defect::inside_out:
      return "The faces point inwards. Neither kind of coordinates minds; other programs may.";
    case Defect::degenerate:
      return "A part of the face without area has no influence; the faces around act in its place.";
    case Defect::thin:
      return "So thin that a small drag of a corner turns or stretches it far, and the mesh near it too.";
    case Defect::doubled_vertex:
      return "Two vertices at one place that are not joined: select both before dragging, or the cage tears.";
    case Defect::unused_vertex: return "Without a face a vertex pulls nothing when it is dragged.";
    case Defect::vertices_outside: break;
  }
  return "";
}

const char* model_meaning(Defect defect) {
  switch (defect) {
    case Defect::vertices_outside:
      return "Outside, the mesh follows the nearest faces in log space just as inside; mean value weights "
             "can be negative there and move it against the drag.";
    case Defect::open: return "The mesh has holes. It deforms like any other.";
    case Defect::nonmanifold_edge: return "It deforms like any other; shading may be uneven there.";
    case Defect::pinched_vertex: return "It deforms like any other; shading may be uneven there.";
    case Defect::misoriented:
      return "Faces disagree on what is outside: shading breaks there, the deformation does not.";
    case Defect::inside_out:
      return "The faces point inwards. The deformation does not mind; programs that open the export may.";
    case Defect::degenerate: return "It cannot be seen; the deformation does not mind.";
    case Defect::doubled_vertex:
      return "As along seams. Vertices at one place move alike and stay together; shading shows an edge "
             "there.";
    case Defect::unused_vertex: return "It moves with the rest and is exported, but cannot be seen.";
    case Defect::self_intersection:
    case Defect::thin: break;
  }
  return "";
}

}  // namespace

std::string meaning(const Finding& finding) {
  if (finding.subject == Subject::cage) return cage_meaning(finding.defect);
  return std::string(model_meaning(finding.defect)) +
         (finding.turned ? " Turned, the cage fits clearly better." : "");
}

bool matters(const Finding& finding) {
  if (finding.subject == Subject::model) return finding.defect == Defect::vertices_outside;
  return finding.defect != Defect::inside_out && finding.defect != Defect::unused_vertex;
}

}  // namespace viete::scene
