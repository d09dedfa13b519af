#!/bin/sh
# How many single changes of the physics the tests see. Each line of tests/mutations.txt is applied to a scratch copy
# in build-mutate/, what changed is built, and the test programs that the list names for it are run until one fails.
# Prints what survived, and the share that was caught; ends with 1 where something survived that the list does not
# expect to.
#   tests/mutate.sh              all of them
#   tests/mutate.sh --sample N   N of those that need no device, evenly taken from the list
#   tests/mutate.sh NAME...      these, as the list's first word is shown (predict_c.sticking)
#   tests/mutate.sh --check      only whether every line still finds its place in the sources
cd "$(dirname "$0")/.." || exit 1
. tests/setup.sh

root=$PWD
list=tests/mutations.txt
folder="build-mutate"
copy=$folder/source
build=$folder/build
jobs=$(nproc)

# Kernels of mutants would fill the user's cache for good.
POCL_CACHE_DIR=$root/$folder/kernels
TMPDIR=$root/$folder/temporary
export POCL_CACHE_DIR TMPDIR

# Writes the chosen rows: name, file, expectation, tests; tabs between.
choose() {
    perl tests/mutate.pl list "$list" >"$folder/all" || stop "$list does not fit the sources"
    case ${1:-} in
    '') cat "$folder/all" ;;
    --sample)
        device_test_files | sed 's,.*/,,; s,\.c$,,' >"$folder/device"
        grep -vwFf "$folder/device" "$folder/all" | awk -F '\t' '$3 == "caught"' >"$folder/host"
        awk -v wanted="$2" -v all="$(wc -l <"$folder/host")" \
            'int(NR * wanted / all) > int((NR - 1) * wanted / all)' "$folder/host"
        ;;
    *)
        for name; do
            awk -F '\t' -v name="$name" '$1 == name { print; found = 1 } END { exit !found }' \
                "$folder/all" || stop "$list has no $name"
        done
        ;;
    esac
}

# make_tests PROGRAM...: builds them in the scratch copy.
make_tests() {
    cmake --build "$build" --parallel "$jobs" --target "$@" >"$folder/build.log" 2>&1
}

# run_test PROGRAM SECONDS: whether it passes; the first failure ends it, as its output is cut off then.
run_test() {
    (
        cd "$build" || exit 1
        timeout -k 5 "$2" "tests/$1" 2>&1
        echo "ended with $?"
    ) | awk '{ print } /FAILED|^ended with/ { exit }' >"$folder/test.log"
    grep -qx 'ended with 0' "$folder/test.log"
}

now() {
    date +%s
}

# Builds and runs the tests on the unchanged copy, and notes for each how long it may take: ten times as long and
# a while more, which only a loop without an end needs.
prepare() {
    mkdir -p "$TMPDIR" "$POCL_CACHE_DIR"
    # shellcheck disable=SC2046 # one word a program is meant
    set -- $(cut -f 4 "$folder/chosen" | tr ' ' '\n' | sort -u)
    perl tests/mutate.pl sync . "$copy" CMakeLists.txt host kernels shaders scenes tests || exit 1
    [ -f "$build/CMakeCache.txt" ] || generator='-G Ninja'
    # shellcheck disable=SC2086 # two words, or none
    { cmake -S "$copy" -B "$build" ${generator:-} -DCMAKE_BUILD_TYPE=Mutate \
        -DCMAKE_C_FLAGS_MUTATE=-O1 >"$folder/build.log" 2>&1 && make_tests "$@"; } ||
        { cat "$folder/build.log" >&2; stop "the unchanged copy cannot be built"; }
    : >"$folder/limits"
    for program; do
        before=$(now)
        run_test "$program" 900 ||
            { cat "$folder/test.log" >&2; stop "$program fails on the unchanged sources"; }
        echo "$program $((($(now) - before) * 10 + 20))" >>"$folder/limits"
    done
}

# Which test, if any, sees the change that is in the copy now: its name, or nothing.
find_witness() {
    for program; do
        make_tests "$program" || { echo '(does not build)'; return; }
        limit=$(awk -v program="$program" '$1 == program { print $2 }' "$folder/limits")
        run_test "$program" "$limit" || { echo "$program"; return; }
    done
}

# try NAME FILE EXPECTATION PROGRAM...
try() {
    name=$1 file=$2 expected=$3
    shift 3
    before=$(now)
    what=$(perl tests/mutate.pl apply "$list" "$name" . "$copy") || stop "$name: see above"
    witness=$(find_witness "$@")
    cp "$file" "$copy/$file"
    case $witness in
    '') outcome=survives ;;
    '(does not build)') outcome='does not build' ;;
    *) outcome=caught ;;
    esac
    verdict=$outcome
    [ "$outcome" = "$expected" ] || verdict="$outcome, not as expected"
    printf '%s\t%s\t%s\t%ss\t%s\n' "$name" "$verdict" "${witness:--}" "$(($(now) - before))" "$what" |
        tee -a "$folder/result"
}

# The end: what survived, what the list is wrong about, and the score.
report() {
    awk -F '\t' -v list="$list" '
        $2 ~ /^caught/ { caught++ }
        $2 == "survives" { equal++ }
        $2 ~ /expected/ { odd[++odds] = $0 }
        END {
            if (odds) { print "orzo: not as " list " expects:" }
            for (i = 1; i <= odds; i++) { print odd[i] }
            printf "orzo: %d of %d mutations caught (%.1f %%), %d more that no test can see survived\n", \
                caught, NR - equal, 100 * caught / (NR > equal ? NR - equal : 1), equal
            exit odds > 0
        }' "$folder/result"
}

if [ "${1:-}" = --check ]; then
    rows=$(perl tests/mutate.pl list "$list") || stop "$list does not fit the sources"
    say "$(printf '%s\n' "$rows" | wc -l) mutations, each in its place"
    exit 0
fi
mkdir -p "$folder" || stop "cannot make $folder/"
choose "$@" >"$folder/chosen" || exit 1
: >"$folder/result"
prepare
say "$(wc -l <"$folder/chosen") mutations"
while IFS='	' read -r name file expected tests; do
    # shellcheck disable=SC2086 # one word a program is meant
    try "$name" "$file" "$expected" $tests </dev/null
done <"$folder/chosen"
report
