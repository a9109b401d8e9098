#!/usr/bin/env bash
# Runs a test where install-wheel.sh has installed the wheel.
#
#   run-in-wheel.sh ENVIRONMENT TEST.py [PYTHON]
#
#   PYTHON  another interpreter, for tests that run the wheel's command and need VTK's Python
set -euo pipefail

if [[ ! -e $1/flipfree-installed ]]; then
  echo "Skipped: the wheel could not be built here (see the test Wheel.Install)."
  exit 77
fi
exec "${3:-$1/bin/python}" "$2"
