#!/usr/bin/env bash
# Pictures of all rows of cases.csv: segments each from its seed with the default settings, and leaves
# CASE.png (three slices through the seed with the contour, and the surface) and CASE.txt (its scores).
#
#   picture-cases.sh BUILD_FOLDER [DATA_FOLDER [RESULT_FOLDER]]
set -euo pipefail

if (($# < 1)) || [[ $1 == -* ]]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  [[ ${1:-} == -h || ${1:-} == --help ]] && exit 0 || exit 2
fi
program=$1/bin/flipfree
data=${2:-$(dirname "${BASH_SOURCE[0]}")/../../../shared/data}
results=${3:-flipfree-cases}
mkdir -p "$results"

flipfree()
{
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
    "$program" "$@"
}

tail -n +2 "$data/cases.csv" |
  while IFS=, read -r name _ _ image labels label x y z radius _; do
    flipfree segment "$data/$image" --seed "$x" "$y" "$z" --radius "$radius" \
      -o "$results/$name.vtp" --snapshot "$results/$name.png" </dev/null
    flipfree evaluate "$results/$name.vtp" "$data/$labels" --reference-label "$label" \
      </dev/null >"$results/$name.txt"
  done
