#!/bin/sh
# Makes build/package/ventricle_*.deb on Debian 12, to be installed with apt where no compiler is. What of the processor it
# needs stands in CMakePresets.json.
set -e
cd "$(dirname "$0")/.."
tools/install_packages.sh --package
cmake --workflow --preset package
