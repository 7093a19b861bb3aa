//! What each family of cases asks, in one sentence a sceptic can answer with yes or no.

/// The question behind a family, by the id that its cases begin with; empty for one that is not known.
pub fn question(family: &str) -> &'static str {
    match family {
        "A1" => "Does every element reproduce a constant strain exactly, whatever its shape?",
        "A2" => "Do rigid motions cost no force, and are they the only motions that cost none?",
        "A3" => "Does the error fall with the mesh at the order that theory gives each element?",
        "A4" => "Are displacements and stresses of a thick ring under pressure right?",
        "A5" => "Does nearly incompressible material lock the elements?",
        "A6" => "Is the stress at the edge of a curved membrane right?",
        "A7" => "Are deflection and energy of a cantilever in bending and shear right?",
        "A8" => "Is a swept membrane in bending as soft as it should be?",
        "A9" => "Does the linear solver solve the equations it is given?",
        "B1" => "Is a uniform pressure carried exactly across meshes that do not match?",
        "B2" => "Are peak, width and shape of Hertz's line contact right, and do they converge?",
        "B3" => "Is the published cylinder-on-block contact reproduced, with and without friction?",
        "B4" => "Is a conforming pin in a sheet solved?",
        "B5" => {
            "Are slip and stick zones under a tangential pull where Cattaneo and Mindlin put them?"
        }
        "B6" => "Is the singular pressure under a rigid flat punch right away from its edges?",
        "B7" => {
            "Do results follow exactly when the problem is turned, mirrored, renumbered or scaled?"
        }
        "B8" => {
            "Does the contact iteration settle, without penetration, in every contact case above?"
        }
        "C" => {
            "Are radii, path of contact, contact ratio and tooth thickness those of the standards and of a published report?"
        }
        "D1" | "D2" | "D3" => "Are Hertz pressures of FZG gears those that are published?",
        "D4" => "Are the load stages of the FZG test those of the standard?",
        "D5" => "Do the elements find Hertz's peak pressure on the flanks of gears?",
        "D6" => "Do forces and torques balance on both members at every position?",
        "E1" => "Does the tooth stiffness of ISO 6336-1 give the standard's own example?",
        "E2" => "Is a tooth pair as stiff as an independent finite-element program finds it?",
        "E3" => {
            "Are load share and transmission error over the mesh cycle those of an independent program?"
        }
        "E4" => "Is the root stress that of an independent program and of the published value?",
        "F1" => {
            "Is the material that Archard's law takes off the material that the geometry has lost?"
        }
        "F2" => "Does a uniformly pressed block wear by exactly k·p·s?",
        "F3" => {
            "Is wear on an elastic foundation integrated at the right order, far beyond the explicit limit?"
        }
        "F4" | "F5" => {
            "Does a cylinder wear into an elastic foundation as the closed form says, in depth and in time?"
        }
        "F6" => {
            "Does an elastic cylinder wear as an independent boundary-element program finds it?"
        }
        "F7" => "Do the modes of a wearing punch decay as theory and an independent program say?",
        "F8" => {
            "Are explicit steps unstable where theory says so, and do ours stay accurate there?"
        }
        "F9" => "Is a gear's wear per pass the closed form k·F'·|sliding| along the whole flank?",
        "S1" => {
            "Do slices of the face share a load as closed forms say, and do waves across it bend a plate as they should?"
        }
        "S2" => {
            "Do teeth that differ share load as springs do, does a mean mate stand for all mates, and do classes that stand alike wear as one tooth?"
        }
        "S3" => {
            "Have helical gears the contact stress and the mesh stiffness of the standard, and contact lines of one length where the overlap is whole?"
        }
        "X1" => {
            "Does CalculiX, a program of others with its own contact, find the same transmission error and peak pressure?"
        }
        "challenge/none_L2" | "challenge/running_in_L1" => {
            "Does an independent program's wear of ten test conditions come out the same, with nothing fitted?"
        }
        "convergence" => "How much do the results still change when one resolution is doubled?",
        "corner" => {
            "Does the pressure where a worn tip corner runs in settle as the resolution grows?"
        }
        "recondensation" => {
            "How much do results change when the worn gears are condensed anew more often?"
        }
        "paper" => {
            "Is every number that the published model printed reproduced, its mistakes included?"
        }
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::runner::known_ids;

    #[test]
    fn every_family_asks_something() {
        for id in known_ids() {
            let family = id.split('.').next().unwrap_or_default();
            assert!(!question(family).is_empty(), "{id} asks nothing");
        }
    }
}
