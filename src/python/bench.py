"""Compares functions of many matrices with numpy and scipy in one run: PYTHONPATH=build/python /usr/bin/python3 src/python/bench.py

Prints medians over alternating rounds. For errors see `viete bench accuracy`.
Skips scipy if it is not installed (apt-get install python3-scipy).
"""
import sys
import time

import numpy as np
import viete

try:
    import scipy.linalg
except ImportError:
    scipy = None

COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
FEW = 1000  # for functions that take one matrix at a time


def by_eigh(f):
    def apply(a):
        values, vectors = np.linalg.eigh(a)
        return (vectors * f(values)[..., None, :]) @ np.swapaxes(vectors, -1, -2)
    return apply


def one_by_one(f):
    return lambda a: np.array([f(m) for m in a])


def times(ways, rounds=7):
    """Nanoseconds a matrix, the median over rounds that alternate between the candidates."""
    all_of = {name: [] for name in ways}
    for _ in range(rounds):
        for name, (f, a) in ways.items():
            begun = time.perf_counter()
            f(a)
            all_of[name].append(1e9 * (time.perf_counter() - begun) / len(a))
    return {name: float(np.median(t)) for name, t in all_of.items()}


def main():
    rng = np.random.default_rng(1)
    m = rng.uniform(-1, 1, (COUNT, 3, 3))
    symmetric, positive = (m + np.swapaxes(m, -1, -2)) / 2, m @ np.swapaxes(m, -1, -2) + 0.1 * np.eye(3)
    single, packed = np.float32(positive), np.ascontiguousarray(positive[..., [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]])
    print("%d matrices, kernel %s; nanoseconds a matrix" % (COUNT, viete.kernel()))
    print("%-6s %10s %10s %10s %12s %12s" % ("", "viete", "(..., 6)", "float32", "numpy eigh", "scipy"))
    for name, f, a in (("exp", np.exp, symmetric), ("log", np.log, positive), ("sqrt", np.sqrt, positive)):
        ours = getattr(viete, name)
        ways = {"viete": (ours, a), "packed": (ours, packed), "single": (ours, single), "eigh": (by_eigh(f), a)}
        if scipy:
            theirs = {"exp": scipy.linalg.expm, "log": scipy.linalg.logm, "sqrt": scipy.linalg.sqrtm}[name]
            ways["scipy"] = (one_by_one(theirs), a[:FEW])
        t = times(ways)
        assert np.allclose(ours(a[:FEW]), by_eigh(f)(a[:FEW]), atol=1e-12)
        print("%-6s %10.1f %10.1f %10.1f %12.1f %12s" % (
            name, t["viete"], t["packed"], t["single"], t["eigh"], "%.1f" % t["scipy"] if scipy else "-"))


main()
