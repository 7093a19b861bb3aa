//! A page: title, conclusion, sections.
use rayon::prelude::*;
use serde_json::Value;

use super::table::Table;
use super::{escape, live};
use crate::report::drawings::Drawing;
use crate::report::error::OutputError;
use crate::report::plots::Plot;

/// One page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Page {
    /// Title.
    pub title: String,
    /// One line under the title: what was run.
    pub kicker: String,
    /// What came out, in a sentence or two.
    pub conclusion: String,
    /// The rest.
    pub sections: Vec<Section>,
    /// Names of the states that sliders move through.
    pub states: Vec<String>,
    /// What scripts need to redraw the worn profile.
    pub tooth: Option<Value>,
}

/// One section.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// Heading.
    pub heading: String,
    /// Paragraphs before the tables and plots; text between backquotes is set as code.
    pub text: Vec<String>,
    /// Figures that matter most, large: name, value with unit.
    pub key_figures: Vec<(String, String)>,
    /// True for a slider over the page's states above the pictures.
    pub slider: bool,
    /// Tables.
    pub tables: Vec<Table>,
    /// Drawings that are no plots, after the plots.
    pub drawings: Vec<Drawing>,
    /// Plots, two beside each other where there is room.
    pub plots: Vec<Plot>,
    /// Paragraphs at the end.
    pub notes: Vec<String>,
}

impl Section {
    /// An empty section.
    pub fn new(heading: &str) -> Self {
        Section {
            heading: heading.to_owned(),
            ..Section::default()
        }
    }

    /// Adds a paragraph.
    pub fn paragraph(mut self, text: impl Into<String>) -> Self {
        self.text.push(text.into());
        self
    }

    /// Adds a table.
    pub fn table(mut self, table: Table) -> Self {
        self.tables.push(table);
        self
    }

    /// Adds a drawing.
    pub fn drawings(mut self, drawings: impl IntoIterator<Item = Drawing>) -> Self {
        self.drawings.extend(drawings);
        self
    }

    /// Puts a slider over the page's states above the pictures.
    pub fn with_slider(mut self) -> Self {
        self.slider = true;
        self
    }

    /// Adds plots.
    pub fn plots(mut self, plots: impl IntoIterator<Item = Plot>) -> Self {
        self.plots.extend(plots);
        self
    }

    /// Adds a paragraph after tables and plots.
    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.notes.push(text.into());
        self
    }
}

impl Page {
    /// All plots, in the order of the page.
    pub fn plots(&self) -> impl Iterator<Item = &Plot> {
        self.sections.iter().flat_map(|section| &section.plots)
    }

    /// All drawings, in the order of the page.
    pub fn drawings(&self) -> impl Iterator<Item = &Drawing> {
        self.sections.iter().flat_map(|section| &section.drawings)
    }

    /// The page as one HTML file.
    pub fn html(&self) -> Result<String, OutputError> {
        let plots: Vec<&Plot> = self.plots().collect();
        let pictures: Result<Vec<String>, OutputError> =
            plots.par_iter().map(|plot| plot.svg()).collect();
        let mut pictures = pictures?.into_iter();
        let title = escape(&self.title);
        let mut out = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n\
             <style>\n{}\n{}</style>\n</head>\n<body>\n<h1>{title}</h1>\n",
            live::STYLE,
            include_str!("style.css"),
        );
        if !self.kicker.is_empty() {
            out.push_str(&format!(
                "<p class=\"kicker\">{}</p>\n",
                prose(&self.kicker)
            ));
        }
        out.push_str(&format!(
            "<p class=\"conclusion\">{}</p>\n",
            prose(&self.conclusion)
        ));
        if self.sections.len() > 2 {
            out.push_str("<nav aria-label=\"Sections\">");
            for (number, section) in self.sections.iter().enumerate() {
                out.push_str(&format!(
                    "<a href=\"#s{number}\">{}</a> ",
                    escape(&section.heading)
                ));
            }
            out.push_str("</nav>\n");
        }
        if !plots.is_empty() {
            out.push_str(HINT);
        }
        let mut chart = 0;
        for (number, section) in self.sections.iter().enumerate() {
            out.push_str(&format!(
                "<section>\n<h2 id=\"s{number}\">{}</h2>\n",
                escape(&section.heading)
            ));
            section.body(&mut out, &self.states, &mut chart, &mut pictures);
            out.push_str("</section>\n");
        }
        if !plots.is_empty() || self.drawings().next().is_some() {
            out.push_str(&live::scripts(&plots, &self.states, self.tooth.as_ref()));
        }
        out.push_str("</body>\n</html>\n");
        Ok(out)
    }

    /// The page as Markdown; plots are left out.
    pub fn markdown(&self) -> String {
        let mut out = format!("# {}\n\n", self.title);
        for line in [&self.kicker, &self.conclusion] {
            if !line.is_empty() {
                out.push_str(&format!("{line}\n\n"));
            }
        }
        for section in &self.sections {
            out.push_str(&format!("## {}\n\n", section.heading));
            for text in &section.text {
                out.push_str(&format!("{text}\n\n"));
            }
            for table in &section.tables {
                out.push_str(&table.markdown());
                out.push('\n');
            }
            for text in &section.notes {
                out.push_str(&format!("{text}\n\n"));
            }
        }
        let kept = out.trim_end().len();
        out.truncate(kept);
        out.push('\n');
        out
    }
}

