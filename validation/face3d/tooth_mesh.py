"""A gear's transverse section in quadrilaterals, from equations of its own: involute flanks, the trochoid of the rack's rounded tip, a rim down to the bore.

Teeth -1, 0 and 1 are there, in front of a whole ring; the other teeth are left out, since nothing loads them. Tooth 0 stands along the x axis. The
flank that carries is the one at positive angles. Lengths in mm."""

import numpy as np


def involute(angle):
    return np.tan(angle) - angle


def graded(start, length, growth, largest):
    """Nodes from 0 to `length`: sizes from `start` on, each `growth` times the former, none beyond `largest`."""
    sizes = [start]
    while sum(sizes) < length:
        sizes.append(min(sizes[-1] * growth, largest))
    nodes = np.concatenate([[0.0], np.cumsum(sizes)])
    if len(nodes) > 2 and length - nodes[-2] < 0.5 * sizes[-1]:
        nodes = nodes[:-1]
    return nodes * (length / nodes[-1])


def around(low, high, centre, size, half, growth, largest, counted):
    """Nodes from `low` to `high`: `size` within `half` of `centre`, coarser beyond. As many as if the centre were `counted`."""
    count = max(2, round(2 * half / size))
    inner = np.linspace(centre - half, centre + half, count + 1)
    room = lambda length, usual: graded(size * growth, usual, growth, largest) * (length / usual)
    below = centre - half - room(centre - half - low, counted - half - low)
    above = centre + half + room(high - centre - half, high - counted - half)
    return np.concatenate([below[:0:-1], inner, above[1:]])


class Gear:
    def __init__(self, teeth, module, pressure_angle, addendum, dedendum, fillet, bore, relief=(0.0, 1.0)):
        """`relief`: what is missing at the tip, and from how far before it on, mm along the path of contact."""
        self.teeth, self.module, self.alpha = teeth, module, pressure_angle
        self.pitch = 0.5 * module * teeth
        self.base = self.pitch * np.cos(pressure_angle)
        self.tip = self.pitch + addendum * module
        self.root = self.pitch - dedendum * module
        self.bore = 0.5 * bore
        self.relief = relief
        self.rounding = fillet * module
        # the rack's rounding: its centre's depth below the reference line, and half the width between the two centres
        self.depth = (dedendum - fillet) * module
        self.land = 0.25 * np.pi * module - self.depth * np.tan(pressure_angle) - self.rounding / np.cos(pressure_angle)
        if self.land < 0.0:
            raise ValueError("the rack's tip is too narrow for its rounding")

    def flank(self, radius):
        """Angle of the flank from the middle of its tooth."""
        alpha = np.arccos(np.clip(self.base / radius, -1.0, 1.0))
        amount, length = self.relief
        before = self.base * (np.tan(np.arccos(self.base / self.tip)) - np.tan(alpha))
        missing = amount * np.clip(1.0 - before / length, 0.0, 1.0)
        return 0.5 * np.pi / self.teeth + involute(self.alpha) - involute(alpha) - missing / self.base

    def middle(self):
        """Radius in the middle of the flank, by arc length."""
        return np.sqrt(0.5 * (self.form() ** 2 + self.tip**2))

    def trochoid(self, share):
        """The fillet from the root circle (0) to the flank (1): radius, angle from the middle of the tooth."""
        s = share * self.depth / np.tan(self.alpha)
        length = np.hypot(s, self.depth)
        x = s + self.rounding * s / length
        y = self.pitch - self.depth - self.rounding * self.depth / length
        # the rack has moved by s - land since its tooth was in the middle of the space; from there to the middle of the tooth
        angle = np.arctan2(x, y) - (s - self.land) / self.pitch
        return np.hypot(x, y), np.pi / self.teeth - angle

    def profile(self, rows):
        """Radius and angle at the rows: those of the fillet are its shares, those of the flank radii."""
        fillet, radii = rows
        troch = np.array([self.trochoid(t) for t in fillet])
        flank = np.array([(r, self.flank(r)) for r in radii])
        return np.vstack([troch, flank])

    def form(self):
        """Radius where flank and fillet meet; the two curves have to agree there."""
        radius, angle = self.trochoid(1.0)
        assert abs(angle - self.flank(radius)) < 1e-9, "fillet and flank do not meet"
        return radius


