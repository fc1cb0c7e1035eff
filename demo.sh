#!/bin/sh
# Installs what is needed, builds the program, and runs a human left ventricle from early diastole over end-diastole to
# end-systole. Some minutes on two cores, after installing and building.
set -e
cd "$(dirname "$0")"
tools/install_packages.sh
cmake --preset release -DBUILD_TESTING=OFF
cmake --build --preset release --target ventricle
build/release/ventricle run examples/demo.toml --work build/demo
echo "pictures: $(pwd)/build/demo/02_mesh/*.png and $(pwd)/build/demo/04_results/*.png"
echo "page: $(pwd)/build/demo/05_report/report.html"
echo "fields for ParaView: $(pwd)/build/demo/03_beat/wall.pvd and blood.pvd"
