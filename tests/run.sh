#!/bin/sh
# The whole test: sets up a fresh Debian 12, runs every test on the Release build, then on the Sanitize
# build (address, undefined, leaks) the tests that need no device and one short run on a device, and fuzzes
# what is read and looks whether the tests see a few wrong changes of the physics.
cd "$(dirname "$0")/.." || exit 1
. tests/setup.sh

# Test programs that need a device, as a pattern for ctest. The leak checker now and then dies of the driver's threads,
# so that these, and the short run below, go without it; tests/leaks.h counts what a run gives back.
device_tests() {
    pattern='^none$'
    for file in $(device_test_files); do
        pattern="$pattern|^$(basename "$file" .c)\$"
    done
    printf '%s' "$pattern"
}

install_packages
build_orzo build Release
ctest --test-dir build --parallel "$(nproc)" --output-on-failure --output-log build/ctest.log ||
    stop "tests failed (Release)"

build_orzo build-sanitize Sanitize
export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1
export LSAN_OPTIONS="suppressions=$PWD/tests/sanitize.supp:print_suppressions=0"
export UBSAN_OPTIONS=print_stacktrace=1
ctest --test-dir build-sanitize --parallel "$(nproc)" --output-on-failure -E "$(device_tests)" ||
    stop "tests failed (Sanitize)"
say "one short run on a device (Sanitize)"
ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 \
    build-sanitize/orzo run scenes/two_rods.yaml -o build-sanitize/smoke --overwrite --device cpu ||
    stop "the short run on a device failed (Sanitize)"

say "fuzzing what is read, 20 s each"
tests/fuzz.sh 20 || stop "a fuzzer found something"

say "twenty wrong changes of the physics"
tests/mutate.sh --sample 20 || stop "the tests do not see a wrong change of the physics"

say "all tests passed: Release, and Sanitize without the device's. Release said:"
grep 'tests passed' build/ctest.log
