//! `residuals.csv`: every measured row with what the fitted model says of it.
use crate::report::csv::Table;
use crate::report::error::OutputError;

/// `residuals.csv`, in the order of the measurement file.
///
/// Columns `test,member,cycles,quantity,position,measured,datum,model,residual,standardised,measured_minus_model,unit`: position as in the measurement
/// file; measured as stated there, datum the most probable one of its trace, residual = model − (measured − datum), all three
/// and the model in the quantity's unit; standardised = residual over the row's sigma; measured_minus_model = −residual, the sign of
/// all tables of a diagnosis; the unit of all five but `standardised`.
///
/// # Errors
/// [`OutputError`] for a figure that is not finite.
pub fn residuals(result: &super::Result<'_>) -> Result<Vec<u8>, OutputError> {
    let mut table = Table::new(
        "residuals.csv",
        "test,member,cycles,quantity,position,measured,datum,model,residual,standardised,measured_minus_model,unit",
    );
    for (o, row) in result.data.observations.iter().zip(&result.fit.rows) {
        table.text(&quoted(&result.data.tests[o.test]));
        table.text(o.member.name());
        table.number("cycles", o.cycles)?;
        table.text(o.quantity.name());
        match o.position {
            Some(position) => table.number("position", position)?,
            None => table.text(""),
        }
        for (what, value) in [
            ("measured", o.value),
            ("datum", row.datum),
            ("model", row.model),
            ("residual", row.residual),
            ("standardised", row.standardised),
            ("measured_minus_model", -row.residual),
        ] {
            table.number(what, value)?;
        }
        table.text(o.quantity.unit());
        table.end_row();
    }
    Ok(table.into_bytes())
}

/// A text as a CSV cell (RFC 4180): in quotes where it must be.
pub(crate) fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\n', '\r']) || text.trim() != text || text.starts_with('#') {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
