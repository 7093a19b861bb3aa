//! Self-contained HTML pages: no network, light and dark, fit for print.
//!
//! Every picture is in the page as SVG; where scripts may run, charts take its place, with values under the pointer (uPlot, in
//! `vendor`, and the scripts in `script`).
//!
//! A [`Page`] is a conclusion, then sections of text, tables and plots. The same page can be had as Markdown.
mod comparison;
mod files;
mod ladder;
mod live;
mod models;
mod oil_and_heat;
mod page;
mod run;
mod table;
mod validation;

pub use comparison::comparison;
pub use ladder::ladder;
pub use models::models;
pub use page::{Page, Section};
pub use run::{files_of_run, run};
pub use table::{Cell, Table};
pub use validation::{Case, FamilyPage, Verdict, family_pages, summary};

/// Text made safe for HTML, in elements and attributes.
pub fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            // Control characters have no place in a page.
            c if c.is_control() && c != '\n' && c != '\t' => safe.push('\u{fffd}'),
            c => safe.push(c),
        }
    }
    safe
}
