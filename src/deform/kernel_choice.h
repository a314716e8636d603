// What each instruction set compiled, by its Highway target. Internal; no inline functions here (see
// sym3/exp_by_jacobi.h).
#pragma once

// Use after Highway's foreach_target: returns the object `name` of the namespace of `target`.
#define VIETE_RETURN_COMPILED(name, target) \
  VIETE_RETURN_AVX3(name, target)           \
  VIETE_RETURN_AVX2(name, target)           \
  VIETE_RETURN_SSE4(name, target)           \
  VIETE_RETURN_NEON(name, target)           \
  return N_SCALAR::name

#if defined(__x86_64__) || defined(__i386__)
#define VIETE_RETURN_AVX3(name, target) \
  if ((target) == HWY_AVX3) return N_AVX3::name;
#define VIETE_RETURN_AVX2(name, target) \
  if ((target) == HWY_AVX2) return N_AVX2::name;
#define VIETE_RETURN_SSE4(name, target) \
  if ((target) == HWY_SSE4) return N_SSE4::name;
#define VIETE_RETURN_NEON(name, target)
#elif defined(__aarch64__)
#define VIETE_RETURN_AVX3(name, target)
#define VIETE_RETURN_AVX2(name, target)
#define VIETE_RETURN_SSE4(name, target)
#define VIETE_RETURN_NEON(name, target) \
  if ((target) == HWY_NEON) return N_NEON::name;
#else
#define VIETE_RETURN_AVX3(name, target)
#define VIETE_RETURN_AVX2(name, target)
#define VIETE_RETURN_SSE4(name, target)
#define VIETE_RETURN_NEON(name, target)
#endif
