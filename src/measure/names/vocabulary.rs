//! The words of five languages for columns of tables and for what stands in them, each as [`super::folded`] leaves it.

use crate::measure::quantity::{Quantity, Subject};

/// Columns by their names in a measurement file.
pub(super) const COLUMNS: [(&str, &[&str]); 10] = [
    (
        "test",
        &[
            "run", "versuch", "prufung", "lauf", "prova", "essai", "ensayo", "prueba",
        ],
    ),
    (
        "member",
        &[
            "wheel",
            "gear",
            "gearwheel",
            "part",
            "rad",
            "zahnrad",
            "bauteil",
            "teil",
            "ruota",
            "componente",
            "pezzo",
            "roue",
            "piece",
            "rueda",
            "pieza",
        ],
    ),
    ("cycles", CYCLES),
    (
        "quantity",
        &[
            "grosse",
            "messgrosse",
            "groesse",
            "grandezza",
            "grandeur",
            "magnitud",
        ],
    ),
    (
        "position",
        &[
            "r",
            "radius",
            "diameter",
            "rollangle",
            "rolllength",
            "ort",
            "stelle",
            "durchmesser",
            "ø",
            "messkreis",
            "messkreisdurchmesser",
            "messkreisø",
            "teethspanned",
            "spannedteeth",
            "messzahne",
            "messzahnezahl",
            "messzahnzahl",
            "walzwinkel",
            "walzlange",
            "raggio",
            "posizione",
            "diametro",
            "rayon",
            "diametre",
            "radio",
            "posicion",
        ],
    ),
    (
        "value",
        &["reading", "wert", "messwert", "valore", "valeur", "valor"],
    ),
    (
        "sigma",
        &[
            "u",
            "sd",
            "std",
            "stdev",
            "stddev",
            "standarddeviation",
            "uncertainty",
            "standarduncertainty",
            "streuung",
            "standardabweichung",
            "unsicherheit",
            "deviazionestandard",
            "incertezza",
            "ecarttype",
            "incertitude",
            "desviacionestandar",
            "desviaciontipica",
            "incertidumbre",
        ],
    ),
    (
        "trace",
        &[
            "profile",
            "curve",
            "spur",
            "kurve",
            "messkurve",
            "profil",
            "traccia",
            "profilo",
            "courbe",
            "curva",
            "traza",
            "perfil",
        ],
    ),
    ("face", &[]),
    ("tooth", &["zahn", "dente", "dent", "diente"]),
];

/// Names of several standard deviations.
pub(super) const EXPANDED: [&str; 7] = [
    "u95",
    "expandeduncertainty",
    "erweiterteunsicherheit",
    "erweitertemessunsicherheit",
    "incertezzaestesa",
    "incertitudeelargie",
    "incertidumbreexpandida",
];

/// Names of counts of revolutions.
pub(super) const CYCLES: &[&str] = &[
    "cycle",
    "loadcycles",
    "rev",
    "revs",
    "revolution",
    "revolutions",
    "turns",
    "lastspiele",
    "lastwechsel",
    "lw",
    "umdrehung",
    "umdrehungen",
    "zyklen",
    "cicli",
    "giri",
    "tours",
    "ciclos",
    "revoluciones",
    "vueltas",
];

/// Names of running times.
pub(super) const TIMES: [&str; 19] = [
    "time",
    "runningtime",
    "runtime",
    "testtime",
    "operatingtime",
    "hours",
    "zeit",
    "laufzeit",
    "betriebszeit",
    "versuchszeit",
    "tempo",
    "tempofunzionamento",
    "temps",
    "tempsmarche",
    "tempsfonctionnement",
    "duree",
    "tiempo",
    "tiempofuncionamiento",
    "duracion",
];

/// Names of speeds of rotation.
pub(super) const SPEEDS: [&str; 11] = [
    "speed",
    "rotationalspeed",
    "inputspeed",
    "testspeed",
    "drehzahl",
    "antriebsdrehzahl",
    "velocita",
    "velocitarotazione",
    "vitesse",
    "vitesserotation",
    "velocidad",
];

/// Units of speeds of rotation: revolutions per minute.
pub(super) const PER_MINUTE: [&str; 9] = [
    "rpm", "1/min", "/min", "min-1", "min^-1", "u/min", "r/min", "tr/min", "giri/min",
];

/// Names of one of the two flanks of a tooth, or of what it looks to.
pub(super) const FLANKS: [&str; 9] = [
    "flank",
    "flankside",
    "toothflank",
    "flanke",
    "zahnflanke",
    "fianco",
    "flanc",
    "flanco",
    "lato",
];

/// Multiples of counts.
pub(super) const MULTIPLES: [&str; 17] = [
    "million",
    "millions",
    "mio",
    "mill",
    "millionen",
    "milioni",
    "milione",
    "millones",
    "thousand",
    "thousands",
    "tausend",
    "tsd",
    "migliaia",
    "mila",
    "milliers",
    "mille",
    "miles",
];

