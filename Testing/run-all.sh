#!/usr/bin/env bash
# Builds FlipFree and runs every check that a change has to pass, on a bare Debian 12 or 13 machine too:
#
#   1. installs what is missing
#   2. style: clang-format (Debian 12's alone)
#   3. build with warnings as errors
#   4. clang-tidy (Debian 12's alone)
#   5. gets ParaView and builds the plugin
#   6. all tests, pictures included, with a virtual display and software rendering; the wheel takes the plugin's kernels
#   7. the tests that take no long segmentation again, under AddressSanitizer and UndefinedBehaviorSanitizer, without the
#      baselines
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
# What another clone on this machine has compiled serves as well.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1

step()
{
  printf '\n== %s (after %d min %02d s)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60))
}

# Several sources at a time: most of the time goes into headers.
build()
{
  cmake --preset "$1" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=8
  cmake --build --preset "$1" --parallel "$jobs"
}

# The display must not start afresh whenever the last window closes (-noreset): a test that opens one at
# that very moment would be thrown out.
run_tests()
{
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
    ctest --preset "$1" --parallel "$jobs"
}

# Our own sources, many at a time. Neither generated files nor tests.
own_units()
{
  python3 - "$root/build/asan" "$root" <<'PYTHON'
import json, re, sys

build, root = sys.argv[1:]
own = re.compile(rf"({re.escape(build)}/(Filters|Wrapping)/.*/Unity/|{re.escape(root)}/(Filters|Wrapping)/)")
with open(build + "/compile_commands.json") as database:
    files = {entry["file"] for entry in json.load(database)}
for file in sorted(files, reverse=True):  # those of Wrapping, the longest, begin early
    if own.match(file):
        print(file, end="\0")
PYTHON
}

# Units include sources, which clang-tidy takes for headers. The static analyzer's default, deep mode takes twice as
# long as the compiler and all other checks together. Across sources it takes moved std::function objects for leaks;
# AddressSanitizer finds the real ones.
lint()
{
  # Of another compiler, nothing may be left. So many sources at a time that each library is one unit; of the kernels each
  # room is one: the checks and the analyzer go through headers anew in every unit.
  cmake --fresh --preset asan -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=32
  find Filters Wrapping -name .clang-tidy -exec cp --parents {} build/asan \; # units stand there
  own_units | xargs --no-run-if-empty -0 -n 1 -P "$jobs" \
    clang-tidy --quiet -p build/asan --warnings-as-errors='*' --header-filter='/(Filters|Wrapping)/[^.]*\.(h|cxx)$' \
    --checks=-bugprone-suspicious-include,-clang-analyzer-cplusplus.NewDeleteLeaks \
    --extra-arg=-Xclang --extra-arg=-analyzer-opt-analyze-headers \
    --extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=mode=shallow \
    2> >(grep -v 'warnings generated' >&2)
}

# The versions of LLVM's tools differ in layout and in checks: Debian 12's have the say, wherever the sources are built.
has_the_say()
{
  if [[ $("$1" --version) != *'version 14.'* ]]; then
    echo "Left to Debian 12, whose $1 is version 14."
    return 1
  fi
}

step "Dependencies"
Wrapping/Setup/install-dependencies.sh test

step "clang-format"
if has_the_say clang-format; then
  find Filters Examples Testing Wrapping \( -name '*.h' -o -name '*.cxx' \) -print0 |
    xargs -0 clang-format --dry-run -Werror
fi

step "Build"
build dev

if ! $quick; then
  step "clang-tidy"
  if has_the_say clang-tidy; then
    lint
  fi

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
