#!/bin/sh
# Installs what is needed, builds with warnings as errors, and runs the tests; with --all also the long verification
# (hours). With --quick the unit and style tests only.
set -e
cd "$(dirname "$0")"
tools/install_packages.sh --tests
cmake --preset release -DBUILD_TESTING=ON -DLV_WERROR=ON
cmake --build --preset release
case "$1" in
  --all) select="" ;;
  --quick) select="-L ^(unit|style)$" ;;
  *) select="-LE ^nightly$" ;;
esac
# one test at a time: some of them start several ranks
# shellcheck disable=SC2086
ctest --test-dir build/release --output-on-failure $select
