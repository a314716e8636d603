#!/bin/sh
# types.sh SOURCE: checks viete-stubs and the gallery with mypy.
set -eu
source=$1
python=/usr/bin/python3
"$python" -c 'import mypy' 2>/dev/null || { echo "mypy is not installed: skipped"; exit 77; }
cd "$source/src/python"
MYPYPATH=. "$python" -m mypy --check-untyped-defs --warn-unused-ignores --cache-dir=/dev/null --python-version 3.11 viete-stubs gallery/*.py
