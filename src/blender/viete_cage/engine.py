"""Deformers for Blender's meshes. Uses the module `viete` or, if Python cannot import it, the program viete."""
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np

try:
    import viete
except ImportError:  # built for another Python version, or not installed
    viete = None


class Error(ValueError):
    """An error whose message says what is wrong and what to do."""


def how():
    """The name of the available engine. Raises Error if neither the module nor the program is installed."""
    if viete:
        return "Viete " + viete.__version__
    if shutil.which("viete"):
        return "Program viete (Python module not found: slower)"
    raise Error("Viete is not installed; install the package python3-viete or viete, or the module with Blender's pip")


def corners_of(mesh):
    """The polygons of a mesh as lists of vertex indices."""
    starts, totals = np.empty(len(mesh.polygons), np.int32), np.empty(len(mesh.polygons), np.int32)
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.polygons.foreach_get("loop_start", starts)
    mesh.polygons.foreach_get("loop_total", totals)
    mesh.loops.foreach_get("vertex_index", corners)
    if len(totals) and (totals == totals[0]).all():
        return corners.reshape(-1, totals[0]) if len(corners) == totals.sum() else corners[starts[:, None] + np.arange(totals[0])]
    return [corners[s:s + n] for s, n in zip(starts, totals)]


def by_module(vertices, faces, cage, cage_faces, deformer_name, arap, mask):
    deformer = viete.Deformer(vertices, faces, cage, cage_faces, deformer_name, arap=arap, iterations=3 if arap else None, dtype="float32")
    deformer.keeps_turns = True
    deformer.set_mask(mask)
    return deformer


class ByProgram:
    """Deforms with the child process `viete deform --stream`, through pipes."""

    def __init__(self, vertices, faces, cage, cage_faces, deformer_name, arap, mask):
        self.folder = tempfile.TemporaryDirectory(prefix="viete-")
        place = pathlib.Path(self.folder.name)
        write_obj(place / "model.obj", vertices, faces)
        write_obj(place / "cage.obj", cage, cage_faces)
        words = ["viete", "deform", "model.obj", "cage.obj", "--stream", "--deformer", deformer_name]
        if arap:
            words += ["--arap", "--iterations", "3"]
        if mask is not None:
            (place / "mask.txt").write_text("\n".join("%.9g" % share for share in mask))
            words += ["--mask", "mask.txt"]
        self.errors = open(place / "errors.txt", "w+")
        self.program = subprocess.Popen(words, cwd=place, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors)
        self.deform(cage, np.empty((len(vertices), 3), np.float32))  # raises errors of the arguments

    def deform(self, pose, out):
        made = b""
        try:
            self.program.stdin.write(np.ascontiguousarray(pose, np.float64).tobytes())
            self.program.stdin.flush()
            made = self.program.stdout.read(12 * len(out))
        except (BrokenPipeError, ValueError):  # the program has ended
            pass
        if len(made) < 12 * len(out):
            self.close()
            self.errors.seek(0)
            said = [line for line in self.errors.read().splitlines() if not line.startswith("viete: note: ")]
            raise Error((said[-1] if said else "The program viete has ended; bind again").removeprefix("viete: "))
        out[:] = np.frombuffer(made, np.float32).reshape(-1, 3)

    def close(self):
        if not self.program.stdin.closed:
            try:
                self.program.stdin.close()
            except BrokenPipeError:
                pass
            self.program.stdout.close()
            self.program.wait()

    def __del__(self):
        if hasattr(self, "program"):
            self.close()


def write_obj(file, vertices, faces):
    lines = ["v %.9g %.9g %.9g" % tuple(v) for v in vertices] + ["f " + " ".join(str(c + 1) for c in f) for f in faces]
    file.write_text("\n".join(lines) + "\n")


def make(*arguments):
    how()
    return (by_module if viete else ByProgram)(*arguments)


def make_cage(vertices, faces, triangles):
    """Vertices and faces of a cage around the mesh."""
    how()
    if viete:
        return viete.make_cage(vertices, faces, triangles)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_obj(folder / "model.obj", vertices, faces)
        done = subprocess.run(["viete", "cage", "model.obj", "--triangles", str(triangles), "-o", "cage.obj"], cwd=folder,
                              capture_output=True, text=True)
        if done.returncode:
            raise Error(done.stderr.strip().removeprefix("viete: "))
        words = [line.split() for line in (folder / "cage.obj").read_text().splitlines() if line]
    places = [[float(x) for x in w[1:4]] for w in words if w[0] == "v"]
    return np.array(places), [[int(c.split("/")[0]) - 1 for c in w[1:]] for w in words if w[0] == "f"]
