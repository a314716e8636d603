// Polynomial coefficients for exp and log of rotations. Internal.
#pragma once

namespace viete::sym3 {

/// tests/sym3/make_tables.cpp computes these tables and measures their errors. The first coefficient of each
/// minimax polynomial is exact. The other coefficients were rounded one by one; after each rounding, the
/// remaining coefficients were fitted again.
/// `cosine` and `sine` approximate cos(sqrt h) and sin(sqrt h) / (2 sqrt h) for 0 <= h <= 2.63. The error of
/// `cosine` is 0.07 u (float 1.3 u), and the error of `sine` is 0.0021 u (float 0.07 u).
/// `arc_even` and `arc_odd` approximate atan(sqrt x) / sqrt x = even(x^2) + x * odd(x^2) for 0 <= x <= 1. The
/// relative error is 0.09 u (float 0.19 u).
template <class T>
struct RotationTables;

template <>
struct RotationTables<double> {
  static constexpr double h_limit = 2.63;
  static constexpr double cosine[] = {0x1.0000000000000p+0,   -0x1.ffffffffffffbp-2,  0x1.555555555535fp-5,
                                      -0x1.6c16c16c060c9p-10, 0x1.a01a0197888c5p-16,  -0x1.27e4f90a36103p-22,
                                      0x1.1eecc1ff6300ap-29,  -0x1.9348c9b978ad7p-37, 0x1.9e4b50f4cbd6ep-45};
  static constexpr double sine[] = {0x1.0000000000000p-1,   -0x1.5555555555555p-4,  0x1.11111111110bep-8,
                                    -0x1.a01a01a013efcp-14, 0x1.71de3a52246f8p-20,  -0x1.ae6454932cf3cp-27,
                                    0x1.6123bb08176d3p-34,  -0x1.ae3e84226c1b0p-42, 0x1.87a537e1c6d70p-50};
  static constexpr double arc_even[] = {0x1.0000000000000p+0,  0x1.99999999955aep-3, 0x1.c71c717fc9a75p-4,
                                        0x1.3b1366964b7f4p-4,  0x1.e1bba544a89adp-5, 0x1.82daca0e82478p-5,
                                        0x1.2c2e24bfded35p-5,  0x1.683c207b6bf51p-6, 0x1.d7b7c820ab3e4p-8,
                                        0x1.b3f9324ed6831p-11, 0x1.bbebbb6ddffc2p-17};
  static constexpr double arc_odd[] = {-0x1.5555555555526p-2, -0x1.249249237f3dfp-3, -0x1.745d11ae1644bp-4,
                                       -0x1.110e510ae73d9p-4, -0x1.ae5e6e38a3b49p-5, -0x1.59a3dfe2c5be0p-5,
                                       -0x1.e9f9714cdddd1p-6, -0x1.c78eb4a60a074p-7, -0x1.7a38588d29facp-9,
                                       -0x1.3f350949de839p-13};
};

template <>
struct RotationTables<float> {
  static constexpr float h_limit = 2.63f;
  static constexpr float cosine[] = {0x1.000000p+0f, -0x1.ffffc6p-2f, 0x1.554e94p-5f, -0x1.6b1c82p-10f,
                                     0x1.836f3ap-16f};
  static constexpr float sine[] = {0x1.000000p-1f, -0x1.55554ap-4f, 0x1.110e82p-8f, -0x1.9f5faap-14f,
                                   0x1.5cc5e0p-20f};
  static constexpr float arc_even[] = {0x1.000000p+0f, 0x1.9991e4p-3f, 0x1.c08c48p-4f, 0x1.da2886p-5f,
                                       0x1.63f382p-7f};
  static constexpr float arc_odd[] = {-0x1.55553ep-2f, -0x1.242086p-3f, -0x1.5808e4p-4f, -0x1.fd6faep-6f,
                                      -0x1.d290d8p-10f};
};

}  // namespace viete::sym3
