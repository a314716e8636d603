"""Compares the module `viete` with numpy: results, shapes, memory, errors."""

import concurrent.futures
import sys
import time
import tracemalloc
import unittest

import numpy as np
import viete

TYPES = (np.float64, np.float32)


def tolerance(dtype):
    return 256 * np.finfo(dtype).eps


def packed(full):
    """Converts symmetric matrices from the shape (..., 3, 3) to (..., 6)."""
    return np.ascontiguousarray(full[..., [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]])


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

    def test_undefined_results_are_nan(self):
        for f in (viete.log, viete.inv_sqrt):
            self.assertTrue(np.isnan(f(-np.eye(3))).all())
        self.assertTrue(np.isnan(viete.exp(np.full(6, np.nan))).all())

    def test_polar_gives_the_nearest_rotation_and_a_symmetric_stretch(self):
        for dtype in TYPES:
            m = np.random.default_rng(7).uniform(-1, 1, (500, 3, 3)).astype(dtype)
            m = m[np.abs(np.linalg.det(m)) > 0.1]
            r, u = viete.polar(m)
            self.assertEqual((r.dtype, u.dtype, r.shape, u.shape), (dtype, dtype, m.shape, m.shape))
            self.assert_close(r @ u, m, dtype)
            self.assert_close(np.swapaxes(r, -1, -2) @ r, np.broadcast_to(np.eye(3), r.shape), dtype)
            self.assertTrue((np.linalg.det(r) > 0).all())
            self.assertTrue((np.linalg.eigvalsh(u)[:, :2].sum(axis=1) > 0).all())  # then no rotation is nearer
            self.assertTrue(np.array_equal(u, np.swapaxes(u, -1, -2)))

    def test_eigh_agrees_with_numpy_in_both_forms(self):
        for dtype in TYPES:
            s = symmetric(dtype, 20, 30)
            w, v = viete.eigh(s)
            self.assertEqual((w.dtype, w.shape, v.shape), (dtype, (20, 30, 3), s.shape))
            self.assertLess(np.abs(w - np.linalg.eigh(s.astype(np.float64))[0]).max(), tolerance(dtype))
            self.assert_close((v * w[..., None, :]) @ np.swapaxes(v, -1, -2), s, dtype)
            self.assertTrue((np.linalg.det(v) > 0.9).all())
            for a, b in zip(viete.eigh(packed(s)), (w, v)):
                self.assertTrue(np.array_equal(a, b))

    def test_svd_agrees_with_numpy_and_has_rotations_if_signed(self):
        for dtype in TYPES:
            m = np.random.default_rng(8).uniform(-1, 1, (20, 30, 3, 3)).astype(dtype)
            u, s, vh = viete.svd(m)
            self.assertEqual((u.dtype, u.shape, s.shape, vh.shape), (dtype, m.shape, (20, 30, 3), m.shape))
            self.assertLess(np.abs(s - np.linalg.svd(m.astype(np.float64), compute_uv=False)).max(), tolerance(dtype))
            self.assertTrue((s >= 0).all())
            self.assert_close((u * s[..., None, :]) @ vh, m, dtype)
            u, s, vh = viete.svd(m, signed=True)
            self.assert_close((u * s[..., None, :]) @ vh, m, dtype)
            self.assertTrue((np.linalg.det(u) > 0.9).all() and (np.linalg.det(vh) > 0.9).all())
            self.assertTrue(np.array_equal(s[..., 2] < 0, np.linalg.det(m) < 0))
        self.assertEqual([x.shape for x in viete.svd(np.zeros((0, 3, 3)))], [(0, 3, 3), (0, 3), (0, 3, 3)])
        self.assertTrue(np.isnan(viete.svd(np.full((3, 3), np.inf))[1]).all())

    def test_polar_writes_into_a_pair_of_arrays(self):
        m = symmetric(np.float32, 150) + np.arange(9, dtype=np.float32).reshape(3, 3)
        (r, u), other = viete.polar(m), np.empty_like(m)
        self.assertIs(viete.polar(m, out=(m, other))[0], m)
        self.assertTrue(np.array_equal(m, r) and np.array_equal(other, u))


