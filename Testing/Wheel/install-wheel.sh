#!/usr/bin/env bash
# Builds FlipFree's wheel and installs it in a virtual environment; or installs the one that FLIPFREE_WHEEL names, such as
# that of a release, by its absolute path.
#
#   install-wheel.sh [--tools] ENVIRONMENT PYTHON [BUILD]
#
#   --tools  only gets what the wheel is built and tested with
#   BUILD    folder of a build of the same sources, such as the ParaView plugin's; where it compiles the kernels with the
#            wheel's options, they are taken from there
#
# Ends with 77, which CTest takes for skipped, where the tools cannot be had.
set -euo pipefail

only_tools=false
if [[ $1 == --tools ]]; then
  only_tools=true
  shift
fi
environment=$1
python=$2
build=${3:-}
cd -P "$(dirname "${BASH_SOURCE[0]}")/../.."
rm -f "$environment/flipfree-installed"
Wrapping/Setup/install-wheel-tools.sh "$environment" "$python"
Wrapping/Setup/install-wheel-tools.sh --extras "$environment" "$python" ||
  echo "Skipped from here on: tests of what these packages are needed for."
if $only_tools; then
  exit 0
fi

if [[ ${FLIPFREE_WHEEL:-} ]]; then
  "$environment/bin/pip" install --quiet --no-deps --force-reinstall "$FLIPFREE_WHEEL"
  touch "$environment/flipfree-installed"
  exit 0
fi

# The kernels of the ParaView plugin are compiled from the same folder with the same options, unless the environment asks
# for another compiler or other options. Where they cannot be had, the wheel compiles its own.
kernels=
if [[ -z ${CXX:-}${CXXFLAGS:-} && -e $build/build.ninja ]] &&
  grep --quiet --fixed-strings "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD/" "$build/CMakeCache.txt" &&
  grep --quiet '^CMAKE_BUILD_TYPE:STRING=Release$' "$build/CMakeCache.txt" &&
  cmake --build "$build" --target FlipFreeKernels; then
  kernels=$(find "$build" -name libFlipFreeKernels.a -print -quit)
fi
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
"$environment/bin/pip" install --quiet --no-build-isolation --no-deps --force-reinstall \
  --config-settings=build-dir="$environment/build" \
  --config-settings=cmake.define.FLIPFREE_KERNELS_LIBRARY="$kernels" .
touch "$environment/flipfree-installed"
