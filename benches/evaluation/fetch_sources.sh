#!/bin/sh
# Gets the C++ sources that lines_cpp.py counts into a folder: from PyPI and Debian (bookworm), by their own clients.
#
#     benches/evaluation/fetch_sources.sh FOLDER
#
# To compile them: apt-get install g++ libeigen3-dev libconsole-bridge-dev libtinyxml-dev libtinyxml2-dev libqhull-dev
# libccd-dev liblodepng-dev libtinyobjloader-dev, and Boost's headers, which the package `pin` has.
set -eu
mkdir -p "$1"
cd "$1"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# pip unpacks a source package before it asks how to build it, which is all that is wanted here: its failure is expected.
of_pypi() {
    mkdir "$work/$1"
    TMPDIR="$work/$1" pip download --quiet --no-clean --no-deps --no-build-isolation --no-binary :all: "$1==$2" > "$work/log" 2>&1 || true
    found="$(find "$work/$1" -name PKG-INFO -not -path '*egg-info*' | head -1)"
    [ -n "$found" ] || { cat "$work/log" >&2; exit 1; }
    rm -rf "$3"
    mv "$(dirname "$found")" "$3"
}
of_pypi pin 4.1.0 pinocchio
of_pypi pybullet 3.2.7 pybullet
of_pypi cmeel-urdfdom 6.0.0 cmeel_urdfdom
rm -rf urdfdom urdfdom_headers
mv cmeel_urdfdom/urdfdom urdfdom
rm -rf cmeel_urdfdom
pip download --quiet --no-deps --only-binary :all: --dest "$work" cmeel-urdfdom-headers==3.0.0
python3 -m zipfile -e "$work"/cmeel_urdfdom_headers-*.whl "$work/headers"
mv "$work/headers/cmeel.prefix/include/urdfdom_headers" urdfdom_headers

echo "deb-src http://deb.debian.org/debian bookworm main" > "$work/sources.list"
mkdir -p "$work/lists/partial"
apt() {
    apt-get --quiet --quiet -o Dir::Etc::sourcelist="$work/sources.list" -o Dir::Etc::sourceparts=- \
        -o Dir::State::lists="$work/lists" -o APT::Sandbox::User=root "$@"
}
apt update
cd "$work"
# The upstream archives alone are counted, so nothing is lost where a file of Debian's patches is missing.
for package in orocos-kdl=1.5.1-2 ros-kdl-parser=1.14.2-2 mujoco=2.2.2-3; do
    apt source --download-only "$package" > "$work/log" 2>&1 || true
done
for archive in *.orig.tar.*; do tar -xf "$archive"; done
cd - > /dev/null
rm -rf orocos_kdl kdl_parser mujoco kdl
mv "$work"/orocos_kinematics_dynamics-*/orocos_kdl orocos_kdl
mv "$work"/kdl_parser-*/kdl_parser kdl_parser
mv "$work"/mujoco-*/ mujoco
# What KDL's own build writes, and the name by which its headers are included.
echo "#define HAVE_STL_CONTAINER_INCOMPLETE_TYPES" > orocos_kdl/src/config.h
mkdir kdl
ln -s ../orocos_kdl/src kdl/kdl
