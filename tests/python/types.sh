#!/bin/sh
# types.sh SOURCE: the gallery and the tests agree with the types in viete-stubs, as mypy sees them; and the stubs with the module's own help.
set -eu
source=$1
python=/usr/bin/python3
"$python" -c 'import mypy' 2>/dev/null || { echo "mypy is not installed: skipped"; exit 77; }
cd "$source/src/python"
MYPYPATH=. "$python" -m mypy --check-untyped-defs --warn-unused-ignores --cache-dir=/dev/null --python-version 3.11 viete-stubs gallery/*.py
