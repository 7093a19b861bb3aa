//! The words of five languages for what is measured: depths, masses, spans and chords of teeth, deviations of profiles; each as
//! [`super::folded`] leaves it.

use crate::measure::quantity::Quantity;

/// Names of quantities beside their own.
pub(super) const QUANTITIES: [(Quantity, &[&str]); 8] = [
    (
        Quantity::WearDepth,
        &[
            "depth",
            "wear",
            "depthwear",
            "flankwear",
            "verschleiss",
            "verschleisstiefe",
            "tiefe",
            "abtrag",
            "usura",
            "profondita",
            "profonditausura",
            "usure",
            "profondeur",
            "profondeurusure",
            "desgaste",
            "profundidad",
            "profundidaddesgaste",
        ],
    ),
    (
        Quantity::MassLoss,
        &[
            "mass",
            "loss",
            "lossmass",
            "weight",
            "weightloss",
            "lossweight",
            "masse",
            "massenverlust",
            "masseverlust",
            "verlust",
            "gewicht",
            "gewichtsverlust",
            "massa",
            "peso",
            "perdita",
            "perditamassa",
            "perditapeso",
            "massapersa",
            "pesoperso",
            "perte",
            "pertemasse",
            "pertepoids",
            "masseperdue",
            "poidsperdu",
            "poids",
            "masa",
            "perdida",
            "perdidamasa",
            "perdidapeso",
            "masaperdida",
            "pesoperdido",
        ],
    ),
    (
        Quantity::TransmissionError,
        &[
            "drehfehler",
            "drehwegfehler",
            "drehabweichung",
            "erroretrasmissione",
            "erreurtransmission",
            "errortransmision",
        ],
    ),
    (Quantity::LoadShare, &["lastanteil"]),
    (
        Quantity::SpanLoss,
        &["lossspan", "spanwear", "zahnweitenverlust"],
    ),
    (
        Quantity::ChordalLoss,
        &[
            "chordloss",
            "losschord",
            "chordalthicknessloss",
            "losschordalthickness",
            "zahndickenverlust",
        ],
    ),
    (
        Quantity::ContactPressure,
        &["pressung", "pressioncontact", "pressionecontatto"],
    ),
    (Quantity::MeshStiffness, &["eingriffssteifigkeit"]),
];

/// Names of the deviation from the new profile.
pub(super) const DEVIATIONS: [&str; 9] = [
    "deviation",
    "profiledeviation",
    "abweichung",
    "profilabweichung",
    "scostamento",
    "deviazione",
    "ecart",
    "desviacion",
    "dev",
];

/// Words for the deviation of a profile or a flank that say so in one.
pub(super) const PROFILE_DEVIATIONS: [&str; 8] = [
    "profiledeviation",
    "flankdeviation",
    "profilabweichung",
    "profilabweichungen",
    "profilformabweichung",
    "profilgesamtabweichung",
    "flankenabweichung",
    "flankenabweichungen",
];

/// Words for what such a deviation is of.
pub(super) const PROFILES: [&str; 18] = [
    "profile",
    "profiles",
    "profil",
    "profils",
    "profilo",
    "profili",
    "perfil",
    "perfiles",
    "flank",
    "flanks",
    "flanke",
    "flanken",
    "fianco",
    "flanc",
    "flanco",
    "involute",
    "evolvente",
    "neuprofil",
];

/// Names of the mass of a part: with `loss` they are no longer it.
pub(super) const MASSES: [&str; 10] = [
    "mass", "weight", "masse", "gewicht", "massa", "peso", "poids", "masa", "massen", "weighing",
];

/// Names of the span over several teeth.
pub(super) const SPANS: [&str; 13] = [
    "span",
    "toothspan",
    "spanmeasurement",
    "spanlength",
    "spanwidth",
    "basetangentlength",
    "wk",
    "zahnweite",
    "zahnweitewk",
    "quotawildhaber",
    "cotesurkdents",
    "cotesurdents",
    "ecartement",
];

/// Names of the chord of a tooth.
pub(super) const CHORDS: [&str; 7] = [
    "chord",
    "chordthickness",
    "chordalthickness",
    "chordaltooththickness",
    "sehnendicke",
    "zahndickensehne",
    "sehnenzahndicke",
];

/// Names of losses that may be of depth or of mass: their unit says which.
pub(super) const LOSSES: [&str; 11] = [
    "wear",
    "loss",
    "verschleiss",
    "verlust",
    "abtrag",
    "usura",
    "perdita",
    "usure",
    "perte",
    "desgaste",
    "perdida",
];
