#!/bin/sh
# Manual pages and completion, as the program itself writes them: manual.sh PROGRAM FOLDER
set -eu
rm -rf "$2"
"$1" man --out "$2/man1" >/dev/null
rm -f "$2/man1/.written-by-phyllite"
gzip -9n "$2"/man1/*.1
for shell in bash zsh fish; do "$1" completion $shell >"$2/completion.$shell"; done
