#!/bin/sh
# wheel.sh SOURCES VIETE VERSION: makes the wheel and runs the tests of the module with it. Skipped without Debian's tools.
set -eu
sources="$1" viete="$2" version="$3"
for tool in apt-get readelf; do command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }; done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

wrong() {
  echo "$*" >&2
  exit 1
}

"$sources/third_party/setup.sh" wheel >"$work/log" 2>&1 || { cat "$work/log"; wrong "setup.sh wheel fails"; }
python=/usr/bin/python3
tag=$($python -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
wheel=$(ls "$sources/build-wheel/viete-$version-$tag-$tag-manylinux_"*"_$(uname -m).whl")
[ "$(stat -c %s "$wheel")" -le 6000000 ] || wrong "$wheel is larger than 6 MB"

$python -m zipfile -e "$wheel" "$work/site packages"
cd "$work/site packages"
for file in viete-stubs/__init__.pyi "viete-$version.dist-info/METADATA" "viete-$version.dist-info/RECORD" \
  "viete-$version.dist-info/licenses/viete.txt"; do
  test -s "$file" || wrong "$wheel has no $file"
done
others=$(readelf -d viete.*.so | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' |
  grep -v -x -E 'lib(c|m)\.so\.6|libstdc\+\+\.so\.6|libgcc_s\.so\.1|libz\.so\.1|ld-linux.*' || true)
[ -z "$others" ] || wrong "the module needs $others"

export PYTHONPATH="$work/site packages" PYTHONDONTWRITEBYTECODE=1
cd /
$python -c 'import importlib.metadata, sys; sys.exit(importlib.metadata.version("viete") != sys.argv[1])' "$version"
$python "$sources/tests/python/test_viete.py"
$python "$sources/tests/python/test_deformer.py" "$viete" "$sources/assets"
