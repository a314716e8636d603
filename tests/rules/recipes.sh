#!/bin/sh
# recipes.sh SOURCE VERSION: the recipes for other package managers must be well-formed and contain this version.
set -eu
cd "$1/third_party/package"
command -v python3 >/dev/null || { echo "there is no Python: skipped"; exit 77; }
python3 - "$2" <<'END'
import ast, json, sys
version = sys.argv[1]
port = json.load(open("vcpkg/viete/vcpkg.json"))
assert port["version"] == version, "vcpkg.json is of version " + port["version"]
recipe = ast.parse(open("conan/conanfile.py").read())
values = {t.id: s.value.value for c in recipe.body if isinstance(c, ast.ClassDef) for s in c.body
          if isinstance(s, ast.Assign) and isinstance(s.value, ast.Constant) for t in s.targets}
assert values["version"] == version, "conanfile.py is of version " + values["version"]
addon = ast.parse(open("../../src/blender/viete_cage/__init__.py").read())
info = next(ast.literal_eval(s.value) for s in addon.body if isinstance(s, ast.Assign) and s.targets[0].id == "bl_info")
assert ".".join(map(str, info["version"])) == version, "the add-on is of version %s" % (info["version"],)
flatpak = json.load(open("flatpak/invalid.viete.Viete.json"))
for module in flatpak["modules"]:
    for source in module["sources"]:
        pinned = source["type"] == "dir" or len(source["sha256"]) == 64
        assert pinned, "the manifest's module %s comes without a checksum" % module["name"]
assert flatpak["modules"][-1]["name"] == flatpak["command"] == "viete"
END
if command -v flatpak-builder >/dev/null; then
  said=$(flatpak-builder --show-manifest flatpak/invalid.viete.Viete.json 2>&1 >/dev/null || true)
  [ -z "$said" ] || { echo "flatpak-builder: $said"; exit 1; }
fi
grep -q 'vcpkg_cmake_install()' vcpkg/viete/portfile.cmake
