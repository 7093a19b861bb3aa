//! The coverage factor of an expanded uncertainty, as headers state it.

/// What may stand between it and the rest of a header.
const BETWEEN: [char; 3] = [' ', ',', ';'];

/// The factor that a header states, and the header without it: `U (k = 2) [um]` is 2 and `U [um]`.
pub(super) fn coverage(header: &str) -> Option<(f64, String)> {
    let (at, behind) = header.match_indices(['k', 'K']).find_map(|(at, k)| {
        let is_word = !header[..at].ends_with(char::is_alphanumeric);
        let behind = header[at + k.len()..].trim_start().strip_prefix('=')?;
        is_word.then(|| (at, behind.trim_start()))
    })?;
    let is_digit = |c: char| c.is_ascii_digit() || ['.', ','].contains(&c);
    let digits = behind.find(|c| !is_digit(c)).unwrap_or(behind.len());
    let number = behind[..digits].trim_end_matches(['.', ',']);
    let k = number.replace(',', ".").parse().ok()?;
    let before = header[..at].trim_end_matches(BETWEEN);
    let after = behind[number.len()..].trim_start_matches(BETWEEN);
    let (before, after) = match (
        before.strip_suffix(['(', '[']),
        after.strip_prefix([')', ']']),
    ) {
        // nothing else stood in its brackets
        (Some(before), Some(after)) => (before.trim_end(), after.trim_start()),
        _ => (before, after),
    };
    Some((k, format!("{before} {after}").trim().to_owned()))
}

/// A header without the level of confidence that it states, in percent: `U (95 %) [um]` is `U [um]`; none if it states none.
pub(super) fn without_level(header: &str) -> Option<String> {
    let percent = header.find('%')?;
    let before = header[..percent].trim_end();
    let is_digit = |c: char| c.is_ascii_digit() || ['.', ','].contains(&c);
    let number = before.trim_end_matches(is_digit);
    if number.len() == before.len() {
        return None;
    }
    let (before, after) = (number.trim_end(), &header[percent + 1..]);
    let (before, after) = match (
        before.strip_suffix(['(', '[']),
        after.trim_start().strip_prefix([')', ']']),
    ) {
        (Some(before), Some(after)) => (before, after),
        _ => (before, after),
    };
    Some(
        format!("{} {}", before.trim(), after.trim())
            .trim()
            .to_owned(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_of_confidence_is_found() {
        for (header, rest) in [
            ("U (95%) [um]", "U [um]"),
            ("U [um] (95 %)", "U [um]"),
            ("uncertainty 95 % [um]", "uncertainty [um]"),
            ("u (99.7 %)", "u"),
        ] {
            assert_eq!(without_level(header).as_deref(), Some(rest), "{header}");
        }
        for header in ["sigma [%]", "U [um]", "share %"] {
            assert_eq!(without_level(header), None, "{header}");
        }
    }

    #[test]
    fn a_factor_is_found_wherever_it_stands() {
        for (header, k, rest) in [
            ("u(k=2)", 2.0, "u"),
            ("U (k = 2) [um]", 2.0, "U [um]"),
            ("U [um] (k=2)", 2.0, "U [um]"),
            ("U [um, k=1.96]", 1.96, "U [um ]"),
            ("U (k=2, um)", 2.0, "U ( um)"),
            ("U, K = 2,5", 2.5, "U"),
        ] {
            assert_eq!(coverage(header), Some((k, rest.to_owned())), "{header}");
        }
        for header in ["U [um]", "mark=2", "U (k)", "U (k=two)"] {
            assert_eq!(coverage(header), None, "{header}");
        }
    }
}
