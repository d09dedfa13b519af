#!/bin/sh
# What orzo exports of a bed of either model, read by VTK, OVITO and h5py and compared number by number:
#   tests/export.sh PROGRAM     exit status 77 where these readers cannot be had
program=$1
cd "$(dirname "$0")/.." || exit 1
. tests/setup.sh
work=$PWD/build/export
mkdir -p "$work" || stop "cannot make $work"
install_python "$work/python" vtk h5py ovito || { echo "VTK, h5py and OVITO cannot be installed: not tried"; exit 77; }

cat >"$work/rods.yaml" <<'SCENE'
model: rods
time: {step: 2e-5, taps: 1}
contact: {contact_time: 6e-4, restitution: 0.4, friction: 0.1}
grains:
  - {kind: random, count: 60, diameter: [0.4e-3, 0.6e-3], aspect: 4}
  - {kind: random, count: 20, diameter: 0.8e-3, aspect: 0}
walls:
  - {kind: plane, normal: [0, 0, 1], motion: {frequency: 30, acceleration_ratio: 2}}
  - {kind: cylinder, diameter: 6e-3}
settle: {drag: 70, rest_time: 0.01}
contacts: {interval: 0.005}
export: [vtk, xyz, h5md, csv]
export_interval: 0.005
SCENE
cat >"$work/flat.yaml" <<'SCENE'
model: trigrains
time: {step: 1.5e-6, duration: 0.1}
beams: {second_moment: 3e-10}
contact: {law: hooke, contact_time: 1e-4, restitution: 0.5}
grains:
  - {kind: random, count: 12, shape: polygon, corners: [4, 7], irregularity: 0.3, radius: [1e-3, 1.6e-3]}
  - {kind: random, count: 4, shape: disc, radius: 1e-3}
walls:
  - {kind: vessel, width: 12e-3, height: 25e-3, thickness: 3e-3}
contacts: {interval: 0.02}
export: [vtk, xyz, h5md, csv]
export_interval: 0.02
SCENE
for scene in rods flat; do
    "$program" run "$work/$scene.yaml" -o "$work/$scene" --overwrite || exit 1
    "$work/python/bin/python" tests/read_exports.py "$work/$scene" || exit 1
done