impl Section {
    /// What stands below the heading; `pictures` are the plots' own, `chart` counts them over the page.
    fn body(
        &self,
        out: &mut String,
        states: &[String],
        chart: &mut usize,
        pictures: &mut impl Iterator<Item = String>,
    ) {
        paragraphs(out, &self.text);
        if !self.key_figures.is_empty() {
            out.push_str("<dl class=\"key\">\n");
            for (name, value) in &self.key_figures {
                out.push_str(&format!(
                    "<div><dt>{}</dt><dd>{}</dd></div>\n",
                    escape(name),
                    escape(value)
                ));
            }
            out.push_str("</dl>\n");
        }
        for table in &self.tables {
            out.push_str(&table.html());
        }
        if self.slider && states.len() > 1 {
            out.push_str(&slider(states));
        }
        if !self.plots.is_empty() || !self.drawings.is_empty() {
            out.push_str("<div class=\"figures\">\n");
            for (plot, svg) in self.plots.iter().zip(pictures) {
                let caption = escape(&plot.title);
                // The declaration of a stand-alone SVG file does not belong inside a page.
                let svg = svg.find("<svg").map_or(svg.as_str(), |at| &svg[at..]);
                out.push_str(&format!(
                    "<figure data-chart=\"{chart}\"><figcaption>{caption}</figcaption>\n<div class=\"still\">{svg}</div></figure>\n"
                ));
                *chart += 1;
            }
            for drawing in &self.drawings {
                out.push_str(&drawing.figure());
            }
            out.push_str("</div>\n");
        }
        paragraphs(out, &self.notes);
    }
}

/// How charts are used.
const HINT: &str = "<p class=\"hint scripts\" hidden>Charts show values under the pointer. Drag across to zoom, double click to go \
                    back, click a name to hide its curve.</p>\n";

/// Moves all pictures of a page through its states; hidden until scripts are there to do so.
fn slider(states: &[String]) -> String {
    let last = states.len() - 1;
    let name = escape(&states[last]);
    format!(
        "<div class=\"slider scripts\" hidden><label>Pinion revolutions <input type=\"range\" min=\"0\" max=\"{last}\" step=\"1\" \
         value=\"{last}\" aria-valuetext=\"{name}\"></label> <output>{name}</output> <button type=\"button\">play</button></div>\n"
    )
}

fn paragraphs(out: &mut String, texts: &[String]) {
    for text in texts {
        out.push_str(&format!("<p>{}</p>\n", prose(text)));
    }
}

/// Escaped text; what stands between backquotes becomes code.
fn prose(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    let paired = parts.len() % 2 == 1;
    parts
        .iter()
        .enumerate()
        .map(|(i, part)| {
            if paired && i % 2 == 1 {
                format!("<code>{}</code>", escape(part))
            } else {
                escape(part)
            }
        })
        .collect::<Vec<_>>()
        .join(if paired { "" } else { "`" })
}
