#!/usr/bin/env bash
# Installs what FlipFree's page for the browser is built with: emscripten, Node and npm of Debian, where they are
# missing, and what Wrapping/Browser/package-lock.json names, by npm from the package index that it is configured for.
#
#   install-browser-tools.sh
#
# Ends with 77 where npm's packages cannot be had.
set -euo pipefail

case "${1:-}" in
  -h | --help)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
esac
here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
"$here/install-dependencies.sh" browser

cd "$here/../Browser"
if cmp --silent package-lock.json node_modules/.flipfree-lock; then
  echo "Nothing to install: npm's packages are there."
  exit 0
fi
# One at a time: several builds may share this folder.
exec 9>.npm-lock
flock 9
if ! npm ci --no-progress --loglevel=error --fetch-retries=1 --fetch-timeout=30000; then
  echo "The package index is out of reach, so the page for the browser cannot be built here." >&2
  exit 77
fi
cp package-lock.json node_modules/.flipfree-lock
