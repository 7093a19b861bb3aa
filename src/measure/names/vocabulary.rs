//! The words of five languages for columns of tables and for what stands in them, each as [`super::folded`] leaves it; those for counts,
//! times and speeds stand in `counting`, those for what is measured in `measured`.

use super::counting::CYCLES;
use crate::measure::quantity::Subject;

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
            "dentsk",
            "dentsmesurees",
            "denticompresi",
            "dentimisurati",
            "walzwinkel",
            "walzlange",
            "walzweg",
            "waelzwinkel",
            "waelzlange",
            "waelzlaenge",
            "waelzweg",
            "raggio",
            "posizione",
            "diametro",
            "angolorotolamento",
            "lunghezzarotolamento",
            "rayon",
            "diametre",
            "angleroulement",
            "longueurroulement",
            "angledeveloppement",
            "longueurdeveloppement",
            "radio",
            "posicion",
            "angulorodadura",
            "longitudrodadura",
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
            "standardabw",
            "stdabw",
            "unsicherheit",
            "deviazionestandard",
            "devstandard",
            "devstd",
            "scartotipo",
            "incertezza",
            "incertezzatipo",
            "ecarttype",
            "incertitude",
            "incertitudetype",
            "desviacionestandar",
            "desviaciontipica",
            "desvestandar",
            "desvest",
            "desvtipica",
            "incertidumbre",
            "incertidumbretipica",
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

/// Names of columns that sum others up.
pub(super) const SUMMARIES: [&str; 23] = [
    "mean",
    "average",
    "median",
    "std",
    "stdev",
    "stddev",
    "max",
    "maximum",
    "min",
    "minimum",
    "range",
    "mittel",
    "mittelwert",
    "durchschnitt",
    "standardabweichung",
    "stabw",
    "spannweite",
    "media",
    "massimo",
    "minimo",
    "moyenne",
    "ecarttype",
    "promedio",
];

/// Words for base pitches.
pub(super) const BASE_PITCHES: [&str; 7] = [
    "basepitch",
    "grundteilung",
    "eingriffsteilung",
    "passobase",
    "passibase",
    "pasdebase",
    "pasosbase",
];

/// Those of them that name the mean.
pub(super) const MEANS: [&str; 8] = [
    "mean",
    "average",
    "mittel",
    "mittelwert",
    "durchschnitt",
    "media",
    "moyenne",
    "promedio",
];

/// Names of rows that add others up.
pub(super) const TOTALS: [&str; 12] = [
    "sum",
    "total",
    "totals",
    "subtotal",
    "summe",
    "gesamt",
    "gesamtsumme",
    "zwischensumme",
    "somma",
    "totale",
    "somme",
    "suma",
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

/// Names of the stops of a test, at which it is measured.
pub(super) const STOPS: [&str; 17] = [
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
    "palier",
    "tappa",
    "tramo",
];

/// Names of columns that may number repeated measurements.
pub(super) const REPEATS: [&str; 23] = [
    "repeat",
    "repetition",
    "rep",
    "replicate",
    "replication",
    "measurement",
    "run",
    "messung",
    "wiederholung",
    "wiederholmessung",
    "wdh",
    "durchgang",
    "lauf",
    "messreihe",
    "ripetizione",
    "misura",
    "misurazione",
    "replica",
    "mesure",
    "repeticion",
    "medicion",
    "medida",
    "replicado",
];

/// Words for the time before a test.
pub(super) const BEFORE: [&str; 23] = [
    "before", "initial", "start", "new", "vorher", "vor", "anfang", "neu", "neuteil", "prima",
    "iniziale", "nuovo", "nuova", "avant", "initiale", "neuf", "neuve", "neufs", "neuves", "antes",
    "inicial", "nuevo", "nueva",
];

/// Words for the time after a test.
pub(super) const AFTER: [&str; 23] = [
    "verschlissen",
    "gelaufen",
    "gebraucht",
    "usurato",
    "usurata",
    "usato",
    "usata",
    "usee",
    "usado",
    "desgastado",
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

/// Words that say that a value adds up from the start, as all values of a measurement file do.
pub(super) const CUMULATIVE: [&str; 22] = [
    "cumulative",
    "cumulated",
    "accumulated",
    "kumuliert",
    "kumulierte",
    "kumulierter",
    "kumulativ",
    "aufsummiert",
    "cumulato",
    "cumulata",
    "cumulati",
    "cumulativo",
    "cumulativa",
    "cumule",
    "cumulee",
    "cumules",
    "cumulees",
    "acumulado",
    "acumulada",
    "acumulados",
    "acumuladas",
    "accumulati",
];

/// The same of counts and running times, beside which they may be sums of rows elsewhere.
pub(super) const TOTAL_COUNTS: [&str; 8] = [
    "total",
    "gesamt",
    "totale",
    "totali",
    "totaux",
    "totales",
    "insgesamt",
    "complessivi",
];

/// Words that say nothing in a name.
pub(super) const FILLERS: [&str; 33] = [
    "nb", "nbre", "of", "the", "a", "an", "after", "no", "nr", "number", "id", "name", "der",
    "die", "das", "des", "nach", "anzahl", "nummer", "di", "d", "del", "della", "dei", "numero",
    "de", "du", "la", "le", "l", "el", "nombre", "n",
];
