//! `--vary KEY=VALUES`: what is varied, and through which values.

/// Largest number of values of one axis.
const MOST: usize = 10_000;

/// One varied key with its values as text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    /// Path of the key in the study: `operation.torque`.
    pub key: String,
    /// Its values, as the study would state them (texts without quotes); none for a range that a design is to fill.
    pub values: Vec<String>,
    /// The range that a design is to fill.
    pub range: Option<Range>,
}

/// A range of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Whether equal shares are equal ratios.
    pub log: bool,
}

impl Range {
    /// The number at a share of the way, as a person would write it: 0.3, not 0.30000000000000004.
    fn at(self, share: f64) -> String {
        let value = match self.log {
            true => self.from * (self.to / self.from).powf(share),
            false => self.from + (self.to - self.from) * share,
        };
        written(value)
    }
}

fn written(value: f64) -> String {
    format!("{value:.12e}")
        .parse::<f64>()
        .unwrap_or(value)
        .to_string()
}

impl Axis {
    /// Whether every value begins with a number.
    pub(super) fn numbers(&self) -> bool {
        self.values.iter().all(|v| leading_number(v).is_some())
    }

    /// The value at a share of the axis, from 0 to 1.
    pub(super) fn at(&self, share: f64) -> String {
        match self.range {
            Some(range) => range.at(share),
            None => {
                let count = self.values.len();
                self.values[((share * count as f64) as usize).min(count - 1)].clone()
            }
        }
    }
}

/// Reads `KEY=V1,V2,...` or `KEY=FROM..TO:COUNT[:log]`, for designs also `KEY=FROM..TO[:log]`.
pub(super) fn axis(text: &str) -> Result<Axis, String> {
    let form = "KEY=VALUE,VALUE,... or KEY=FROM..TO:COUNT";
    let (key, values) = text
        .split_once('=')
        .ok_or_else(|| format!("no = in it; write {form}"))?;
    let key = key.trim();
    if key.is_empty() {
        return Err(format!("no key before the =; write {form}"));
    }
    if let Some(range) = open_range(values.trim()) {
        return Ok(Axis {
            key: key.to_owned(),
            values: Vec::new(),
            range: Some(range),
        });
    }
    let mut all = Vec::new();
    for part in values.split(',').map(str::trim) {
        if part.is_empty() {
            return Err(format!("an empty value; write {form}"));
        }
        if part.contains("..") {
            all.extend(range(part)?);
        } else {
            all.push(part.to_owned());
        }
        if all.len() > MOST {
            return Err(format!("more than {MOST} values"));
        }
    }
    for (i, value) in all.iter().enumerate() {
        if all[..i].contains(value) {
            return Err(format!("the value {value} stands twice"));
        }
    }
    Ok(Axis {
        key: key.to_owned(),
        values: all,
        range: None,
    })
}

/// `FROM..TO` or `FROM..TO:log`.
fn open_range(text: &str) -> Option<Range> {
    let (from, to) = text.split_once("..")?;
    let (to, log) = match to.split_once(':') {
        Some((to, "log")) => (to, true),
        Some(_) => return None,
        None => (to, false),
    };
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    let (from, to) = (number(from)?, number(to)?);
    (from != to && (!log || from > 0.0 && to > 0.0)).then_some(Range { from, to, log })
}

fn range(text: &str) -> Result<Vec<String>, String> {
    let form = "write a range as FROM..TO:COUNT or FROM..TO:COUNT:log, with COUNT from 2";
    let wrong = || format!("{text}: {form}");
    let (from, rest) = text.split_once("..").ok_or_else(wrong)?;
    let mut rest = rest.split(':');
    let number = |text: Option<&str>| {
        let value = text.and_then(|t| t.trim().parse::<f64>().ok());
        value.filter(|v| v.is_finite()).ok_or_else(wrong)
    };
    let (from, to) = (number(Some(from))?, number(rest.next())?);
    let count = rest.next().and_then(|t| t.trim().parse::<usize>().ok());
    let count = count.filter(|n| (2..=MOST).contains(n)).ok_or_else(wrong)?;
    let logarithmic = match (rest.next().map(str::trim), rest.next()) {
        (None, None) => false,
        (Some("log"), None) if from > 0.0 && to > 0.0 => true,
        _ => return Err(wrong()),
    };
    let range = Range {
        from,
        to,
        log: logarithmic,
    };
    let value = |i: usize| match i {
        0 => written(from),
        i if i == count - 1 => written(to),
        _ => range.at(i as f64 / (count - 1) as f64),
    };
    Ok((0..count).map(value).collect())
}

/// The number in front of a value, with or without a unit behind it.
pub(super) fn leading_number(value: &str) -> Option<f64> {
    let first = value.split_whitespace().next()?;
    first.parse::<f64>().ok().filter(|v| v.is_finite())
}

/// A value as TOML writes it: numbers and truth values bare, everything else as a text.
pub(super) fn toml(value: &str) -> String {
    if value.parse::<i64>().is_ok() || value == "true" || value == "false" {
        return value.to_owned();
    }
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() => format!("{number:?}"),
        _ => {
            let escaped = value.replace('\\', "\\\\").replace('"', "\\\"");
            let plain: String = escaped.chars().filter(|c| !c.is_control()).collect();
            format!("\"{plain}\"")
        }
    }
}

/// A value in a JSON document.
pub(super) fn json(value: &str) -> serde_json::Value {
    let number = value.parse::<f64>().ok().filter(|v| v.is_finite());
    number.map_or_else(|| value.into(), Into::into)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_ranges() {
        let values = |text: &str| axis(text).unwrap().values;
        assert_eq!(values("a.b=0,0.25, 1"), ["0", "0.25", "1"]);
        assert_eq!(values("a=50..200:4"), ["50", "100", "150", "200"]);
        assert_eq!(values("a=0.1..0.5:5"), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(values("a=1..100:3:log"), ["1", "10", "100"]);
        assert_eq!(values("a=0.2 mm,1..2:2"), ["0.2 mm", "1", "2"]);
        for wrong in [
            "a",
            "=1",
            "a=",
            "a=1,,2",
            "a=1..1",
            "a=0..2:log",
            "a=1..2:1",
            "a=1..x:3",
            "a=0..2:3:log",
            "a=1,1",
            "a=1..2:3:exp",
            "a=nan..2:3",
        ] {
            assert!(axis(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn values_as_toml() {
        assert_eq!(toml("27"), "27");
        assert_eq!(toml("0.5"), "0.5");
        assert_eq!(toml(".5"), "0.5");
        assert_eq!(toml("fem"), "\"fem\"");
        assert_eq!(toml("20 deg"), "\"20 deg\"");
        assert_eq!(toml("a\"b"), "\"a\\\"b\"");
    }
}
