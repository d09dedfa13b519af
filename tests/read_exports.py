"""What orzo exports, read by the programs' own readers and compared number by number with frames.bin,
which is read here as host/observe/frames.h describes it: read_exports.py RUN, a run's folder whose scene
exports everything, with contacts at the same moments."""
import sys

import h5py
import numpy as np
import vtk
from ovito.io import import_file
from vtk.util.numpy_support import vtk_to_numpy

run = sys.argv[1]
folder = run + "/export"
EXPORT = 8  # purpose of a frame


class Frames:
    """frames.bin, versions 3 and 4."""

    def __init__(self, path):
        self.bytes = open(path, "rb").read()
        self.at = 8
        assert self.bytes[:8] == b"ozframes"
        assert self.take("u4") == 0x01020304
        self.flat = {3: False, 4: True}[int(self.take("u4"))]
        self.count, self.walls = int(self.take("i8")), int(self.take("u4", 2)[0])
        elements = self.take("i8", 4) if self.flat else [0, 0, 0, 0]
        self.elements = int(elements[0] + elements[1])
        self.diameter, self.length, self.mass = (self.take("f8", self.count) for _ in range(3))
        self.population = self.take("i4", self.count)
        if self.flat:
            self.first = self.take("i4", self.count + self.walls + 1)
            self.radius, self.corner = self.take("f8", self.elements), self.take("f8", 6 * self.elements)
            self.area, self.element_mass = self.take("f8", self.elements), self.take("f8", self.elements)
            self.take("f8", self.elements)
            self.angle = self.take("f8", self.elements)
            self.take("i4", int(2 * (elements[2] + elements[3])))
        self.take("u8")
        self.frames = []
        while self.at < len(self.bytes):
            self.frames.append(self.frame())
        self.frames = [f for f in self.frames if f["purpose"] & EXPORT]

    def take(self, kind, count=None):
        values = np.frombuffer(self.bytes, kind, 1 if count is None else count, self.at)
        self.at += values.nbytes
        return values[0] if count is None else values

    def frame(self):
        n, f = self.count, {}
        end = self.at + int(self.take("u8"))
        f["purpose"], _ = self.take("u4", 2)
        f["step"], f["time"] = int(self.take("i8")), float(self.take("f8"))
        f["offset"], _ = self.take("f4", self.walls), self.take("f4", self.walls)
        if self.flat:
            e = self.elements
            f["place"], f["turn"] = self.take("f4", 2 * e).reshape(e, 2), self.take("f4", e)
            f["speed"], f["spin"] = self.take("f4", 2 * e).reshape(e, 2), self.take("f4", e)
        else:
            f["position"], f["quaternion"] = self.take("f4", 3 * n).reshape(n, 3), self.take("f4", 4 * n).reshape(n, 4)
            f["velocity"], f["angular_velocity"] = (self.take("f4", 3 * n).reshape(n, 3) for _ in range(2))
        contacts = int(self.take("i8"))
        kind = [("whole", "i4", 6), ("point", "f4", 3), ("normal", "f4", 3), ("push", "f4"), ("tangential", "f4", 3),
                ("overlap", "f4")]
        f["contacts"] = np.frombuffer(self.bytes, kind, contacts, self.at)
        self.at += f["contacts"].nbytes + 8
        assert self.at == end
        if self.flat:
            self.join(f)
        return f

    def join(self, f):
        """Grains of elements: centre of mass, its velocity, spin and turn by mass."""
        f["position"], f["velocity"] = np.zeros((self.count, 3)), np.zeros((self.count, 3))
        f["turned"] = np.zeros(self.count)
        for g in range(self.count):
            part = slice(self.first[g], self.first[g + 1])
            m = self.element_mass[part] / self.element_mass[part].sum()
            f["position"][g, :2], f["velocity"][g, :2] = m @ f["place"][part], m @ f["speed"][part]
            f["turned"][g] = m @ (f["turn"][part] - self.angle[part])


