#!/bin/sh
# run_changed.sh FOLDER: builds the tests of the modules of the checkout FOLDER that changed, and of those that use them,
# with AddressSanitizer and UndefinedBehaviorSanitizer (preset `sanitize`), and runs them. What changed is the difference to
# the commit WAVEBALANCE_SANITIZE_BASE or, without it, to the last one that is older than a day. Modules that are not
# listed in WAVEBALANCE_SANITIZE_MODULES, where it is set, are left out.
set -eu
cd "$1"

base=${WAVEBALANCE_SANITIZE_BASE-$(git rev-list -1 --before='1 day ago' HEAD)}
base=${base:-$(git rev-list --max-parents=0 HEAD | tail -n 1)}
changed=$(git diff --name-only "$base" | sed -n 's#^\([a-z]*\)/.*#\1#p' | sort -u)
echo "changed since $base:" $changed

# A module with the modules whose changes it is tested for.
programs=""
add() {
  module=$1
  shift
  case " ${WAVEBALANCE_SANITIZE_MODULES-$module} " in
    *" $module "*) ;;
    *) return ;;
  esac
  for folder in "$module" "$@"; do
    case " $(echo $changed) " in
      *" $folder "*) programs="$programs ${module}_test"; return ;;
    esac
  done
}
add wavelets cmake
add spectral cmake
add fem cmake
add contact cmake
add solvers cmake spectral contact
add app cmake solvers contact fem wavelets spectral

if [ -z "$programs" ]; then
  echo "no module changed"
  exit 0
fi
cmake --preset sanitize
# shellcheck disable=SC2086  # a list of words on purpose
cmake --build --preset sanitize --target $programs
export RC_PARAMS="seed=20140817" GTEST_BRIEF=1 GTEST_TOTAL_SHARDS=2
for program in $programs; do
  echo "--- $program, each half on a core"
  path="build/sanitize/${program%_test}/$program"
  GTEST_SHARD_INDEX=0 "$path" &
  first=$!
  GTEST_SHARD_INDEX=1 "$path"
  wait "$first"
done
