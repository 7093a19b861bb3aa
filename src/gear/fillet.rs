//! The tooth root: the trochoid that the tool's tip rounding leaves.
//!
//! The tool's tooth stands in the space between two gear teeth. In the frame of that space (x axis along its middle) the
//! tool's pitch line rolls on the reference circle of radius r: turned by φ, a tool point (u along the pitch line, v from
//! the gear's centre) lies at v e(φ) + (u − r φ) e'(φ), e = (cos φ, sin φ), e' = (−sin φ, cos φ). A point of the rounding
//! (centre u_c, v_c, radius R), whose normal has the angle β against the pitch line, cuts when its normal passes through
//! the pitch point u = r φ, v = r, hence
//!
//! ```text
//! φ(β) = (u_c + (v_c − r) cot β) / r
//! P(β) = (v_c − R sin β) e(φ) + (R cos β − (v_c − r) cot β) e'(φ)        β from π/2 (root circle) to α (flank)
//! ```
//! Exact for all signs of v_c − r and for R = 0 (then P is the path of the tool's corner). Derived here from the rolling
//! condition (Litvin and Fuentes, Gear Geometry and Applied Theory, 2004, ch. 6, derive the same envelope).

use crate::numeric::Vec2;

/// The fillet of one flank, seen in the frame of the tooth space (x axis along the middle of the space, +y side).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trochoid {
    /// Radius of the circle on which the tool rolls (the reference circle), mm.
    pub rolling_radius: f64,
    /// Centre of the tool's tip rounding: distance from the middle of the tool's tooth, mm.
    pub centre_u: f64,
    /// Centre of the tool's tip rounding: distance from the gear's centre in the middle position, mm.
    pub centre_v: f64,
    /// Radius of the tool's tip rounding, mm.
    pub rounding: f64,
    /// Normal angle β at the upper end, where the involute takes over, rad; π/2 at the root circle.
    pub beta_end: f64,
}

impl Trochoid {
    /// The normal angle β at the root circle, rad.
    pub const BETA_ROOT: f64 = std::f64::consts::FRAC_PI_2;

    /// Roll angle φ of the gear at which the tool's normal β cuts, rad.
    pub fn roll_angle(&self, beta: f64) -> f64 {
        (self.centre_u + (self.centre_v - self.rolling_radius) * cot(beta)) / self.rolling_radius
    }

    /// Point in the frame of the tooth space, mm.
    pub fn point(&self, beta: f64) -> Vec2 {
        let (s, c) = self.roll_angle(beta).sin_cos();
        let (radial, tangential) = self.local(beta);
        Vec2::new(radial * c - tangential * s, radial * s + tangential * c)
    }

    /// Distance from the gear's centre, mm; falls monotonically with β.
    pub fn radius(&self, beta: f64) -> f64 {
        let (radial, tangential) = self.local(beta);
        radial.hypot(tangential)
    }

    /// Angle of the point from the middle of the tooth space, rad.
    pub fn angle(&self, beta: f64) -> f64 {
        let (radial, tangential) = self.local(beta);
        self.roll_angle(beta) + tangential.atan2(radial)
    }

    /// Normal angle β of the point at radius `r`, mm, by bisection; clamped to the fillet.
    pub fn beta_at_radius(&self, r: f64) -> f64 {
        bisect(self.beta_end, Self::BETA_ROOT, |beta| self.radius(beta) - r)
    }

