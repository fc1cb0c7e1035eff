#!/bin/sh
# clang-tidy on the files given; with --changed BASE on the sources changed since that commit, at most MOST of them, for a file
# takes half a minute; without arguments on every source.
#   tools/lint.sh [FILE... | --changed BASE [MOST]]
set -e
cd "$(dirname "$0")/.."
if [ "$1" = --changed ]; then
  git rev-parse -q --verify "$2^{commit}" >/dev/null || { echo "skipped: no commit $2 here (a shallow clone?)"; exit 77; }
  most=${3:-20}
  changed=$(git diff --name-only --diff-filter=d "$2" -- 'src/*.cpp' 'app/*.cpp' 'tests/*.cpp')
  echo "$changed" | tail -n "+$((most + 1))" | sed 's/^/left to the run over every file: /'
  # shellcheck disable=SC2046
  set -- $(echo "$changed" | head -n "$most")
  [ $# -gt 0 ] || exit 0
elif [ $# = 0 ]; then
  # shellcheck disable=SC2046
  set -- $(git ls-files 'src/*.cpp' 'app/*.cpp' 'tests/*.cpp')
fi
cmake --preset lint >/dev/null
# Clang 14 has coroutines, but neither says so nor is believed by Boost 1.74, whose header for them forgets <utility>. Debian's ITK
# is for GCC alone: what includes it is left out.
grep -LE '#include (<itk|"lv/strain/grey_image.hpp")' "$@" | xargs -r -P "$(nproc)" -n 1 clang-tidy -p build/lint --quiet --extra-arg=-Wno-unknown-warning-option \
  --extra-arg=-Qunused-arguments --extra-arg=-D__cpp_impl_coroutine=201902L --extra-arg=-DBOOST_ASIO_HAS_CO_AWAIT --extra-arg=-DBOOST_ASIO_HAS_STD_COROUTINE \
  --extra-arg=-include --extra-arg=utility 2>/dev/null
