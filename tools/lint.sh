#!/bin/sh
# clang-tidy on the files given, or on every source file. Needs the dev preset's compile commands.
set -e
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- $(git ls-files 'src/*.cpp' 'app/*.cpp' 'tests/*.cpp')
clang-tidy -p build/dev --quiet --extra-arg=-Wno-unknown-warning-option "$@" 2>/dev/null
