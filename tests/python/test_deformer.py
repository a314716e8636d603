"""test_deformer.py PROGRAM ASSETS: tests the deformer of the module `viete`, and compares it with the program."""

import concurrent.futures
import gc
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import unittest.mock

import numpy as np
import viete

PROGRAM, ASSETS = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]) / "dragon"
CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
CUBE_FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def ball(n=12):
    """Returns a sphere of triangles inside the cube."""
    u, v = np.meshgrid(np.linspace(0.2, np.pi - 0.2, n), np.linspace(0, 2 * np.pi, n, endpoint=False), indexing="ij")
    places = 0.8 * np.stack([np.sin(u) * np.cos(v), np.sin(u) * np.sin(v), np.cos(u)], axis=-1).reshape(-1, 3)
    at = lambda i, j: i * n + j % n
    faces = [t for i in range(n - 1) for j in range(n)
             for t in ([at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)])]
    return places, np.array(faces, np.int32)


def run(*words):
    subprocess.run([str(PROGRAM), *map(str, words)], check=True, capture_output=True)


def turned(points, angle):
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Dragon(WithFolder):
    @classmethod
    def setUpClass(cls):
        cls.dragon, cls.cage = viete.read(ASSETS / "dragon.ply"), viete.read(ASSETS / "cage.obj")
        cls.pose = viete.read(ASSETS / "pose_alert.obj").vertices

    def bound(self, **words):
        return viete.Deformer(self.dragon.vertices, self.dragon.faces, self.cage.vertices, self.cage.faces, **words)

    def test_it_has_the_bits_of_the_command_line(self):
        for words, options in [({}, []), ({"deformer": "mean-value"}, ["--deformer", "mean-value"]),
                               ({"deformer": "paper", "method": "improved_sd", "rotation": 0.5},
                                ["--deformer", "paper", "--method", "improved_sd", "--rotation", "50"])]:
            out = self.folder / "out.ply"
            run("deform", ASSETS / "dragon.ply", ASSETS / "cage.obj", "--pose", ASSETS / "pose_alert.obj", *options,
                "-o", out, "--force")
            asked = self.folder / "asked.ply"
            viete.write(asked, self.dragon, vertices=self.bound(**words).deform(self.pose))
            with self.subTest(words):
                self.assertEqual(out.read_bytes(), asked.read_bytes())

    def test_normals_are_of_length_1_and_near_in_both_types(self):
        _, exact_normals = self.bound().deform(self.pose, normals=True)
        fast, normals = self.bound(dtype="float32").deform(self.pose, normals=True)
        self.assertEqual(fast.dtype, np.float32)
        for n in (exact_normals, normals):
            self.assertLess(np.abs(np.linalg.norm(n, axis=1) - 1).max(), 1e-5)
        self.assertLess(np.median(np.abs(normals - exact_normals)), 1e-3)

    def test_float32_is_as_near_to_float64_as_the_help_says(self):
        rest = np.asarray(self.cage.vertices)
        size = lambda points: np.linalg.norm(np.ptp(points, axis=0))
        noise = 0.03 * size(rest) * np.random.default_rng(1).normal(size=rest.shape)
        poses = [self.pose, viete.read(ASSETS / "pose_coil.obj").vertices, rest + noise, 3 * rest]
        for deformer in ("smooth", "paper", "mean-value", "rigid", "arap", "local"):
            exact, fast = self.bound(deformer=deformer), self.bound(deformer=deformer, dtype="float32")
            for i, pose in enumerate(poses):
                with self.subTest(deformer=deformer, pose=i):
                    error = np.linalg.norm(fast.deform(pose) - exact.deform(pose), axis=1).max()
                    self.assertLess(error, 1e-4 * max(size(rest), size(pose)))

    def test_session_frames_equal_viete_animate(self):
        session = viete.Session(ASSETS / "loop.viete")
        self.assertEqual(session.range, [1, 121])
        run("animate", ASSETS / "loop.viete", "--frames", "12-13", "-o", self.folder / "f_###.obj",
            "--digits", "all")
        for frame in (12, 13):
            written = viete.read(self.folder / f"f_{frame:03}.obj").vertices
            self.assertTrue(np.array_equal(session.frame(frame), written))

    def test_shapes_are_those_of_the_command_line(self):
        run("between", ASSETS / "dragon.ply", ASSETS / "shape_coiled.pc2", "--at", "0.5", "--digits", "all",
            "-o", self.folder / "half.obj")
        run("mix", ASSETS / "dragon.ply", "--shape", f"{ASSETS / 'shape_coiled.pc2'}=0.5", "--digits", "all",
            "-o", self.folder / "mix.obj")
        rest = self.dragon.vertices
        coiled = np.fromfile(ASSETS / "shape_coiled.pc2", "<f4", offset=32).reshape(-1, 3).astype(float)
        between = viete.ShapeSpace(rest, self.dragon.faces, [rest, coiled]).between(0.5)
        mixed = viete.ShapeSpace(rest, self.dragon.faces, [coiled]).mix([0.5])
        for ours, file in ((between, "half.obj"), (mixed, "mix.obj")):
            self.assertTrue(np.array_equal(ours, viete.read(self.folder / file).vertices))


