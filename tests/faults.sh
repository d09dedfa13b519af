#!/bin/sh
# Makes the n-th call of each kind fail (tests/faults.c) in a small run with a movie, for n = 1, 1 + STRIDE, ...: memory,
# write, open, sync, rename, HDF5, libav, GL, OpenCL. However it ends: by no signal, in time, with no success claimed that
# is none, with all memory, files and objects of OpenCL, GL and libav given back (tests/leaks.h), and in a folder from which
# `orzo resume` gives the bytes of the run without a fault, or, before its first step, that can be run again. The run's last
# words name what goes on.
#   tests/faults.sh [STRIDE] [PROGRAM] [KIND]...
set -u
root=$(cd "$(dirname "$0")/.." && pwd)
stride=${1:-1}
orzo=${2:-$root/build/orzo}
[ $# -gt 2 ] && shift 2 && kinds=$* || kinds='open sync rename write hdf5 libav gl memory opencl'
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
faulty=0
wrong=0

complain() {
    printf 'faults.sh: %s\n' "$*" >&2
    sed 's/^/    /' log >&2
    wrong=$((wrong + 1))
}

${CC:-cc} -shared -fPIC -O1 -o faults.so "$root/tests/faults.c" -ldl || exit 1
cat >scene.yaml <<'SCENE'
model: rods
time: {step: 2e-5, taps: 2}
contact: {contact_time: 6e-4, restitution: 0.5}
grains:
  - {kind: random, count: 29, diameter: 1e-3, aspect: 2}
  - {kind: random, count: 1, diameter: 1e-3, aspect: 1}
walls:
  - {kind: plane, motion: {frequency: 50, acceleration_ratio: 2}}
  - {kind: cylinder, diameter: 8e-3}
settle: {drag: 70, time_max: 0.02, rest_time: 0.01}
observe: {interval_taps: 0.5}
movie: {speed: 0.1, size: [64, 64]}
checkpoint: {every: 0.05}
SCENE

same() {
    cmp -s whole/series.csv cut/series.csv && cmp -s whole/final.csv cut/final.csv
}

# all_given_back WHERE
all_given_back() {
    [ ! -s held ] || complain "$1: not given back: $(sort -u held | xargs addr2line -fsp -e "$orzo" | cut -d' ' -f1 | tr '\n' ' ')"
}

# with KIND N; the host draws rods itself where there is no GPU, unless it is told not to
with() {
    case $1 in gl) drawn='--gl egl' ;; *) drawn= ;; esac
    # Without a PATH there is no gnuplot, which would meet the faults too.
    # shellcheck disable=SC2086 # two words, or none
    timeout -k 5 100 env PATH=/nonexistent LD_PRELOAD="$work/faults.so" ORZO_FAULT="$1:$2" ORZO_FAULT_COUNT="$work/count" \
        ORZO_FAULT_HELD="$work/held" "$orzo" run scene.yaml -o cut $drawn >log 2>&1
}

# try KIND N
try() {
    rm -rf cut count held
    with "$1" "$2"
    status=$?
    [ -s count ] || return 0 # not that many calls this time
    faulty=$((faulty + 1))
    all_given_back "$1 $2"
    case $status in
    0)
        same || complain "$1 $2: success is claimed, and the numbers are others"
        return 0
        ;;
    1 | 2) ;;
    *)
        complain "$1 $2: ends with status $status"
        return 0
        ;;
    esac
    grep -q . log || complain "$1 $2: status $status and not a word"
    if [ -f cut/state.h5 ] || [ -f cut/state.h5.previous ]; then
        # A whole run whose own last words were what could not be written has nothing to go on with.
        grep -q 'orzo resume cut' log || same || complain "$1 $2: no word of how to go on"
        PATH=/nonexistent "$orzo" resume cut >log 2>&1 || { complain "$1 $2: cannot be resumed"; return 0; }
    else
        grep -q 'first step' log && ! grep -q 'the state is not kept' log && complain "$1 $2: leaves no state"
        PATH=/nonexistent "$orzo" run scene.yaml -o cut --overwrite >log 2>&1 || { complain "$1 $2: cannot be run again"; return 0; }
    fi
    same || complain "$1 $2: afterwards the numbers are others"
}

"$orzo" run scene.yaml -o whole >log 2>&1 || { complain 'the run without a fault'; exit 1; }
for kind in $kinds; do
    rm -rf cut count
    with "$kind" 0 || { complain "$kind: the run that counts"; exit 1; }
    all_given_back "$kind"
    calls=$(cat count)
    n=1
    while [ "$n" -le "$calls" ]; do
        try "$kind" "$n"
        n=$((n + stride))
    done
    printf 'faults.sh: %s, %s calls: %s faults so far, %s wrong\n' "$kind" "$calls" "$faulty" "$wrong"
done
[ "$wrong" -eq 0 ]
