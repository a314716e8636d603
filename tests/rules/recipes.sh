#!/bin/sh
# recipes.sh SOURCE VERSION: the recipes for other package managers are well formed, and of this version.
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
END
grep -q 'vcpkg_cmake_install()' vcpkg/viete/portfile.cmake
