"""Involute geometry and loads that the generator needs to draw gears that can run; standard formulas of ISO 21771,
written here apart from the program's so that a refusal by the program is a finding."""

from math import acos, atan, cos, pi, radians, sin, sqrt, tan


def inv(angle):
    return tan(angle) - angle


def inverse_inv(value):
    low, high = 1e-6, 1.2
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if inv(middle) < value else (low, middle)
    return 0.5 * (low + high)


class Pair:
    """A spur gear pair on ISO 53 profile A, at large pressure angles with a smaller fillet: lengths mm, angles rad."""

    addendum, dedendum = 1.0, 1.25

    def __init__(self, module, pressure_angle_deg, teeth, shift, misalignment=0.0):
        self.module, self.teeth, self.shift = module, teeth, shift
        self.alpha = radians(pressure_angle_deg)
        self.fillet = 0.38 if pressure_angle_deg < 22 else 0.3
        self.base = [0.5 * module * z * cos(self.alpha) for z in teeth]
        self.reference = [0.5 * module * z for z in teeth]
        self.tip = [0.5 * module * z + module * (self.addendum + x) for z, x in zip(teeth, shift)]
        self.root = [0.5 * module * z - module * (self.dedendum - x) for z, x in zip(teeth, shift)]
        working = inverse_inv(inv(self.alpha) + 2 * tan(self.alpha) * sum(shift) / sum(teeth))
        self.nominal_distance = sum(self.base) / cos(working)
        self.distance = self.nominal_distance + misalignment
        self.working = acos(sum(self.base) / self.distance)
        self.base_pitch = pi * module * cos(self.alpha)
        self.line = self.distance * sin(self.working)
        self.rho_tip = [sqrt(t * t - b * b) for t, b in zip(self.tip, self.base)]
        self.start = self.line - self.rho_tip[1]
        self.end = self.rho_tip[0]
        self.contact_ratio = (self.end - self.start) / self.base_pitch

    def rho_form(self, side):
        """Curvature radius where the involute of a rack-generated flank begins; negative: undercut."""
        straight = self.dedendum - self.fillet * (1 - sin(self.alpha)) - self.shift[side]
        return self.reference[side] * sin(self.alpha) - self.module * straight / sin(self.alpha)

    def tip_thickness(self, side):
        """Tooth thickness at the tip circle, in modules."""
        half = (0.5 * pi + 2 * self.shift[side] * tan(self.alpha)) / self.teeth[side] + inv(self.alpha)
        return 2 * self.tip[side] * (half - inv(atan(self.rho_tip[side] / self.base[side]))) / self.module

    def runs(self):
        """Whether the pair runs well inside what involute gears can do."""
        form = [self.rho_form(0), self.rho_form(1)]
        return (
            min(form) > 0.01 * self.module
            and min(self.tip_thickness(0), self.tip_thickness(1)) > 0.2
            and 1.1 <= self.contact_ratio <= 2.3
            and self.start > form[0] + 0.01 * self.module
            and self.line - self.end > form[1] + 0.01 * self.module
            # the tip must leave room to the mate's root
            and all(self.distance - self.tip[i] - self.root[1 - i] > 0.05 * self.module for i in (0, 1))
        )

    def relative_radius(self):
        """At the pitch point, mm."""
        first = self.base[0] * tan(self.working)
        return first * (self.line - first) / self.line

    def hertz(self, line_load, modulus):
        """Largest pressure at the pitch point (MPa) under a line load (N/mm)."""
        return sqrt(line_load * modulus / (pi * self.relative_radius()))


def contact_modulus(materials):
    return 1 / sum((1 - nu * nu) / e for e, nu in materials)


def nominal_line_load(pair, materials):
    """The line load (N/mm) at which the pair is used to its full: the least of a Hertz and a bending criterion.

    Allowable pressures and root stresses follow the modulus, from steel (1100 and 350 MPa) to polyamide (about 65 and 45 MPa),
    a power law through the values of ISO 6336-5 and VDI 2736. Bending: F_t/(b m) times a tooth form factor of 3."""
    modulus = contact_modulus(materials)
    softest = min(e for e, _ in materials) / 2.1e5
    pressure = 1100 * softest**0.6
    bending = 350 * softest**0.45
    by_pressure = pressure**2 * pi * pair.relative_radius() / modulus
    by_bending = bending * pair.module / 3.0 / cos(pair.alpha)
    return min(by_pressure, by_bending), pressure
