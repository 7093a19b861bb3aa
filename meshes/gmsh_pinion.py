"""Mesh of the reference pinion (27 teeth, module 2, bore 25) by gmsh, as a user might bring one.

    pip install gmsh; python gmsh_pinion.py            writes pinion_27_gmsh.msh (MSH 4.1, ASCII, 6-node triangles)

Basic rack ISO 53 profile A. The loaded (counter-clockwise) flanks of teeth -1 and 0 are the physical curves flank_1 and
flank_2, the bore is `bore`. Nothing here is shared with gearwear's own mesher.
"""
from math import acos, atan2, cos, hypot, pi, radians, sin, sqrt, tan

import gmsh

Z, M, BORE = 27, 2.0, 12.5
FLANK, COARSE = 0.1, 0.55  # edge lengths, mm
ALPHA = radians(20)
R0, RB, RA, RF = M * Z / 2, M * Z / 2 * cos(ALPHA), M * (Z / 2 + 1), M * (Z / 2 - 1.25)
ROUND = 0.38 * M
HALF = pi / (2 * Z) + tan(ALPHA) - ALPHA  # half tooth angle at the base circle
FORM = R0 * sin(ALPHA) - (1.25 * M - ROUND * (1 - sin(ALPHA))) / sin(ALPHA)  # curvature radius where the fillet ends
ACTIVE, TIP = 3.9, sqrt(RA**2 - RB**2)


def involute(arc):
    xi = sqrt(2 * arc / RB)
    t = HALF - xi
    return RB * (cos(t) - xi * sin(t)), RB * (sin(t) + xi * cos(t))


def fillet(beta):
    """Envelope of the tool's tip rounding: its normal (angle beta) passes through the pitch point."""
    uc = pi * M / 4 - (1.25 * M - ROUND) * tan(ALPHA) - ROUND / cos(ALPHA)
    vc = RF + ROUND
    phi = (uc + (vc - R0) / tan(beta)) / R0
    radial, tangential = vc - ROUND * sin(beta), ROUND * cos(beta) - (vc - R0) / tan(beta)
    angle = pi / Z - (phi + atan2(tangential, radial))
    r = hypot(radial, tangential)
    return r * cos(angle), r * sin(angle)


def turn(p, angle, mirror=False):
    x, y = p[0], -p[1] if mirror else p[1]
    return x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)


def arcs(a, b, n):
    return [a + (b - a) * i / n for i in range(n + 1)]


def even(points, n):
    """n + 1 of the points at equal distances along the line: a spline's parameter then follows its length."""
    length = [0.0]
    for p, q in zip(points, points[1:]):
        length.append(length[-1] + hypot(q[0] - p[0], q[1] - p[1]))
    return [points[min(range(len(points)), key=lambda i: abs(length[i] - s))] for s in arcs(0, length[-1], n)]


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
geo = gmsh.model.geo
origin = geo.addPoint(0, 0, 0)
point = lambda p: geo.addPoint(p[0], p[1], 0)
s_form, s_act, s_tip = (rho**2 / (2 * RB) for rho in (FORM, ACTIVE, TIP))
lower = [involute(s) for s in arcs(s_form, s_act, 4)]
active = [involute(s) for s in arcs(s_act, s_tip, 80)]
whole = [involute(s) for s in arcs(s_form, s_tip, 12)]
root = even([fillet(b) for b in arcs(pi / 2, ALPHA, 1000)], 8)
root[-1] = lower[0]
curves, flanks, fine = [], [], []
first = None
land = None
for k in range(Z):
    a = 2 * pi * k / Z
    spline = lambda points, p0, p1: geo.addSpline([p0, *[point(p) for p in points[1:-1]], p1])
    right_root = point(turn(root[0], a, True))
    if land is not None:
        curves.append(geo.addCircleArc(land, origin, right_root))
    else:
        first = right_root
    r_form, r_tip = point(turn(lower[0], a, True)), point(turn(active[-1], a, True))
    curves.append(spline([turn(p, a, True) for p in root], right_root, r_form))
    curves.append(spline([turn(p, a, True) for p in whole], r_form, r_tip))
    l_tip, l_form, l_root = (point(turn(p, a)) for p in (active[-1], lower[0], root[0]))
    curves.append(geo.addCircleArc(r_tip, origin, l_tip))
    if k in (0, Z - 1):
        l_act = point(turn(active[0], a))
        flank = spline([turn(p, a) for p in reversed(active)], l_tip, l_act)
        curves += [flank, spline([turn(p, a) for p in reversed(lower)], l_act, l_form)]
        fine.append(flank)
        flanks.append((2 if k == 0 else 1, flank))
    else:
        curves.append(spline([turn(p, a) for p in reversed(whole)], l_tip, l_form))
    curves.append(spline([turn(p, a) for p in reversed(root)], l_form, l_root))
    land = l_root
curves.append(geo.addCircleArc(land, origin, first))
quarter = [point((BORE * cos(i * pi / 2), BORE * sin(i * pi / 2))) for i in range(4)]
bore = [geo.addCircleArc(quarter[i], origin, quarter[(i + 1) % 4]) for i in range(4)]
face = geo.addPlaneSurface([geo.addCurveLoop(curves), geo.addCurveLoop(bore)])
geo.synchronize()
gmsh.model.addPhysicalGroup(1, bore, name="bore")
for k, flank in flanks:
    gmsh.model.addPhysicalGroup(1, [flank], name=f"flank_{k}")
    gmsh.model.mesh.setTransfiniteCurve(flank, round((s_tip - s_act) / FLANK) + 1)
gmsh.model.addPhysicalGroup(2, [face], name="body")
field = gmsh.model.mesh.field
near = field.add("Distance")
field.setNumbers(near, "CurvesList", fine)
field.setNumber(near, "Sampling", 200)
size = field.add("MathEval")
field.setString(size, "F", f"min({FLANK} + 0.4*F{near}, {COARSE} + 0.4*max(0, {RF} - sqrt(x*x + y*y)) + 0.5*max(0, sqrt(x*x + y*y) - {RF + 1}))")
field.setAsBackgroundMesh(size)
for name, value in (("MeshSizeExtendFromBoundary", 0), ("MeshSizeFromPoints", 0), ("MeshSizeFromCurvature", 0)):
    gmsh.option.setNumber(f"Mesh.{name}", value)
gmsh.option.setNumber("Mesh.Algorithm", 6)
gmsh.model.mesh.generate(2)
gmsh.model.mesh.setOrder(2)
gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
gmsh.write("pinion_27_gmsh.msh")
gmsh.finalize()
