#!/bin/sh
# Installs the Debian 12 packages that the program needs to be built and run; with --tests also those of the tests, with
# --package also those that make the Debian package.
set -e
packages="g++ cmake ninja-build pkg-config openmpi-bin libopenmpi-dev libfftw3-dev libfftw3-mpi-dev
  libeigen3-dev libxsimd-dev libboost-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libspdlog-dev
  libfmt-dev libmetis-dev libpetsc-real-dev libopenblas0-pthread liblapacke-dev libvtk9-dev libinsighttoolkit5-dev libgdcm-dev libmatio-dev libpugixml-dev libminizip-dev zlib1g-dev libcairo2-dev fonts-dejavu-core"
case "$1" in
  --tests)
    packages="$packages catch2 libsundials-dev python3 python3-pandas python3-meshio python3-pydicom python3-nibabel python3-scipy clang-format clang-tidy chromium man-db"
    command -v npm >/dev/null || packages="$packages nodejs npm"  # a Node.js from elsewhere brings its own
    ;;
  --package) packages="$packages dpkg-dev file" ;;
esac
missing=""
for package in $packages; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q "install ok installed" || missing="$missing $package"
done
[ -n "$missing" ] || exit 0
echo "installing:$missing"
sudo=""
[ "$(id -u)" = 0 ] || sudo=sudo
$sudo apt-get update -q
# shellcheck disable=SC2086
$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
