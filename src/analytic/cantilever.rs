//! End-loaded cantilever of rectangular section, plane stress.
//!
//! The beam lies along 0 ≤ x ≤ L, |y| ≤ D/2; its end x = L carries a parabolic shear traction of resultant P along +y per
//! unit width and x = 0 is held by the exact displacements. I = D³/12.
//!
//! ```text
//! σ_x  = −P (L − x) y / I,   σ_y = 0,   τ = P / (2 I) (D²/4 − y²)
//! u_x  = −P y / (6 E I) [ (6 L − 3 x) x + (2 + nu) (y² − D²/4) ]
//! u_y  =  P / (6 E I) [ 3 nu y² (L − x) + (4 + 5 nu) D² x / 4 + (3 L − x) x² ]
//! U    =  P² L³ / (6 E I) + 3 P² L / (5 G D),   G = E / (2 (1 + nu))
//! ```
//! Timoshenko & Goodier (1970), section 21; in this frame Augarde & Deeks, Finite Elements in Analysis and Design 44 (2008) 595.

/// The cantilever, its material and its load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cantilever {
    /// Length L, mm.
    pub length: f64,
    /// Depth D, mm.
    pub depth: f64,
    /// End load P per width, N/mm.
    pub load: f64,
    /// Young's modulus E, MPa.
    pub youngs_modulus: f64,
    /// Poisson's ratio nu.
    pub poisson_ratio: f64,
}

impl Cantilever {
    /// Second moment of area per width D³/12, mm³.
    pub fn second_moment(&self) -> f64 {
        self.depth.powi(3) / 12.0
    }

    /// Displacements u_x, u_y, mm.
    pub fn displacement(&self, x: f64, y: f64) -> (f64, f64) {
        let (l, d, nu) = (self.length, self.depth, self.poisson_ratio);
        let factor = self.load / (6.0 * self.youngs_modulus * self.second_moment());
        let ux = -y * ((6.0 * l - 3.0 * x) * x + (2.0 + nu) * (y * y - d * d / 4.0));
        let uy =
            3.0 * nu * y * y * (l - x) + (4.0 + 5.0 * nu) * d * d * x / 4.0 + (3.0 * l - x) * x * x;
        (factor * ux, factor * uy)
    }

    /// Stresses σ_x and τ, MPa.
    pub fn stress(&self, x: f64, y: f64) -> (f64, f64) {
        let factor = self.load / self.second_moment();
        (
            -factor * (self.length - x) * y,
            0.5 * factor * (self.depth * self.depth / 4.0 - y * y),
        )
    }

    /// Deflection of the middle of the loaded end, mm.
    pub fn tip(&self) -> f64 {
        self.displacement(self.length, 0.0).1
    }

    /// Elastic energy per width, N.
    pub fn energy(&self) -> f64 {
        let (p, l, e) = (self.load, self.length, self.youngs_modulus);
        let shear_modulus = e / (2.0 * (1.0 + self.poisson_ratio));
        p * p * l.powi(3) / (6.0 * e * self.second_moment())
            + 0.6 * p * p * l / (shear_modulus * self.depth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEAM: Cantilever = Cantilever {
        length: 48.0,
        depth: 12.0,
        load: 1000.0,
        youngs_modulus: 3e4,
        poisson_ratio: 0.3,
    };

    #[test]
    fn tip_is_bending_plus_the_published_shear_term() {
        let bending = 1000.0 * 48.0_f64.powi(3) / (3.0 * 3e4 * 144.0);
        let shear = 1000.0 * 5.5 * 144.0 * 48.0 / (24.0 * 3e4 * 144.0);
        assert!((BEAM.tip() - bending - shear).abs() < 1e-12);
        assert!((BEAM.tip() - 8.9).abs() < 1e-4);
    }

    #[test]
    fn stress_follows_from_displacement_by_hooke() {
        let (x, y, h) = (17.0, 2.3, 1e-4);
        let dx =
            |k: usize| pick(BEAM.displacement(x + h, y), k) - pick(BEAM.displacement(x - h, y), k);
        let dy =
            |k: usize| pick(BEAM.displacement(x, y + h), k) - pick(BEAM.displacement(x, y - h), k);
        let (exx, eyy, gxy) = (
            dx(0) / (2.0 * h),
            dy(1) / (2.0 * h),
            (dx(1) + dy(0)) / (2.0 * h),
        );
        let (sx, tau) = BEAM.stress(x, y);
        assert!((3e4 * exx - sx).abs() < 1e-4 * sx.abs());
        assert!((eyy + 0.3 * exx).abs() < 1e-7);
        assert!((3e4 / 2.6 * gxy - tau).abs() < 1e-4 * tau.abs());
    }

    fn pick(pair: (f64, f64), k: usize) -> f64 {
        if k == 0 { pair.0 } else { pair.1 }
    }

    #[test]
    fn energy_is_the_integral_of_the_stresses() {
        let n = 400;
        let mut energy = 0.0;
        for i in 0..n {
            for j in 0..n {
                let x = 48.0 * (i as f64 + 0.5) / n as f64;
                let y = 12.0 * ((j as f64 + 0.5) / n as f64 - 0.5);
                let (sx, tau) = BEAM.stress(x, y);
                energy += (sx * sx / 6e4 + tau * tau * 2.6 / 6e4) * 48.0 * 12.0 / (n * n) as f64;
            }
        }
        assert!((energy / BEAM.energy() - 1.0).abs() < 1e-4);
    }
}
