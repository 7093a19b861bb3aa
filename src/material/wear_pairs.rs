//! Specific wear coefficients of material pairs from published measurements: a prior on k where a pair's own is not known yet.
//!
//! Each entry was read at the place it names. A thrust washer or a pin wears under its own conditions, not under a gear's: the prior is wide.

/// What one source says of the wear of one material against another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearPair {
    /// Its name in a study: what wears, then what it runs against.
    pub name: &'static str,
    /// The material that wears.
    pub worn: &'static str,
    /// What it runs against.
    pub against: &'static str,
    /// Specific wear coefficient, mm²/N (a thousandth of the figure in mm³/(N m)): the value stated, the geometric mean of several.
    pub coefficient: f64,
    /// Smallest and largest value stated, mm²/N; both the same where there is one.
    pub range: [f64; 2],
    /// One standard deviation of ln k as a factor, the prior's width in fits.
    pub spread: f64,
    /// Where the spread is from.
    pub scatter: &'static str,
    /// Test and conditions.
    pub conditions: &'static str,
    /// Who published it, and where it stands.
    pub source: &'static str,
    /// Table, row or sentence.
    pub place: &'static str,
    /// What of the source was read.
    pub read: &'static str,
}

const RTP: &str = "RTP Company, Wear Resistance Data, 800 Series (acetal), metric: rtpcompany.com/products/wear-resistant/wear-factor-friction-data/wear-resistance-data-800-series-metric/";
const RTP_PC: &str = "RTP Company, Wear Resistance Data, 300 Series (polycarbonate), English units (1e-10 in3 min/(ft lb h) = 2.014e-8 mm3/(N m)): rtpcompany.com/products/wear-resistant/wear-factor-friction-data/wear-resistance-data-300-series-english/";
const WASHER: &str = "dry thrust washer, ASTM D3702, plastic on plastic; PV 35 kPa m/s, 0.25 m/s";
const WASHER_READ: &str = "the table in the open page, its first rows";
const ASSUMED: &str = "not stated; pairs that the acetal table holds twice differ by a factor of 1.8 (one standard deviation), 3 leaves room for another kind of test";

