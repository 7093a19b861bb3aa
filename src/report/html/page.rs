//! A page: title, conclusion, sections.
use super::escape;
use super::table::Table;
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
}

/// One section.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// Heading.
    pub heading: String,
    /// Paragraphs before the tables and plots; text between backquotes is set as code.
    pub text: Vec<String>,
    /// Tables.
    pub tables: Vec<Table>,
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
    /// The page as one HTML file.
    pub fn html(&self) -> Result<String, OutputError> {
        let mut out = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>\n{}</style>\n\
             </head>\n<body>\n<h1>{}</h1>\n",
            escape(&self.title),
            include_str!("style.css"),
            escape(&self.title)
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
        for (number, section) in self.sections.iter().enumerate() {
            out.push_str(&format!(
                "<section>\n<h2 id=\"s{number}\">{}</h2>\n",
                escape(&section.heading)
            ));
            paragraphs(&mut out, &section.text);
            for table in &section.tables {
                out.push_str(&table.html());
            }
            if !section.plots.is_empty() {
                out.push_str("<div class=\"figures\">\n");
                for plot in &section.plots {
                    let svg = plot.svg()?;
                    let caption = escape(&plot.title);
                    // The declaration of a stand-alone SVG file does not belong inside a page.
                    let svg = svg.find("<svg").map_or(svg.as_str(), |at| &svg[at..]);
                    out.push_str(&format!(
                        "<figure><figcaption>{caption}</figcaption>\n{svg}</figure>\n"
                    ));
                }
                out.push_str("</div>\n");
            }
            paragraphs(&mut out, &section.notes);
            out.push_str("</section>\n");
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
