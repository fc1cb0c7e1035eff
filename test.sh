#!/bin/sh
# Installs what is needed, builds with warnings as errors, and runs the tests; with --all also the long verification and the
# linter on every file (hours). With --quick the unit and style tests only.
set -e
cd "$(dirname "$0")"
tools/install_packages.sh --tests
# the exact versions of package-lock.json, once
[ -n "$(find web/node_modules/.package-lock.json -newer web/package-lock.json 2>/dev/null)" ] || npm ci --prefix web --no-audit --no-fund
cmake --preset release -DBUILD_TESTING=ON -DLV_WERROR=ON
cmake --build --preset release
case "$1" in
  --all) select="" ;;
  --quick) select="-L ^(unit|style)$" ;;
  *) select="-LE ^nightly$" ;;
esac
# Tests that start several ranks say so (PROCESSORS) and run alone; the others run beside each other, so that BLAS needs no threads.
# shellcheck disable=SC2086
OPENBLAS_NUM_THREADS=1 ctest --test-dir build/release --output-on-failure -j "$(nproc)" $select
