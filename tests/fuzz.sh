#!/bin/sh
# Fuzzes what orzo reads from people and disks (tests/fuzz/fuzz_<what>.c), under the address and undefined-behaviour
# sanitizers, from the scenes of scenes/ and tests/bad/, from the files of small runs and from tests/fuzz/<what>/.
#   tests/fuzz.sh [SECONDS]        each target for so long, 20 without
#   tests/fuzz.sh runs N [TARGET]  each target, or one, N times
cd "$(dirname "$0")/.." || exit 1
. tests/setup.sh
limit="-max_total_time=${1:-20}"
[ "${1:-}" = runs ] && limit="-runs=${2:?how many}"
only=${3:-}
work=$PWD/build-fuzz/corpus
export ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1

# What the fuzzers begin with: fuzz_WHAT's in WHAT/.
make_corpus() {
    mkdir -p "$work/scene" "$work/bed" "$work/frames" "$work/state"
    cp scenes/*.yaml tests/bad/*.yaml "$work/scene/"
    cp -r tests/fuzz/reloads tests/fuzz/page "$work/"
    printf 'model: rods\ntime: {step: 1e-5, duration: 2e-3}\ncontact: {contact_time: 6e-4, restitution: 0.4}\n%s' \
        'grains: [{kind: random, count: 3, diameter: 1e-3, aspect: 2}]
movie: {speed: 0.05, size: [64, 64]}
' >"$work/rods.yaml"
    printf 'model: trigrains\ntime: {step: 2e-6, duration: 2e-4}\n%s' \
        'grains: [{kind: random, count: 2, shape: polygon, corners: 5, radius: 2e-3}]
movie: {speed: 0.005, size: [64, 64]}
' >"$work/trigrains.yaml"
    for model in rods trigrains; do
        build/orzo run "$work/$model.yaml" -o "$work/$model" --overwrite --no-video >"$work/log" 2>&1 ||
            { cat "$work/log" >&2; stop "no files to begin with"; }
        cp "$work/$model/final.csv" "$work/bed/$model.csv"
        cp "$work/$model/frames.bin" "$work/frames/$model.bin"
        cp "$work/$model/state.h5" "$work/state/$model.h5"
    done
}

install_packages
build_orzo build Release
CC=clang build_orzo build-fuzz Fuzz
make_corpus
for fuzzer in build-fuzz/tests/fuzz_*; do
    [ -x "$fuzzer" ] && [ -f "$fuzzer" ] || continue
    what=${fuzzer##*fuzz_}
    [ -z "$only" ] || [ "$only" = "$what" ] || continue
    say "fuzzing $what"
    "$fuzzer" "$limit" -timeout=20 -rss_limit_mb=3000 -artifact_prefix="build-fuzz/found_${what}_" "$work/$what" \
        >"build-fuzz/$what.log" 2>&1 || { tail -n 60 "build-fuzz/$what.log" >&2; stop "fuzz_$what found something"; }
    tail -n 1 "build-fuzz/$what.log"
done
say "the fuzzers found nothing"
