#include "sym3/call_kernel.h"

#include <algorithm>
#include <cassert>
#include <type_traits>

#include "sym3/batch.h"
#include "sym3/decomposition.h"
#include "sym3/derivative.h"
#include "sym3/eigenvalues.h"
#include "sym3/log.h"
#include "sym3/polar.h"
#include "sym3/rotation.h"

namespace viete::sym3 {

namespace {

// About half of a large last-level cache. For more data, streaming stores are faster, because normal stores
// first load each cache line.
constexpr std::size_t streaming_bytes = 24u << 20;

constexpr std::size_t granule = 64;  // chunks begin at a multiple of this number of items

struct Chunks {
  const RangeTask& task;
  std::size_t count, size;
  bool stream;
};

void run_chunk(void* context, std::size_t i) {
  const auto& c = *static_cast<const Chunks*>(context);
  const std::size_t begin = i * c.size;
  if (begin < c.count) c.task.run(c.task.context, {begin, std::min(begin + c.size, c.count), c.stream});
}

bool should_stream(Stores stores, std::size_t bytes, bool in_place) {
  if (stores != Stores::automatic) return stores == Stores::streaming;
  return !in_place && bytes > streaming_bytes;
}

// The kernels read and write these types as contiguous numbers.
template <class T, class Number>
constexpr bool is_contiguous(std::size_t numbers) {
  return sizeof(T) == numbers * sizeof(Number) && std::is_standard_layout_v<T>;
}
static_assert(is_contiguous<Sym3<double>, double>(6) && is_contiguous<Sym3<float>, float>(6));
static_assert(is_contiguous<Tangent<double>, double>(36) && is_contiguous<Tangent<float>, float>(36));
static_assert(is_contiguous<Polar<double>, double>(15) && is_contiguous<Polar<float>, float>(15));
static_assert(is_contiguous<Eigensystem<double>, double>(12) && is_contiguous<Eigensystem<float>, float>(12));
static_assert(is_contiguous<SingularSystem<double>, double>(21) &&
              is_contiguous<SingularSystem<float>, float>(21));

template <class T>
Sym3<T> one_derivative(Of f, double p, const Sym3<T>& s, const Sym3<T>& direction) {
  Sym3<T> out;
  functions<T>(kernel()).derivative->one(&s.xx, &direction.xx, &out.xx, f, p);
  return out;
}

template <class T>
void many_derivatives(Of f, double p, const SymView<const T>& s, Directions<T> directions, Derivatives<T> out,
                      std::size_t count, const Batch& batch) {
  assert(directions.size() == out.size());
  const auto many = functions<T>(kernel_of(batch)).derivative->many;
  const auto call = [&](const Range& range) {
    many(s, directions.data(), out.data(), out.size(), f, p, range);
  };
  run_batch(task_of(call), count, 0, true, batch);
}

}  // namespace

const Kernel& kernel_of(const Batch& batch) {
  return batch.kernel ? *batch.kernel : kernel();
}

void run_batch(const RangeTask& task, std::size_t count, std::size_t bytes, bool in_place,
               const Batch& batch) {
  const Executor* executor = batch.executor;
  const std::size_t most = std::max<std::size_t>(1, count / Batch::least_chunk);
  const std::size_t tasks = executor ? std::clamp<std::size_t>(executor->threads, 1, most) : 1;
  const std::size_t size = ((count + tasks - 1) / tasks + granule - 1) / granule * granule;
  Chunks chunks = {task, count, size, should_stream(batch.stores, bytes, in_place)};
  if (tasks == 1) return run_chunk(&chunks, 0);
  executor->run(executor->self, tasks, run_chunk, &chunks);
}

// A function of one item of type In<T>, N numbers, and of a batch. The result has M numbers.
#define VIETE_FUNCTION_FOR(T, name, In, N, Out, M)                                                      \
  template Out<T> name(const In<T>&);                                                                   \
  void name(const View<const T, N>& in, const View<T, M>& out, std::size_t count, const Batch& batch) { \
    call_many(&KernelFunctions<T>::name, in, out, count, batch);                                        \
  }
#define VIETE_FUNCTION(name, In, N, Out, M)                                              \
  template <class T>                                                                     \
  Out<T> name(const In<T>& in) {                                                         \
    return call_one<Out<T>>(&KernelFunctions<T>::name, reinterpret_cast<const T*>(&in)); \
  }                                                                                      \
  VIETE_FUNCTION_FOR(float, name, In, N, Out, M)                                         \
  VIETE_FUNCTION_FOR(double, name, In, N, Out, M)
VIETE_FUNCTION(log, Sym3, 6, Sym3, 6)
VIETE_FUNCTION(sqrt, Sym3, 6, Sym3, 6)
VIETE_FUNCTION(inv_sqrt, Sym3, 6, Sym3, 6)
VIETE_FUNCTION(eigenvalues, Sym3, 6, Vec3, 3)
VIETE_FUNCTION(exp_rotation, Vec3, 3, Mat3, 9)
VIETE_FUNCTION(log_rotation, Mat3, 9, Vec3, 3)
#undef VIETE_FUNCTION
#undef VIETE_FUNCTION_FOR

template <class T>
Sym3<T> pow(const Sym3<T>& s, double p) {
  return call_one<Sym3<T>>(&KernelFunctions<T>::pow, &s.xx, p);
}

template <class T>
Eigensystem<T> eigh(const Sym3<T>& s) {
  return call_one<Eigensystem<T>>(&KernelFunctions<T>::eigh, &s.xx);
}

template <class T>
SingularSystem<T> svd(const Mat3<T>& m) {
  return call_one<SingularSystem<T>>(&KernelFunctions<T>::svd, m.data());
}

template <class T>
Polar<T> polar(const Mat3<T>& m) {
  return call_one<Polar<T>>(&KernelFunctions<T>::polar, m.data());
}

#define VIETE_FOR(T)                                                                                       \
  template Sym3<T> pow(const Sym3<T>&, double);                                                            \
  void pow(const SymView<const T>& in, double p, const SymView<T>& out, std::size_t count,                 \
           const Batch& batch) {                                                                           \
    call_many(&KernelFunctions<T>::pow, in, out, count, batch, p);                                         \
  }                                                                                                        \
  template Eigensystem<T> eigh(const Sym3<T>&);                                                            \
  void eigh(const SymView<const T>& in, const VecView<T>& values, const MatView<T>& vectors,               \
            std::size_t count, const Batch& batch) {                                                       \
    call_many(&KernelFunctions<T>::eigh, in, values, count, batch, vectors);                               \
  }                                                                                                        \
  template SingularSystem<T> svd(const Mat3<T>&);                                                          \
  void svd(const MatView<const T>& in, const MatView<T>& u, const VecView<T>& values, const MatView<T>& v, \
           std::size_t count, const Batch& batch) {                                                        \
    call_many(&KernelFunctions<T>::svd, in, u, count, batch, values, v);                                   \
  }                                                                                                        \
  template Polar<T> polar(const Mat3<T>&);                                                                 \
  void polar(const MatView<const T>& in, const MatView<T>& rotations, std::size_t count,                   \
             const Batch& batch) {                                                                         \
    call_many(&KernelFunctions<T>::rotation_of, in, rotations, count, batch);                              \
  }                                                                                                        \
  void polar(const MatView<const T>& in, const MatView<T>& rotations, const SymView<T>& stretches,         \
             std::size_t count, const Batch& batch) {                                                      \
    call_many(&KernelFunctions<T>::polar, in, rotations, count, batch, stretches);                         \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

// `p` is the exponent, or 0. For functions with an exponent, the last argument declares this parameter.
#define VIETE_DERIVATIVE_FOR(T, name, p, ...)                                                            \
  template Sym3<T> name##_derivative(const Sym3<T>& __VA_OPT__(, ) __VA_ARGS__, const Sym3<T>&);         \
  template Tangent<T> name##_tangent(const Sym3<T>& __VA_OPT__(, ) __VA_ARGS__);                         \
  void name##_derivative(const SymView<const T>& s __VA_OPT__(, ) __VA_ARGS__, Directions<T> directions, \
                         Derivatives<T> out, std::size_t count, const Batch& batch) {                    \
    many_derivatives(Of::name, p, s, directions, out, count, batch);                                     \
  }                                                                                                      \
  void name##_tangent(const SymView<const T>& s __VA_OPT__(, ) __VA_ARGS__, const TangentView<T>& out,   \
                      std::size_t count, const Batch& batch) {                                           \
    call_many(&KernelFunctions<T>::tangent, s, out, count, batch, Of::name, double(p));                  \
  }
#define VIETE_DERIVATIVE(name, p, ...)                                                               \
  template <class T>                                                                                 \
  Sym3<T> name##_derivative(const Sym3<T>& s __VA_OPT__(, ) __VA_ARGS__, const Sym3<T>& direction) { \
    return one_derivative(Of::name, p, s, direction);                                                \
  }                                                                                                  \
  template <class T>                                                                                 \
  Tangent<T> name##_tangent(const Sym3<T>& s __VA_OPT__(, ) __VA_ARGS__) {                           \
    return call_one<Tangent<T>>(&KernelFunctions<T>::tangent, &s.xx, Of::name, double(p));           \
  }                                                                                                  \
  VIETE_DERIVATIVE_FOR(float, name, p __VA_OPT__(, ) __VA_ARGS__)                                    \
  VIETE_DERIVATIVE_FOR(double, name, p __VA_OPT__(, ) __VA_ARGS__)
VIETE_DERIVATIVE(exp, 0)
VIETE_DERIVATIVE(log, 0)
VIETE_DERIVATIVE(sqrt, 0)
VIETE_DERIVATIVE(pow, p, double p)
#undef VIETE_DERIVATIVE
#undef VIETE_DERIVATIVE_FOR

}  // namespace viete::sym3
