// Polynomial coefficients for exp by method `fast`, and for the derivative. Internal.
#pragma once

namespace viete::sym3 {

/// tests/sym3/make_tables.cpp computes these tables and measures their errors.
/// `matrix_exp` times `lead` is a minimax polynomial for e^x, for |x| <= 2 sqrt(p_limit / 3): the range of
/// eigenvalues of A. The last coefficient of `matrix_exp` is 1. With the chosen `lead`, the value at 0 is 1
/// up to rounding. The error is 0.45 u (float 0.51 u), relative to max(e^x, e^(-x / 2)). The norm of exp(A)
/// is at least this maximum, because the other two eigenvalues of A sum to -x.
/// `scalar_exp` is a minimax polynomial for e^r, for |r| <= 0.3467: a little more than ln 2 / 2. The relative
/// error is 0.04 u (float 0.06 u).
template <class T>
struct ExpTables;

template <>
struct ExpTables<double> {
  static constexpr double p_limit = 8, trace_limit = 1500, exponent_limit = 2800;
  static constexpr int max_squarings = 7;
  static constexpr int mantissa_bits = 52;
  static constexpr double round_magic = 0x1.8p52, log2_e = 0x1.71547652b82fep0;
  static constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;  // n ln2_high is exact
  static constexpr double lead = 0x1.88b702c1a20bcp-66;
  static constexpr double matrix_exp[] = {
      0x1.4dc23888e53afp+65, 0x1.4dc23888e53afp+65, 0x1.4dc23888e53a5p+64, 0x1.bd02f60bdc4cfp+62,
      0x1.bd02f60bdc70ep+60, 0x1.64025e6fe3915p+58, 0x1.daadd33fd328fp+55, 0x1.0f3ec1db57c6fp+53,
      0x1.0f3ec1dc10dabp+50, 0x1.e236adf6e38edp+46, 0x1.81c557cabf935p+43, 0x1.188f85ebf4ad5p+40,
      0x1.7614b9b15ec06p+36, 0x1.cc6835f638cfep+32, 0x1.07164583a6869p+29, 0x1.18a1971462f6dp+25,
      0x1.18b85ef5fc3a7p+21, 0x1.081764ee83932p+17, 0x1.d1f73b1653797p+12, 0x1.8b40b5079cde0p+8,
      0x1.63637a85474b7p+4,  0x1.0000000000000p+0};
  static constexpr double scalar_exp[] = {
      0x1.0000000000000p+0,  0x1.0000000000000p+0,  0x1.000000000000ap-1,  0x1.5555555555504p-3,
      0x1.55555555506b7p-5,  0x1.1111111125707p-7,  0x1.6c16c1847938cp-10, 0x1.a01a0135e60a9p-13,
      0x1.a01999564844cp-16, 0x1.71df0cf7761fbp-19, 0x1.28ae0727ec680p-22, 0x1.ada449250c4e5p-26};
};

template <>
struct ExpTables<float> {
  static constexpr float p_limit = 16, trace_limit = 150, exponent_limit = 340;
  static constexpr int max_squarings = 4;
  static constexpr int mantissa_bits = 23;
  static constexpr float round_magic = 0x1.8p23f, log2_e = 0x1.715476p0f;
  static constexpr float ln2_high = 0x1.62e4p-1f, ln2_low = 0x1.7f7d1cp-20f;  // n ln2_high is exact
  static constexpr float lead = 0x1.f7b082p-41f;
  static constexpr float matrix_exp[] = {0x1.04394cp+40f, 0x1.04394cp+40f, 0x1.04394ep+39f, 0x1.5af70cp+37f,
                                         0x1.5af6dcp+35f, 0x1.1592c2p+33f, 0x1.721c58p+30f, 0x1.a6f0eep+27f,
                                         0x1.a6b9fcp+24f, 0x1.7831a8p+21f, 0x1.2ec56ep+18f, 0x1.b3f96ep+14f,
                                         0x1.126d7ap+11f, 0x1.674db4p+7f,  0x1.15e848p+4f,  0x1.000000p+0f};
  static constexpr float scalar_exp[] = {0x1.000000p+0f, 0x1.000000p+0f, 0x1.fffffcp-2f, 0x1.555492p-3f,
                                         0x1.5558b2p-5f, 0x1.123980p-7f, 0x1.6a4994p-10f};
};

/// A polynomial for exp whose derivative is minimax. The degree is one more than in ExpTables. The error is
/// 0.56 u (float 0.38 u), and the error of the derivative is 1.29 u (float 0.51 u). The derivative of the
/// polynomial in ExpTables has an error of 100 u.
template <class T>
struct ExpDerivativeTables;

template <>
struct ExpDerivativeTables<double> {
  static constexpr double lead = 0x1.1d78207914c65p-70;
  static constexpr double matrix_exp[] = {
      0x1.cb2551fa6172bp+69, 0x1.cb2551fa6172bp+69, 0x1.cb2551fa6172ap+68, 0x1.3218e151964c3p+67,
      0x1.3218e151964e3p+65, 0x1.e9c168828a330p+62, 0x1.4680f05706593p+60, 0x1.7525a4f5b9293p+57,
      0x1.7525a4f5d2094p+54, 0x1.4bafaf144a96dp+51, 0x1.095958da0af5dp+48, 0x1.81f65280dc76bp+44,
      0x1.014ee21adca05p+41, 0x1.3cafe1aa42eb6p+37, 0x1.69ed7fac18dcep+33, 0x1.820d4ba652a27p+29,
      0x1.820faf813cff9p+25, 0x1.6b791124b0ebdp+21, 0x1.42ea766219c6ap+17, 0x1.0dd050bcf02aep+13,
      0x1.b338d457f38eap+8,  0x1.755d3843840d9p+4,  0x1.0000000000000p+0};
};

template <>
struct ExpDerivativeTables<float> {
  static constexpr float lead = 0x1.f6d5b8p-45f;
  static constexpr float matrix_exp[] = {
      0x1.04aa86p+44f, 0x1.04aa86p+44f, 0x1.04aa86p+43f, 0x1.5b8e0ap+41f, 0x1.5b8dfcp+39f, 0x1.160b0ap+37f,
      0x1.72ba5ep+34f, 0x1.a7b46cp+31f, 0x1.a7a5eep+28f, 0x1.785fc4p+25f, 0x1.2d8592p+22f, 0x1.b957bcp+18f,
      0x1.22e2f8p+15f, 0x1.5170fcp+11f, 0x1.9c5c10p+7f,  0x1.2a7796p+4f,  0x1.000000p+0f};
};

}  // namespace viete::sym3
