// Computes the fields shown in the window: quick ones within the frame, others in the background.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "analysis/field.h"
#include "analysis/strain.h"
#include "app/view_model.h"
#include "base/worker_pool.h"
#include "workspace/workspace.h"

namespace viete::app {

/// The input of a field: one view of a frame.
struct FieldSubject {
  const document::Document& document;
  analysis::Field field;
  const ViewModel& model;  ///< without a frame: nothing is computed in the background
  sym3::Method method;
  document::PosedModel posed,
      first;  ///< the model as drawn in this view and in the first view; empty: at rest
};

/// Follows the frames of a model while its fields are shown; costs nothing otherwise. Call from one thread.
class FieldMaker {
public:
  /// Call after a frame is deformed: delivers the newest values to this view and starts the next ones.
  /// Background results may belong to a slightly earlier pose. Returns true for new values.
  bool follow(std::size_t view, const FieldSubject& subject, workspace::FieldView& shown, bool wait = false);
  /// Waits until the values belong to this pose.
  void finish(std::size_t view, const FieldSubject& subject, workspace::FieldView& shown);
  /// Cancels all computations, for a change of the document.
  void forget();
  /// True if follow() would do something now.
  bool is_due(std::size_t view, const FieldSubject& subject, const workspace::FieldView& shown) const;

private:
  // Identifies computed values.
  struct Key {
    analysis::Field field = analysis::Field::none;
    unsigned long frame = 0, first = 0;
    const void *vertices = nullptr, *surface = nullptr;
    sym3::Method method = sym3::Method::fast;
    document::Selection selection;  // for the influence field
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct View {
    base::BackgroundJob<analysis::FieldValues> job;
    Key key;
  };
  static Key key_of(const FieldSubject& subject);
  void begin(View& view, const FieldSubject& subject);
  std::shared_ptr<const analysis::Strain> strain_of(const document::Document& document);

  std::unique_ptr<base::WorkerPool> pool_;
  std::shared_ptr<const mesh::Surface> surface_;
  std::shared_ptr<const analysis::Strain> strain_;  // for surface_
  std::array<View, workspace::Split::most> views_;
};

}  // namespace viete::app
