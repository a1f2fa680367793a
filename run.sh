#!/usr/bin/env bash
# ./run.sh          builds Isorelax and opens the editor on a sample mesh; without a display, smooths the sample and
#                   draws it before and after.
# ./run.sh ARGS...  builds Isorelax and passes ARGS to the program: ./run.sh smooth IN.off -o OUT.off
# Installs the Debian packages that are missing (.ci/packages.run), through sudo when not root, and says which.
set -euo pipefail
root=$(CDPATH='' cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")" && pwd -P)
# shellcheck source=.ci/lib.sh
. "$root/.ci/lib.sh"

install_packages "$root/.ci/packages.run"
build_preset "$root" release isorelax
program="$root/build/release/bin/isorelax"
sample="$root/assets/samples/part.ply"

if [ $# -gt 0 ]; then
  exec "$program" "$@"
elif [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  exec "$program" view "$sample"
fi

# No display: the same in files.
min_angle() { "$program" quality "$1" --json | sed -n 's/.*"min_angle_deg": *\([-0-9.e]*\).*/\1/p'; }
out="$root/out"
mkdir -p "$out"
say "No display: smoothing ${sample#"$root/"} into $out"
"$program" smooth "$sample" -o "$out/after.ply" --report "$out/report.json" --quiet
"$program" render "$sample" -o "$out/before.png" --color angle --size 1280x960
"$program" render "$out/after.ply" -o "$out/after.png" --color angle --size 1280x960
"$program" view "$sample" --after-iterations 50 --screenshot "$out/editor.png"
printf 'Smallest angle before: %.2f degrees  %s\n' "$(min_angle "$sample")" "$out/before.png"
printf 'Smallest angle after:  %.2f degrees  %s\n' "$(min_angle "$out/after.ply")" "$out/after.png"
printf 'Report: %s\nEditor: %s\n' "$out/report.json" "$out/editor.png"
