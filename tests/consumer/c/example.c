/* Uses the C header from C: all layouts must give equal results, and invalid arguments must be rejected. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <viete/sym3/c.h>

enum { count = 1000 };

static double packed[6 * count], planes[6 * count], full[9 * count], odd[21 * count], answers[6 * count], other[21 * count];
static const int upper[6] = {0, 1, 2, 4, 5, 8};

static void check(int holds, const char* what) {
  if (holds) return;
  printf("wrong: %s\n", what);
  exit(1);
}

static double entry(int i, int k) {
  return (k == 0 || k == 3 || k == 5) + 0.3 * sin(i + 7.0 * k);
}

int main(void) {
  const viete_layout one = {1, 6}, plane = {count, 1}, nine = {0, 9}, strange = {3, 21}, wide = {0, 21};
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < 6; ++k) {
      packed[6 * i + k] = planes[count * k + i] = full[9 * i + upper[k]] = odd[21 * i + 3 * k] = entry(i, k);
    }
  check(viete_exp(packed, one, answers, one, count) == 0, "exp");
  /* det exp(S) = exp(trace S) */
  for (int i = 0; i < count; ++i) {
    const double* e = answers + 6 * i;
    const double det = e[0] * (e[3] * e[5] - e[4] * e[4]) - e[1] * (e[1] * e[5] - e[4] * e[2]) + e[2] * (e[1] * e[4] - e[3] * e[2]);
    check(fabs(log(det) - packed[6 * i] - packed[6 * i + 3] - packed[6 * i + 5]) < 1e-12, "the determinant of exp");
  }
  check(viete_exp(planes, plane, planes, plane, count) == 0, "planes in place");
  check(viete_exp(odd, strange, other, wide, count) == 0, "strides");
  check(viete_exp(full, nine, full, nine, count) == 0, "nine entries in place");
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < 6; ++k) {
      const double e = answers[6 * i + k];
      check(planes[count * k + i] == e, "planes are the same");
      check(full[9 * i + upper[k]] == e && other[21 * i + upper[k]] == e, "nine entries are the same");
      check(other[21 * i + 3] == other[21 * i + 1] && full[9 * i + 7] == full[9 * i + 5], "both triangles are written");
    }
  check(viete_log(answers, one, answers, one, count) == 0, "log in place");
  for (int i = 0; i < 6 * count; ++i) check(fabs(answers[i] - packed[i]) < 1e-13, "log of exp");

  float single[6] = {4, 0, 0, 9, 0, 16};
  const float rotation[9] = {0, -2, 0, 3, 0, 0, 0, 0, 4};
  float r[9], u[6];
  check(viete_sqrt_f(single, one, single, one, 1) == 0 && fabsf(single[0] - 2) + fabsf(single[3] - 3) + fabsf(single[5] - 4) < 1e-5f, "sqrt of floats");
  check(viete_polar_f(rotation, (viete_layout){1, 9}, r, (viete_layout){1, 9}, u, one, 1) == 0, "polar");
  check(fabsf(r[3] - 1) < 1e-6f && fabsf(u[0] - 3) < 1e-5f && fabsf(u[3] - 2) < 1e-5f, "its rotation and stretch");
  float values[3], v[9];
  const viete_layout three = {1, 3}, rows = {1, 9};
  check(viete_svd_f(rotation, rows, r, rows, values, three, v, rows, 1) == 0, "svd");
  check(fabsf(values[0] - 4) + fabsf(values[1] - 3) + fabsf(values[2] - 2) < 1e-5f, "the singular values");
  check(viete_eigh_f(u, one, values, three, v, rows, 1) == 0, "eigh");
  check(fabsf(values[0] - 2) + fabsf(values[1] - 3) + fabsf(values[2] - 4) < 1e-5f, "the eigenvalues");
  check(viete_eigh_f(u, one, values, (viete_layout){0, 9}, v, rows, 1) == -1, "a vector has no upper triangle");
  check(viete_exp(NULL, one, answers, one, 1) == -1, "null is refused");
  check(viete_exp(packed, (viete_layout){1, 0}, answers, one, 1) == -1, "a stride of 0 is refused");
  check(viete_polar_f(rotation, nine, r, (viete_layout){1, 9}, u, one, 1) == -1, "a general matrix has no upper triangle");
  check(viete_exp(packed, one, answers, one, 0) == 0, "none at all");
  check(strlen(viete_kernel()) > 2, "the kernel");
  printf("C agrees, by %s\n", viete_kernel());
  return 0;
}
