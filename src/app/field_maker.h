// The field that the window shows: computed in the frame where that is quick, else aside.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "app/bound.h"
#include "base/background.h"
#include "base/worker_pool.h"
#include "deform/deformer.h"
#include "lab/field.h"
#include "lab/strain.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// What a field is to be of: one view of a frame.
struct FieldSubject {
  const scene::Document& document;
  lab::Field field;
  const deform::Deformer* deformer;  ///< null, or without a frame: nothing is computed aside
  const Bound& bound;
  sym3::Method method;
  scene::PosedModel posed, first;  ///< as it is drawn here, and in the first view; nothing: at rest
};

/// Follows the frames of a model while fields of it are shown, and costs nothing otherwise. Call from one
/// thread.
class FieldMaker {
public:
  /// After a frame is deformed: the newest values come to the view of that number, and the next ones are
  /// begun. Those that are computed aside may be of a pose a moment ago. Says whether there are new ones.
  bool follow(std::size_t view, const FieldSubject& subject, scene::FieldView& shown, bool wait = false);
  /// Waits until the values are those of this pose.
  void finish(std::size_t view, const FieldSubject& subject, scene::FieldView& shown);
  /// Another document: what was begun about the old one is void.
  void forget();
  /// True if follow() would do something now.
  bool is_due(std::size_t view, const FieldSubject& subject, const scene::FieldView& shown) const;

private:
  // Which values there are.
  struct Key {
    lab::Field field = lab::Field::none;
    unsigned long frame = 0, first = 0;
    const void *vertices = nullptr, *surface = nullptr;
    sym3::Method method = sym3::Method::fast;
    scene::Selection selection;  // of influence
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct View {
    base::BackgroundJob<lab::FieldValues> job;
    Key key;
  };
  static Key key_of(const FieldSubject& subject);
  void begin(View& view, const FieldSubject& subject);
  std::shared_ptr<const lab::Strain> strain_of(const scene::Document& document);

  std::unique_ptr<base::WorkerPool> pool_;
  std::shared_ptr<const mesh::Surface> surface_;
  std::shared_ptr<const lab::Strain> strain_;  // of that surface
  std::array<View, scene::Split::most_sides + 1> views_;
};

}  // namespace viete::app
