#!/usr/bin/env bash
# A package on a bare Debian 12, in a folder of its own: installed, tried, purged; what is left is told.
# check.sh PACKAGE (as root, with a Debian mirror at hand)
set -euo pipefail
TIMEFORMAT="  %R s"
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
inside() { chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
# What apt and dpkg keep of their own is in /var.
files() { (cd "$root" && find . -xdev \( -path ./var -o -path ./tmp -o -path ./root/.cache \) -prune -o -print | sort); }

mmdebstrap --quiet --variant=minbase --customize-hook='rm -f "$1"/etc/apt/apt.conf.d/99mmdebstrap' bookworm "$root"
cp "$1" "$root/tmp/phyllite.deb"
before=$(files)
inside apt-get update -qq
inside apt-get install -y -qq --no-install-recommends /tmp/phyllite.deb >"$root/tmp/apt.txt" 2>&1 || { cat "$root/tmp/apt.txt"; exit 1; }
echo "check: $(inside phyllite --version), installed with $(inside dpkg-query -W -f '${Installed-Size}' phyllite) KiB"
time inside phyllite verify >"$root/tmp/verify.txt" || { grep -i fail "$root/tmp/verify.txt"; exit 1; }
tail -1 "$root/tmp/verify.txt"
inside cp -r /usr/share/doc/phyllite/examples /tmp
time inside sh -c 'cd /tmp && phyllite run examples/pfc2d/specimen.toml --out results >run.txt'
tail -1 "$root/tmp/run.txt"
inside sh -c 'apt-get purge -y -qq phyllite && apt-get autoremove --purge -y -qq' >"$root/tmp/apt.txt" 2>&1
diff <(echo "$before") <(files) || { echo "check: left behind (>) or gone (<)"; exit 1; }
echo "check: installed, verified, ran, purged; nothing is left"
