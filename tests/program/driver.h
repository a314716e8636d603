// Runs the program offscreen with simulated mouse and key events.
#pragma once

#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <thread>
#include <vector>

#include "app/offscreen_viewer.h"
#include "base/worker_pool.h"
#include "deform/exact.h"
#include "files/export.h"
#include "interact/picking.h"
#include "program/dragon.h"
#include "program/no_pixels.h"
#include "support/distance.h"
#include "support/user_input.h"

namespace viete::test {

/// An argument of Driver for tests that need pixels.
struct WithPixels {
  platform::OffscreenContext::Kind kind = platform::OffscreenContext::Kind::any;
};
inline constexpr WithPixels with_pixels;

/// The program in a test. Draws only if a test needs pixels.
class Driver : public UserInput {
public:
  explicit Driver(const app::ViewerOptions& options = default_options(),
                  std::optional<WithPixels> pixels = {})
      : offscreen_(options,
                   pixels ? platform::OffscreenContext::create(pixels->kind) : std::make_unique<NoPixels>()) {
    document().put_deformer({});  // the deformer "As published"
    for (const char* title : {"Transform", "Select", "Display", "Analysis"})
      workspace().preferences.layout.sections[title] = true;
  }

  explicit Driver(WithPixels pixels) : Driver(default_options(), pixels) {}
  /// Checks at the end of every test that the program comes to rest.
  ~Driver() override {
    if (std::uncaught_exceptions() == 0) check_rest();
  }

  /// If there is no playback and no background work, runs frames until no activity is due. Then another frame
  /// must not draw anything new.
  void check_rest() {
    const auto busy = [&] {
      return viewer().working() || viewer().checking() || workspace().playback.playing;
    };
    for (int i = 0; i < 100 && !busy() && viewer().wants_frame(); ++i) frame();
    if (busy()) return;
    CHECK_MESSAGE(!viewer().wants_frame(), "the activity '", viewer().due_activity(), "' does not end");
    frame();
    CHECK_FALSE(viewer().has_drawn());
    CHECK_MESSAGE(!viewer().wants_frame(), "the activity '", viewer().due_activity(), "' begins by itself");
  }

  static app::ViewerOptions default_options() { return default_options({1280, 800}); }
  static app::ViewerOptions default_options(glm::ivec2 size) {
    app::ViewerOptions options;
    options.size = size;
    options.builtin_font = true;
    options.probe = false;
    return options;
  }

  app::Viewer& viewer() { return offscreen_.viewer(); }
  workspace::Workspace& workspace() final { return viewer().workspace(); }
  const ui::Recorder& recorder() final { return viewer().recorder(); }
  platform::InputQueue& input() final { return viewer().input(); }
  void settle() { offscreen_.settle(); }
  render::Image picture() { return viewer().picture(); }

  using What = files::OpenRequest::What;
  /// Opens files, and runs frames until they are open. Returns false on a refusal or a question.
  [[nodiscard]] bool open(std::vector<std::filesystem::path> files, What what = What::model);
  /// Opens the dragon and its cage, at rest or in a pose. Waits until the picture no longer changes.
  void open_dragon(const std::string& pose = "", const std::filesystem::path& model = dragon);

  void frame(int count = 1) final {
    for (int i = 0; i < count; ++i) viewer().frame(1.0f / 60);
  }
  /// Runs frames until the condition is true. If this takes five minutes, returns false.
  template <class Condition>
  [[nodiscard]] bool until(Condition has_come) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    while (!has_come()) {
      if (std::chrono::steady_clock::now() > end) return false;
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  /// Saves the file. Waits until it is written or refused.
  void save(workspace::SaveFile::Content content, const std::filesystem::path& file) {
    workspace().jobs.wishes.save(content, file);
    frame();
    REQUIRE(until([&] { return !viewer().exporting(); }));
  }
  /// Runs frames until the generated cage follows the current settings. After a preview, also waits for the
  /// cage of full quality.
  void finish_making() {
    do {
      frame();
      REQUIRE(until([&] { return !workspace().jobs.making_cage.running; }));
      std::this_thread::sleep_for(std::chrono::milliseconds(400));
      frame();
    } while (workspace().jobs.making_cage.running);
  }

  /// Returns the deformed model in double precision, as an export writes it.
  std::vector<mesh::Point> exact_positions() {
    base::WorkerPool pool;
    const files::Export e = files::export_of(document(), {});
    return deform::deform_exactly(*e.model, e.cage, e.deformer, e.pose, e.method, pool, nullptr, e.mask,
                                  e.probes, e.shape)
        .positions;
  }
  /// Returns exact_positions(). The model drawn in single precision must agree.
  std::vector<mesh::Point> checked_positions() {
    CHECK(drawn_error() < 2e-5);
    return exact_positions();
  }

  /// Returns the largest error of the drawn vertices, in diagonals of the model.
  double drawn_error() {
    return largest_distance(exact_positions(), viewer().deformer()->positions()) /
           document().model().bounds.diagonal();
  }

private:
  app::OffscreenViewer offscreen_;
};

inline bool Driver::open(std::vector<std::filesystem::path> files, What what) {
  const document::Revision before = document().revisions().pose;
  workspace().jobs.wishes.open({what, std::move(files)});
  frame();
  REQUIRE(until([&] { return !viewer().loading(); }));
  return document().revisions().pose != before;
}

inline void Driver::open_dragon(const std::string& pose, const std::filesystem::path& model) {
  std::vector<std::filesystem::path> files = {model, dragon_cage};
  if (!pose.empty()) files.push_back(dragon_cage.parent_path() / (pose + ".obj"));
  REQUIRE(open(files));
  settle();
}

/// The program with the dragon.
struct Dragon : Driver {
  explicit Dragon(const std::string& pose = "", std::optional<WithPixels> pixels = {})
      : Driver(default_options(), pixels) {
    open_dragon(pose);
  }
  Dragon(const std::string& pose, const std::filesystem::path& model) { open_dragon(pose, model); }
};

}  // namespace viete::test
