#!/usr/bin/env bash
# Runs a program of the ParaView that install-paraview.sh has unpacked, with the plugin at hand.
#
#   with-paraview.sh [--no-plugin] PROGRAM [ARGUMENT...]
#
#   --no-plugin  without it: for the plugin in Python of the package that pip installs
#   PROGRAM      paraview, pvpython, pvbatch or pvserver; the plugin is loaded from the start
#
#   FLIPFREE_BUILD  folder in which build-plugin.sh has built (default: build/paraview in the source folder)
#
# Where no display is, programs that draw run under a virtual one, with software rendering.
set -euo pipefail

if (($# == 0)) || [[ $1 == -h || $1 == --help ]]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  exit 0
fi

with_plugin=true
if [[ $1 == --no-plugin ]]; then
  with_plugin=false
  shift
fi
if (($# == 0)); then
  echo "with-paraview.sh: which program is to run? Its help says more: with-paraview.sh --help" >&2
  exit 2
fi
root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${FLIPFREE_BUILD:-$root/build/paraview}
prefix=$build-prefix
program=$prefix/usr/bin/$1
shift

if [[ ! -x $program ]]; then
  echo "There is no $program. Wrapping/ParaView/build-plugin.sh gets ParaView and builds the plugin; FLIPFREE_BUILD" \
    "names the folder if it is not $build." >&2
  exit 1
fi
plugin=
if $with_plugin; then
  plugin=$(find "$build" -name FlipFree.so -print -quit)
fi
if $with_plugin && [[ -z $plugin ]]; then
  echo "There is no FlipFree.so in $build. Wrapping/ParaView/build-plugin.sh builds it." >&2
  exit 1
fi

libraries=$(dirname "$(find "$prefix/usr/lib" -name 'libvtkRemotingCore-pv*.so' -print -quit)")
export LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export PYTHONPATH=$prefix/usr/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}
if $with_plugin; then
  export PV_PLUGIN_PATH=${plugin%/*}${PV_PLUGIN_PATH:+:$PV_PLUGIN_PATH}
fi

# The plugin's folder is named after the ParaView that it was built for. Asked is the server, which wants no display.
built_for=$(sed -n 's,.*/paraview-\([0-9.]*\)/plugins/.*,\1,p' <<<"$plugin")
started=$("$prefix/usr/bin/pvserver" --version 2>/dev/null | sed -n 's/^paraview version //p' || true)
if $with_plugin && [[ $started. != "$built_for".* ]]; then
  echo "The plugin $plugin was built for ParaView ${built_for:-of an unknown version}, and $prefix holds ParaView" \
    "${started:-of an unknown version}: it would not load. Remove $prefix and build the plugin again," \
    "by Wrapping/ParaView/build-plugin.sh $build." >&2
  exit 1
fi

if [[ -z ${DISPLAY:-} ]]; then
  export LIBGL_ALWAYS_SOFTWARE=1
  exec xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" "$program" "$@"
fi
exec "$program" "$@"
