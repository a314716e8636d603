"""Tests of the module `viete` against numpy: results, shapes, memory, errors."""

import importlib.util
import sys
import threading
import tracemalloc
import unittest

import numpy as np
import viete

TYPES = (np.float64, np.float32)


def tolerance(dtype):
    return 256 * np.finfo(dtype).eps


def packed(full):
    """Converts (..., 3, 3) to (..., 6): the upper triangle by rows."""
    return np.ascontiguousarray(full[..., [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]])


def full(six):
    return np.ascontiguousarray(six[..., [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(six.shape[:-1] + (3, 3)))


def symmetric(dtype, *shape):
    m = np.random.default_rng(5).uniform(-1, 1, shape + (3, 3))
    return (m + np.swapaxes(m, -1, -2)).astype(dtype)


def positive(dtype, *shape):
    m = np.random.default_rng(6).uniform(-1, 1, shape + (3, 3))
    return (m @ np.swapaxes(m, -1, -2) + 0.5 * np.eye(3)).astype(dtype)


def by_eigenvalues(f, s):
    values, vectors = np.linalg.eigh(s.astype(np.float64))
    return (vectors * f(values)[..., None, :]) @ np.swapaxes(vectors, -1, -2)


FUNCTIONS = {
    "exp": (viete.exp, np.exp, symmetric),
    "log": (viete.log, np.log, positive),
    "sqrt": (viete.sqrt, np.sqrt, positive),
    "inv_sqrt": (viete.inv_sqrt, lambda x: 1 / np.sqrt(x), positive),
    "pow": (lambda a, out=None: viete.pow(a, 0.3, out), lambda x: x**0.3, positive),
}


class Answers(unittest.TestCase):
    def assert_close(self, a, b, dtype):
        a, b = a.astype(np.float64), b.astype(np.float64)
        error = np.linalg.norm(a - b, axis=(-1, -2)) / np.linalg.norm(b, axis=(-1, -2))
        self.assertLess(error.max(), tolerance(dtype))

    def test_every_function_agrees_with_numpy_in_both_forms_and_types(self):
        for name, (f, g, matrices) in FUNCTIONS.items():
            for dtype in TYPES:
                with self.subTest(name=name, dtype=dtype.__name__):
                    s = matrices(dtype, 1003)
                    expected = by_eigenvalues(g, s)
                    answer = f(s)
                    self.assertEqual(answer.dtype, dtype)
                    self.assert_close(answer, expected, dtype)
                    self.assertTrue(np.array_equal(packed(answer), f(packed(s))))
                    self.assertTrue(np.array_equal(answer, np.swapaxes(answer, -1, -2)))

    def test_powers_agree_with_numpy(self):
        s = positive(np.float64, 100)
        self.assert_close(viete.pow(s, -1), np.linalg.inv(s), np.float64)
        self.assert_close(viete.pow(s, 2), s @ s, np.float64)
        self.assert_close(viete.sqrt(s) @ viete.sqrt(s), s, np.float64)
        self.assert_close(viete.exp(viete.log(s)), s, np.float64)

    def test_undefined_results_are_nan(self):
        for f in (viete.log, viete.inv_sqrt):
            self.assertTrue(np.isnan(f(-np.eye(3))).all())
        self.assertTrue(np.isnan(viete.exp(np.full(6, np.nan))).all())

    def test_polar_gives_a_rotation_and_a_symmetric_stretch(self):
        for dtype in TYPES:
            m = np.random.default_rng(7).uniform(-1, 1, (500, 3, 3)).astype(dtype)
            m = m[np.abs(np.linalg.det(m)) > 0.1]
            r, u = viete.polar(m)
            self.assertEqual((r.dtype, u.dtype, r.shape, u.shape), (dtype, dtype, m.shape, m.shape))
            self.assert_close(r @ u, m, dtype)
            self.assert_close(np.swapaxes(r, -1, -2) @ r, np.broadcast_to(np.eye(3), r.shape), dtype)
            self.assertTrue((np.linalg.det(r) > 0).all())
            self.assertTrue(np.array_equal(u, np.swapaxes(u, -1, -2)))

    def test_polar_agrees_with_the_singular_values(self):
        m = np.random.default_rng(8).uniform(-1, 1, (500, 3, 3)) + 2 * np.eye(3)
        m = m[np.linalg.det(m) > 0.1]
        left, values, right = np.linalg.svd(m)
        r, u = viete.polar(m)
        self.assert_close(r, left @ right, np.float64)
        self.assert_close(u, np.swapaxes(right, -1, -2) @ (values[..., None] * right), np.float64)

    def test_polar_writes_into_a_pair_of_arrays(self):
        for dtype in TYPES:
            m = np.random.default_rng(9).uniform(-1, 1, (150, 3, 3)).astype(dtype)
            r, u = viete.polar(m)
            given = np.empty_like(m), np.empty_like(m)
            got = viete.polar(m, out=given)
            self.assertTrue(got[0] is given[0] and got[1] is given[1])
            self.assertTrue(np.array_equal(given[0], r) and np.array_equal(given[1], u))
            viete.polar(m, out=(m, given[1]))
            self.assertTrue(np.array_equal(m, r) and np.array_equal(given[1], u))
        for text, out in (("out must be a pair", m), ("must not share memory", (given[0], m)),
                          ("must not share memory", (given[0], given[0])),
                          (r"out has shape \(3, 3\)", (given[0], np.zeros((3, 3), dtype)))):
            with self.assertRaisesRegex(ValueError, text):
                viete.polar(m, out=out)


EXTREME_WEIGHTS = [  # two weights, and their normalised values
    ([1e308, 1e308], [0.5, 0.5]), ([1.5e308, 0.5e308], [0.75, 0.25]), ([3e-320, 3e-320], [0.5, 0.5]),
    ([5e-324, 1.5e-323], [0.25, 0.75]), ([1e308, 1e-320], [1, 0]), ([-1e308, -1e308], [0.5, 0.5]),
    ([-3e-320, -3e-320], [0.5, 0.5]), ([1.5e308, -0.5e308], [1.5, -0.5]), ([-1, -3], [0.25, 0.75]),
]


def turn_about_z(angle, shift=(0, 0, 0)):
    m = np.eye(4)
    m[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    m[:3, 3] = shift
    return m


def affine(*shape):
    m = np.zeros(shape + (4, 4))
    m[..., :3, :] = np.random.default_rng(10).uniform(-0.4, 0.4, shape + (3, 4))
    return m + np.eye(4)


class AffineMaps(unittest.TestCase):
    def test_exp_undoes_log(self):
        for m in (affine(50), affine(2, 3)[..., :3, :3]):
            l = viete.affine_log(m)
            self.assertEqual(l.shape, m.shape)
            self.assertTrue(viete.affine_has_log(m).all())
            np.testing.assert_allclose(viete.affine_exp(l), m, atol=1e-14)
        self.assertTrue((viete.affine_log(affine(5))[..., 3, :] == 0).all())
        self.assertEqual(viete.affine_log(affine(5).astype(np.float32)).dtype, np.float32)

    def test_affine_log_of_a_symmetric_map_is_the_symmetric_log(self):
        s = positive(np.float64, 50)
        np.testing.assert_allclose(viete.affine_log(s), viete.log(s), atol=1e-13)

    def test_half_of_a_half_turn_is_a_quarter_turn(self):
        half = viete.affine_combine(turn_about_z(np.pi)[None], [0.5])
        np.testing.assert_allclose(half, turn_about_z(np.pi / 2), atol=1e-15)

    def test_logs_follow_a_branch(self):
        m = turn_about_z(0.5)
        for turns in (-1, 0, 2):
            l = viete.affine_log(m, near=(0, 0, 0.4 + 2 * np.pi * turns))
            self.assertAlmostEqual(l[1, 0], 0.5 + 2 * np.pi * turns, places=13)
        self.assertEqual(viete.affine_log(m, near=np.zeros((7, 3))).shape, (7, 4, 4))

    def test_interpolation_goes_from_one_map_to_the_other_over_any_axes(self):
        a, b = affine(6)[:3], affine(6)[3:]
        np.testing.assert_array_equal(viete.affine_interpolate(a, b, 0), a)
        np.testing.assert_allclose(viete.affine_interpolate(a, b, 1), b, atol=1e-13)
        way = viete.affine_interpolate(a[0], b[0], np.linspace(0, 1, 11))
        self.assertEqual(way.shape, (11, 4, 4))
        np.testing.assert_allclose(way[5], viete.affine_interpolate(b[0], a[0], 0.5), atol=1e-13)
        back = viete.affine_interpolate(turn_about_z(0), turn_about_z(1), 0.5, near=(0, 0, -5))
        np.testing.assert_allclose(back, turn_about_z(0.5 - np.pi), atol=1e-14)

    def test_combinations_use_sums_of_logs_and_means_are_invariant(self):
        m, w = affine(4, 5), np.array([0.4, 0.1, 0.2, 0.2, 0.1])
        sums = np.einsum("k,ikab->iab", w, viete.affine_log(m))
        np.testing.assert_allclose(viete.affine_combine(m, w), viete.affine_exp(sums), atol=1e-13)
        mean, converged = viete.affine_mean(m, w)
        self.assertTrue(converged.all())
        c = affine(1)[0]
        np.testing.assert_allclose(viete.affine_mean(c @ m, w)[0], c @ mean, atol=1e-12)
        np.testing.assert_allclose(viete.affine_mean(m @ c, w)[0], mean @ c, atol=1e-12)
        np.testing.assert_allclose(viete.affine_mean(m)[0], viete.affine_mean(m, np.full((4, 5), 3.0))[0], atol=1e-13)

    def test_means_of_maps_take_weights_of_any_size(self):
        m = affine(2)
        for weights, share in EXTREME_WEIGHTS:
            with self.subTest(weights=weights):
                mean, converged = viete.affine_mean(m, weights)
                self.assertTrue(converged)
                np.testing.assert_allclose(mean, viete.affine_mean(m, share)[0], atol=1e-12)

    def test_opposite_terms_of_a_combination_cancel_at_any_size(self):
        m = turn_about_z(2, (3, 0, 0))  # its log is above 1, so terms overflow
        np.testing.assert_allclose(viete.affine_combine([m, m, m], [1e308, 0.25, -1e308]), np.eye(4), atol=1e-15)

    def test_maps_without_a_log_get_a_bounded_one(self):
        mirror = np.diag([1.0, 2.0, -1.0])
        self.assertFalse(viete.affine_has_log(mirror))
        self.assertTrue(np.isfinite(viete.affine_log(mirror)).all())
        for nothing in (np.zeros((3, 3)), np.zeros((4, 4))):
            self.assertFalse(viete.affine_has_log(nothing))
            self.assertTrue(np.isfinite(viete.affine_log(nothing)).all())
            self.assertTrue(np.isfinite(viete.affine_log(nothing, near=(0, 0, 7))).all())
        self.assertTrue(np.isnan(viete.affine_log(np.full((3, 3), np.nan))).all())

    def test_wrong_shapes_are_rejected(self):
        for f in (viete.affine_log, viete.affine_exp, viete.affine_has_log):
            with self.assertRaisesRegex(ValueError, r"viete.affine_.*\(\.\.\., 4, 4\)"):
                f(np.zeros((3, 4)))
        with self.assertRaisesRegex(ValueError, "there are 2 maps; weights have shape"):
            viete.affine_combine(affine(2), [1, 2, 3])
        with self.assertRaisesRegex(ValueError, "there are no maps"):
            viete.affine_mean(affine(0))
        with self.assertRaisesRegex(ValueError, "near is"):
            viete.affine_log(affine(2), near=(1, 2))
        with self.assertRaisesRegex(ValueError, "not of the same size"):
            viete.affine_interpolate(np.eye(3), np.eye(4), 0.5)


def derivative_by_eigenvalues(f, slope, s, e):
    """Reference by divided differences, for well separated or equal eigenvalues."""
    x, v = np.linalg.eigh(s.astype(np.float64))
    gap = x[..., :, None] - x[..., None, :]
    near = np.abs(gap) < 1e-6
    slopes = np.where(near, slope((x[..., :, None] + x[..., None, :]) / 2),
                      (f(x)[..., :, None] - f(x)[..., None, :]) / np.where(near, 1, gap))
    t = np.swapaxes(v, -1, -2)
    return v @ (slopes * (t @ e.astype(np.float64) @ v)) @ t


DERIVATIVES = {
    "exp": (viete.exp_derivative, viete.exp_tangent, np.exp, np.exp),
    "log": (viete.log_derivative, viete.log_tangent, np.log, lambda x: 1 / x),
    "sqrt": (viete.sqrt_derivative, viete.sqrt_tangent, np.sqrt, lambda x: 0.5 / np.sqrt(x)),
    "pow": (lambda a, e, out=None: viete.pow_derivative(a, 0.3, e, out), lambda a: viete.pow_tangent(a, 0.3),
            lambda x: x**0.3, lambda x: 0.3 * x**-0.7),
}


class Means(unittest.TestCase):
    """Means and interpolation in log space (V. Arsigny et al., 2006)."""

    def test_the_determinant_of_a_mean_is_the_geometric_mean(self):
        for a in (positive(np.float64, 5, 40), packed(positive(np.float64, 5, 40))):
            mean = viete.mean(a)
            six = a.shape[-1] == 6
            self.assertEqual(mean.shape, (5, 6) if six else (5, 3, 3))
            det = lambda s: np.linalg.det(full(s) if six else s)
            self.assertTrue(np.allclose(np.log(det(mean)), np.log(det(a)).mean(axis=-1)))

    def test_weights_count_by_their_share(self):
        a = positive(np.float64, 4)
        self.assertTrue(np.allclose(viete.mean(a, [0, 5, 0, 0]), a[1]))
        self.assertTrue(np.allclose(viete.mean(a, [1, 1, 1, 1]), viete.mean(a)))
        twice = np.stack([a, a[::-1]])
        weights = np.array([[1, 2, 3, 4], [4, 3, 2, 1]])
        means = viete.mean(twice, weights)
        self.assertTrue(np.allclose(means[0], means[1]))
        self.assertEqual(viete.mean(a.astype(np.float32)).dtype, np.float32)

    def test_weights_of_any_size_count_by_their_share(self):
        for a in (positive(np.float64, 2), positive(np.float32, 2)):
            for weights, share in EXTREME_WEIGHTS:
                with self.subTest(weights=weights, dtype=a.dtype):
                    np.testing.assert_allclose(viete.mean(a, weights), viete.mean(a, share), rtol=1e-6)
        rows = [w for w, _ in EXTREME_WEIGHTS]
        np.testing.assert_allclose(viete.mean(a, rows)[2], viete.mean(a, rows[2]))  # weights have more axes

    def test_interpolation_goes_from_one_to_the_other(self):
        a, b = positive(np.float64, 7), positive(np.float64, 7)[::-1].copy()
        self.assertTrue(np.allclose(viete.interpolate(a, b, 0), a))
        self.assertTrue(np.allclose(viete.interpolate(a, b, 1), b))
        self.assertTrue(np.allclose(viete.interpolate(a, b, 0.5), viete.mean(np.stack([a, b], axis=1))))
        t = np.linspace(0, 1, 7)
        self.assertTrue(np.allclose(viete.interpolate(a, b, t)[3], viete.interpolate(a[3], b[3], t[3])))
        way = viete.interpolate(a[0], b[0], t)
        self.assertEqual(way.shape, (7, 3, 3))
        self.assertTrue(np.allclose(np.diff(np.log(np.linalg.det(way)), 2), 0))

    def test_one_matrix_has_no_mean(self):
        with self.assertRaisesRegex(ValueError, "expected several"):
            viete.mean(np.eye(3))

    def test_undefined_means_are_rejected(self):
        pair = np.stack([np.eye(3), 2 * np.eye(3)])
        for problem, error, words in [
            (lambda: viete.mean(pair[:0]), ValueError, "no matrices"),
            (lambda: viete.mean(pair, [1, -1]), ValueError, "sum to 0"),
            (lambda: viete.mean(pair, [1e308, -1e308]), ValueError, "sum to 0"),
            (lambda: viete.mean(np.stack([*pair, *pair])[:3], [0.1, 0.2, -0.3]), ValueError, "sum to 0"),
            (lambda: viete.mean(pair, [1]), ValueError, "there are 2 matrices; weights have shape"),
            (lambda: viete.affine_mean(pair, [[1, 1], [1e308, -1e308]]), ValueError, "sum to 0"),
            (lambda: viete.mean(pair, [1, np.nan]), ValueError, "not finite"),
            (lambda: viete.interpolate(pair[0], pair[1], None), TypeError, "float32, float64 or integers"),
            (lambda: viete.interpolate(pair[0], pair[1], np.inf), ValueError, "not finite"),
            (lambda: viete.affine_mean(pair, [0, 0]), ValueError, "sum to 0"),
            (lambda: viete.affine_combine(pair, [0, np.nan]), ValueError, "not finite"),
            (lambda: viete.affine_log(pair[0], near=[0, 0, np.nan]), ValueError, "not finite"),
        ]:
            with self.subTest(words), self.assertRaisesRegex(error, words):
                problem()


class Derivatives(unittest.TestCase):
    def assert_close(self, a, b, dtype):
        error = np.linalg.norm(a.astype(np.float64) - b, axis=(-1, -2)) / np.linalg.norm(b, axis=(-1, -2))
        self.assertLess(error.max(), 20 * tolerance(dtype))

    def test_every_derivative_agrees_with_numpy_in_one_direction_and_in_several(self):
        for name, (derivative, _, f, slope) in DERIVATIVES.items():
            for dtype in TYPES:
                with self.subTest(name=name, dtype=dtype.__name__):
                    s, e = positive(dtype, 203), symmetric(dtype, 4, 203)
                    several = derivative(s, e)
                    self.assertEqual((several.dtype, several.shape), (dtype, e.shape))
                    self.assert_close(several, derivative_by_eigenvalues(f, slope, s, e), dtype)
                    self.assertTrue(np.array_equal(derivative(s, e[1]), several[1]))
                    self.assertTrue(np.array_equal(derivative(packed(s), packed(e)), packed(several)))

    def test_tangent_contains_all_derivatives(self):
        six = np.broadcast_to(np.eye(6)[:, None], (6, 50, 6))
        for name, (derivative, tangent, _, _) in DERIVATIVES.items():
            for dtype in TYPES:
                s = positive(dtype, 50)
                t = tangent(s)
                self.assertEqual((t.dtype, t.shape), (dtype, (50, 6, 6)))
                self.assertTrue(np.array_equal(t, tangent(packed(s))))
                expected = np.swapaxes(derivative(packed(s), six.astype(dtype)), 0, 1)
                self.assertLess(np.abs(t - expected).max() / np.abs(expected).max(), tolerance(dtype))

    def test_out_receives_the_derivatives_and_may_be_the_directions(self):
        s, e = symmetric(np.float64, 30), symmetric(np.float64, 2, 30)
        expected = viete.exp_derivative(s, e)
        out = np.empty_like(e)
        self.assertIs(viete.exp_derivative(s, e, out=out), out)
        self.assertTrue(np.array_equal(out, expected))
        self.assertIs(viete.exp_derivative(s, e, out=e), e)
        self.assertTrue(np.array_equal(e, expected))
        with self.assertRaisesRegex(ValueError, "out overlaps the matrices"):
            viete.exp_derivative(s, s[::-1].copy(), out=s)

    def test_directions_of_another_shape_are_refused(self):
        s = symmetric(np.float64, 5)
        for e in (packed(s), s[:4], s[None, None], np.zeros((5, 3))):
            with self.assertRaisesRegex(ValueError, "viete.exp_derivative: directions"):
                viete.exp_derivative(s, e)

    @unittest.skipIf(importlib.util.find_spec("scipy") is None, "SciPy is not installed")
    def test_derivatives_of_exp_agree_with_those_of_scipy(self):
        from scipy.linalg import expm_frechet
        s, e = positive(np.float64, 40), symmetric(np.float64, 40)
        s[:10] = np.eye(3)  # equal eigenvalues
        expected = np.array([expm_frechet(a, b, compute_expm=False) for a, b in zip(s, e)])
        self.assert_close(viete.exp_derivative(s, e), expected, np.float64)


class Arrays(unittest.TestCase):
    def test_arrays_too_large_for_memory_are_memory_errors(self):
        # Broadcast views without memory; a copy or a result would need exabytes.
        matrices, maps, planes = (np.broadcast_to(a, (10**15,) + a.shape) for a in (np.eye(3), np.eye(4), np.eye(3)[0]))
        s, e = np.eye(3), matrices
        numbers = np.broadcast_to(np.float64(0.5), (10**16,))
        for name, call in {
            **{name: lambda f=f: f(matrices) for name, (f, _, _) in FUNCTIONS.items()},
            **{name + "_derivative": lambda d=d: d(s, e) for name, (d, _, _, _) in DERIVATIVES.items()},
            **{name + "_tangent": lambda t=t: t(matrices) for name, (_, t, _, _) in DERIVATIVES.items()},
            "polar": lambda: viete.polar(matrices),
            "mean": lambda: viete.mean(matrices),
            "weights": lambda: viete.mean(np.stack([s, s]), np.broadcast_to(numbers[:1], (10**16, 2))),
            "interpolate": lambda: viete.interpolate(s, matrices, 0.5),
            "interpolate t": lambda: viete.interpolate(s, s, numbers),
            "affine_log": lambda: viete.affine_log(maps),
            "affine_log near": lambda: viete.affine_log(np.eye(4), near=planes),
            "affine_exp": lambda: viete.affine_exp(maps),
            "affine_has_log": lambda: viete.affine_has_log(maps),
            "affine_interpolate": lambda: viete.affine_interpolate(np.eye(4), np.eye(4), numbers),
            "affine_combine": lambda: viete.affine_combine(maps[:, None], [1.0]),
            "affine_mean": lambda: viete.affine_mean(maps),
            "integers": lambda: viete.exp(np.broadcast_to(np.int8(1), (10**15, 6))),
        }.items():
            with self.subTest(name), self.assertRaises(MemoryError):
                call()

    def test_any_number_of_leading_axes_is_kept(self):
        for shape in ((), (1,), (0,), (7,), (2, 3), (2, 0, 3), (2, 3, 4, 5)):
            s = symmetric(np.float64, *shape)
            self.assertEqual(viete.exp(s).shape, shape + (3, 3))
            self.assertEqual(viete.exp(packed(s)).shape, shape + (6,))

    def test_strides_byte_order_and_alignment_do_not_change_the_answer(self):
        s = symmetric(np.float64, 50)
        expected = viete.exp(s)
        unaligned = np.frombuffer(b"x" + s.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(s.shape)
        for other in (np.asfortranarray(s), np.repeat(s, 2, axis=0)[::2], s.astype(">f8"), unaligned):
            self.assertTrue(np.array_equal(viete.exp(other), expected))

    def test_integers_and_lists_are_computed_in_double(self):
        answer = viete.exp([[0, 1, 0], [1, 0, 0], [0, 0, 0]])
        self.assertEqual(answer.dtype, np.float64)
        self.assertAlmostEqual(answer[0, 0], np.cosh(1), places=15)

    def test_only_the_upper_triangle_is_read(self):
        s = symmetric(np.float64, 10)
        self.assertTrue(np.array_equal(viete.exp(np.triu(s)), viete.exp(s)))

    def test_the_input_is_left_as_it_was(self):
        s = symmetric(np.float64, 10)
        before = s.copy()
        viete.exp(s)
        self.assertTrue(np.array_equal(s, before))

    def test_out_receives_the_answers_and_is_returned(self):
        s = symmetric(np.float32, 11)
        expected = viete.exp(s)
        out = np.empty_like(s)
        self.assertIs(viete.exp(s, out=out), out)
        self.assertTrue(np.array_equal(out, expected))
        self.assertIs(viete.exp(s, out=s), s)
        self.assertTrue(np.array_equal(s, expected))

    def test_contiguous_arrays_are_not_copied(self):
        for dtype in TYPES:
            for s in (symmetric(dtype, 20000), packed(symmetric(dtype, 20000))):
                out = np.empty_like(s)
                tracemalloc.start()
                viete.exp(s, out=out)
                peak = tracemalloc.get_traced_memory()[1]
                tracemalloc.stop()
                self.assertLess(peak, 10000)

    def test_other_threads_run_during_a_call(self):
        s = np.zeros((200000, 6))
        interval = sys.getswitchinterval()
        sys.setswitchinterval(1e6)  # the interpreter does not switch threads by itself
        try:
            self.assertTrue(any(self.saw_a_call_running(s) for _ in range(1000)))
        finally:
            sys.setswitchinterval(interval)

    def saw_a_call_running(self, s):
        started, state = threading.Event(), {"running": False}

        def work():
            state["running"] = True
            started.set()
            viete.exp(s, out=s)
            state["running"] = False

        thread = threading.Thread(target=work)
        thread.start()
        started.wait()
        seen = state["running"]
        thread.join()
        return seen


class Errors(unittest.TestCase):
    def assert_raises(self, error, text, f, *arguments, **named):
        with self.assertRaisesRegex(error, text):
            f(*arguments, **named)

    def test_wrong_shapes_say_what_is_expected_and_what_came(self):
        for shape in ((), (3,), (5,), (2, 3), (3, 4), (6, 1)):
            self.assert_raises(ValueError, r"viete.exp: .*\(\.\.\., 6\).*\(", viete.exp, np.zeros(shape))
        self.assert_raises(ValueError, "viete.polar", viete.polar, np.zeros((4, 6)))

    def test_wrong_types_are_named(self):
        self.assert_raises(TypeError, "viete.log: .*complex128", viete.log, np.zeros(6, complex))
        self.assert_raises(TypeError, "viete.exp: .*float16", viete.exp, np.zeros(6, np.float16))
        self.assert_raises(TypeError, "viete.exp", viete.exp, "six numbers")
        self.assert_raises(TypeError, "viete.exp", viete.exp, None)

    def test_an_out_that_does_not_fit_is_refused(self):
        s = np.zeros((4, 6))
        self.assert_raises(ValueError, r"out has shape \(5, 6\)", viete.exp, s, out=np.zeros((5, 6)))
        self.assert_raises(TypeError, "out is float32", viete.exp, s, out=np.zeros((4, 6), np.float32))
        self.assert_raises(TypeError, "out must be an array; this is a list", viete.exp, s, out=[0] * 24)
        self.assert_raises(ValueError, "out is not contiguous", viete.exp, s, out=np.zeros((4, 12))[:, ::2])
        read_only = np.zeros((4, 6))
        read_only.flags.writeable = False
        self.assert_raises(ValueError, "out is read-only", viete.exp, s, out=read_only)
        both = np.zeros((5, 6))
        self.assert_raises(ValueError, "out overlaps", viete.exp, both[:4], out=both[1:])


class Module(unittest.TestCase):
    def test_it_knows_its_version_and_its_kernel(self):
        self.assertRegex(viete.__version__, r"^\d+\.\d+\.\d+$")
        self.assertTrue(viete.kernel())


if __name__ == "__main__":
    unittest.main()
