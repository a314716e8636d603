#!/usr/bin/env python3
"""Before a release, by hand: builds every module of the Flatpak manifest, as flatpak-builder does but without its runtime.
  apt-get install g++ cmake ninja-build pkg-config curl xorg-dev libwayland-dev libxkbcommon-dev libegl-dev libgl-dev
  tests/releases/try_flatpak.py FOLDER [MODULE ...]
In a bare root: then nothing but what the manifest has can be found. Of modules that are named those alone."""
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]
MANIFEST = TOP / "third_party/package/flatpak/invalid.viete.Viete.json"


def fetched(source, archives):
    """The file of that checksum, fetched once."""
    file = archives / os.path.basename(source["url"])
    if not file.exists():
        subprocess.run(["curl", "-fsSLo", file, source["url"]], check=True)
    found = hashlib.sha256(file.read_bytes()).hexdigest()
    if found != source["sha256"]:
        sys.exit("%s has the checksum %s, and not %s" % (file, found, source["sha256"]))
    return file


def unpacked(source, place, archives):
    if source["type"] == "dir":
        top = (MANIFEST.parent / source["path"]).resolve()
        built = lambda folder, names: [n for n in names if folder == str(top) and (n == ".git" or n.startswith("build"))]
        shutil.copytree(top, place, dirs_exist_ok=True, ignore=built)
    elif source["type"] == "archive":
        subprocess.run(["tar", "xf", fetched(source, archives), "--strip-components=1", "-C", place], check=True)
    else:
        shutil.copy(fetched(source, archives), place)


def build(module, place, prefix):
    commands = module.get("build-commands", [])
    if module["buildsystem"] == "cmake-ninja":
        options = " ".join(module.get("config-opts", []))
        commands = ["cmake -S . -B _build -G Ninja -DCMAKE_INSTALL_PREFIX=%s -DCMAKE_INSTALL_LIBDIR=lib %s" % (prefix, options),
                    "cmake --build _build", "cmake --install _build"]
    surroundings = dict(os.environ, FLATPAK_DEST=str(prefix), CMAKE_PREFIX_PATH=str(prefix), PATH="%s/bin:%s" % (prefix, os.environ["PATH"]),
                        PKG_CONFIG_PATH="%s/lib/pkgconfig:%s/share/pkgconfig" % (prefix, prefix), LD_LIBRARY_PATH="%s/lib" % prefix)
    for command in commands + module.get("post-install", []):
        done = subprocess.run(command, shell=True, cwd=place, env=surroundings, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            sys.exit("%s\n%s" % (command, done.stdout[-4000:]))


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    prefix, archives = folder / "app", folder / "archives"
    archives.mkdir(parents=True, exist_ok=True)
    for module in json.loads(MANIFEST.read_text())["modules"]:
        if sys.argv[2:] and module["name"] not in sys.argv[2:]:
            continue
        print(module["name"], flush=True)
        place = folder / module["name"]
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir()
        for source in module["sources"]:
            unpacked(source, place, archives)
        build(module, place, prefix)
    print("built: %s/bin/viete" % prefix)


main()