def near(a, b, scale=None):
    """Equal but for a float's rounding (6e-8), twice, of the largest number or of the scale."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    assert a.shape == b.shape, (a.shape, b.shape)
    bound = 1.3e-7 * (scale or (np.abs(b).max() if b.size else 0))
    assert np.all(np.abs(a - b) <= bound), (np.abs(a - b).max(), bound)


def read_poly(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    assert reader.GetErrorCode() == 0, path
    return reader.GetOutput()


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))


def check_vtk(frames):
    for k, f in enumerate(frames.frames):
        poly = read_poly(f"{folder}/grains_{k:05d}.vtp")
        near(poly.GetFieldData().GetArray("TimeValue").GetValue(0), f["time"])
        if frames.flat:
            check_flat_polygons(frames, f, poly)
        else:
            data = poly.GetPointData()
            assert poly.GetNumberOfVerts() == frames.count
            near(vtk_to_numpy(poly.GetPoints().GetData()), f["position"])
            for name in ("quaternion", "velocity", "angular_velocity"):
                near(array(data, name), f[name])
            for name in ("diameter", "length", "mass"):
                near(array(data, name), getattr(frames, name))
            near(array(data, "population"), frames.population)
            x, y, z = axis_of(f["quaternion"])
            near(array(data, "axis"), np.c_[x, y, z], 4)  # sums of squares of rounded numbers
        check_network(f, read_poly(f"{folder}/contacts_{k:05d}.vtp"))
        walls = read_poly(f"{folder}/walls_{k:05d}.vtp")
        assert set(array(walls.GetCellData(), "wall")) == set(range(frames.walls))
        if not frames.flat:  # wall 0 is the floor: a square at its height
            near([walls.GetPoint(i)[2] for i in range(4)], [f["offset"][0]] * 4, 1e-2)
    times = [line.split('"')[1] for line in open(folder + "/grains.pvd") if "<DataSet" in line]
    assert [float(t) for t in times] == [f["time"] for f in frames.frames]


def axis_of(q):
    w, x, y, z = q.astype(float).T
    return 2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)


def check_flat_polygons(frames, f, poly):
    """Every triangle has its corners where they are; a disc's polygon has its radius."""
    free = frames.first[frames.count]
    points = vtk_to_numpy(poly.GetPoints().GetData())
    assert poly.GetNumberOfPolys() == free
    for i in range(free):
        ids = poly.GetCell(i).GetPointIds()
        got = points[[ids.GetId(c) for c in range(ids.GetNumberOfIds())]]
        if frames.radius[i] > 0:
            near(np.hypot(*(got[:, :2] - f["place"][i]).T), np.full(len(got), frames.radius[i]), 2e-2)
        else:
            c, s = np.cos(f["turn"][i]), np.sin(f["turn"][i])
            corners = frames.corner[6 * i:6 * i + 6].reshape(3, 2) @ np.array([[c, s], [-s, c]])
            near(got[:, :2], corners + f["place"][i], 2e-2)
    owner = array(poly.GetCellData(), "id").astype(int)
    near(array(poly.GetCellData(), "turned"), f["turned"][owner])
    near(array(poly.GetCellData(), "velocity"), f["velocity"][owner])


def check_network(f, poly):
    c, data = f["contacts"], poly.GetCellData()
    assert poly.GetNumberOfLines() == len(c)
    if len(c) == 0:
        return
    a, b = c["whole"][:, 0], c["whole"][:, 1]
    ends = vtk_to_numpy(poly.GetPoints().GetData()).reshape(-1, 2, 3)
    near(array(data, "a"), a)
    near(array(data, "b"), b)
    near(array(data, "fn"), c["push"])
    near(array(data, "ft"), c["tangential"])
    near(array(data, "force"), c["push"][:, None] * c["normal"] + c["tangential"], 4 * np.abs(c["push"]).max())
    near(array(data, "overlap"), c["overlap"])
    near(ends[:, 0], f["position"][a], 2e-2)
    near(ends[:, 1], np.where(b[:, None] >= 0, f["position"][b], c["point"]), 2e-2)


def check_xyz(frames):
    pipeline = import_file(folder + "/grains.xyz")
    assert pipeline.source.num_frames == len(frames.frames)
    for k, f in enumerate(frames.frames):
        data = pipeline.compute(k)
        grains = data.particles
        assert data.attributes["Timestep"] == f["step"]
        near(grains["Position"][...], f["position"])
        near(grains["Velocity"][...], f["velocity"])
        assert list(grains["Particle Identifier"]) == list(range(frames.count))
        assert list(grains["Particle Type"]) == list(frames.population + 1)
        if not frames.flat:
            near(grains["Orientation"][...], f["quaternion"][:, [1, 2, 3, 0]])
            shape = np.c_[frames.diameter / 2, frames.diameter / 2, frames.length]
            near(grains["Aspherical Shape"][...], shape)


def check_h5md(frames):
    with h5py.File(folder + "/grains.h5") as file:
        assert list(file["h5md"].attrs["version"]) == [1, 1]
        grains = file["particles/grains"]
        assert list(grains["box"].attrs["boundary"]) == [b"none"] * 3
        assert list(grains["species"]) == list(frames.population)
        near(grains["mass"], frames.mass if not frames.flat else grains["mass"])
        names = ["position", "velocity"] + ([] if frames.flat else ["quaternion", "angular_velocity"])
        for name in names:
            assert list(grains[name]["step"]) == [f["step"] for f in frames.frames]
            assert list(grains[name]["time"]) == [f["time"] for f in frames.frames]
            for k, f in enumerate(frames.frames):
                near(grains[name]["value"][k], f[name])


def check_csv(frames):
    index = np.genfromtxt(folder + "/frames.csv", delimiter=",", names=True)
    assert list(index["step"]) == [f["step"] for f in frames.frames]
    whole = open(run + "/contacts.csv").read().split("\n")
    for k, f in enumerate(frames.frames):
        table = np.genfromtxt(f"{folder}/grains_{k:05d}.csv", delimiter=",", names=True)
        near(np.c_[table["x"], table["y"], table["z"]], f["position"])
        near(np.c_[table["vx"], table["vy"], table["vz"]], f["velocity"])
        rows = open(f"{folder}/contacts_{k:05d}.csv").read().split("\n")
        straight = [row.split(",") for row in whole if row.startswith(f"{f['step']},")]
        kept = [row.split(",") for row in rows[1:] if row]
        assert rows[0] == whole[0] and len(kept) == len(straight) == len(f["contacts"])
        if kept:  # what contacts.csv has at the same moment
            near(np.array(kept, float)[:, 4:], np.array(straight, float)[:, 4:])


all_frames = Frames(run + "/frames.bin")
assert len(all_frames.frames) > 3 and sum(len(f["contacts"]) for f in all_frames.frames) > 10
for check in (check_vtk, check_xyz, check_h5md, check_csv):
    check(all_frames)
print(run, len(all_frames.frames), "frames of", all_frames.count, "grains: every reader agrees")