def affine(*shape):
    return np.eye(4) + np.pad(np.random.default_rng(10).uniform(-0.4, 0.4, shape + (3, 4)), len(shape) * [(0, 0)] + [(0, 1), (0, 0)])


class LogSpace(unittest.TestCase):
    """Tests affine maps (M. Alexa, 2002) and log-Euclidean means (V. Arsigny et al., 2006)."""

    def assert_equal(self, a, b, error=1e-12):
        self.assertEqual((a.shape, a.dtype), (b.shape, b.dtype))
        np.testing.assert_allclose(a, b, rtol=error, atol=error)

    def test_exp_undoes_logarithms_on_any_branch(self):
        for m in (affine(50), affine(2, 3)[..., :3, :3], affine(5).astype(np.float32)):
            self.assertTrue(viete.affine_has_log(m).all())
            self.assert_equal(viete.affine_exp(viete.affine_log(m)), m, tolerance(m.dtype))
        turns = 2 * np.pi * np.array([-1, 0, 2])
        logs = (0.5 + turns)[:, None, None] * np.array([[0, -1, 0], [1, 0, 0], [0, 0, 0]])
        self.assert_equal(viete.affine_log(viete.affine_exp(logs[1]), near=turns[:, None] * [0, 0, 1]), logs)
        self.assert_equal(viete.affine_interpolate(np.eye(3), viete.affine_exp(logs[1]), 0.5, near=(0, 0, 12)), viete.affine_exp(logs[2] / 2))

    def test_maps_without_a_logarithm_get_a_bounded_one(self):
        for m in (np.diag([1.0, 2.0, -1.0]), np.zeros((3, 3)), np.zeros((4, 4))):
            self.assertFalse(viete.affine_has_log(m))
            self.assertTrue(np.isfinite(viete.affine_log(m)).all() and np.isfinite(viete.affine_log(m, near=(0, 0, 7))).all())

    def test_sums_means_and_interpolation_broadcast(self):
        m, w, c = affine(4, 5), np.array([0.4, 0.1, 0.2, 0.2, 0.1]), affine(1)[0]
        self.assert_equal(viete.affine_combine(m, w), viete.affine_exp(np.einsum("k,ikab->iab", w, viete.affine_log(m))))
        self.assert_equal(viete.affine_mean(c @ m, w)[0], c @ viete.affine_mean(m, w)[0])
        steps = viete.affine_interpolate(m[0], m[1], np.linspace(0, 1, 3)[:, None])
        for step, expected in zip(steps, (m[0], viete.affine_mean(m[:2].swapaxes(0, 1))[0], m[1])):
            self.assert_equal(step, expected)
        a, b = positive(np.float64, 2, 7)
        self.assert_equal(viete.interpolate(packed(a), packed(b), 0.5), packed(viete.mean(np.stack([a, b], axis=1))))
        determinants = np.linalg.det(viete.interpolate(a[0], b[0], np.linspace(0, 1, 7)))
        self.assert_equal(np.log(determinants), np.linspace(*np.log(np.linalg.det([a[0], b[0]])), 7))

    def test_weights_and_powers_may_have_any_size(self):
        table = {(1e308, 1e308): (0.5, 0.5), (1.5e308, 0.5e308): (0.75, 0.25), (5e-324, 1.5e-323): (0.25, 0.75), (1e308, 1e-320): (1, 0),
                 (-1e308, -1e308): (0.5, 0.5), (-3e-320, -3e-320): (0.5, 0.5), (1.5e308, -0.5e308): (1.5, -0.5)}
        weights, shares, maps = list(table), list(table.values()), affine(2)
        for a in (positive(np.float64, 2), positive(np.float32, 2)):
            sums = np.einsum("nk,kij->nij", shares, viete.log(a)).astype(a.dtype)
            self.assert_equal(viete.mean(a, weights), viete.exp(sums), tolerance(a.dtype))
            self.assert_equal(viete.pow(a, 1e-320), np.broadcast_to(np.eye(3, dtype=a.dtype), a.shape))
        self.assert_equal(viete.pow(np.eye(3), 1e308), np.eye(3))
        means, converged = viete.affine_mean(maps, weights)
        self.assertTrue(converged.all())
        self.assert_equal(means, viete.affine_mean(maps, shares)[0])
        self.assert_equal(viete.affine_combine([20 * maps[0]] * 3, [1e308, 0.25, -1e308]), np.eye(4))


