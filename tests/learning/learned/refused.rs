//! What cannot be read.

use gearwear::study::{Fault, Study};

use super::entry;

struct Refused {
    keys: &'static str,
    fault: Fault,
    key: &'static str,
    mark: &'static str,
    allowed: &'static str,
    says: &'static str,
}

#[test]
fn what_cannot_be_read_is_refused_at_its_place() {
    let cases = [
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycle\"\nknots = [0, 1]\nvalues = [0, 0]",
            fault: Fault::BadValue,
            key: "effect.driver",
            mark: "\"cycle\"",
            allowed: "slid_distance",
            says: "the nearest is \"cycles\"",
        },
        Refused {
            keys: "acts = \"profile\"\ndriver = \"cycles\"\nknots = [0, 1]\nvalues = [0, 0]",
            fault: Fault::BadValue,
            key: "effect.driver",
            mark: "\"cycles\"",
            allowed: "from_tip",
            says: "is nothing that profile can follow",
        },
        Refused {
            keys: "acts = \"load_factor\"\ndriver = \"cycles\"\nknots = [0, 1]\nvalues = [0, 0]",
            fault: Fault::BadValue,
            key: "effect.acts",
            mark: "\"load_factor\"",
            allowed: "\"added_depth\"",
            says: "is not known",
        },
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycles\"\nmember = \"wheel\"\nknots = [0, 1]\nvalues = [0, 0]",
            fault: Fault::BadValue,
            key: "effect.member",
            mark: "\"wheel\"",
            allowed: "\"both\" or \"pinion\" or \"gear\"",
            says: "is not known",
        },
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycles\"\nknots = [0, 2e5, 1e5]\nvalues = [0, 0, 0]",
            fault: Fault::BadValue,
            key: "effect.knots",
            mark: "[0, 2e5, 1e5]",
            allowed: "above the one before",
            says: "knot 3 is 100000, which is not above 200000",
        },
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycles\"\nknots = [0]\nvalues = [0]",
            fault: Fault::BadValue,
            key: "effect.knots",
            mark: "[0]",
            allowed: "at least 2",
            says: "1 knots",
        },
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycles\"\nknots = [0, 1]\nvalues = [0, 0, 0]",
            fault: Fault::BadValue,
            key: "effect.values",
            mark: "[0, 0, 0]",
            allowed: "one value for each knot",
            says: "3 values for 2 knots",
        },
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycles\"\nknots = [0, 1]\nvalues = [0, 100]",
            fault: Fault::BadValue,
            key: "effect.values",
            mark: "[0, 100]",
            allowed: "-20 to 20",
            says: "natural logarithms",
        },
        Refused {
            keys: "acts = \"added_depth\"\ndriver = \"cycles\"\nknots = [0, 1]\nvalues = [0, -1]",
            fault: Fault::BadValue,
            key: "effect.values",
            mark: "[0, -1]",
            allowed: "0 or more",
            says: "value 2 is -1",
        },
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycles\"\nknots = [0, \"a\"]\nvalues = [0, 0]",
            fault: Fault::WrongType,
            key: "effect.knots",
            mark: "\"a\"",
            allowed: "a list of numbers",
            says: "not a list of numbers",
        },
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycles\"\nvalues = [0, 0]",
            fault: Fault::MissingKey,
            key: "effect.knots",
            mark: "[[effect]]",
            allowed: "ascending",
            says: "is missing",
        },
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycles\"\nknot = [0, 1]\nvalues = [0, 0]",
            fault: Fault::UnknownKey,
            key: "effect.knot",
            mark: "knot",
            allowed: "knots",
            says: "the nearest valid key is `knots`",
        },
        Refused {
            keys: "acts = \"wear_factor\"\ndriver = \"cycles\"\nknots = [0, 1]\nvalues = [0, 0]\nlength = 0",
            fault: Fault::BadValue,
            key: "effect.length",
            mark: "0",
            allowed: "above 0",
            says: "not above 0",
        },
    ];
    for case in cases {
        let text = entry(case.keys);
        let error = Study::parse(&text, "study.toml").expect_err(case.keys);
        let (message, found) = (error.to_string(), error.diagnostic());
        assert_eq!(found.fault, case.fault, "{message}");
        assert_eq!(found.key, case.key, "{message}");
        assert_eq!(&text[found.span.clone().unwrap()], case.mark, "{message}");
        assert!(found.allowed.contains(case.allowed), "{message}");
        assert!(
            message.contains(case.says),
            "no `{}` in:\n{message}",
            case.says
        );
    }
}
