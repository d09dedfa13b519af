#!/bin/sh
# Fuzzes what orzo reads from people and disks (tests/fuzz/fuzz_<what>.c), under the address and undefined-behaviour
# sanitizers, from tests/fuzz/<what>/, the scenes of scenes/ and tests/bad/, and the frames and states of two small runs.
#   tests/fuzz.sh [SECONDS]        each target for so long, 20 without, from one and the same random seed: what one
#                                  machine passes, another does not fail by chance
#   tests/fuzz.sh runs N [TARGET]  each target, or one, N times, each time from another seed
cd "$(dirname "$0")/.." || exit 1
. tests/setup.sh
limit="-max_total_time=${1:-20} -seed=1"
[ "${1:-}" = runs ] && limit="-runs=${2:?how many}"
only=${3:-}
work=$PWD/build-fuzz/corpus
# Short stacks of allocations and a small store of freed memory: half as many runs again in the same time.
export ASAN_OPTIONS=detect_leaks=1:malloc_context_size=2:quarantine_size_mb=16:max_malloc_fill_size=0 UBSAN_OPTIONS=print_stacktrace=1

# What the fuzzers begin with: fuzz_WHAT's in WHAT/. Frames and states are binary: they are made here, of the scenes.
make_corpus() {
    mkdir -p "$work/frames" "$work/state" "$work/study"
    for what in tests/fuzz/*/; do
        cp -r "$what" "$work/"
    done
    cp scenes/*.yaml "$work/scene/"
    for bad in tests/bad/*.yaml; do
        cp "$bad" "$work/scene/bad_${bad##*/}"
    done
    for paper in pournin2005 poschel1995; do
        cp "scenes/$paper/study.yaml" "$work/study/$paper.yaml"
    done
    for model in rods trigrains; do
        printf '%s\0time.step=2e-6\0walls.0=false\0' "$(cat tests/fuzz/scene/$model.yaml)" >"$work/scene/$model.set"
        build/orzo run tests/fuzz/scene/$model.yaml -o "$work/$model" --overwrite --no-video >"$work/log" 2>&1 ||
            { cat "$work/log" >&2; stop "no files to begin with"; }
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
    # shellcheck disable=SC2086 # one option, or two
    "$fuzzer" $limit -timeout=20 -rss_limit_mb=3000 -artifact_prefix="build-fuzz/found_${what}_" "$work/$what" \
        >"build-fuzz/$what.log" 2>&1 || { tail -n 60 "build-fuzz/$what.log" >&2; stop "fuzz_$what found something"; }
    tail -n 1 "build-fuzz/$what.log"
done
say "the fuzzers found nothing"
