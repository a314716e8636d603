// Polynomial coefficients for eigenvalues and logarithms. Internal.
#pragma once

namespace viete::sym3 {

/// With t = (2/3) atan(sqrt w) and 0 <= w <= 1, `sine` is sin(t) / sqrt w and `cosine` is cos(t). `atanh` is
/// atanh(s) / s as a polynomial in s^2 <= 0.0445. tests/sym3/make_tables.cpp interpolates the functions at
/// Chebyshev points. The errors are below 0.9 u (float 1.5 u).
template <class T>
struct SpectralTables;

template <>
struct SpectralTables<double> {
  static constexpr double sine[] = {0x1.5555555555555p-1,  -0x1.161f9add3c046p-2,  0x1.78732eb4764ecp-3,
                                    -0x1.2535e9131a7c5p-3, 0x1.e81891f99eba1p-4,   -0x1.a643350709fe4p-4,
                                    0x1.76a7da8d72052p-4,  -0x1.525f58e12e0f7p-4,  0x1.3592d8c6712d7p-4,
                                    -0x1.1daf84cbef5c5p-4, 0x1.083a3900c0b37p-4,   -0x1.e3a4199d8013ep-5,
                                    0x1.abfae37731971p-5,  -0x1.61e3072f1574dp-5,  0x1.063af28e3f06ap-5,
                                    -0x1.4cd47b5c688b2p-6, 0x1.58d998675a162p-7,   -0x1.141c5492c8255p-8,
                                    0x1.3d6b613bdbbc1p-10, -0x1.cf3517d8482a3p-13, 0x1.40d6b5d19050ap-16};
  static constexpr double cosine[] = {0x1.0000000000000p+0,  -0x1.c71c71c71c624p-3,  0x1.40436c82994d6p-3,
                                      -0x1.feac622783a0fp-4, 0x1.afdf9aa39d342p-4,   -0x1.7a09d187ae9d1p-4,
                                      0x1.527d3ce75998ep-4,  -0x1.33f5605165146p-4,  0x1.1b7579c8f50ebp-4,
                                      -0x1.06eb04efe35a7p-4, 0x1.e86c274f108f6p-5,   -0x1.c09600fb567edp-5,
                                      0x1.8e1452f0c49d1p-5,  -0x1.49dea33765623p-5,  0x1.e9a29a972f349p-6,
                                      -0x1.3713fa188bdf4p-6, 0x1.4291b50fa5665p-7,   -0x1.026b10e88dd04p-8,
                                      0x1.2933f9dcf54c1p-10, -0x1.b1d6c01f91b7dp-13, 0x1.2c910b5f904fap-16};
  static constexpr double atanh[] = {0x1.0000000000000p+0, 0x1.5555555555540p-2, 0x1.999999999fedep-3,
                                     0x1.2492491ee1937p-3, 0x1.c71c76e5395c5p-4, 0x1.745bcd107e126p-4,
                                     0x1.3b446712b78d3p-4, 0x1.0ce8a3d0aaab2p-4, 0x1.2112c3209801ap-4};
  static constexpr double smallest = 1e-80, largest = 1e80, condition = 0x1p33;
  static constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;
  static constexpr int mantissa_bits = 52, exponent_bias = 1023;
};

template <>
struct SpectralTables<float> {
  static constexpr float sine[] = {0x1.555556p-1f, -0x1.161f6ap-2f, 0x1.786680p-3f, -0x1.248c52p-3f,
                                   0x1.dedb8ap-4f, -0x1.7fd1a2p-4f, 0x1.0f30dap-4f, -0x1.266860p-5f,
                                   0x1.9c231ap-7f, -0x1.0d89d2p-9f};
  static constexpr float cosine[] = {0x1.000000p+0f,  -0x1.c71ab8p-3f, 0x1.401418p-3f,
                                     -0x1.faaa2ap-4f, 0x1.99524ap-4f,  -0x1.2ecb3ep-4f,
                                     0x1.61716cp-5f,  -0x1.0d068ep-6f, 0x1.7ed920p-9f};
  static constexpr float atanh[] = {0x1.000000p+0f, 0x1.555606p-2f, 0x1.98ff78p-3f, 0x1.39e286p-3f};
  static constexpr float smallest = 1e-9f, largest = 1e9f, condition = 0x1p12f;
  static constexpr float ln2_high = 0x1.62e4p-1f, ln2_low = 0x1.7f7d1cp-20f;
  static constexpr int mantissa_bits = 23, exponent_bias = 127;
};

}  // namespace viete::sym3
