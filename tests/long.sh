#!/bin/sh
# A long run of a small shaken bed with rows, a movie and a state every second: memory and open files must not grow after
# its first fifth. Speed is printed for people to look at.
#   tests/long.sh [STEPS] [PROGRAM]     1e7 steps, some minutes; build/orzo
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
steps=${1:-10000000}
orzo=${2:-$root/build/orzo}
work=$(mktemp -d)
pid=
trap '[ -z "$pid" ] || kill "$pid" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work"

cat >scene.yaml <<SCENE
model: rods
time: {step: 2e-5, duration: $(awk -v n="$steps" 'BEGIN { printf "%.9g", n * 2e-5 }')}
contact: {contact_time: 6e-4, restitution: 0.5}
grains: [{kind: random, count: 30, diameter: 1e-3, aspect: 2}]
walls:
  - {kind: plane, motion: {frequency: 50, acceleration_ratio: 2}}
  - {kind: cylinder, diameter: 8e-3}
settle: {drag: 70}
observe: {interval_taps: 0.5}
movie: {length: 40, fps: 25, size: [128, 96]}
checkpoint: {every: 1}
SCENE

fail() {
    printf 'long.sh: %s\n' "$*" >&2
    exit 1
}

# The run's last row: its step.
last_step() {
    step=$(tail -n 1 out/series.csv 2>/dev/null | cut -d, -f1)
    case $step in '' | *[!0-9]*) step=0 ;; esac
}

start=$(date +%s%N)
"$orzo" run scene.yaml -o out >log 2>&1 &
pid=$!
printf '%12s %10s %6s %10s\n' step 'memory/kB' files 'steps/s'
next=$((steps / 10))
before=0
looks=0
while kill -0 "$pid" 2>/dev/null; do
    sleep 0.2
    last_step
    [ "$step" -ge "$next" ] || continue
    memory=$(awk '/^VmRSS/ { print $2 }' "/proc/$pid/status" 2>/dev/null) || break
    files=$(find "/proc/$pid/fd" -mindepth 1 2>/dev/null | wc -l)
    [ -n "$memory" ] || break
    now=$(date +%s%N)
    printf '%12d %10d %6d %10d\n' "$step" "$memory" "$files" $(((step - before) * 1000000 / ((now - start) / 1000)))
    looks=$((looks + 1))
    [ "$looks" -gt 2 ] || { first=$memory; first_files=$files; }
    before=$step
    start=$now
    next=$((step + steps / 10))
done
wait "$pid" || { cat log >&2; fail 'the run failed'; }
pid=
[ "$looks" -gt 5 ] || fail 'too short to be looked at'
# A run that frees all moved by 40 kB of 166 MB, one that loses the bytes of every state grew by 6 MB.
[ "$memory" -le $((first + first / 100)) ] || fail "memory grew from $first to $memory kB"
[ "$files" -le $((first_files + 2)) ] || fail "open files grew from $first_files to $files" # a state may be on its way
last_step
printf 'long.sh: %s steps, %s rows\n' "$step" "$(($(wc -l <out/series.csv) - 1))"
