//! Numbers as people read them.

/// `value` with `digits` significant digits, thousands apart, a true minus sign; tiny and huge values with a power of ten.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "not a number".to_owned();
    }
    let digits = digits.max(1);
    let scientific = format!("{value:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..7).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        grouped(&format!("{value:.decimals$}"))
    } else {
        format!("{}·10{}", grouped(mantissa), superscript(exponent))
    }
}

/// A figure with so many decimals, never a minus before a zero.
pub fn fixed(value: f64, decimals: usize) -> String {
    grouped(&format!("{value:.decimals$}"))
}

/// Up to six significant digits without trailing zeros, for figures that were put in rather than computed.
pub fn plain(value: f64) -> String {
    let text = significant(value, 6);
    let (number, power) = match text.split_once("·10") {
        Some((number, exponent)) => (number.to_owned(), format!("·10{exponent}")),
        None => (text, String::new()),
    };
    let number = if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.')
    } else {
        &number
    };
    format!("{number}{power}")
}

/// The beginning of a sentence.
pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters
        .next()
        .map(|letter| letter.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// A sentence with the mark at its end: its own, else a full stop.
pub fn ended(text: &str) -> String {
    if text.ends_with(['?', '.']) {
        text.to_owned()
    } else {
        format!("{text}.")
    }
}

/// A unit as people read it, of one that is written with the letters of a keyboard: `µm`, `N/(mm·µm)`.
pub fn unit(plain: &str) -> String {
    let mut shown = String::new();
    let mut rest = plain;
    while !rest.is_empty() {
        let letters = rest.chars().take_while(|c| c.is_ascii_alphabetic()).count();
        let (word, behind) = rest.split_at(letters);
        shown += match word {
            "um" => "µm",
            "urad" => "µrad",
            other => other,
        };
        let mut others = behind.chars();
        if let Some(sign) = others.next() {
            // `mm um` is a product, `um per contact` a sentence
            let is_product = sign == ' ' && word == "mm" && others.as_str().starts_with("um");
            shown.push(if is_product { '·' } else { sign });
        }
        rest = others.as_str();
    }
    shown
}

/// A whole number, thousands apart.
pub fn whole(value: usize) -> String {
    grouped(&value.to_string())
}

/// A count such as cycles: whole where it is whole.
pub fn count(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        grouped(&format!("{value:.0}"))
    } else {
        significant(value, 6)
    }
}

/// A value with its standard deviation: two digits of that, the value to the same place (`266 000 ± 32 000`).
pub fn uncertain(value: f64, sigma: f64) -> String {
    if !(value.is_finite() && sigma.is_finite() && sigma > 0.0) {
        return significant(value, 4);
    }
    let size = value.abs().max(sigma);
    let power = size.log10().floor() as i32;
    let tiny_or_huge = !(-3..6).contains(&power);
    let scale = if tiny_or_huge { 10f64.powi(power) } else { 1.0 };
    let (value, sigma) = (value / scale, sigma / scale);
    let place = 1.0 - sigma.log10().floor();
    let decimals = place.clamp(0.0, 9.0) as usize;
    // beyond two digits a whole number has zeros
    let in_steps = |figure: f64| match place < 0.0 {
        true => 10f64.powf(-place) * (figure / 10f64.powf(-place)).round(),
        false => figure,
    };
    let [value, sigma] = [value, sigma].map(in_steps);
    let both = format!(
        "{} ± {}",
        grouped(&format!("{value:.decimals$}")),
        grouped(&format!("{sigma:.decimals$}"))
    );
    if tiny_or_huge {
        format!("({both})·10{}", superscript(power))
    } else {
        both
    }
}

/// A percentage of a ratio.
pub fn percent(ratio: f64, digits: usize) -> String {
    format!("{} %", significant(100.0 * ratio, digits))
}

/// A probability, never a certainty.
pub fn probability(p: f64) -> String {
    if p > 0.999 {
        ">99.9 %".to_owned()
    } else if p < 0.001 {
        "<0.1 %".to_owned()
    } else {
        format!("{} %", rounded_down(100.0 * p, 1))
    }
}

/// A percentage rounded down, so that none is shown that reaches a threshold which its figure does not.
pub fn rounded_down(percent: f64, decimals: usize) -> String {
    // a figure that is 0.29 but for the machine's rounding is 29 %
    let steps = 10f64.powi(decimals as i32);
    let down = (percent * steps * (1.0 + 1e-12)).floor() / steps;
    format!("{down:.decimals$}")
}

/// Seconds as seconds, or minutes and hours when long.
pub fn duration(seconds: f64) -> String {
    if seconds < 120.0 {
        format!("{} s", significant(seconds, 3))
    } else if seconds < 7200.0 {
        format!("{} min", significant(seconds / 60.0, 3))
    } else {
        format!("{} h", significant(seconds / 3600.0, 3))
    }
}

