#!/usr/bin/env bash
# Runs a program of ParaView with the plugin, for CTest:
#
#   run-test.sh PROGRAM FILE
#
# Where there is no plugin, it says so and ends with 77, by which CTest knows a skipped test.
# FLIPFREE_BUILD is the folder that build-plugin.sh has built in.
set -euo pipefail

source_folder=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
if ! find "$FLIPFREE_BUILD" -name FlipFree.so -print -quit 2>/dev/null | grep --quiet . ||
  [[ ! -x $FLIPFREE_BUILD-prefix/usr/bin/$1 ]]; then
  echo "Skipped: there is no ParaView plugin in $FLIPFREE_BUILD. Wrapping/ParaView/build-plugin.sh gets ParaView and" \
    "builds it; FLIPFREE_PARAVIEW_BUILD tells CMake of another folder."
  exit 77
fi
exec "$source_folder/Wrapping/ParaView/with-paraview.sh" "$@"
