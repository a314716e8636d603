// Results of batches must not depend on layouts, lengths, positions, other items or threads.
#include "sym3/view.h"

#include <limits>
#include <thread>

#include "sym3/arranged.h"
#include "sym3/preamble.h"

using sym3::Layout;
using sym3::SymView;

namespace {

/// Returns ordinary matrices, and matrices that need squarings or Jacobi's method.
template <class T>
std::vector<Sym3<T>> mixture(std::size_t count) {
  auto all = paper_ensemble<T>(count, 5);
  const auto wide = spreads<T>(30, -20, count);
  for (std::size_t i = 5; i < count; i += 11) all[i] = wide[i];
  for (std::size_t i = 9; i < count; i += 31) all[i] = diagonal(T(1000), T(-1000), T(0.5));
  for (std::size_t i = 13; i < count; i += 47) all[i].xy = std::numeric_limits<T>::quiet_NaN();
  return all;
}

template <class T>
std::vector<Sym3<T>> one_by_one(const sym3::Kernel& kernel, const std::vector<Sym3<T>>& in) {
  std::vector<Sym3<T>> out;
  for (const auto& s : in) out.push_back(exp_with(kernel, s));
  return out;
}

void run_on_threads(void*, std::size_t tasks, void (*task)(void*, std::size_t), void* context) {
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < tasks; ++i) threads.emplace_back(task, context, i);
  for (auto& t : threads) t.join();
}

}  // namespace

TEST_CASE_TEMPLATE("every_length_and_layout_of_a_batch_gives_the_bits_of_the_single_call", T, double, float) {
  const auto in = mixture<T>(197);
  for (const auto& kernel : sym3::kernels()) {
    CAPTURE(kernel.name);
    check_every_batch<T>(in, one_by_one(kernel, in),
                         [&](const SymView<const T>& from, const SymView<T>& to, std::size_t count) {
                           sym3::exp(from, to, count, {&kernel});
                         });
  }
}

TEST_CASE_TEMPLATE("any_alignment_any_stores_and_any_place_of_a_batch_give_the_same_bits", T, double, float) {
  constexpr std::size_t count = 67;
  const auto in = mixture<T>(count);
  for (const auto& kernel : sym3::kernels()) {
    const auto expected = one_by_one(kernel, in);
    for (const Layout layout : layouts)
      for (std::size_t offset = 0; offset < 16; ++offset)
        for (const auto stores : {sym3::Stores::ordinary, sym3::Stores::streaming})
          for (const bool in_place : {false, true}) {
            Arranged<T> from(layout, in, count, offset), beside(layout, count, offset);
            Arranged<T>& to = in_place ? from : beside;
            sym3::exp(SymView<const T>(from.view()), to.view(), count, {&kernel, nullptr, stores});
            bool same = in_place || to.holds(count);
            for (std::size_t i = 0; i < count; ++i)
              same = same && same_or_nan<T>(to.get(i), expected[i]) && to.is_symmetric(i);
            CAPTURE(kernel.name);
            CAPTURE(int(layout));
            CAPTURE(offset);
            CHECK(same);
          }
  }
}

TEST_CASE_TEMPLATE("threads_do_not_change_a_bit_of_a_batch", T, double, float) {
  const auto in = mixture<T>(20011);
  std::vector<Sym3<T>> alone(in.size()), together(in.size());
  sym3::exp(sym3::packed(in.data()), sym3::packed(alone.data()), in.size());
  for (const std::size_t threads : {1, 2, 3, 4, 100}) {
    const sym3::Executor executor = {run_on_threads, nullptr, threads};
    std::fill(together.begin(), together.end(), Sym3<T>{});
    sym3::exp(sym3::packed(in.data()), sym3::packed(together.data()), in.size(), {nullptr, &executor});
    for (std::size_t i = 0; i < in.size(); ++i) REQUIRE(same_or_nan<T>(together[i], alone[i]));
  }
}

TEST_CASE("an_executor_is_asked_for_chunks_of_at_least_4096") {
  std::size_t asked = 0;
  const auto count_tasks = [](void* self, std::size_t tasks, void (*task)(void*, std::size_t),
                              void* context) {
    *static_cast<std::size_t*>(self) = tasks;
    for (std::size_t i = 0; i < tasks; ++i) task(context, i);
  };
  const sym3::Executor executor = {count_tasks, &asked, 8};
  std::vector<Sym3<float>> m(3 * 4096 + 7);
  sym3::exp(sym3::packed(m.data()), sym3::packed(m.data()), m.size(), {nullptr, &executor});
  CHECK(asked == 3);
  CHECK(std::ranges::all_of(m, [](const auto& s) { return s == sym3::identity<float>(); }));
}

TEST_CASE("padded_strides_are_448_bytes_more_than_whole_pages") {
  for (const std::size_t count : {1, 8, 56, 57, 112, 113, 568, 569, 4096, 1000000}) {
    CHECK(sym3::padded_stride<double>(count) >= count);
    CHECK(sym3::padded_stride<double>(count) < count + 512);
    CHECK(sym3::padded_stride<double>(count) % 512 == 56);
    CHECK(sym3::padded_stride<float>(count) >= count);
    CHECK(sym3::padded_stride<float>(count) % 1024 == 112);
  }
}
