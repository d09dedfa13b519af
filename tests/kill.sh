#!/bin/sh
# Kills runs at random moments (SIGKILL) and resumes them: series.csv, final.csv, frames.bin and exports must be those of the run
# that nobody killed, to the byte, and the movie one file with as many frames.
#   tests/kill.sh [TIMES] [PROGRAM]     100 times, build/orzo
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
times=${1:-100}
orzo=${2:-$root/build/orzo}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

cat >scene.yaml <<'SCENE'
model: rods
time: {step: 1e-5, taps: 30}
contact: {contact_time: 6e-4, restitution: 0.4, friction: 0.1}
grains: [{kind: random, count: 60, diameter: 0.5e-3, aspect: 4}]
walls:
  - {kind: plane, motion: {frequency: 30, acceleration_ratio: 2}}
  - {kind: cylinder, diameter: 5e-3}
settle: {drag: 70}
observe: {interval: 0.004}
movie: {length: 2, size: [128, 96]}
export: [vtk, xyz]
checkpoint: {every: 0.05}
SCENE

fail() {
    printf 'kill.sh: %s\n' "$*" >&2
    exit 1
}

# Frames of a finished movie, as its table of sizes (stsz) counts them.
count_frames() {
    at=$(grep -abo stsz "$1" | head -n 1 | cut -d: -f1)
    od -An -tu1 -j $((at + 12)) -N 4 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'
}

"$orzo" run scene.yaml -o whole >log 2>&1 || { cat log; fail 'the run that nobody kills'; }
frames=$(count_frames whole/movie.mp4)
[ "$frames" -gt 40 ] || fail "the whole movie has $frames frames"
start=$(date +%s%N)
"$orzo" run scene.yaml -o timed >log 2>&1
span=$((($(date +%s%N) - start) / 1000000))
killed=0
resumed=0
i=0
while [ "$i" -lt "$times" ]; do
    i=$((i + 1))
    rm -rf cut
    "$orzo" run scene.yaml -o cut >log 2>&1 &
    pid=$!
    wait_ms=$(od -An -N4 -tu4 /dev/urandom | awk -v span="$span" '{ print $1 % span }')
    sleep "$(awk -v ms="$wait_ms" 'BEGIN { print ms / 1000 }')"
    if kill -9 "$pid" 2>/dev/null; then killed=$((killed + 1)); fi
    wait "$pid" 2>/dev/null || true
    if [ -f cut/state.h5 ] || [ -f cut/state.h5.previous ]; then # a .part is none yet
        "$orzo" resume cut >log 2>&1 || { cat log; fail "killed after $wait_ms ms, cannot be resumed"; }
        resumed=$((resumed + 1))
    else # before its first state: said, and run again
        "$orzo" resume cut >log 2>&1 && fail 'resumes without a state'
        grep -q 'no state' log || { cat log; fail "killed after $wait_ms ms: another message"; }
        "$orzo" run scene.yaml -o cut --overwrite >log 2>&1 || { cat log; fail "killed after $wait_ms ms, cannot be run again"; }
    fi
    for file in series.csv final.csv frames.bin; do
        cmp whole/$file cut/$file || fail "killed after $wait_ms ms: $file differs"
    done
    diff -rq -x .orzo whole/export cut/export || fail "killed after $wait_ms ms: exports differ"
    [ "$(count_frames cut/movie.mp4)" = "$frames" ] || fail "killed after $wait_ms ms: the movie is not one of $frames frames"
    ! ls cut/movie.mp4.* >/dev/null 2>&1 || fail "killed after $wait_ms ms: a part of the movie is left"
done
printf 'kill.sh: %s runs, %s killed, %s of them resumed from a state: all the same to the byte\n' "$times" "$killed" "$resumed"
