// The coefficients of the rotation exponential, and its way out at large angles. Internal; no inline functions.
#pragma once

namespace viete::sym3 {

/// cos(sqrt h) and sin(sqrt h) / (2 sqrt h) on 0 <= h <= 2.63: minimax, first coefficient kept exact, the
/// others rounded one after the other with a refit of the rest. Error 0.07 u and 0.002 u in double, 1.3 u and
/// 0.1 u in float (u = unit roundoff).
template <class T>
struct RotationTables;

template <>
struct RotationTables<double> {
  static constexpr double h_limit = 2.63;
  static constexpr double cosine[] = {1,
                                      -0x1.ffffffffffffbp-2,
                                      0x1.555555555535fp-5,
                                      -0x1.6c16c16c060c9p-10,
                                      0x1.a01a0197888c5p-16,
                                      -0x1.27e4f90a36103p-22,
                                      0x1.1eecc1ff6300ap-29,
                                      -0x1.9348c9b978ad7p-37,
                                      0x1.9e4b50f4cbd6ep-45};
  static constexpr double sine[] = {0.5,
                                    -0x1.5555555555555p-4,
                                    0x1.11111111110bep-8,
                                    -0x1.a01a01a013efcp-14,
                                    0x1.71de3a52246f8p-20,
                                    -0x1.ae6454932cf3cp-27,
                                    0x1.6123bb08176d3p-34,
                                    -0x1.ae3e84226c1b0p-42,
                                    0x1.87a537e1c6d70p-50};
};

template <>
struct RotationTables<float> {
  static constexpr float h_limit = 2.63f;
  static constexpr float cosine[] = {1, -0x1.ffffc6p-2f, 0x1.554e94p-5f, -0x1.6b1c82p-10f, 0x1.836f3ap-16f};
  static constexpr float sine[] = {0.5, -0x1.55554ap-4f, 0x1.110e82p-8f, -0x1.9f5faap-14f, 0x1.5cc5e0p-20f};
};

/// cos(|w| / 2) and sin(|w| / 2) / |w| at any finite w; NaN else. w is three numbers, the answer two.
void half_angle(const double* w, double* cosine_and_sine);
void half_angle(const float* w, float* cosine_and_sine);

}  // namespace viete::sym3
