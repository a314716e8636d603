// Computes the values of colour maps (fields): quick fields within the frame, slow fields in the background.
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

/// The input for computing a field of one view.
struct FieldSubject {
  const document::Document& document;
  analysis::Field field;
  const ViewModel& model;  ///< a slow field waits for the first frame of this model
  sym3::Method method;
  document::PosedModel posed, first;  ///< the models of: this view, the first view; empty: at rest
};

/// Computes the shown fields of all views, again after each change of the input. Not thread-safe.
class FieldMaker {
public:
  explicit FieldMaker(const base::Wake& wake = nullptr)
      : views_{View(wake), View(wake), View(wake), View(wake)} {}

  /// Call after a frame is deformed. Stores new values in `shown` and starts the next computation. If `wait`
  /// is false, values of a slow field can belong to an earlier pose. Returns true if there are new values.
  bool follow(std::size_t view, const FieldSubject& subject, workspace::FieldView& shown, bool wait = false);
  /// Waits for the values of the current pose.
  void finish(std::size_t view, const FieldSubject& subject, workspace::FieldView& shown);
  /// Cancels all computations. Call when the document changes.
  void forget();
  /// True if follow() would do something now.
  bool is_due(std::size_t view, const FieldSubject& subject, const workspace::FieldView& shown) const;

private:
  // The input from which values were computed.
  struct Key {
    analysis::Field field = analysis::Field::none;
    unsigned long frame = 0, first = 0;
    const void *vertices = nullptr, *surface = nullptr;
    sym3::Method method = sym3::Method::fast;
    document::Selection selection;  // only for the influence field
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct View {
    explicit View(const base::Wake& wake) : job(wake) {}

    base::BackgroundJob<analysis::FieldValues> job;
    Key key;
  };
  static Key key_of(const FieldSubject& subject);
  void begin(View& view, const FieldSubject& subject);
  std::shared_ptr<const analysis::Strain> strain_of(const document::Document& document);

  std::unique_ptr<base::WorkerPool> pool_;
  std::shared_ptr<const mesh::Surface> surface_;
  std::shared_ptr<const analysis::Strain> strain_;  // the strain of surface_
  std::array<View, workspace::Split::most> views_;
};

}  // namespace viete::app