/// Puts narrow no-break spaces between thousands of five and more digits and a true minus sign in front, but before no zero: what was rounded to one, or
/// is one with a sign, has none.
pub fn grouped(number: &str) -> String {
    let is_zero = |rest: &str| !rest.contains(|c: char| ('1'..='9').contains(&c));
    let (sign, rest) = match number.strip_prefix('-') {
        Some(rest) if is_zero(rest) => ("", rest),
        Some(rest) => ("\u{2212}", rest),
        None => ("", number),
    };
    let (int, fraction) = match rest.split_once('.') {
        Some((int, fraction)) => (int, Some(fraction)),
        None => (rest, None),
    };
    let mut text = sign.to_owned();
    for (place, digit) in int.chars().enumerate() {
        if int.len() > 4 && place > 0 && (int.len() - place).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    if let Some(fraction) = fraction {
        text.push('.');
        text.push_str(fraction);
    }
    text
}

fn superscript(exponent: i32) -> String {
    exponent
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '\u{207b}',
            '1' => '\u{b9}',
            '2' => '\u{b2}',
            '3' => '\u{b3}',
            digit => char::from_u32(0x2070 + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_question_keeps_its_mark() {
        let both = ["is it in g?", "it is.", "look at it"].map(ended);
        assert_eq!(both, ["is it in g?", "it is.", "look at it."]);
    }

    #[test]
    fn units_are_shown_with_their_letters() {
        for (plain, shown) in [
            ("um", "µm"),
            ("urad", "µrad"),
            ("N/(mm um)", "N/(mm·µm)"),
            ("mm um/N", "mm·µm/N"),
            ("um per 1e6 contacts", "µm per 1e6 contacts"),
            ("mm2/N", "mm2/N"),
            ("MPa", "MPa"),
            ("N m", "N m"),
            ("1", "1"),
            ("cumulated", "cumulated"),
            ("", ""),
        ] {
            assert_eq!(unit(plain), shown);
        }
    }

    #[test]
    fn no_zero_has_a_minus_sign() {
        assert_eq!(fixed(-0.04, 1), "0.0");
        assert_eq!(fixed(-0.06, 1), "\u{2212}0.1");
        assert_eq!(fixed(-12_345.6, 0), "\u{2212}12\u{202f}346");
        assert_eq!(count(-0.0), "0");
        assert_eq!(plain(-0.0), "0");
        assert_eq!(significant(-0.0, 3), "0");
        assert_eq!(uncertain(-0.001, 1.0), "0.0 ± 1.0");
        assert_eq!(percent(-0.0, 2), "0 %");
    }

    #[test]
    fn numbers_as_people_write_them() {
        assert_eq!(significant(2.333_49, 4), "2.333");
        assert_eq!(significant(-0.012_345, 3), "\u{2212}0.0123");
        assert_eq!(significant(6e-10, 2), "6.0·10\u{207b}\u{b9}\u{2070}");
        assert_eq!(significant(115_385.2, 3), "115\u{202f}385");
        assert_eq!(significant(9.999_9, 3), "10.0");
        assert_eq!(
            uncertain(6.1234e-10, 2.3e-12),
            "(6.123 ± 0.023)·10\u{207b}\u{b9}\u{2070}"
        );
        assert_eq!(uncertain(-2.913, 0.21), "\u{2212}2.91 ± 0.21");
        assert_eq!(uncertain(127_300.0, 5_400.0), "127\u{202f}300 ± 5400");
        assert_eq!(
            uncertain(266_198.0, 32_086.0),
            "266\u{202f}000 ± 32\u{202f}000"
        );
        assert_eq!(uncertain(1234.0, 99.7), "1234 ± 100");
        assert_eq!(uncertain(1.8194, 0.0353), "1.819 ± 0.035");
        assert_eq!(uncertain(1.239e7, 4.7e5), "(1.239 ± 0.047)·10\u{2077}");
        assert_eq!(uncertain(0.0271, 0.0017), "0.0271 ± 0.0017");
        assert_eq!(uncertain(3.0, 0.0), "3.000");
        assert_eq!(count(50_000.0), "50\u{202f}000");
        assert_eq!(count(1018.0), "1018");
        assert_eq!(plain(2.0), "2");
        assert_eq!(plain(1018.868), "1018.87");
        assert_eq!(plain(6e-10), "6·10\u{207b}\u{b9}\u{2070}");
        assert_eq!(percent(0.0123, 2), "1.2 %");
        // 84.987 % is not the 85 % from which an effect is named
        assert_eq!(probability(0.849_87), "84.9 %");
        assert_eq!(probability(0.29), "29.0 %");
        assert_eq!(rounded_down(100.0 * 0.29, 0), "29");
        assert_eq!(duration(7200.0), "2.00 h");
    }
}
