#!/usr/bin/env bash
# Builds the ParaView plugin from a bare Debian 12 or 13 and a clean clone: gets ParaView, configures, builds.
#
#   build-plugin.sh [FOLDER] [CMAKE-OPTION...]
#
#   FOLDER  where the plugin is built (default: build/paraview in the source folder); ParaView goes beside it,
#           into FOLDER-prefix
#
# With -DParaView_DIR=... among the options no ParaView is fetched: the plugin is built for that one, of which the
# development files have to be there. FLIPFREE_JOBS sets the number of compilers at work.
# The last line says how to start ParaView with the plugin.
set -euo pipefail

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  exit 0
fi

here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd -P "$here/../.." && pwd)
folder=$root/build/paraview
if [[ -n ${1:-} && $1 != -* ]]; then
  folder=$1
  shift
fi
mkdir -p "$folder"
folder=$(cd -P "$folder" && pwd)

options=("$@")
gets_paraview=true
for option in "$@"; do
  if [[ $option == -DParaView_DIR[:=]* ]]; then
    gets_paraview=false
  fi
done
if $gets_paraview; then
  "$root/Wrapping/Setup/install-paraview.sh" "$folder-prefix"
  config=$(find "$folder-prefix/usr/lib" -name paraview-config.cmake -print -quit)
  if [[ -z $config ]]; then
    echo "There is no paraview-config.cmake in $folder-prefix/usr/lib, although ParaView was unpacked there; remove" \
      "$folder-prefix and try again." >&2
    exit 1
  fi
  options+=("-DParaView_DIR=$(dirname "$config")")
fi

# Several sources at a time: most of the time goes into headers.
cmake -S "$here" -B "$folder" -G Ninja -DFLIPFREE_USE_CCACHE=ON -DCMAKE_UNITY_BUILD=ON "${options[@]}"
cmake --build "$folder" --parallel "${FLIPFREE_JOBS:-$(nproc)}"

plugin=$(find "$folder" -name FlipFree.so -print -quit)
echo "The plugin is $plugin."
if $gets_paraview; then
  printf 'Start ParaView with it: FLIPFREE_BUILD=%q %q paraview\n' "$folder" "$here/with-paraview.sh"
fi
