#!/usr/bin/env bash
# From a bare Debian 12 or 13 machine to a first segmentation: installs what is missing, builds FlipFree,
# segments the liver of the built-in abdomen phantom, and scores it against the phantom's truth.
#
#   segment-phantom.sh [folder for the results, default: ./flipfree-results]
#
# Leaves there
#   abdomen.nii.gz, abdomen-truth.nii.gz   the phantom and its true organs
#   liver.vtp, liver.nii.gz                the surface and the label map that FlipFree found
#   liver.csv                              its convergence
#   scores.txt                             how well they agree with the truth
#   liver.png                              three slices with the contour, and the surface
set -euo pipefail

case "${1:-}" in
  -*)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    [[ $1 == -h || $1 == --help ]] && exit 0 || exit 2
    ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
mkdir -p "${1:-flipfree-results}"
results=$(cd "${1:-flipfree-results}" && pwd -P)

"$root/Wrapping/Setup/install-dependencies.sh" build
cd "$root"
cmake --preset release
cmake --build --preset release --target flipfree --parallel "$(nproc)"

# The picture needs a display; a virtual one serves wherever this runs.
flipfree()
{
  LIBGL_ALWAYS_SOFTWARE=1 xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
    "$root/build/release/bin/flipfree" "$@"
}

# The phantom knows a seed for each of its organs, printed as "liver (label 6): --seed ...".
read -ra seed < <(flipfree phantom abdomen -o "$results" | sed -n 's/^liver .*: //p')
flipfree segment "$results/abdomen.nii.gz" "${seed[@]}" \
  -o "$results/liver.vtp" --labels "$results/liver.nii.gz" --convergence "$results/liver.csv" \
  --snapshot "$results/liver.png"
flipfree evaluate "$results/liver.vtp" "$results/abdomen-truth.nii.gz" --reference-label 6 |
  tee "$results/scores.txt"
printf '\nThe results are in %s\n' "$results"
