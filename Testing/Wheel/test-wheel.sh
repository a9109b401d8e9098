#!/usr/bin/env bash
# Installs a wheel with numpy alone, and runs the tests that need nothing else: what a release is to pass with every
# Python.
#
#   test-wheel.sh WHEEL PYTHON ENVIRONMENT RESULTS
#
#   ENVIRONMENT  folder of a virtual environment, which is made where it is missing; ENVIRONMENT/tests.log has what the
#                tests say
#   RESULTS      file of results (TestSameBits.py) that the wheel must give bit for bit; where it is missing, it is
#                written, for the wheels that follow
#
# Prints the names of tests that fail. Ends with 77 where numpy cannot be had.
set -euo pipefail

if [[ $# != 4 ]]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  [[ ${1:-} == -h || ${1:-} == --help ]] && exit 0 || exit 2
fi
wheel=$1
environment=$3
results=$4
testing=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
python=$environment/bin/python

[[ -x $environment/bin/pip ]] || "$2" -m venv "$environment"
"$environment/bin/pip" uninstall --quiet --yes flipfree 2>/dev/null
if ! "$environment/bin/pip" install --quiet --retries 1 --timeout 30 "$wheel"; then
  echo "The wheel cannot be installed, or the package index is out of reach." >&2
  exit 77
fi

export PYTHONPATH=$testing/Python FLIPFREE_PYTHON_SOURCE=$testing/../Wrapping/Python
failed=()
# check NAME COMMAND...
check()
{
  printf '\n== %s\n' "$1"
  "${@:2}" || failed+=("$1")
}

# As in README.md: the phantom, a liver, its files, its scores.
command_line()
{
  local flipfree=$environment/bin/flipfree folder=$environment/try
  rm -rf "$folder"
  mkdir "$folder"
  "$flipfree" phantom abdomen -o "$folder" &&
    "$flipfree" segment "$folder/abdomen.nii.gz" --seed 99.75 83.75 167 --radius 28 -o "$folder/liver.vtp" \
      --labels "$folder/liver.nii.gz" &&
    "$flipfree" evaluate "$folder/liver.nii.gz" "$folder/abdomen-truth.nii.gz" --reference-label 6 | tee "$folder/scores" &&
    grep --quiet --extended-regexp '^Dice +0\.94' "$folder/scores"
}

{
  "$python" -m pip list --disable-pip-version-check
  check command command_line
  for name in Python/TestSegment Python/TestSurfaces Python/TestTrace Wheel/TestExtension; do
    check "${name#*/}" "$python" -B "$testing/$name.py"
  done
  if [[ -e $results ]]; then
    check TestSameBits env FLIPFREE_EXPECTED="$results" "$python" -B "$testing/Wheel/TestSameBits.py"
  else
    check TestSameBits "$python" -B "$testing/Wheel/TestSameBits.py" "$results"
  fi
} >"$environment/tests.log" 2>&1
echo "${failed[*]}"
((${#failed[@]} == 0))
