#!/bin/sh
# Libraries as source, for machines that this one compiles for (make windows): Debian's source packages and headers into
# FOLDER, as packaging/libraries.cmake wants them. Uses lists of packages of its own: the system's are left as they are.
#   tools/sources.sh FOLDER
set -eu
mkdir -p "$1"
folder=$(cd "$1" && pwd)
test -e "$folder/complete" && exit 0
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
# The mirror that this machine has its packages from.
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' "Codename: $suite" | head -1)
test -n "$mirror" || { echo "sources: apt knows no mirror of $suite; run apt-get update" >&2; exit 1; }
mkdir -p "$folder/apt/lists/partial" "$folder/include"
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" \
  >"$folder/apt/sources.list"
apt() { apt-get -qq -o Dir::Etc::SourceList="$folder/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null \
  -o Dir::State::Lists="$folder/apt/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= "$@"; }
apt update
cd "$folder"
rm -rf zlib-* fmtlib-* pugixml-* sqlite3-*
for package in zlib fmtlib pugixml sqlite3; do apt -o APT::Sandbox::User=root source "$package"; done
ln -sfn zlib-* zlib
ln -sfn fmtlib-* fmt
ln -sfn pugixml-* pugixml
# The amalgamation, which its own makefile makes with tclsh.
(cd sqlite3-*/ && ./configure -q >configure.txt 2>&1 && make -s sqlite3.c sqlite3.h >make.txt 2>&1)
mkdir -p sqlite
cp sqlite3-*/sqlite3.c sqlite3-*/sqlite3.h sqlite
# Of libraries that are headers alone those of this machine.
for header in boost eigen3/Eigen eigen3/unsupported nlohmann toml++ CLI xxhash.h; do ln -sfn "/usr/include/$header" "include/${header##*/}"; done
rm -rf apt
touch complete
