#include "files/output.h"
#include "workspace/command_tables.h"
#include "workspace/open_save.h"

namespace viete::workspace {

namespace {

using Purpose = FileBrowser::Purpose;
namespace fs = std::filesystem;

// The file of the cage, or of the model if the cage has no file.
const fs::path& file_of_cage(const document::Document& document) {
  const bool in_file = document.has_cage() && !document.cage_file().path.empty();
  return in_file ? document.cage_file().path : document.model().path;
}

void browse_beside(Workspace& w, Purpose purpose, const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = fs::absolute(file, ignored).parent_path();  // "model.obj" is in the current folder
  show(w.files.browser, purpose, fs::is_directory(folder, ignored) ? folder : w.preferences.folder);
}

// The open file that may be overwritten when saving for this purpose.
std::string_view own_of(Purpose purpose) {
  switch (purpose) {
    case Purpose::save_session: return document::the_session;
    case Purpose::save_pose: return document::the_pose;
    case Purpose::save_cage: return document::the_cage;
    default: return document::no_own;
  }
}

void browse_for_model(Workspace& w) {
  const fs::path& last = w.preferences.folder;
  show(w.files.browser, Purpose::model, last.empty() ? file_of_cage(w.document).parent_path() : last);
}

template <Purpose For>
void browse_for(Workspace& w) {
  browse_beside(w, For, file_of_cage(w.document));
}

// Proposes a name such as "cage_pose.obj" in the session's folder. Without a session: beside the file `from`.
void browse_to_save(Workspace& w, Purpose purpose, const fs::path& from, const std::string& ending) {
  const fs::path& beside = w.files.saved.session.empty() ? from : w.files.saved.session;
  w.files.browser.saves_capture = w.document.model().splats != nullptr;
  show(w.files.browser, purpose, beside.parent_path(), from.stem().string() + ending,
       files_open(w, own_of(purpose)));
}

// Proposes the ending, or for a capture its own format, because few formats store splats.
void browse_to_export(Workspace& w, Purpose purpose, const std::string& ending,
                      const std::string& capture_ending) {
  const document::OpenedSurface& model = w.document.model();
  browse_to_save(w, purpose, model.path,
                 model.splats ? capture_ending + model.path.extension().string() : ending);
}

void save_animation(Workspace& w) {
  browse_to_export(w, Purpose::save_animation, "_animation.pc2", "_####");
  const glm::ivec2 size =
      glm::clamp(glm::ivec2(w.view.camera.viewport.window), least_picture, largest_picture);
  w.files.browser.pictures = PictureChoice{
      .grid = w.view.options.grid, .light = !w.view.options.dark, .width = size.x, .height = size.y};
  w.files.browser.first_frame = w.document.timeline().first;
  w.files.browser.last_frame = w.document.timeline().last;
}

constexpr Condition has_example{"The bundled dragon was not found.",
                                [](const Workspace& w) { return !w.files.example.empty(); }};

constexpr Condition can_import{"Open a cage first. Leave cage editing.", [](const Workspace& w) {
                                 return has_cage(w) && !is_editing_cage(w.document) && !is_dragging(w);
                               }};
constexpr Condition can_import_animation{
    "Open a model first. Leave cage editing.",
    [](const Workspace& w) { return has_model(w) && !is_editing_cage(w.document) && !is_dragging(w); }};
constexpr Condition can_import_shapes{
    "Open a model with faces first. Leave cage editing.",
    [](const Workspace& w) { return w.document.has_faces() && can_import_animation(w); }};
constexpr Condition can_export_animation{
    "No keys yet: pose the model and set a key (I).", [](const Workspace& w) {
      return is_movable(w) && w.document.timeline().has_poses() && !is_editing_cage(w.document);
    }};

}  // namespace

void save(Workspace& w) {
  if (w.files.saved.session.empty()) return browse_to_save_session(w);
  w.jobs.wishes.save(SaveFile::Content::session, w.files.saved.session);
}

void browse_to_save_session(Workspace& w) {
  browse_to_save(w, Purpose::save_session,
                 w.files.saved.session.empty() ? w.document.model().path : w.files.saved.session, ".viete");
}

void browse_to_locate(Workspace& w, Purpose purpose) {
  const fs::path& session = w.files.unopened->files.front();
  // Does not browse the folder of recovery files, because it contains no models.
  const bool recovery = w.files.unopened->what == files::OpenRequest::What::recovery;
  recovery ? show(w.files.browser, purpose, w.preferences.folder) : browse_beside(w, purpose, session);
}

void add_file_commands(CommandTable& table) {
  table.heading("File");
  table.add("open_model", {"Open model or session", "Open"}, "Open a mesh to deform or a saved session.",
            {key('O'), true}, always, browse_for_model);
  table.add("open_cage", "Open cage", "Open a cage for the model.", {key('O'), true, true}, has_model,
            [](Workspace& w) { browse_beside(w, Purpose::cage, w.document.model().path); });
  table.add("open_cage_beside", {"Open cage next to the model", "Open this cage"},
            "Open the file in the model's folder that seems to be its cage.", has_cage_beside,
            passing([](Workspace& w) {
              w.jobs.wishes.open({files::OpenRequest::What::cage, {w.document.cage_beside()}});
            }));
  table.add("open_pose", "Open pose", "Open a posed version of the cage.", {key('P'), true}, has_cage,
            browse_for<Purpose::pose>);
  table.add("open_example", "Open example animation",
            "Open the dragon with poses and a five-second animation, and play it.", has_example,
            [](Workspace& w) {
              w.jobs.wishes.open({files::OpenRequest::What::model, {w.files.example}});
            });
  table.add("save_session", {"Save session", "Save"},
            "Save model, cage, pose, settings and camera in a session file.", {key('S'), true}, has_model,
            save);
  table.add("save_session_as", {"Save session as", "Save as"}, "Save the session under a new name.",
            {key('S'), true, true}, has_model, browse_to_save_session);
  table.add(
      "save_pose", "Save pose", "Write the posed cage to a mesh file.", {key('P'), true, true}, has_cage,
      [](Workspace& w) { browse_to_save(w, Purpose::save_pose, file_of_cage(w.document), "_pose.obj"); });
  table.add("save_cage", "Save cage", "Write the cage at rest to a mesh file.", has_cage, [](Workspace& w) {
    browse_to_save(w, Purpose::save_cage, w.document.model().path, "_cage.obj");
  });
  table.add("save_model", "Export model", "Write the deformed model to a file.", {key('E'), true}, is_movable,
            [](Workspace& w) { browse_to_export(w, Purpose::save_model, "_deformed.obj", "_deformed"); });
  table.add("stop_work", {"Cancel current task", "Cancel"},
            "Cancel the current task: opening a file, making a cage or binding. The document stays as it is.",
            {Key::escape}, is_working, passing(cancel<CancelWork::Work::opening>));
  table.add("stop_export", {"Cancel export", "Cancel"},
            "Stop the export. Each file is either complete or unchanged.", is_exporting,
            passing(cancel<CancelWork::Work::exporting>));
  table.add("restore_leftover", {"Restore recovered edits", "Restore"},
            "Open the most recent recovered edits.", {key('B'), true}, has_recovery_files,
            passing([](Workspace& w) {
              if (!std::exchange(w.recovery.offered, true)) return;
              w.jobs.wishes.open({files::OpenRequest::What::recovery, {w.recovery.offers().front().file}});
            }));
  table.add("discard_leftovers", {"Discard recovered edits", "Discard"},
            "Delete the listed recovered edits permanently.", offers_recovery, passing([](Workspace& w) {
              w.files.question = ask_before_discarding(w.recovery.offers().size());
            }));
  table.add("put_off_leftovers", {"Keep recovered edits for later", "Later"},
            "Hide this row. The next start offers the recovered edits again.", offers_recovery,
            passing([](Workspace& w) { w.recovery.offered = false; }));
  table.add("screenshot", {"Save screenshot", "Screenshot"}, "Save a picture of the window as PNG.",
            {Key::f12}, always, [](Workspace& w) { w.jobs.wishes.add(SaveScreenshot{}); });
  table.add("quit", "Quit", "Close Viete.", {key('Q'), true}, always,
            [](Workspace& w) { w.jobs.wishes.add(CloseProgram{}); });
}

void add_animation_file_commands(CommandTable& table) {
  table.heading("Poses");
  table.add("import_poses", "Import poses",
            "Add posed cages to the pose list, from a file, from its morph targets or from a folder.",
            can_import, browse_for<Purpose::poses>);
  table.add("import_shapes", "Import shapes",
            "Add shapes of the model to the pose list, from mesh files, numbered sequences, point caches "
            "(PC2, MDD), morph targets (glTF) or a folder.",
            can_import_shapes,
            [](Workspace& w) { browse_beside(w, Purpose::shapes, w.document.model().path); });
  table.heading("Time");
  table.add("import_animation", "Import animation",
            "Import keys from numbered files of the posed cage, a point cache (PC2, MDD) of cage or model, "
            "or animated morph targets (glTF).",
            can_import_animation, browse_for<Purpose::animation>);
  table.add(
      "save_animation", "Export animation",
      "Write the playback range as numbered models, a point cache (PC2, MDD) or glTF with morph targets.",
      can_export_animation, save_animation);
}

}  // namespace viete::workspace