/// Powers of ten behind counts, as people write them, without blanks.
pub(super) const POWERS: [&str; 7] = [
    "1e3",
    "1e6",
    "10^3",
    "10^6",
    "10\u{b3}",
    "10\u{2076}",
    "1000",
];

/// What stands before and behind a power of ten that multiplies.
pub(super) const AROUND_POWER: [(&str, &str); 6] = [
    ("x", ""),
    ("\u{d7}", ""),
    ("*", ""),
    ("in", ""),
    ("[", "]"),
    ("(", ")"),
];

/// Hours of each unit of time.
pub(super) const HOURS: [(&str, f64); 24] = [
    ("h", 1.0),
    ("hr", 1.0),
    ("hrs", 1.0),
    ("hour", 1.0),
    ("hours", 1.0),
    ("std", 1.0),
    ("stunden", 1.0),
    ("ore", 1.0),
    ("heures", 1.0),
    ("horas", 1.0),
    ("min", 1.0 / 60.0),
    ("minutes", 1.0 / 60.0),
    ("s", 1.0 / 3600.0),
    ("sec", 1.0 / 3600.0),
    ("d", 24.0),
    ("day", 24.0),
    ("days", 24.0),
    ("tage", 24.0),
    ("wk", 168.0),
    ("week", 168.0),
    ("weeks", 168.0),
    ("runninghours", 1.0),
    ("operatinghours", 1.0),
    ("betriebsstunden", 1.0),
];

/// Names of columns for people.
pub(super) const FOR_PEOPLE: [&str; 19] = [
    "comment",
    "comments",
    "note",
    "notes",
    "remark",
    "remarks",
    "kommentar",
    "bemerkung",
    "bemerkungen",
    "notiz",
    "hinweis",
    "nota",
    "osservazioni",
    "commento",
    "commentaire",
    "remarque",
    "remarques",
    "comentario",
    "observaciones",
];

/// Names that only hint at a column: too vague to be read as it.
pub(super) const HINTS: [(&str, &[&str]); 5] = [
    ("sigma", &["error", "s"]),
    ("cycles", &["n", "time"]),
    ("position", &["x", "place"]),
    ("value", &["y", "measured"]),
    ("member", &["body"]),
];

/// Members by what they are called.
pub(super) const MEMBERS: [(Subject, &[&str]); 3] = [
    (
        Subject::Pinion,
        &[
            "pinion", "small", "smaller", "ritzel", "kleinrad", "klein", "pignone", "piccolo",
            "piccola", "pignon", "petit", "petite", "pinon", "pequeno", "pequena",
        ],
    ),
    (
        Subject::Gear,
        &[
            "gear", "wheel", "big", "bigger", "large", "larger", "rad", "grossrad", "gross",
            "corona", "ruota", "grande", "couronne", "roue", "rueda",
        ],
    ),
    (
        Subject::Pair,
        &["pair", "paar", "radpaar", "coppia", "couple", "par"],
    ),
];

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
            "perte",
            "pertemasse",
            "pertepoids",
            "poids",
            "masa",
            "perdida",
            "perdidamasa",
            "perdidapeso",
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
pub(super) const DEVIATIONS: [&str; 8] = [
    "deviation",
    "profiledeviation",
    "abweichung",
    "profilabweichung",
    "scostamento",
    "ecart",
    "desviacion",
    "dev",
];

/// Names of the mass of a part: with `loss` they are no longer it.
pub(super) const MASSES: [&str; 10] = [
    "mass", "weight", "masse", "gewicht", "massa", "peso", "poids", "masa", "massen", "weighing",
];

/// Names of the span over several teeth.
pub(super) const SPANS: [&str; 9] = [
    "span",
    "toothspan",
    "spanmeasurement",
    "spanlength",
    "spanwidth",
    "basetangentlength",
    "wk",
    "zahnweite",
    "quotawildhaber",
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

/// Names of the stops of a test, at which it is measured.
pub(super) const STOPS: [&str; 14] = [
    "stop",
    "stage",
    "interval",
    "inspection",
    "stopp",
    "stufe",
    "abschnitt",
    "intervall",
    "fermata",
    "intervallo",
    "arret",
    "etape",
    "intervalle",
    "etapa",
];

/// Words for the time before a test.
pub(super) const BEFORE: [&str; 15] = [
    "before", "initial", "start", "new", "vorher", "vor", "anfang", "neu", "prima", "iniziale",
    "avant", "initiale", "antes", "inicial", "nuevo",
];

/// Words for the time after a test.
pub(super) const AFTER: [&str; 13] = [
    "after",
    "final",
    "end",
    "worn",
    "remaining",
    "nachher",
    "nach",
    "ende",
    "dopo",
    "finale",
    "apres",
    "despues",
    "fin",
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

/// Words that say nothing in a name.
pub(super) const FILLERS: [&str; 31] = [
    "of", "the", "a", "an", "after", "no", "nr", "number", "id", "name", "der", "die", "das",
    "des", "nach", "anzahl", "nummer", "di", "d", "del", "della", "dei", "numero", "de", "du",
    "la", "le", "l", "el", "nombre", "n",
];
