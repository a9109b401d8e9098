#!/usr/bin/env bash
# Builds FlipFree's wheel and installs it in a virtual environment.
#
#   install-wheel.sh ENVIRONMENT PYTHON
#
# Ends with 77, which CTest takes for skipped, where the tools cannot be had.
set -euo pipefail

environment=$1
python=$2
cd -P "$(dirname "${BASH_SOURCE[0]}")/../.."
rm -f "$environment/flipfree-installed"
Wrapping/Setup/install-wheel-tools.sh "$environment" "$python"
Wrapping/Setup/install-wheel-tools.sh --extras "$environment" "$python" ||
  echo "Skipped from here on: tests of what these packages are needed for."
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
"$environment/bin/pip" install --quiet --no-build-isolation --no-deps --force-reinstall \
  --config-settings=build-dir="$environment/build" .
touch "$environment/flipfree-installed"
