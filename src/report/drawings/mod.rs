//! Drawings that are no plots: the pair to scale, worn teeth, stresses in the mesh.
mod around;
mod base64;
mod field;
mod flank_map;
mod pair;
mod palette;
mod raster;
mod stress_files;
mod tooth;
mod view;

use super::html::escape;

pub use around::around;
pub use field::stresses;
pub use flank_map::flank_maps;
pub use pair::of_pair;
pub(super) use stress_files::stress_pictures;
pub use tooth::{Worn, worn_teeth};

/// A picture as files have it.
pub(super) struct Picture {
    /// File stem.
    pub(super) name: String,
    /// The document.
    pub(super) svg: String,
    /// The same in pixels.
    pub(super) png: Vec<u8>,
}

/// A drawing of a page.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// File stem; empty for what is no file of its own.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// SVG, its colours as `var(--name,#fallback)`; or, without a file of its own, HTML.
    pub content: String,
    /// Attributes of its figure, for scripts.
    pub attributes: String,
}

impl Drawing {
    /// As a figure of a page.
    pub fn figure(&self) -> String {
        format!(
            "<figure {}><figcaption>{}</figcaption>\n{}</figure>\n",
            self.attributes,
            escape(&self.title),
            self.content
        )
    }

    /// As a file: the fallback colours in place of the page's.
    pub fn svg(&self) -> String {
        let mut out = String::new();
        let mut rest = self.content.as_str();
        while let Some(at) = rest.find("var(") {
            let (before, after) = rest.split_at(at);
            let end = after.find(')').unwrap_or(after.len() - 1);
            let fallback = after[..end].split(',').nth(1).unwrap_or("#000000");
            out.push_str(before);
            out.push_str(fallback);
            rest = &after[end + 1..];
        }
        out + rest
    }
}

/// Opens an SVG element that fills its figure; `size` in pixels is its view box.
fn opened(size: [f64; 2], title: &str) -> String {
    let [width, height] = size;
    let title = escape(title);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{title}\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\"><title>{title}</title>\n"
    )
}

/// A path through points, open.
fn path(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    let mut out = String::new();
    for [x, y] in points {
        out.push(if out.is_empty() { 'M' } else { 'L' });
        out.push_str(&format!("{x:.2} {y:.2}"));
    }
    out
}
