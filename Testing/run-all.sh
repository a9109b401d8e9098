#!/usr/bin/env bash
# Builds FlipFree and runs every check that a change has to pass, on a bare Debian 12 machine too:
#
#   1. installs what is missing
#   2. style: clang-format
#   3. build with warnings as errors
#   4. clang-tidy
#   5. gets ParaView and builds the plugin
#   6. all tests, pictures included, with a virtual display and software rendering
#   7. the tests that take no long segmentation again, under AddressSanitizer and UndefinedBehaviorSanitizer
#
#   run-all.sh [--quick]
#
#   --quick  leaves out 4, 5 and 7, which take most of the time; the tests of the plugin are then skipped
#
# It stops at the first step that fails. The last lines are CTest's summary.
set -euo pipefail

quick=false
case "${1:-}" in
  '') ;;
  --quick) quick=true ;;
  *)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    [[ $1 == -h || $1 == --help ]] && exit 0 || exit 2
    ;;
esac

cd -P "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD
jobs=$(nproc)

step()
{
  printf '\n== %s (after %d min %02d s)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60))
}

build()
{
  cmake --preset "$1"
  cmake --build --preset "$1" --parallel "$jobs"
}

# The display must not start afresh whenever the last window closes (-noreset): a test that opens one at
# that very moment would be thrown out.
run_tests()
{
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
    ctest --preset "$1" --parallel "$jobs"
}

# Our own sources, as the build compiles them; neither generated files nor tests.
own_sources()
{
  python3 - "$root/build/dev/compile_commands.json" "$root/Filters/" "$root/Wrapping/" <<'PYTHON'
import json, sys

with open(sys.argv[1]) as database:
    files = {entry["file"] for entry in json.load(database)}
for file in sorted(files):
    if file.startswith(tuple(sys.argv[2:])):
        print(file, end="\0")
PYTHON
}

step "Dependencies"
Wrapping/Setup/install-dependencies.sh test

step "clang-format"
find Filters Examples Testing Wrapping \( -name '*.h' -o -name '*.cxx' \) -print0 |
  xargs -0 clang-format --dry-run -Werror

step "Build"
build dev

if ! $quick; then
  step "clang-tidy"
  # The static analyzer's default, deep mode takes twice as long as the compiler and all other checks together.
  own_sources | xargs --no-run-if-empty -0 -n 1 -P "$jobs" \
    clang-tidy --quiet -p build/dev --warnings-as-errors='*' \
    --extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=mode=shallow \
    2> >(grep -v 'warnings generated' >&2)

  step "ParaView plugin"
  Wrapping/ParaView/build-plugin.sh build/paraview -DFLIPFREE_WARNINGS_AS_ERRORS=ON
fi

step "Tests"
run_tests dev

if ! $quick; then
  step "Build with sanitizers"
  build asan

  step "Tests with sanitizers"
  run_tests asan
fi
