//! Tables for pages and Markdown.
use super::escape;

/// A table with a header row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// What the table shows; may be empty.
    pub caption: String,
    /// Column heads, units included; empty for a list of names and values.
    pub head: Vec<String>,
    /// Rows of as many cells as the head has.
    pub rows: Vec<Vec<Cell>>,
}

/// Characters beyond which a cell's text is a sentence, and keeps a width that reads well beside columns of numbers.
const SENTENCE: usize = 40;

/// One cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Words, to the left.
    Text(String),
    /// A number already formatted, to the right.
    Number(String),
    /// A file name or other literal.
    Code(String),
    /// A link to a file beside the page: relative path.
    Link(String),
    /// A link to another page: its name, then its relative path without extension, for the page is written as HTML and as Markdown.
    Page(String, String),
    /// A share from 0 to 1 as a bar, with its words.
    Bar(f64, String),
    /// A remark on the row above, across all columns; alone in its row.
    Remark(String),
    /// A verdict: style class (`pass`, `fail`, `skipped`, `theory`) and its word.
    Badge(&'static str, String),
}

impl Table {
    /// An empty table.
    pub fn new<'a>(caption: &str, head: impl IntoIterator<Item = &'a str>) -> Self {
        Table {
            caption: caption.to_owned(),
            head: head.into_iter().map(str::to_owned).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row.
    pub fn row(mut self, cells: impl IntoIterator<Item = Cell>) -> Self {
        self.rows.push(cells.into_iter().collect());
        self
    }

    /// A table of names, values and units; `(name, value with unit)`.
    pub fn of_values<'a>(
        caption: &str,
        values: impl IntoIterator<Item = (&'a str, String)>,
    ) -> Self {
        let mut table = Table::new(caption, []);
        for (name, value) in values {
            table
                .rows
                .push(vec![Cell::Text(name.to_owned()), Cell::Text(value)]);
        }
        table
    }

    /// The table as HTML.
    pub fn html(&self) -> String {
        let mut out = String::from("<div class=\"scroll\"><table>\n");
        if !self.caption.is_empty() {
            out.push_str(&format!("<caption>{}</caption>\n", escape(&self.caption)));
        }
        if !self.head.is_empty() {
            out.push_str("<thead><tr>");
            for (column, name) in self.head.iter().enumerate() {
                let numeric = self
                    .rows
                    .first()
                    .is_some_and(|row| matches!(row.get(column), Some(Cell::Number(_))));
                let class = if numeric { " class=\"n\"" } else { "" };
                out.push_str(&format!("<th scope=\"col\"{class}>{}</th>", escape(name)));
            }
            out.push_str("</tr></thead>\n");
        }
        out.push_str("<tbody>\n");
        for row in &self.rows {
            out.push_str("<tr>");
            for cell in row {
                out.push_str(&cell.html(self.head.len()));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</tbody></table></div>\n");
        out
    }

    /// The table as Markdown.
    pub fn markdown(&self) -> String {
        let columns = self
            .head
            .len()
            .max(self.rows.iter().map(Vec::len).max().unwrap_or(0));
        let mut out = String::new();
        if !self.caption.is_empty() {
            out.push_str(&format!("{}\n\n", self.caption));
        }
        let line = |cells: &mut dyn Iterator<Item = String>| {
            let cells: Vec<String> = cells
                .map(|cell| cell.replace('|', "\\|").replace('\n', " "))
                .collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let head = (0..columns).map(|i| self.head.get(i).cloned().unwrap_or_default());
        out.push_str(&line(&mut head.into_iter()));
        out.push_str(&line(&mut (0..columns).map(|i| {
            let numeric = self
                .rows
                .first()
                .is_some_and(|row| matches!(row.get(i), Some(Cell::Number(_))));
            if numeric {
                "---:".to_owned()
            } else {
                "---".to_owned()
            }
        })));
        for row in &self.rows {
            out.push_str(&line(&mut row.iter().map(Cell::plain)));
        }
        out
    }
}

impl Cell {
    /// Words.
    pub fn text(text: impl Into<String>) -> Self {
        Cell::Text(text.into())
    }

    /// A formatted number.
    pub fn number(number: impl Into<String>) -> Self {
        Cell::Number(number.into())
    }

    /// In a table of so many columns.
    fn html(&self, columns: usize) -> String {
        match self {
            Cell::Remark(text) => format!(
                "<td class=\"remark\" colspan=\"{columns}\">{}</td>",
                escape(text)
            ),
            Cell::Text(text) if text.chars().count() > SENTENCE => {
                format!("<td class=\"sentence\">{}</td>", escape(text))
            }
            Cell::Text(text) => format!("<td>{}</td>", escape(text)),
            Cell::Number(text) => format!("<td class=\"n\">{}</td>", escape(text)),
            Cell::Code(text) => format!("<td><code>{}</code></td>", escape(text)),
            Cell::Link(path) => format!(
                "<td><a href=\"{0}\"><code>{0}</code></a></td>",
                escape(path)
            ),
            Cell::Page(name, path) => format!(
                "<td><a href=\"{}.html\">{}</a></td>",
                escape(path),
                escape(name)
            ),
            Cell::Bar(share, words) => format!(
                "<td><span class=\"bar\" style=\"--share:{:.1}%\">{}</span></td>",
                100.0 * share.clamp(0.0, 1.0),
                escape(words)
            ),
            Cell::Badge(class, word) => format!(
                "<td><span class=\"badge {class}\">{}</span></td>",
                escape(word)
            ),
        }
    }

    fn plain(&self) -> String {
        match self {
            Cell::Text(text) | Cell::Number(text) | Cell::Bar(_, text) | Cell::Remark(text) => {
                text.clone()
            }
            Cell::Code(text) => format!("`{text}`"),
            Cell::Link(path) => format!("[`{path}`]({path})"),
            Cell::Page(name, path) => format!("[`{name}`]({path}.md)"),
            Cell::Badge(_, word) => format!("**{word}**"),
        }
    }
}
