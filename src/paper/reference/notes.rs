//! Why a printed number is matched only by a quirk, missed, or ruled out.

#[derive(Clone, Copy)]
pub(super) struct Note {
    pub(super) text: &'static str,
    /// A law of gearing rules the printed number out.
    pub(super) law: bool,
}

/// The note of a row, for every row that is not plain agreement.
pub(super) fn of(id: &str) -> Option<Note> {
    let (text, law) = match id {
        "T2.2.a" => ("20.956 cut after two decimals, not rounded", false),
        "T2.2.s" | "T2.3.s" => (
            "an involute pair transmits z2/z1 = 1.963 at every centre distance: the base radii alone set it. No expression \
             built from the paper's formulas gives the printed number",
            true,
        ),
        "B1" => (
            "stated as calculated, but Eq. 5 gives zero without misalignment; the formula that comes nearest to the other two \
             backlashes contains 45 um, not 45.5",
            false,
        ),
        "B2" | "B3" => (
            "(a'/CD)(45 um + 2 m (inv a' - inv a)): one constant fitted, and the factor (z1 + z2)/2 = 40 of the correct formula \
             is missing; the correct backlash is several times larger",
            false,
        ),
        "P4" => (
            "the profile angle at the operating pitch circle is 20 deg; the point meant lies 0.032 mm below it, at 19.81 deg",
            false,
        ),
        "W1" | "W2" | "W3" => (
            "an artefact of the 50 points: it measures how far the nearest point happens to lie from the pitch point (y squared), \
             where nothing slides and nothing wears",
            false,
        ),
        "A1" => (
            "the run that gives the other angle change and the pressure drop gives 1.03 deg; 1.2 deg would take 35.2 um of wear, \
             the model removes 29.5 um",
            false,
        ),
        "A2" | "Q1" => (
            "follows from reading a thinner tooth as a larger pressure angle (Eq. 6) and from wear that grows with the square of \
             the distance from the pitch point: about nine times the correct one",
            false,
        ),
        "R1" => (
            "from the contact ratios rounded to one decimal (1.7 and 1.5), then cut; the contact ratio falls by 14.3 %",
            false,
        ),
        "R2" => (
            "the rounded contact ratios 1.7 and 1.2 give 29.4: one last digit off; the contact ratio falls by 27.9 %",
            false,
        ),
        "R3" => (
            "this is the decrease of the contact ratio under another name; the length along which two pairs touch falls from \
             8.23 to 2.63 mm, by 68 %",
            true,
        ),
        _ => return None,
    };
    Some(Note { text, law })
}
