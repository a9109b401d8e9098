#!/usr/bin/env bash
# Builds, audits and tests the wheels and the source archive of a release, for Linux on processors like this one's.
#
#   build-wheels.sh [--plan] [--to FOLDER] [--toolkit BUILD] [PYTHON...]
#
#   --plan           only prints which wheels there would be, and which Pythons would build and test them
#   --to FOLDER      for everything (default: build/wheels in the source folder); what is there is used again
#   --toolkit BUILD  a build of the toolkit with Python, such as build/dev: the wheels must give the same bits. Without it,
#                    they must do so among themselves.
#   PYTHON           CPythons with their headers to build for. By default, those on PATH and in pyenv, of which each
#                    version with a wheel of its own has to be there.
#
# Leaves in FOLDER/dist what is to be uploaded, and prints a table. pyproject.toml says which versions there are: each has
# a wheel, and all from wheel.py-api on have one together. Needed are GCC and the headers of Eigen, CLI11 and nlohmann's
# JSON; all else comes from the package index into FOLDER. FLIPFREE_JOBS sets the number of compilers at work.
#
# Ends with 77 where the package index is out of reach.
set -euo pipefail

# What pip installs on Debian 10, Ubuntu 20.04, RHEL 8 and all later ones.
glibc=2.28

here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd -P "$here/../../.." && pwd)
folder=$root/build/wheels
toolkit=
only_plan=false
while [[ ${1:-} == -* ]]; do
  case "$1" in
    --plan) only_plan=true ;;
    --to)
      folder=${2:?--to wants a folder}
      shift
      ;;
    --toolkit)
      toolkit=$(cd -P "${2:?--toolkit wants a build folder}" && pwd)
      shift
      ;;
    *)
      sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
      [[ $1 == -h || $1 == --help ]] && exit 0 || exit 2
      ;;
  esac
  shift
done

cd "$root"
# shellcheck source-path=SCRIPTDIR
source "$here/find-pythons.sh"
find_pythons "$@"

if $only_plan; then
  for builder in "${builders[@]}"; do
    echo "$(tag_of "$builder"), tested with 3.${testers[$builder]// / 3.}, built with ${pythons[$builder]}"
  done
  print_untested
  exit 0
fi

step()
{
  printf '\n== %s (after %d min %02d s)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60))
}

# Options of other builds, and a toolkit that is on the path.
unset CPPFLAGS CXXFLAGS LDFLAGS PYTHONPATH
mkdir -p "$folder"
folder=$(cd -P "$folder" && pwd)
tools=$folder/tools/bin

step "Tools"
Wrapping/Setup/install-wheel-tools.sh --release "$folder/tools" "${pythons[${builders[-1]}]}"
export PATH=$tools:$PATH CXX=$folder/c++ CMAKE_BUILD_PARALLEL_LEVEL=${FLIPFREE_JOBS:-$(nproc)}
"$here/make-compiler.sh" "$tools/python" "$glibc" "$CXX"

rm -rf "$folder/dist" "$folder/built"
step "Source archive"
"$tools/python" -m build --sdist --no-isolation --outdir "$folder/dist" . >"$folder/sdist.log" ||
  give_up "No source archive: $folder/sdist.log says why."

# build_wheel BUILDER: leaves the wheel in built/BUILDER. All link the kernels that the first one has compiled.
kernels=
build_wheel()
{
  local environment=$folder/build-3.$1
  Wrapping/Setup/install-wheel-tools.sh "$environment" "${pythons[$1]}"
  "$environment/bin/pip" wheel --quiet --no-build-isolation --no-deps --wheel-dir "$folder/built/$1" \
    --config-settings=build-dir="$environment/build" \
    --config-settings=cmake.define.FLIPFREE_KERNELS_LIBRARY="$kernels" .
  kernels=${kernels:-$(find "$environment/build" -name libFlipFreeKernels.a)}
}

for builder in "${builders[@]}"; do
  step "Wheel $(tag_of "$builder")"
  build_wheel "$builder"
  log=$folder/built/$builder/audit.log
  "$here/audit-wheel.sh" "$folder/built/$builder"/*.whl "$glibc" "$folder/dist" >"$log" 2>&1 ||
    give_up "The wheel cannot be released; $log says why."
done
twine check --strict "$folder"/dist/*

# What the wheels must give, bit for bit.
results=$folder/results.pickle
rm -f "$results"
if [[ $toolkit ]]; then
  step "Results of the toolkit"
  package=$(find "$toolkit/lib" -path '*-packages/flipfree' -printf '%h\n' -quit)
  python=$(sed -n 's/^_Python3_EXECUTABLE:INTERNAL=//p' "$toolkit/CMakeCache.txt")
  PYTHONPATH=$package "$python" -B Testing/Wheel/TestSameBits.py "$results"
fi

status=0
rows=()
for builder in "${builders[@]}"; do
  wheel=$(find "$folder/dist" -name "*-$(tag_of "$builder")-*.whl")
  for minor in ${testers[$builder]}; do
    step "Tests with Python 3.$minor"
    outcome=passed
    failed=$(Testing/Wheel/test-wheel.sh "$wheel" "${pythons[$minor]}" "$folder/test-3.$minor" "$results") || {
      outcome="failed: $failed; see $folder/test-3.$minor/tests.log"
      status=1
    }
    rows+=("| ${wheel##*/} | $(stat --format=%s "$wheel" | numfmt --to=si --format=%.2f) | 3.$minor | $outcome |")
  done
done

step "Result"
echo "| wheel | size | Python | tests |"
echo "|---|---|---|---|"
printf '%s\n' "${rows[@]}"
print_untested
echo "What is to be uploaded is in $folder/dist:"
ls -l "$folder/dist"
exit $status
