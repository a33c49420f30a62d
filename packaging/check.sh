#!/bin/sh
# A package on a bare Debian 12, in a folder of its own: installed, tried, purged; what is left is told. check.sh PACKAGE [ROOT.tar]
set -eu
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
files() { (cd "$root" && find . -xdev \( -path ./var -o -path ./proc -o -path ./sys -o -path ./dev \) -prune -o -print | sort); }
inside() { chroot "$root" env HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
if [ $# -gt 1 ]; then tar -xf "$2" -C "$root"; else mmdebstrap --quiet --variant=minbase bookworm "$root"; fi
rm -f "$root"/etc/apt/apt.conf.d/*
cp "$1" "$root/tmp/phyllite.deb"
inside apt-get update -qq
files >"$root/tmp/before"
inside apt-get install -y -qq --no-install-recommends /tmp/phyllite.deb
inside phyllite --version
inside sh -c 'cd /tmp && time phyllite verify | tail -1'
inside sh -c 'cd /tmp && cp -r /usr/share/doc/phyllite/examples . && time phyllite run examples/pfc2d/specimen.toml --out results | tail -1'
inside sh -c 'apt-get purge -y -qq phyllite && apt-get autoremove --purge -y -qq'
rm -rf "$root/tmp/examples" "$root/tmp/results" "$root/root/.cache"
files | diff "$root/tmp/before" - >"$root/tmp/left" || true
if grep -v '/tmp/' "$root/tmp/left" | grep -q '^[<>]'; then echo "check: left behind or gone:"; cat "$root/tmp/left"; exit 1; fi
echo "check: installed, verified, ran, purged; nothing is left"
