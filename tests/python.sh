#!/bin/sh
# The Python package: installed with the library that was built, looked at beside the program, and its examples run small:
#   tests/python.sh PROGRAM     exit status 77 where its Python packages cannot be had
program=$1
cd "$(dirname "$0")/.." || exit 1
. tests/setup.sh
build=$(dirname "$program")
work=$build/python
mkdir -p "$work" || stop "cannot make $work"
install_python "$work/environment" numpy cffi pandas matplotlib grainlearning ipykernel nbclient scikit-build-core ||
    { echo "the packages of tests/requirements.txt cannot be installed: not tried"; exit 77; }
"$work/environment/bin/pip" install --quiet --disable-pip-version-check --no-build-isolation --no-deps --force-reinstall \
    ./host/python -C "cmake.define.ORZO_LIBRARY=$build/liborzo.so" || exit 1

python=$work/environment/bin/python
examples=$PWD/host/python/examples
cat >"$work/bed.yaml" <<'SCENE'
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
SCENE
"$program" run "$work/bed.yaml" -o "$work/bed" --overwrite --no-video || exit 1
export MPLBACKEND=Agg MPLCONFIGDIR="$work/matplotlib"
cd "$work" || exit 1
"$python" "$OLDPWD/tests/check_python.py" bed.yaml bed "$examples"
