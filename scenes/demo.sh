#!/bin/sh
# Sets up a fresh Debian 12, builds orzo and runs the first taps of experiment an6:
#     scenes/demo.sh [TAPS]        (30 taps; root or sudo only where packages are missing)
# ORZO_PROGRAM and ORZO_OUT, when set, name a built program to run instead, and the folder to write.
cd "$(dirname "$0")/.." || exit 1
. tests/setup.sh

taps=${1:-30}
case $taps in
'' | *[!0-9]* | 0) stop "'$taps' is no number of taps; expected: scenes/demo.sh [TAPS]" ;;
esac
out=${ORZO_OUT:-runs/demo}
program=${ORZO_PROGRAM:-build/orzo}

if [ -z "$ORZO_PROGRAM" ]; then
    install_packages
    build_orzo build Release
fi
say "running scenes/an6.yaml for $taps taps"
"$program" run scenes/an6.yaml --set "time.taps=$taps" --set "snapshots.taps=[0, $taps]" \
    -o "$out" --overwrite ||
    stop "the run failed; see above and $out/log.txt"

say "done. Look at"
say "    movie     $out/movie.mp4"
for picture in "$out"/snapshots/*.png; do
    [ -f "$picture" ] && say "    picture   $picture"
done
say "    numbers   $out/series.csv"