def derivative_by_eigenvalues(f, slope, s, e):
    """Computes the derivative by divided differences. Eigenvalues must be well separated or equal."""
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


class Derivatives(unittest.TestCase):
    def assert_close(self, a, b, dtype):
        error = np.linalg.norm(a.astype(np.float64) - b, axis=(-1, -2)) / np.linalg.norm(b, axis=(-1, -2))
        self.assertLess(error.max(), 20 * tolerance(dtype))

    def test_every_derivative_agrees_with_numpy_in_one_direction_and_in_several(self):
        for name, (derivative, _, f, slope) in DERIVATIVES.items():
            for dtype in TYPES:
                with self.subTest(name=name, dtype=dtype.__name__):
                    s, e = positive(dtype, 203), symmetric(dtype, 4, 203)
                    s[:10] = np.eye(3)  # equal eigenvalues
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


class Arrays(unittest.TestCase):
    def test_arrays_too_large_for_memory_are_memory_errors(self):
        s = np.eye(3)
        matrices = np.broadcast_to(s, (10**15, 3, 3))  # a view without memory; a copy or a result would need exabytes
        for name, call in {
            **{name: lambda f=f: f(matrices) for name, (f, _, _) in FUNCTIONS.items()},
            **{name + "_derivative": lambda d=d: d(s, matrices) for name, (d, _, _, _) in DERIVATIVES.items()},
            **{name + "_tangent": lambda t=t: t(matrices) for name, (_, t, _, _) in DERIVATIVES.items()},
            "polar": lambda: viete.polar(matrices),
            "eigh": lambda: viete.eigh(matrices),
            "svd": lambda: viete.svd(matrices),
            "mean": lambda: viete.mean(matrices),
            "interpolate": lambda: viete.interpolate(s, s, np.broadcast_to(0.5, 10**16)),
            "affine_log": lambda: viete.affine_log(s, near=np.broadcast_to(0.0, (10**15, 3))),
            "affine_has_log": lambda: viete.affine_has_log(matrices),
            "affine_mean": lambda: viete.affine_mean(matrices),
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

    def test_only_the_upper_triangle_is_read_and_the_input_kept(self):
        s = symmetric(np.float64, 10)
        upper = np.triu(s)
        self.assertTrue(np.array_equal(viete.exp(upper), viete.exp(s)))
        self.assertTrue(np.array_equal(upper, np.triu(symmetric(np.float64, 10))))

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
        self.addCleanup(sys.setswitchinterval, interval)

        def seen_running():
            call = pool.submit(viete.exp, s, s)
            time.sleep(1e-4)  # usually, the call starts during this time
            return call.running()

        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            self.assertTrue(any(seen_running() for _ in range(1000)))


class Errors(unittest.TestCase):
    def test_wrong_arguments_are_named(self):
        s, six, pair, m = symmetric(np.float64, 5), np.zeros((4, 6)), np.stack([np.eye(3), 2 * np.eye(3)]), np.zeros((5, 3, 3))
        read_only = np.zeros((4, 6))
        read_only.flags.writeable = False
        wrong_shapes = [np.zeros(shape) for shape in ((), (3,), (5,), (2, 3), (3, 4), (6, 1))]
        for error, words, call in [
            *[(viete.Error, r"viete.exp: .*\(\.\.\., 6\).*\(", lambda a=a: viete.exp(a)) for a in wrong_shapes],
            (viete.Error, "viete.polar", lambda: viete.polar(six)),
            (viete.Error, "viete.svd", lambda: viete.svd(six)),
            (viete.Error, "viete.eigh", lambda: viete.eigh(np.zeros((3, 4)))),
            (TypeError, "viete.log: .*complex128", lambda: viete.log(np.zeros(6, complex))),
            (TypeError, "viete.exp: .*float16", lambda: viete.exp(np.zeros(6, np.float16))),
            (TypeError, "viete.exp", lambda: viete.exp("six numbers")),
            (TypeError, "viete.exp", lambda: viete.exp(None)),
            (viete.Error, r"out has shape \(5, 6\)", lambda: viete.exp(six, out=np.zeros((5, 6)))),
            (TypeError, "out is float32", lambda: viete.exp(six, out=np.zeros((4, 6), np.float32))),
            (TypeError, "out must be an array; this is a list", lambda: viete.exp(six, out=[0] * 24)),
            (viete.Error, "out is not contiguous", lambda: viete.exp(six, out=np.zeros((4, 12))[:, ::2])),
            (viete.Error, "out is read-only", lambda: viete.exp(six, out=read_only)),
            (viete.Error, "out overlaps", lambda: viete.exp(s[:4], out=s[1:])),
            (viete.Error, "u in out must not share memory", lambda: viete.polar(s, out=(m, s))),
            (viete.Error, "u in out must not share memory", lambda: viete.polar(s, out=(m, m))),
            (viete.Error, "out overlaps the matrices", lambda: viete.exp_derivative(s, s[::-1].copy(), out=s)),
            *[(viete.Error, "viete.exp_derivative: directions", lambda e=e: viete.exp_derivative(s, e))
              for e in (packed(s), s[:4], s[None, None], np.zeros((5, 3)))],
            (viete.Error, "expected several", lambda: viete.mean(np.eye(3))),
            (viete.Error, "no matrices", lambda: viete.mean(pair[:0])),
            (viete.Error, "sum to 0", lambda: viete.mean(pair, [1e308, -1e308])),
            (viete.Error, "sum to 0", lambda: viete.mean(pair[[0, 0, 1]], [0.1, 0.2, -0.3])),
            (viete.Error, "there are 2 matrices; weights have shape", lambda: viete.mean(pair, [1])),
            (TypeError, "float32, float64 or integers", lambda: viete.interpolate(pair[0], pair[1], None)),
            (viete.Error, "t contains a number that is not finite", lambda: viete.interpolate(pair[0], pair[1], np.inf)),
            (viete.Error, "sum to 0", lambda: viete.affine_mean(pair, [[1, 1], [0, 0]])),
            (viete.Error, "weights must end in axes", lambda: viete.affine_combine(pair, [1, 2, 3])),
            (viete.Error, "maps must end in axes", lambda: viete.affine_exp(np.zeros((3, 4)))),
            (viete.Error, "viete.interpolate: .*broadcast", lambda: viete.interpolate(s, pair, 0.5)),
            (viete.Error, "viete.interpolate: .*broadcast", lambda: viete.interpolate(s, s, np.zeros(3))),
            (viete.Error, "viete.mean: .*broadcast", lambda: viete.mean(np.zeros((2, 5, 6)), np.ones((3, 5)))),
            (viete.Error, "viete.affine_interpolate: .*broadcast", lambda: viete.affine_interpolate(s, pair, 0.5)),
        ]:
            with self.subTest(words), self.assertRaisesRegex(error, words):
                call()


class Module(unittest.TestCase):
    def test_it_knows_its_version_and_its_kernel(self):
        self.assertRegex(viete.__version__, r"^\d+\.\d+\.\d+$")
        self.assertTrue(viete.kernel())


if __name__ == "__main__":
    unittest.main()
