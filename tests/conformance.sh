#!/bin/sh
# The kernels on other OpenCL implementations than the one at hand: PoCL, Intel's runtime for CPUs and Oclgrind, which
# simulates a device and tells data races, reads of what nobody wrote and accesses out of bounds. Tiny scenes of both
# models and of the large path (tests/conformance.c), each beside the host reference; then the tests that need a device,
# on Intel's runtime. Not part of tests/run.sh: it takes some ten minutes, most of it Oclgrind and builds, and installs oclgrind and a Python package.
#   tests/conformance.sh [pocl|intel|oclgrind]...     all of them without arguments
cd "$(dirname "$0")/.." || exit 1
. tests/setup.sh
work=$PWD/build/conformance
mkdir -p "$work" || stop "cannot make $work"

on_pocl() {
    build/tests/conformance
}

# Found through a folder that names it and nothing else.
install_intel() {
    install_python "$work/intel" intel-opencl-rt intel-cmplr-lib-rt || stop "Intel's runtime cannot be installed"
    OCL_ICD_VENDORS=$work/vendors
    mkdir -p "$OCL_ICD_VENDORS"
    echo "$work/intel/lib/libintelocl.so" >"$OCL_ICD_VENDORS/intel.icd"
    export OCL_ICD_VENDORS
}

on_intel() (
    install_intel
    build/tests/conformance && ctest --test-dir build --output-on-failure -R \
        '^test_(closest_device|device|device_laws|element_device|lists|state)$' &&
        CL_CONFIG_CPU_VECTORIZER_MODE=0 build/tests/test_closest_device # small enough to be vectorized
)

# Inlined functions that return structs are what this simulator does not know, so nothing is inlined.
on_oclgrind() {
    command -v oclgrind >/dev/null || as_root apt-get install -y -q --no-install-recommends oclgrind ||
        stop "oclgrind cannot be installed"
    rm -f "$work/oclgrind.log"
    oclgrind --build-options '-cl-opt-disable -DOZ_INLINE=static' --data-races --uninitialized --check-api \
        --log "$work/oclgrind.log" build/tests/conformance one-lane || return 1
    [ ! -s "$work/oclgrind.log" ] || { head -n 40 "$work/oclgrind.log" >&2; return 1; }
}

install_packages
build_orzo build Release
cmake --build build --target conformance >build/setup.log 2>&1 || { cat build/setup.log >&2; stop "the build failed"; }
failed=
for one in ${*:-pocl intel oclgrind}; do
    say "on $one"
    "on_$one" || failed="$failed $one"
done
[ -z "$failed" ] || stop "something is wrong on:$failed"
say "agrees: ${*:-pocl intel oclgrind}"
