"""Deformers for Blender's meshes: by the module `viete`, or, where this Python cannot import it, by the program."""
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np

try:
    import viete
except ImportError:  # another Python than the one that the module was built for
    viete = None


class Error(Exception):
    """One sentence: what is wrong, and what to do."""


def how():
    """What works here, for the panel; raises Error where nothing does."""
    if viete:
        return "Viete " + viete.__version__
    if shutil.which("viete"):
        return "by the program viete, slower: this Python has no module viete"
    raise Error("Neither the module viete nor the program is here: install python3-viete, or viete, or "
                "pip install it for Blender's Python")


def corners_of(mesh):
    """The polygons of a mesh, as lists of their corners."""
    starts, totals = np.empty(len(mesh.polygons), np.int32), np.empty(len(mesh.polygons), np.int32)
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.polygons.foreach_get("loop_start", starts)
    mesh.polygons.foreach_get("loop_total", totals)
    mesh.loops.foreach_get("vertex_index", corners)
    if len(totals) and (totals == totals[0]).all():
        return corners.reshape(-1, totals[0]) if len(corners) == totals.sum() else corners[starts[:, None] + np.arange(totals[0])]
    return [corners[s:s + n] for s, n in zip(starts, totals)]


class ByModule:
    def __init__(self, vertices, faces, cage, cage_faces, way, stitched, mask):
        try:
            self.deformer = viete.Deformer(vertices, faces, cage, cage_faces, way, stitched=3 if stitched else None, dtype="float32")
            self.deformer.keeps_turns = True
            if mask is not None:
                self.deformer.set_mask(mask)
        except ValueError as error:
            raise Error(str(error)) from error

    def deform(self, pose, out):
        try:
            self.deformer.deform(pose, out=out)
        except ValueError as error:
            raise Error(str(error)) from error


class ByProgram:
    """Frames through files in memory (/dev/shm, where there is one)."""

    def __init__(self, vertices, faces, cage, cage_faces, way, stitched, mask):
        if mask is not None:
            raise Error("Masks need the module viete in Blender's Python; leave the mask empty, or install python3-viete")
        memory = pathlib.Path("/dev/shm")
        self.folder = tempfile.TemporaryDirectory(prefix="viete-", dir=memory if memory.is_dir() else None)
        self.place = pathlib.Path(self.folder.name)
        self.faces = cage_faces
        write_obj(self.place / "model.obj", vertices, faces)
        write_obj(self.place / "cage.obj", cage, cage_faces)
        self.words = ["--way", way] + (["--stitched"] if stitched else [])

    def deform(self, pose, out):
        write_obj(self.place / "pose.obj", pose, self.faces)
        words = ["viete", "deform", "model.obj", "cage.obj", "--pose", "pose.obj", "-o", "out.obj", "--force", *self.words]
        done = subprocess.run(words, cwd=self.place, capture_output=True, text=True)
        if done.returncode:
            raise Error(done.stderr.strip().removeprefix("viete: "))
        lines = (self.place / "out.obj").read_text().splitlines()
        out[:] = [line.split()[1:4] for line in lines if line.startswith("v ")]


def write_obj(file, vertices, faces):
    lines = ["v %.9g %.9g %.9g" % tuple(v) for v in vertices] + ["f " + " ".join(str(c + 1) for c in f) for f in faces]
    file.write_text("\n".join(lines) + "\n")


def make(*arguments):
    how()
    return (ByModule if viete else ByProgram)(*arguments)


def make_cage(vertices, faces, triangles):
    """Vertices and faces of a cage around these."""
    how()
    if viete:
        try:
            return viete.make_cage(vertices, faces, triangles)
        except ValueError as error:
            raise Error(str(error)) from error
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
