//! The map of a smooth discrepancy: `discrepancy.csv` and its pictures.

use super::comparison::quoted;
use super::csv::Table;
use super::error::OutputError;
use super::plots::{Plot, Style};
use crate::learn::diagnose::MapPoint;
use crate::numeric::written::count;

/// File name of the table.
const NAME: &str = "discrepancy.csv";

/// `discrepancy.csv`: the smooth part of measured minus base model at every fitted row.
///
/// Columns `test,member,quantity,cycles,position,value,measured_minus_model,unit`: pinion revolutions; mm of radius or base pitches of
/// rotation, empty for a whole member; the discrepancy in standard deviations of the row, and the same in `unit`.
pub fn csv(map: &[MapPoint]) -> Result<Vec<u8>, OutputError> {
    let mut table = Table::new(
        NAME,
        "test,member,quantity,cycles,position,value,measured_minus_model,unit",
    );
    for point in map {
        table.text(&quoted(&point.test));
        table.text(point.member);
        table.text(point.quantity);
        table.number("cycles", point.cycles)?;
        match point.position {
            Some(position) => table.number("position", position)?,
            None => table.text(""),
        }
        table.number("value", point.value)?;
        table.number("measured_minus_model", point.value * point.sigma)?;
        table.text(point.unit);
        table.end_row();
    }
    Ok(table.into_bytes())
}

/// One picture for each test and member with wear depths: the discrepancy along the flank, a curve for each time.
pub fn plots(map: &[MapPoint]) -> Vec<Plot> {
    let mut keys: Vec<(&str, &str)> = Vec::new();
    let depths: Vec<&MapPoint> = map.iter().filter(|p| p.quantity == "wear_depth").collect();
    for point in &depths {
        let key = (point.test.as_str(), point.member);
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys.iter()
        .enumerate()
        .map(|(number, &(test, member))| {
            let own = || {
                depths
                    .iter()
                    .filter(|p| (p.test.as_str(), p.member) == (test, member))
            };
            let mut times: Vec<f64> = own().map(|p| p.cycles).collect();
            times.sort_by(f64::total_cmp);
            times.dedup();
            let mut plot = Plot::new(
                &format!("discrepancy_{}", number + 1),
                &format!("Smooth discrepancy: test {test}, {member}"),
                "radius, mm",
                "measured − model, σ",
            );
            for (index, &time) in times.iter().enumerate() {
                let at = own().filter(|p| p.cycles == time);
                let mut points: Vec<(f64, f64)> = at
                    .filter_map(|p| p.position.map(|x| (x, p.value)))
                    .collect();
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
                let style = Style::TimeLine {
                    index,
                    count: times.len(),
                };
                plot = plot.curve(&format!("{} cycles", count(time)), style, points);
            }
            plot.residuals = true;
            plot
        })
        .filter(|plot| !plot.is_empty())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(test: &str, member: &'static str, cycles: f64, value: f64) -> MapPoint {
        MapPoint {
            test: test.to_owned(),
            member,
            quantity: "wear_depth",
            cycles,
            position: Some(27.5),
            value,
            sigma: 0.5,
            unit: "um",
        }
    }

    #[test]
    fn every_row_stands_in_the_table_and_every_flank_has_a_picture() {
        let mut map = vec![
            point("A, first", "pinion", 1e5, 0.5),
            point("A, first", "pinion", 2e5, -1.0),
            point("B", "gear", 1e5, 2.0),
        ];
        map.push(MapPoint {
            quantity: "mass_loss",
            position: None,
            ..point("B", "gear", 1e5, 1.0)
        });
        let table = String::from_utf8(csv(&map).unwrap()).unwrap();
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(
            lines[0],
            "test,member,quantity,cycles,position,value,measured_minus_model,unit"
        );
        assert_eq!(
            lines[1],
            "\"A, first\",pinion,wear_depth,100000,27.5,0.5,0.25,um"
        );
        assert_eq!(lines[4], "B,gear,mass_loss,100000,,1,0.5,um");
        let plots = plots(&map);
        assert_eq!(plots.len(), 2);
        assert_eq!(plots[0].curves.len(), 2);
        assert!(plots.iter().all(|plot| plot.svg().is_ok()));
    }
}
