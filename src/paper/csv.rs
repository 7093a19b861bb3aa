//! The few lines of comma-separated text this module needs: fields may be quoted, quotes inside are doubled.

/// The fields of one line.
pub(super) fn fields(line: &str) -> Vec<String> {
    let mut out = vec![String::new()];
    let mut quoted = false;
    let mut chars = line.chars().peekable();
    while let Some(c) = chars.next() {
        let field = out.last_mut();
        match (c, field) {
            ('"', Some(field)) if quoted && chars.peek() == Some(&'"') => {
                chars.next();
                field.push('"');
            }
            ('"', _) => quoted = !quoted,
            (',', _) if !quoted => out.push(String::new()),
            (c, Some(field)) => field.push(c),
            (_, None) => {}
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::fields;

    #[test]
    fn quoted_commas_and_quotes() {
        assert_eq!(fields("a,\"b, c\",,\"d\"\"e\""), ["a", "b, c", "", "d\"e"]);
    }
}
