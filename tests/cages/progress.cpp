// How far the making of a cage is, and that it stops when it is told to.
#include "base/progress.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "cages/make.h"
#include "cages/models.h"

using namespace viete;
using namespace viete::test;

namespace {

void pause_for(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// Made on a thread of its own.
struct Work {
  base::Progress progress;
  std::atomic<bool> ended{false}, cancelled{false};
  std::thread thread;

  explicit Work(const mesh::Surface& model, const cages::Wish& wish)
      : thread([this, &model, wish] {
          base::WorkerPool pool(1);
          try {
            cages::make(model, wish, pool, &progress);
          } catch (const base::Cancelled&) {
            cancelled = true;
          }
          ended = true;
        }) {}
  ~Work() { thread.join(); }
};

}  // namespace

TEST_CASE("progress_rises_from_nothing_to_all_in_small_steps") {
  for (const auto& model : {sphere(4)}) {
    double widest = 1;
    for (int i = 0; i < 100 && widest >= 0.6;
         ++i) {  // this thread may have to wait while the other one works
      Work work(model, {.triangles = 60});
      double last = 0;
      bool falls = false;
      widest = 0;
      while (!work.ended) {
        const double done = work.progress.done();
        falls = falls || done < last;
        widest = std::max(widest, done - last);
        last = done;
        pause_for(1e-4);
      }
      CHECK_FALSE(falls);
      CHECK(work.progress.done() == 1);
    }
    CHECK(widest < 0.6);
  }
}

TEST_CASE("the_making_of_a_cage_stops_soon_after_it_is_cancelled") {
  const mesh::Surface model = sphere(5);
  for (const double share : {0.02, 0.5}) {
    CAPTURE(share);
    bool cancelled = false;
    for (int i = 0; i < 20 && !cancelled; ++i) {  // it may end before this thread runs again
      Work work(model, {.triangles = 100});
      while (work.progress.done() < share && !work.ended) pause_for(1e-4);
      work.progress.cancel();
      const double asked = work.progress.done();
      while (!work.ended) pause_for(1e-4);
      CHECK(work.progress.done() <
            asked + 0.1);  // counted in work: how long that takes is the machine's matter
      cancelled = work.cancelled;
    }
    CHECK(cancelled);
  }
}

TEST_CASE("after_a_cancel_the_next_cage_of_a_maker_is_the_same_as_ever") {
  const auto model = std::make_shared<const mesh::Surface>(stool());
  base::WorkerPool pool(1);
  cages::Maker maker(model);
  base::Progress stopped;
  stopped.cancel();
  CHECK_THROWS_AS(maker.make({.triangles = 60}, pool, &stopped), base::Cancelled);
  CHECK(maker.make({.triangles = 60}, pool).surface.positions ==
        cages::make(*model, {.triangles = 60}, pool).surface.positions);
}
