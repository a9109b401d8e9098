#!/usr/bin/env bash
# Runs a test in ParaView's Python, without the plugin in C++, but with the wheel that install-wheel.sh has installed.
#
#   run-in-paraview.sh ENVIRONMENT TEST.py
#
# FLIPFREE_BUILD is the folder beside which build-plugin.sh has unpacked ParaView.
set -euo pipefail

if [[ ! -e $1/flipfree-installed ]]; then
  echo "Skipped: the wheel could not be built here (see the test Wheel.Install)."
  exit 77
fi
if [[ ! -x $FLIPFREE_BUILD-prefix/usr/bin/pvpython ]]; then
  echo "Skipped: there is no ParaView in $FLIPFREE_BUILD-prefix. Wrapping/Setup/install-paraview.sh gets it."
  exit 77
fi
site=("$1"/lib/python3*/site-packages)
export FLIPFREE_WHEEL_SITE=${site[0]}
exec "$(dirname "${BASH_SOURCE[0]}")/../../Wrapping/ParaView/with-paraview.sh" --no-plugin pvpython "$2"
