#!/usr/bin/env bash
# Builds FlipFree for the browser, on Debian 12 or 13:
#
#   build.sh [FOLDER]
#
#   FOLDER  for everything that is built (default: build/browser in the source folder)
#
# leaves FOLDER/page, a static page that any web server takes, and FOLDER/package, the npm package `flipfree`. What
# is missing (Debian's packages, and with npm what package-lock.json names) is installed first.
#
# Ends with 77 where npm's packages cannot be had.
set -euo pipefail

case "${1:-}" in
  -h | --help)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
  -*)
    "$0" --help >&2
    exit 2
    ;;
esac

here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=${1:-$here/../../build/browser}
mkdir -p "$folder"
folder=$(cd -P "$folder" && pwd)

"$here/../Setup/install-browser-tools.sh"

# Debian's emscripten: its parser of JavaScript is where Debian's Node packages are, and newer Nodes' fetch gets into
# the way of its programs. Its cache of libraries is complete and must not be moved.
export NODE_PATH=/usr/share/nodejs
if EM_COMPILER_WRAPPER=$(command -v ccache); then
  export EM_COMPILER_WRAPPER
fi
if [[ ! -e $folder/kernels/build.ninja ]]; then
  NODE_OPTIONS=--no-experimental-fetch emcmake cmake -S "$here/Kernels" -B "$folder/kernels" -G Ninja
fi
NODE_OPTIONS=--no-experimental-fetch cmake --build "$folder/kernels"

cd "$here"
node types.mjs "$folder/kernels" flipfree/parametertypes.ts
node_modules/.bin/tsc
node build.mjs "$folder/kernels" "$folder/package" "$folder/page"
node_modules/.bin/tsc --noEmit false --emitDeclarationOnly --declaration --rootDir flipfree \
  --outDir "$folder/package/types" --project flipfree/tsconfig.json
echo "The page is in $folder/page, the package in $folder/package."
