#!/usr/bin/env python3
"""Read gearwear's field files with two readers that are not ours and recompute load and area from them.

usage: read_vtk.py FIELDS [LOADS.json]        FIELDS: the folder with the .vtu and .pvd files of a run
needs: pip install vtk meshio                 without them: prints 'skipped: ...' and succeeds

Checked for every .vtu: VTK's XML reader and meshio agree to the last bit on points, cells and all arrays; all numbers are
finite; counts are those of loads.json; for each member
  area          Green's theorem over the outer edges (curved ones quadratic)     = area of loads.json
  load          integral of contact_pressure over the outer edges (5 Gauss pts)  = line_load
  force         sum of contact_force of pinion and gear                          = 0
  moment        of the pinion's contact_force, at the points before wear         = torque_per_width
                (contact is solved on the line of action; wear turns a point back on its circle by depth / base radius)
relative tolerance: the one in loads.json (1e-6). For every .pvd: files exist beside it, time ascends.
Exit code 1 and a line per fault if anything is wrong.
"""
import json
import math
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    print("skipped: vtk not installed")
    sys.exit(0)
try:
    import meshio
except ImportError:
    meshio = None

GAUSS_POINTS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(5)
T3_EDGES = ((0, 1), (1, 2), (2, 0))
T6_EDGES = ((0, 3, 1), (1, 4, 2), (2, 5, 0))  # corner, mid-side, corner


def main(arguments):
    if not 1 <= len(arguments) <= 2:
        print(__doc__, file=sys.stderr)
        return 2
    folder = pathlib.Path(arguments[0])
    loads_path = pathlib.Path(arguments[1]) if len(arguments) == 2 else folder / "loads.json"
    loads = json.loads(loads_path.read_text())
    faults = []
    if meshio is None:
        print("meshio not installed: read with VTK only")
    stored = {path.name for path in folder.glob("*.vtu")}
    listed = {entry["file"] for entry in loads["files"]}
    if stored != listed:
        faults.append(f"files and {loads_path.name} differ: {sorted(stored ^ listed)}")
    for entry in loads["files"]:
        if entry["file"] in stored:
            faults += check_file(folder / entry["file"], entry, loads["tolerance"])
    for path in sorted(folder.glob("*.pvd")):
        faults += check_series(path)
    for fault in faults:
        print("FAULT", fault)
    print(f"{len(stored)} files read, {len(faults)} faults")
    return 1 if faults else 0


def check_file(path, expected, tolerance):
    points, cells, arrays = read_with_vtk(path)
    faults = []

    def fault(text):
        faults.append(f"{path.name}: {text}")

    def compare(what, found, wanted, scale=None):
        error = abs(found - wanted) / (scale or abs(wanted) or 1.0)
        if not error <= tolerance:
            fault(f"{what} is {found!r}, expected {wanted!r} (relative error {error:.2e})")
        return error

    if meshio is not None:
        for text in differences(meshio.read(path), points, cells, arrays):
            fault(text)
    for name, array in [("points", points), *arrays.items()]:
        if not np.isfinite(array).all():
            fault(f"{name} is not finite everywhere")

    errors = {}
    force = {}
    for number, member in enumerate(("pinion", "gear")):
        wanted = expected[member]
        nodes = arrays["member"] == number
        own = [cell for cell in cells if nodes[cell[0]]]
        if any(not nodes[list(cell)].all() for cell in own):
            fault(f"a cell joins {member} and its mate")
        if (int(nodes.sum()), len(own)) != (wanted["nodes"], wanted["cells"]):
            fault(f"{member} has {nodes.sum()} nodes and {len(own)} cells, expected {wanted['nodes']} and {wanted['cells']}")
        area, load = integrate(points, own, arrays["contact_pressure"])
        errors[f"{member} area"] = compare(f"{member} area", area, wanted["area"])
        errors[f"{member} load"] = compare(f"{member} load", load, expected["line_load"])
        compare(f"{member} largest wear depth", float(arrays["wear_depth"][nodes].max()), wanted["largest_wear_depth"])
        force[member] = arrays["contact_force"][nodes].sum(axis=0)
    size = float(np.linalg.norm(force["pinion"]))
    errors["forces cancel"] = compare("force on both members", float(np.linalg.norm(force["pinion"] + force["gear"])), 0.0, size)
    pinion = arrays["member"] == 0
    arm = (points - arrays["wear_vector"])[pinion][:, :2] - np.array(expected["pinion"]["centre"])
    forces = arrays["contact_force"][pinion]
    moment = abs(math.fsum(arm[:, 0] * forces[:, 1] - arm[:, 1] * forces[:, 0]))
    errors["moment"] = compare("moment on the pinion", moment, abs(expected["torque_per_width"]))
    print(path.name, *(f"{what} {error:.1e}" for what, error in errors.items()), sep="  ")
    return faults


def read_with_vtk(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    allowed = {5: 3, 22: 6}
    cells = []
    for number in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(number)
        if allowed.get(cell.GetCellType()) != cell.GetNumberOfPoints():
            raise SystemExit(f"{path.name}: cell {number} has type {cell.GetCellType()}")
        cells.append(tuple(cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())))
    data = grid.GetPointData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    return points, cells, arrays


def differences(mesh, points, cells, arrays):
    """How meshio's view differs from VTK's, bit for bit."""
    if not np.array_equal(mesh.points, points):
        yield "points differ between VTK and meshio"
    if [tuple(row) for block in mesh.cells for row in block.data.tolist()] != cells:
        yield "cells differ between VTK and meshio"
    if set(mesh.point_data) != set(arrays):
        yield f"arrays differ between VTK and meshio: {sorted(set(mesh.point_data) ^ set(arrays))}"
    for name in set(mesh.point_data) & set(arrays):
        if not np.array_equal(np.squeeze(mesh.point_data[name]), arrays[name]):
            yield f"array {name} differs between VTK and meshio"


def integrate(points, cells, pressure):
    """Area by Green's theorem and the integral of the pressure, both over the edges that belong to one cell only."""
    seen = {}
    for cell in cells:
        for edge in T6_EDGES if len(cell) == 6 else T3_EDGES:
            nodes = tuple(cell[i] for i in edge)
            key = frozenset((nodes[0], nodes[-1]))
            if key in seen:
                seen[key] = None
            else:
                seen[key] = nodes
    areas, loads = [], []
    for nodes in filter(None, seen.values()):
        position, trace = points[list(nodes), :2], pressure[list(nodes)]
        for at, weight in zip(0.5 * (GAUSS_POINTS + 1.0), 0.5 * GAUSS_WEIGHTS):
            shape, slope = shape_functions(at, len(nodes))
            x, tangent = shape @ position, slope @ position
            areas.append(weight * 0.5 * (x[0] * tangent[1] - x[1] * tangent[0]))
            loads.append(weight * (shape @ trace) * math.hypot(*tangent))
    return math.fsum(areas), math.fsum(loads)


def shape_functions(t, count):
    if count == 2:
        return np.array([1 - t, t]), np.array([-1.0, 1.0])
    return (
        np.array([(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)]),
        np.array([4 * t - 3, 4 - 8 * t, 4 * t - 1]),
    )


def check_series(path):
    entries = ElementTree.parse(path).getroot().findall("./Collection/DataSet")
    times = [float(entry.get("timestep")) for entry in entries]
    faults = [f"{path.name}: {entry.get('file')} is missing" for entry in entries if not (path.parent / entry.get("file")).is_file()]
    if not entries or any(later <= earlier for earlier, later in zip(times, times[1:])):
        faults.append(f"{path.name}: times do not ascend: {times}")
    return faults


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