class Section:
    """Nodes (x, y), quadrilaterals, and by tooth the edges of the flank that carries."""

    def __init__(self, gear, contact_radii, size, half, body=1.0, counted=None):
        """`contact_radii`: by tooth where it touches; other teeth are coarse. `size`: edge within `half` of that
        place. `body`: edges elsewhere, over the usual ones. `counted`: radius; sections that touch elsewhere have the nodes of one that touches there, moved."""
        self.gear, self.nodes, self.quads, self.edges = gear, [], [], {}
        coarse, growth = 0.22 * gear.module * body, 1.0 + 0.35 * body
        self.body, self.growth, self.counted = body, growth, counted
        teeth = (-1, 0, 1)
        columns = []
        for tooth in teeth:
            fine = contact_radii.get(tooth)
            columns.append(self.tooth(tooth, fine, size, half, coarse))
        depth = gear.root - gear.bore
        self.radial = graded(0.18 * gear.module * body, depth, growth, 0.18 * body * depth) / depth
        tops = [node for column in columns for node in column[::-1]]  # by ascending angle
        angles = [np.arctan2(self.nodes[n][1], self.nodes[n][0]) for n in tops]
        bore = np.linspace(angles[0], angles[-1], len(tops))
        # each tooth keeps its own part of the bore
        at = 0
        for column in columns:
            part = slice(at, at + len(column))
            bore[part] = np.linspace(angles[at], angles[at + len(column) - 1], len(column))
            at += len(column)
        first, last = angles[0], angles[-1]
        gap = 2 * np.pi - (last - first)
        start = 2.0 * np.pi / gear.teeth / 3 * body
        half_gap = graded(start, 0.5 * gap, 1.4, 0.3 * body)
        ring = np.concatenate([half_gap, gap - half_gap[-2::-1]])[1:-1] + last
        for angle in ring:
            tops.append(self.add(gear.root * np.cos(angle), gear.root * np.sin(angle)))
        bore = np.concatenate([bore, ring])
        lines = []
        for top, angle in zip(tops, bore):
            a = np.array(self.nodes[top])
            b = gear.bore * np.array([np.cos(angle), np.sin(angle)])
            lines.append([top] + [self.add(*(a + t * (b - a))) for t in self.radial[1:]])
        for a, b in zip(lines, lines[1:] + lines[:1]):
            for k in range(len(self.radial) - 1):
                self.quad(a[k + 1], a[k], b[k], b[k + 1])
        self.bore_nodes = [line[-1] for line in lines]
        self.nodes = np.array(self.nodes)
        self.quads = np.array(self.quads)

    def add(self, x, y):
        self.nodes.append((x, y))
        return len(self.nodes) - 1

    def quad(self, *corners):
        p = np.array([self.nodes[n] for n in corners])
        for i in range(4):
            a, b, c = p[i - 1], p[i], p[(i + 1) % 4]
            cross = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
            assert cross > 0, f"element turned over at {p.mean(axis=0)}"
        self.quads.append(corners)
        return len(self.quads) - 1

    def tooth(self, tooth, touch, size, half, coarse):
        """One tooth; the nodes of its base, from the flank that carries to the other."""
        gear = self.gear
        form = gear.form()
        # along the flank by arc length, which for an involute is (rho² - rho_form²) / (2 base radius)
        arc = lambda r: (r * r - gear.base**2) / (2 * gear.base)
        radius = lambda s: np.sqrt(2 * gear.base * s + gear.base**2)
        low, high = arc(form), arc(gear.tip)
        if touch is None:
            stations = np.linspace(low, high, max(3, round((high - low) / coarse)) + 1)
            across = np.linspace(0.0, 1.0, 1 + round(4 / self.body))
        else:
            counted = self.counted or touch
            room = min(arc(counted) - low, high - arc(counted)) - 2.0 * size
            assert room > 0.5 * half, "contact too near the end of the flank"
            half = min(half, room)
            centre = np.clip(arc(touch), low + half + 2.0 * size, high - half - 2.0 * size)
            stations = around(low, high, centre, size, half, self.growth, coarse, arc(counted))
            width = 2 * counted * gear.flank(counted)
            across = graded(size, width, self.growth, 0.3 * gear.module * self.body) / width
        fillet = np.linspace(0.0, 1.0, 1 + round((5 if touch is not None else 3) / self.body))
        curve = gear.profile((fillet[:-1], radius(stations)))
        x, y = curve[:, 0] * np.cos(curve[:, 1]), curve[:, 0] * np.sin(curve[:, 1])
        # lines across leave the flank along its normal, but no steeper than 45°; at the tip they are the tip circle
        slope = np.gradient(y, x, edge_order=2) if len(x) > 2 else 0
        normal = np.clip(-slope, 0.0, 1.0)
        normal[: len(fillet)] = np.maximum(normal[: len(fillet)], np.linspace(1.0, normal[len(fillet)], len(fillet)))
        weight = np.clip((gear.tip - curve[:, 0]) / (0.3 * gear.module), 0.0, 1.0)
        # the sagitta of the parabola through both flanks, towards the bore
        sag = weight * 0.5 * y * normal - (1 - weight) * curve[:, 0] * (1 - np.cos(curve[:, 1]))
        turn = 2 * np.pi * tooth / gear.teeth
        c, s = np.cos(turn), np.sin(turn)
        grid = []
        for xj, yj, sj in zip(x, y, sag):
            row = []
            for u in across:
                t = 1 - 2 * u
                px, py = xj - sj * (1 - t * t), yj * t
                row.append(self.add(c * px - s * py, s * px + c * py))
            grid.append(row)
        edges = []
        for v in range(len(grid) - 1):
            for u in range(len(across) - 1):
                a, b, d, e = grid[v][u], grid[v][u + 1], grid[v + 1][u + 1], grid[v + 1][u]
                # x outwards, y towards the flank that carries: a (low, flank), e (high, flank), d (high, inside), b
                number = self.quad(b, d, e, a)
                if u == 0 and v >= len(fillet) - 1:
                    edges.append((number, 2))  # the edge from corner 2 to corner 3: e, a
        self.edges[tooth] = edges
        return grid[0]