class Arrays(WithFolder):
    def setUp(self):
        super().setUp()
        self.model, self.faces = ball()
        self.pose = CUBE * [1.5, 1, 1] + [0, 0.25, 0]

    def bound(self, **words):
        return viete.Deformer(self.model, self.faces, CUBE, CUBE_FACES, **words)

    def test_any_order_strides_and_types_of_input_give_the_same(self):
        expected = self.bound().deform(self.pose)
        wide = np.zeros((16, 6))
        wide[::2, ::2] = self.pose
        for pose in (np.asfortranarray(self.pose), wide[::2, ::2], self.pose.astype(np.float32), self.pose.tolist()):
            self.assertTrue(np.array_equal(self.bound().deform(pose), expected))
        same = viete.Deformer(np.asfortranarray(self.model), self.faces.astype(np.int64).tolist(), CUBE.tolist(),
                              [np.array(f, np.uint8) for f in CUBE_FACES])
        self.assertTrue(np.array_equal(same.deform(self.pose), expected))

    def test_out_receives_results(self):
        d = self.bound()
        expected, expected_normals = d.deform(self.pose, normals=True)
        count = len(self.model)
        out, normals = np.empty((count, 3)), np.empty((count, 3))
        answer = d.deform(self.pose, out=out, normals=normals)
        self.assertIs(answer[0], out)
        self.assertIs(answer[1], normals)
        self.assertTrue(np.array_equal(out, expected) and np.array_equal(normals, expected_normals))
        single = np.empty((count, 3), np.float32)
        self.assertIs(d.deform(self.pose, out=single), single)
        self.assertLess(np.abs(single - expected).max(), 1e-5)

    def test_an_object_without_init_is_refused(self):
        class Early(viete.Deformer):
            def __init__(self):
                self.notes

        with self.assertRaisesRegex(TypeError, "__init__"):
            Early()
        for kind in (viete.Deformer, viete.ShapeSpace, viete.PoseSpace, viete.Session, viete.Surface):
            empty = kind.__new__(kind)
            for name in dir(kind):
                if not name.startswith("_"):
                    with self.subTest(kind.__name__ + "." + name), self.assertRaises(TypeError):
                        getattr(empty, name)()
        with self.assertRaises(TypeError):
            viete.write(self.folder / "a.obj", viete.Surface.__new__(viete.Surface))

    @unittest.skipUnless(hasattr(os, "fork"), "there is no fork here")
    def test_forked_child_works_while_a_parent_thread_computes(self):
        deformer, shapes = self.bound(threads=3), viete.ShapeSpace(self.model, self.faces, [self.model * 2])
        poses = viete.PoseSpace(CUBE, CUBE_FACES, [CUBE * 2])
        for name, work in [
            ("deform", lambda: deformer.deform(self.pose)),
            ("mix", lambda: shapes.mix([0.5])),
            ("pose", lambda: shapes.pose([0], [self.model[0] * 1.5])[0]),
            ("mix of poses", lambda: poses.mix([0.5])),
        ]:
            expected, stop = work(), threading.Event()

            def repeat():
                while not stop.is_set():
                    work()

            thread = threading.Thread(target=repeat)
            thread.start()
            for _ in range(10):
                child = os.fork()
                if child == 0:
                    signal.alarm(60)  # timeout
                    os._exit(0 if np.array_equal(work(), expected) else 1)
                with self.subTest(name):
                    self.assertEqual(os.waitpid(child, 0)[1], 0)
            stop.set()
            thread.join()

    @unittest.skipUnless(hasattr(os, "fork"), "there is no fork here")
    def test_works_without_threads(self):
        expected = self.bound().deform(self.pose)
        child = os.fork()
        if child == 0:
            signal.alarm(60)  # timeout
            pages = int(pathlib.Path("/proc/self/statm").read_text().split()[0])
            most = pages * resource.getpagesize() + (1 << 30)
            resource.setrlimit(resource.RLIMIT_AS, (most, most))
            os._exit(0 if np.array_equal(self.bound(threads=600).deform(self.pose), expected) else 1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)

    def test_arrays_are_not_kept(self):
        model, pose = self.model.copy(), self.pose.copy()
        d = viete.Deformer(model, self.faces, CUBE, CUBE_FACES)
        expected = d.deform(pose)
        model[:] = np.nan
        self.assertTrue(np.array_equal(d.deform(pose), expected))
        first = expected.copy()
        d.deform(pose + 1)
        self.assertTrue(np.array_equal(first, expected))

    def test_moved_cage_moves_the_model_equally(self):
        for deformer in ("smooth", "paper", "mean-value", "rigid", "arap"):
            for dtype in ("float64", "float32"):
                with self.subTest((deformer, dtype)):
                    moved = self.bound(deformer=deformer, dtype=dtype).deform(turned(CUBE, 0.7) + 1)
                    self.assertLess(np.abs(moved - (turned(self.model, 0.7) + 1)).max(), 1e-5)

    def test_wrong_arrays_are_rejected(self):
        d = self.bound()
        count = len(self.model)
        read_only = np.empty((count, 3))
        read_only.flags.writeable = False
        shared = np.empty((count + 1, 3))
        shapes = viete.ShapeSpace(self.model, self.faces, [self.model * 2])
        nan = self.pose.copy()
        nan[3, 1] = np.nan
        for problem, error, words in [
            (lambda: d.deform(self.pose[:-1]), viete.Error, "7 places for 8 vertices"),
            (lambda: d.deform(nan), viete.Error, "vertex 3 has a coordinate that is not finite"),
            (lambda: d.deform(self.pose[:, :2]), viete.Error, "(n, 3)"),
            (lambda: d.deform(self.pose.astype(complex)), TypeError, "float32, float64 or integers"),
            (lambda: d.deform(None), TypeError, ""),
            (lambda: d.deform(self.pose, out=np.empty((count, 4))), viete.Error, "out has shape"),
            (lambda: d.deform(self.pose, out=np.empty((count, 3), int)), TypeError, "out is int64"),
            (lambda: d.deform(self.pose, out=np.empty((count, 6))[:, ::2]), viete.Error, "out is not contiguous"),
            (lambda: d.deform(self.pose, out=read_only), viete.Error, "read-only"),
            (lambda: d.deform(self.pose, out=shared[1:], normals=shared[:-1]), viete.Error, "share memory"),
            (lambda: d.deform(self.pose, out=np.empty((count, 3)), normals=np.empty((count, 3), np.float32)), TypeError, "normals is float32"),
            (lambda: viete.Deformer(self.model, [[0, 1, 99999]], CUBE, CUBE_FACES), viete.Error, "vertex 99999"),
            (lambda: viete.Deformer(self.model, [[0, 1, -1]], CUBE, CUBE_FACES), viete.Error, "start at 0"),
            (lambda: viete.Deformer(self.model, [[0, 1]], CUBE, CUBE_FACES), viete.Error, "fewer than three"),
            (lambda: viete.Deformer(self.model, [[0.5, 1, 2]], CUBE, CUBE_FACES), TypeError, "must be integers"),
            (lambda: self.bound(deformer="smoth"), viete.Error, "choose one of smooth"),
            (lambda: self.bound(deformer="smooth", rotation=3), viete.Error, "rotation"),
            (lambda: self.bound(method="fats"), viete.Error, "improved_sd"),
            (lambda: self.bound(dtype="int32"), TypeError, "dtype"),
            (lambda: viete.read(self.folder / "none.obj"), viete.Error, "none.obj"),
            (lambda: viete.write(self.folder / "a.xyz", CUBE, CUBE_FACES), viete.Error, "a.xyz"),
            (lambda: viete.make_cage(self.model, self.faces, triangles=3), viete.Error, "triangles"),
            (lambda: viete.Session(self.folder / "a.obj"), viete.Error, "session"),
            (lambda: d.deform(self.pose * 1e80), viete.Error, "within 1e60"),
            (lambda: d.deform(self.pose * 1e50, out=np.empty((count, 3), np.float32)), viete.Error, "exceeds the range of float"),
            (lambda: d.set_mask([]), viete.Error, "mask is empty"),
            (lambda: d.set_shape(np.zeros((0, 3))), viete.Error, "shape is empty"),
            (lambda: d.set_shape(self.model * 1e70), viete.Error, "the shape: it has a coordinate of size"),
            (lambda: viete.ShapeSpace(self.model, self.faces, [self.model * 1e70]), viete.Error, "a shape: it has a coordinate"),
            (lambda: viete.PoseSpace(CUBE, CUBE_FACES, [CUBE * 1e70]), viete.Error, "a pose: it has a coordinate"),
            (lambda: shapes.pose([5], self.model[[5]] * 1e70), viete.Error, "the places: it has a coordinate"),
            (lambda: viete.Deformer(self.model, np.zeros((4, 0), int), CUBE, CUBE_FACES), viete.Error, "fewer than three"),
            (lambda: viete.Deformer(self.model, np.array([[0, 1, 2**64 - 1]], np.uint64), CUBE, CUBE_FACES), viete.Error, "invalid vertex index"),
            (lambda: viete.Deformer(self.model * 1e-200, self.faces, CUBE, CUBE_FACES), viete.Error, "1e-60 or more"),
            (lambda: viete.Deformer(self.model, self.faces, CUBE * 1e80, CUBE_FACES), viete.Error, "the cage: it has a coordinate of size 1e"),
            (lambda: viete.ShapeSpace(self.model, self.faces, [self.model * 3]).mix([1000]), viete.Error, "nearer to 0"),
            (lambda: self.bound(radius=100, deformer="local"), viete.Error, "choose 0.001 to 10"),
            (lambda: self.bound(deformer="smooth", radius=0.2), viete.Error, "choose the weights cutoff"),
            (lambda: self.bound(threads=100000), viete.Error, "choose 0 to 1024"),
            (lambda: viete.make_cage(self.model, self.faces, margin=0), viete.Error, "choose 0.0005 to 0.2"),
            (lambda: viete.make_cage(self.model, self.faces, triangles=-5), viete.Error, "12 to 20000"),
            (lambda: viete.write(self.folder / "a.glb", np.zeros((0, 3)), []), viete.Error, "no vertices to write"),
            (lambda: shapes.pose([], np.zeros((0, 3))), viete.Error, "pass one or more"),
            (lambda: shapes.pose([5, 5], self.model[[5, 5]]), viete.Error, "vertex 5 is given twice"),
            (lambda: viete.read("\udcff.obj"), viete.Error, "\udcff.obj"),
        ]:
            with self.subTest(words):
                with self.assertRaisesRegex(error, words.replace("(", "\\(").replace(")", "\\)")) as raised:
                    problem()
                self.assertNotIn("--", str(raised.exception))
        self.assertTrue(issubclass(viete.Error, ValueError))
        self.assertEqual(d.deform(self.pose).shape, (count, 3))  # the errors have not changed the deformer

    def test_arrays_too_large_for_memory_are_memory_errors(self):
        rows = np.broadcast_to(np.zeros(3), (10**16, 3))  # a view without memory
        faces = np.broadcast_to(np.array([0, 1, 2], np.int32), (10**16, 3))
        d = self.bound()
        for name, call in {
            "vertices": lambda: viete.Deformer(rows, self.faces, CUBE, CUBE_FACES),
            "faces": lambda: viete.Deformer(self.model, faces, CUBE, CUBE_FACES),
            "deform": lambda: d.deform(rows),
            "set_mask": lambda: d.set_mask(np.broadcast_to(0.5, (10**17,))),
            "set_shape": lambda: d.set_shape(rows),
            "make_cage": lambda: viete.make_cage(rows, self.faces),
            "write": lambda: viete.write(self.folder / "a.obj", rows, self.faces),
            "ShapeSpace": lambda: viete.ShapeSpace(self.model, self.faces, [rows]),
            "PoseSpace": lambda: viete.PoseSpace(CUBE, CUBE_FACES, [rows]),
            "pose": lambda: viete.ShapeSpace(self.model, self.faces, [self.model]).pose([0], rows),
        }.items():
            with self.subTest(name), self.assertRaises(MemoryError):
                call()

    def test_masks_and_shapes_act(self):
        d = self.bound()
        all_of_it = d.deform(self.pose)
        d.set_mask(np.zeros(len(self.model)))
        self.assertTrue(np.allclose(d.deform(self.pose), self.model))
        d.set_mask(None)
        self.assertTrue(np.array_equal(d.deform(self.pose), all_of_it))
        d.set_shape(self.model * 0.5)
        self.assertLess(np.abs(d.deform(CUBE) - 0.5 * self.model).max(), 1e-12)

    def test_keeps_turns_accumulates_rotations(self):
        space = viete.PoseSpace(CUBE, CUBE_FACES, [CUBE, turned(CUBE, 2.5)])
        self.assertLess(np.abs(space.between(0.5) - turned(CUBE, 1.25)).max(), 1e-9)
        self.assertLess(np.abs(space.between(0.5, linear=True) - 0.5 * (CUBE + turned(CUBE, 2.5))).max(), 1e-12)
        self.assertTrue(np.array_equal(space.mix([0, 1]), turned(CUBE, 2.5)))
        shapes = viete.ShapeSpace(self.model, self.faces, [turned(self.model, 1.0)])
        self.assertLess(np.abs(shapes.mix([2]) - turned(self.model, 2.0)).max(), 1e-6)
        places, weights = shapes.pose([0, 50, 100], turned(self.model, 1.0)[[0, 50, 100]])
        self.assertEqual(len(weights), 1)
        self.assertLess(np.abs(places[[0, 50, 100]] - turned(self.model, 1.0)[[0, 50, 100]]).max(), 1e-6)

    def test_made_cage_encloses_the_model(self):
        vertices, faces = viete.make_cage(self.model, self.faces, triangles=60)
        self.assertLessEqual(len(faces), 90)
        deformed = viete.Deformer(self.model, self.faces, vertices, faces).deform(vertices * 2)
        self.assertLess(np.abs(deformed - 2 * self.model).max(), 1e-9)
        box, quads = viete.make_cage(self.model, self.faces, kind="box", cells=(2, 1, 1))
        self.assertTrue((box.min(axis=0) <= self.model.min(axis=0)).all())

    def test_files_keep_what_they_had(self):
        source = self.folder / "a.obj"
        source.write_text("# mine\no box\n" + "".join("v %g %g %g\n" % tuple(v) for v in CUBE) +
                          "vt 0 0\nvt 1 1\n" + "".join("f " + " ".join(f"{c + 1}/1" for c in f) + "\n" for f in CUBE_FACES))
        surface = viete.read(source)
        self.assertEqual(surface.faces.shape, (6, 4))
        viete.write(self.folder / "b.obj", surface, vertices=2 * CUBE)
        text = (self.folder / "b.obj").read_text()
        self.assertIn("# mine", text)
        self.assertIn("vt 1 1", text)
        self.assertTrue(np.array_equal(viete.read(self.folder / "b.obj").vertices, 2 * CUBE))
        mixed = CUBE_FACES[:5] + [[1, 5, 7], [1, 7, 3]]
        viete.write(self.folder / "c.ply", CUBE, mixed)
        again = viete.read(self.folder / "c.ply").faces
        self.assertEqual([list(f) for f in again], mixed)

    @unittest.skipUnless((PROGRAM.parent / "viete-import").exists(), "built without Assimp and decoders")
    def test_foreign_and_compressed_files_are_read_by_viete_import(self):
        with unittest.mock.patch.dict(os.environ, VIETE_IMPORT=str(PROGRAM.parent / "viete-import")):
            folder = pathlib.Path(__file__).parents[1] / "foreign"
            surface, packed = viete.read(folder / "smile.fbx"), viete.read(folder / "packed.gltf")
        self.assertEqual(packed.vertices.shape, (16, 3))
        self.assertIn("decompressed", packed.notes[-1])
        self.assertEqual(surface.vertices.tolist(), [[0, 3, 0], [1, 3, 0], [1, 3, -1], [0, 3, -1]])
        self.assertEqual(surface.faces.tolist(), [[0, 1, 2, 3]])
        self.assertIn("y is up", surface.notes[0])

    def test_threads_work_in_parallel(self):
        deformers = (self.bound(), self.bound(deformer="paper"))
        expected = [d.deform(self.pose) for d in deformers]
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            for i, answer in enumerate(pool.map(lambda i: deformers[i % 2].deform(self.pose), range(150))):
                self.assertTrue(np.array_equal(answer, expected[i % 2]))

    def test_signals_cancel_only_long_work(self):
        class Stop(Exception):
            pass

        def stop(*_):
            raise Stop

        places, faces = ball(250)
        before = signal.signal(signal.SIGALRM, stop)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        cage, cage_faces = viete.make_cage(CUBE, CUBE_FACES, 12)
        works = (lambda: viete.make_cage(places, faces, 20000),
                 lambda: viete.Deformer(places, faces, *viete.make_cage(places, faces, kind="box", cells=(30, 30, 30))),
                 lambda: viete.ShapeSpace(places, faces, 400 * [places]))
        for number, work in enumerate(works):
            signal.setitimer(signal.ITIMER_REAL, 0.2)
            with self.subTest(number), self.assertRaises(Stop):
                work()
        d = viete.Deformer(CUBE, CUBE_FACES, cage, cage_faces)
        self.assertLess(np.abs(d.deform(cage) - CUBE).max(), 1e-9)

    def test_memoryviews_are_arrays(self):
        moved = np.stack([self.model * 2, self.model * 3])
        shapes = viete.ShapeSpace(memoryview(self.model), memoryview(self.faces), memoryview(moved))
        self.assertLess(np.abs(shapes.mix(memoryview(np.array([1.0, 0.0]))) - self.model * 2).max(), 1e-9)
        with self.assertRaises(ValueError):
            shapes.mix(memoryview(np.ones((2, 2))))

    def test_memory_does_not_grow(self):
        d = self.bound(dtype="float32")
        out = np.empty((len(self.model), 3), np.float32)

        def frames(count):
            for i in range(count):
                d.deform(CUBE * (1 + 1e-4 * i), out=out)
            gc.collect()
            return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

        before = frames(1000)
        self.assertLess(frames(9000) - before, 2048)  # kB

    def test_import_is_fast(self):
        """If numpy is not needed, the module does not import it, because the import is slow."""
        code = "import sys, viete; assert 'numpy' not in sys.modules; viete.exp([[0.0] * 6]); assert 'numpy' in sys.modules"
        subprocess.run([sys.executable, "-c", code], check=True)

    def test_everything_has_a_docstring(self):
        for name in dir(viete):
            if not name.startswith("_"):
                self.assertTrue(getattr(viete, name).__doc__, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