    /// What `known` says of `angle(beta_at_radius(r))`, for a `known` that changes with the angle at most once: by the steps of the same
    /// bisection, which ends as soon as both bounds of the angle say the same.
    ///
    /// ```text
    /// angle = φ(β) + atan(t/ρ):   φ rises with β, ρ and t fall, where v_c <= r
    /// ```
    pub fn decide_at_radius(&self, r: f64, known: impl Fn(f64) -> bool) -> bool {
        // far above what rounding does to the bounds
        const DOUBT: f64 = 1e-12;
        let bounded = self.centre_v <= self.rolling_radius && self.rounding >= 0.0;
        let place = |beta: f64| {
            let (radial, tangential) = self.local(beta);
            Place {
                beta,
                radial,
                tangential,
                roll: self.roll_angle(beta),
                beyond: radial.hypot(tangential) - r,
            }
        };
        let (mut out, mut root) = (place(self.beta_end), place(Self::BETA_ROOT));
        let side = out.beyond.signum();
        if side == root.beyond.signum() || !bounded {
            return known(self.angle(self.beta_at_radius(r)));
        }
        loop {
            let least = known(out.roll + root.tangential.atan2(out.radial) - DOUBT);
            if least == known(root.roll + out.tangential.atan2(root.radial) + DOUBT) {
                return least;
            }
            let mid = place(0.5 * (out.beta + root.beta));
            if mid.beta == out.beta || mid.beta == root.beta || mid.beyond == 0.0 {
                return known(self.angle(mid.beta));
            }
            if mid.beyond.signum() == side {
                out = mid;
            } else {
                root = mid;
            }
        }
    }

    /// Unit normal of the point, from the gear's material into the space, in the frame of the tooth space.
    pub fn normal(&self, beta: f64) -> Vec2 {
        let (s, c) = self.roll_angle(beta).sin_cos();
        let (sb, cb) = beta.sin_cos();
        // The tool's outward normal is (v, u) = (−sin β, cos β); the gear's is opposite.
        Vec2::new(sb * c + cb * s, sb * s - cb * c)
    }

    /// `n` >= 2 normal angles from the root circle to the upper end, at equal steps of arc length.
    pub fn betas_by_arc(&self, n: usize) -> Vec<f64> {
        const FINE: usize = 512;
        let beta =
            |i: usize| Self::BETA_ROOT + (self.beta_end - Self::BETA_ROOT) * i as f64 / FINE as f64;
        let mut arc = Vec::with_capacity(FINE + 1);
        arc.push(0.0);
        let mut last = self.point(beta(0));
        for i in 1..=FINE {
            let p = self.point(beta(i));
            arc.push(arc[i - 1] + (p - last).norm());
            last = p;
        }
        let n = n.max(2);
        let mut out = Vec::with_capacity(n);
        let mut i = 0;
        for k in 0..n {
            if k == n - 1 {
                out.push(self.beta_end);
                break;
            }
            let s = arc[FINE] * k as f64 / (n - 1) as f64;
            while i + 1 < FINE && arc[i + 1] < s {
                i += 1;
            }
            let step = arc[i + 1] - arc[i];
            let t = if step > 0.0 { (s - arc[i]) / step } else { 0.0 };
            out.push(beta(i) + t * (beta(i + 1) - beta(i)));
        }
        out
    }

    /// Radial and tangential component of the point in the frame that rolls with φ.
    fn local(&self, beta: f64) -> (f64, f64) {
        let (s, c) = beta.sin_cos();
        (
            self.centre_v - self.rounding * s,
            self.rounding * c - (self.centre_v - self.rolling_radius) * cot(beta),
        )
    }
}

/// A point of the fillet on the way to the one at a given radius.
struct Place {
    beta: f64,
    radial: f64,
    tangential: f64,
    roll: f64,
    /// How far it stands beyond that radius, mm.
    beyond: f64,
}

/// The zero of `f` between `lo` and `hi` by bisection to the last bit; an end if there is no change of sign.
pub(super) fn bisect(lo: f64, hi: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut a, mut b) = (lo, hi);
    let (fa, fb) = (f(a), f(b));
    if fa.signum() == fb.signum() {
        return if fa.abs() <= fb.abs() { a } else { b };
    }
    loop {
        let mid = 0.5 * (a + b);
        if mid == a || mid == b {
            return mid;
        }
        let fm = f(mid);
        if fm == 0.0 {
            return mid;
        }
        if fm.signum() == fa.signum() {
            a = mid;
        } else {
            b = mid;
        }
    }
}

fn cot(beta: f64) -> f64 {
    let (s, c) = beta.sin_cos();
    c / s
}
