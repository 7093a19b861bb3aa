//! The words of five languages for counts of revolutions, running times, speeds and torques, with their units and multiples, each as
//! [`super::folded`] leaves it.

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
    "lastspiel",
    "lastspielzahl",
    "lastwechsel",
    "lastwechselzahl",
    "schwingspiele",
    "schwingspielzahl",
    "zyklenzahl",
    "lw",
    "uberrollungen",
    "umdrehung",
    "umdr",
    "umdrehungen",
    "zyklen",
    "ciclo",
    "cicli",
    "ciclicarico",
    "giri",
    "rotazioni",
    "tours",
    "cyclescharge",
    "ciclos",
    "cicloscarga",
    "revoluciones",
    "vueltas",
];

/// Names of running times.
pub(super) const TIMES: [&str; 36] = [
    "time",
    "runningtime",
    "runtime",
    "testtime",
    "operatingtime",
    "hours",
    "runninghours",
    "operatinghours",
    "zeit",
    "laufzeit",
    "betriebszeit",
    "versuchszeit",
    "stunden",
    "betriebsstunden",
    "laufstunden",
    "tempo",
    "tempofunzionamento",
    "durata",
    "ore",
    "orefunzionamento",
    "oremarcia",
    "orelavoro",
    "temps",
    "tempsmarche",
    "tempsfonctionnement",
    "duree",
    "heures",
    "heuresmarche",
    "heuresfonctionnement",
    "tiempo",
    "tiempofuncionamiento",
    "duracion",
    "horas",
    "horasmarcha",
    "horasfuncionamiento",
    "horasservicio",
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

/// Names of torques. Some of them mean other things without a unit of torque.
pub(super) const TORQUES: [&str; 21] = [
    "torque",
    "inputtorque",
    "testtorque",
    "loadtorque",
    "t",
    "t1",
    "drehmoment",
    "moment",
    "antriebsmoment",
    "antriebsdrehmoment",
    "eingangsdrehmoment",
    "prufmoment",
    "lastmoment",
    "m",
    "m1",
    "coppia",
    "momento",
    "momentotorcente",
    "couple",
    "par",
    "partorsion",
];

/// N m of each unit of torque.
pub(super) const NEWTON_METRES: [(&str, f64); 5] = [
    ("nm", 1.0),
    ("nmm", 1e-3),
    ("ncm", 1e-2),
    ("mnm", 1e-3),
    ("knm", 1e3),
];

/// Names of the module of gears.
pub(super) const MODULES: [&str; 10] = [
    "module",
    "normalmodule",
    "modul",
    "normalmodul",
    "modulo",
    "modulonormale",
    "modulonormal",
    "modulenormal",
    "m",
    "mn",
];

/// Names of how many teeth a gear has. Words for teeth alone may say which of them were measured.
pub(super) const NUMBERS_OF_TEETH: [&str; 13] = [
    "z",
    "z1",
    "z2",
    "numberofteeth",
    "noofteeth",
    "zahnezahl",
    "zahnezahlz",
    "nombrededents",
    "numerodidenti",
    "numerodenti",
    "numerodedientes",
    "numerodientes",
    "nodedents",
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
pub(super) const HOURS: [(&str, f64); 33] = [
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
    ("laufstunden", 1.0),
    ("orefunzionamento", 1.0),
    ("oremarcia", 1.0),
    ("orelavoro", 1.0),
    ("heuresmarche", 1.0),
    ("heuresfonctionnement", 1.0),
    ("horasmarcha", 1.0),
    ("horasfuncionamiento", 1.0),
    ("horasservicio", 1.0),
];
