#!/usr/bin/env bash
# completion.sh PROGRAM SCRIPT: what the completion offers for lines as they are typed.
set -euo pipefail
program=$1
source "$2"
cd "$(mktemp -d)"
trap 'rm -rf "$PWD"' EXIT
touch "my scene.toml" other.toml notes.txt
mkdir results

# offers LINE: the candidates for LINE, in one line.
offers() {
  COMP_LINE=$1 COMP_POINT=${#1}
  COMP_WORDBREAKS=$' \t='
  read -r -a COMP_WORDS <<< "${1//=/ = } "
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _wavebalance "$program"
  printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd' '
}

expect() {
  local found
  found=" $(offers "$1") "
  for candidate in "${@:2}"; do
    case $found in
      *" $candidate "*) ;;
      *) echo "'$1' is completed by:$found; expected $candidate among it" >&2; exit 1 ;;
    esac
  done
}

expect_only() {
  local found
  found=$(offers "$1")
  [ "$found" = "$2" ] || { echo "'$1' is completed by: $found; expected: $2" >&2; exit 1; }
}

expect "wavebalance " run check compare study overlay keys init
expect_only "wavebalance ini" init
expect_only "wavebalance run " "my scene.toml other.toml results"
expect "wavebalance run other.toml --" --output --set --unset --start-from --quiet
expect_only "wavebalance run other.toml --output " results
expect_only "wavebalance run other.toml --set contact.gap_" "contact.gap_below="
expect_only "wavebalance run other.toml --set structure.type=m" matrices
expect "wavebalance run other.toml --set time.trial=" fourier haar bspline
expect_only "wavebalance run other.toml --unset contact.gap_" contact.gap_below
expect "wavebalance keys con" contact contact.law
expect_only "wavebalance init m" matrices