/// An entry from one figure of a thrust washer's table, 1e-8 mm³/(N m).
const fn washer(
    name: &'static str,
    [worn, against]: [&'static str; 2],
    factor: f64,
    [source, place]: [&'static str; 2],
) -> WearPair {
    let coefficient = factor * 1e-11;
    WearPair {
        name,
        worn,
        against,
        coefficient,
        range: [coefficient, coefficient],
        spread: 3.0,
        scatter: ASSUMED,
        conditions: WASHER,
        source,
        place,
        read: WASHER_READ,
    }
}

/// 1e-10 in³ min/(ft lb h) in 1e-8 mm³/(N m): in³ = 16387.064 mm³, ft lb = 1.3558179 N m, 60 min an hour.
const ENGLISH: f64 = 16387.064 / (1.355_817_9 * 60.0) * 1e-2;

/// All pairs, by what wears.
pub const WEAR_PAIRS: &[WearPair] = &[
    washer(
        "pom-pa66",
        ["POM, unfilled", "PA 6/6, unfilled"],
        26.0,
        [RTP, "first row, rotating sample"],
    ),
    washer(
        "pom-pa66_gf30",
        ["POM, unfilled", "PA 6/6, 30 % glass fibre"],
        122.0,
        [RTP, "second row, rotating sample"],
    ),
    washer(
        "pom-pc",
        ["POM, unfilled", "PC, unfilled"],
        26.0,
        [RTP, "fourth row, rotating sample"],
    ),
    washer(
        "pom_ptfe20-pa66",
        ["POM, 20 % PTFE", "PA 6/6, unfilled"],
        8.0,
        [RTP, "fifth row, rotating sample"],
    ),
    washer(
        "pom_ptfe20-pa66_gf30",
        ["POM, 20 % PTFE", "PA 6/6, 30 % glass fibre"],
        81.0,
        [RTP, "sixth row, rotating sample"],
    ),
    WearPair {
        coefficient: 8.44e-10,
        range: [5.2e-10, 1.37e-9],
        scatter: "two rows of the table, 137 and 52 (1e-8 mm3/(N m)); 3 leaves room for another kind of test",
        ..washer(
            "pom_ptfe20-pa66_gf30_ptfe15",
            ["POM, 20 % PTFE", "PA 6/6, 30 % glass fibre, 15 % PTFE"],
            84.4,
            [RTP, "seventh and tenth row, rotating sample"],
        )
    },
    washer(
        "pom_ptfe20-pa66_cf30_ptfe15",
        ["POM, 20 % PTFE", "PA 6/6, 30 % carbon fibre, 15 % PTFE"],
        12.0,
        [RTP, "eighth row, rotating sample"],
    ),
    washer(
        "pa66-pom",
        ["PA 6/6, unfilled", "POM, unfilled"],
        265.0,
        [RTP, "first row, stationary sample"],
    ),
    washer(
        "pa66-pom_ptfe20",
        ["PA 6/6, unfilled", "POM, 20 % PTFE"],
        22.0,
        [RTP, "fifth row, stationary sample"],
    ),
    washer(
        "pa66-pc",
        ["PA 6/6, unfilled", "PC, unfilled"],
        616.0 * ENGLISH,
        [RTP_PC, "first row, stationary sample: 616"],
    ),
    washer(
        "pa66_gf30-pom",
        ["PA 6/6, 30 % glass fibre", "POM, unfilled"],
        459.0,
        [RTP, "second row, stationary sample"],
    ),
    washer(
        "pa66_gf30-pom_ptfe20",
        ["PA 6/6, 30 % glass fibre", "POM, 20 % PTFE"],
        300.0,
        [RTP, "sixth row, stationary sample"],
    ),
    washer(
        "pc-pom",
        ["PC, unfilled", "POM, unfilled"],
        82.0,
        [RTP, "fourth row, stationary sample"],
    ),
    washer(
        "pc-pa66",
        ["PC, unfilled", "PA 6/6, unfilled"],
        1256.0 * ENGLISH,
        [RTP_PC, "first row, rotating sample: 1256"],
    ),
    WearPair {
        coefficient: 3.32e-8,
        range: [1.742e-8, 6.34e-8],
        scatter: "rotating and stationary sample of one test, 3147 and 865; 3 leaves room for another kind of test",
        ..washer(
            "pc_gf30-self",
            ["PC, 30 % glass fibre", "PC, 30 % glass fibre"],
            3320.0,
            [RTP_PC, "third row"],
        )
    },
    WearPair {
        name: "ptfe_peek-self",
        worn: "PTFE with 10 to 40 % PEEK",
        against: "the same",
        coefficient: 1e-12,
        range: [1e-12, 1e-12],
        spread: 3.0,
        scatter: "stated as an order of magnitude; 3 is half a decade",
        conditions: "dry, reciprocating pin on flat, controlled humidity, steady state",
        source: "Ultralow wear self-mated PTFE composites: discovery.researcher.life/article/ultralow-wear-self-mated-ptfe-composites/de3ba97ec3a3320288dc6230a575eecc",
        place: "abstract: of the order of 1e-9 mm3/(N m)",
        read: "the abstract",
    },
    WearPair {
        name: "plastic-steel",
        worn: "an unfilled gear plastic",
        against: "steel",
        coefficient: 1e-9,
        range: [1e-9, 1e-9],
        spread: 5.0,
        scatter: "not stated; plastics of this table span a factor of 1000, 5 is two decades between 2.5 % and 97.5 %",
        conditions: "none: what a program takes for the wear coefficient of the guideline VDI 2736 part 2 where a user states none",
        source: "GEARpie (C. Fernandes, University of Porto), CLASSES/VDI2736.py: github.com/cfernandesFEUP/GEARpie",
        place: "kw = 1e-6 (mm3/(N m))",
        read: "the program; the table of the guideline was not",
    },
    WearPair {
        name: "mild_steel-self-dry",
        worn: "mild steel",
        against: "mild steel",
        coefficient: 1.98e-6,
        range: [1.98e-6, 1.98e-6],
        spread: 3.0,
        scatter: "not stated; 3 is assumed",
        conditions: "dry and severe; the dimensionless K = 7e-3 of V = K P L/(3 H) with the example's hardness of 1176 N/mm2",
        source: "Wikipedia, Wear coefficient: en.wikipedia.org/wiki/Wear_coefficient",
        place: "Table 1, last row, and the example below it",
        read: "the page",
    },
];

/// The pair of this name.
pub fn wear_pair(name: &str) -> Option<&'static WearPair> {
    WEAR_PAIRS.iter().find(|pair| pair.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_told_apart_and_hold_together() {
        for (place, pair) in WEAR_PAIRS.iter().enumerate() {
            assert!(WEAR_PAIRS[..place].iter().all(|p| p.name != pair.name));
            let [least, most] = pair.range;
            let mean = (least * most).sqrt();
            assert!((pair.coefficient / mean - 1.0).abs() < 2e-3, "{pair:?}");
            assert!(
                pair.spread > 1.0 && most / least < pair.spread * pair.spread,
                "{pair:?}"
            );
            for text in [
                pair.source,
                pair.place,
                pair.read,
                pair.scatter,
                pair.conditions,
            ] {
                assert!(!text.is_empty(), "{pair:?}");
            }
        }
    }

    /// RTP's two tables state the same test in both units: 13 is 26, 132 is 265 (rounded to whole figures).
    #[test]
    fn english_wear_factors_are_converted_as_their_table_does() {
        for (english, metric) in [(13.0, 26.0), (132.0, 265.0), (228.0, 459.0), (149.0, 300.0)] {
            let converted: f64 = english * ENGLISH;
            // half a unit of both roundings
            assert!(
                (converted - metric).abs() < 0.5 + 0.5 * ENGLISH,
                "{english}"
            );
        }
    }
}
