#!/bin/sh
# run_blocks.sh FOLDER: runs every ```sh block of FOLDER/README.md in FOLDER, in order, after each ```toml block has gone
# to the file that the text before it names as "Save as `NAME`".
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
    if (kind == "sh") file = sprintf("%s/%02d", steps, ++blocks)
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
for step in "$steps"/*; do
  echo "--- block $(basename "$step")"
  cat "$step"
  sh -eu "$step"
done
