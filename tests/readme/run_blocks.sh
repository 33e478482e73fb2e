#!/bin/sh
# run_blocks.sh FOLDER: runs every ```sh and ```python block of FOLDER/README.md in FOLDER, in order, after each ```toml
# block has gone to the file that the text before it names as "Save as `NAME`". Python finds the package in the build tree;
# where that was built without it, its blocks are left out.
set -eu
cd "$1"
steps=$(mktemp -d)
trap 'rm -rf "$steps"' EXIT

awk -v steps="$steps" '
  /^```/ && inside { if (file != "") close(file); inside = 0; next }
  /^```/ {
    inside = 1
    kind = substr($0, 4)
    file = ""
    if (kind == "sh" || kind == "python") file = sprintf("%s/%02d.%s", steps, ++blocks, kind)
    if (kind == "toml") file = name
    next
  }
  inside && file != "" { print > file }
  !inside && match($0, /Save as `[^`]+`/) { name = substr($0, RSTART + 9, RLENGTH - 10) }
' README.md

if [ -z "$(ls "$steps")" ]; then
  echo "README.md has no block of commands" >&2
  exit 1
fi
run_python() {
  python=$(sed -n 's/^WAVEBALANCE_PYTHON:[A-Z]*=//p' build/default/CMakeCache.txt)
  if [ -d build/default/python/wavebalance ]; then
    PYTHONPATH=build/default/python "$python" "$1"
  else
    echo "the Python package is not built: left out"
  fi
}

for step in "$steps"/*; do
  echo "--- block $(basename "$step")"
  cat "$step"
  case $step in
    *.python) run_python "$step" ;;
    *) sh -eu "$step" ;;
  esac
done
