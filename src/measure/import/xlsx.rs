//! Sheets of an Office Open XML workbook (.xlsx): a zip archive of XML parts.
//!
//! ```text
//! xl/workbook.xml (names, r:id) -> xl/_rels/workbook.xml.rels (r:id -> part) -> the sheet's cells; texts in xl/sharedStrings.xml
//! ```
//! ECMA-376-1, 18.2 (workbook), 18.3 (worksheets), 18.4 (shared strings); the archive by PKWARE's APPNOTE 6.3, 4.3. Values are what the
//! spreadsheet last computed; numbers that it shows as dates are read as these (`dates`). Encrypted and split archives are not read.

mod dates;

use std::collections::BTreeMap;
use std::io::Read;

use flate2::read::DeflateDecoder;
use roxmltree::{Document, Node};

use self::dates::Dates;
use super::Sheet;

/// Largest part that is unpacked, bytes: a wide table has a thousandth of it.
const LARGEST_PART: u64 = 256 << 20;

/// Largest number of rows and columns of a spreadsheet.
const LARGEST: [usize; 2] = [1 << 20, 1 << 14];

type Result<T> = std::result::Result<T, String>;

/// The sheets of a workbook, in its order.
pub(super) fn sheets(bytes: &[u8]) -> Result<Vec<Sheet>> {
    let archive = Archive::open(bytes)?;
    let workbook = archive.text("xl/workbook.xml")?;
    let links = archive.text("xl/_rels/workbook.xml.rels")?;
    let (workbook, links) = (parsed(&workbook)?, parsed(&links)?);
    let shared = match archive.part("xl/sharedStrings.xml") {
        Some(_) => shared_texts(&archive.text("xl/sharedStrings.xml")?)?,
        None => Vec::new(),
    };
    let dates = match archive.part("xl/styles.xml") {
        Some(_) => Dates::of(&parsed(&archive.text("xl/styles.xml")?)?, &workbook),
        None => Dates::default(),
    };
    let targets: BTreeMap<&str, &str> = elements(links.root(), "Relationship")
        .filter_map(|link| Some((link.attribute("Id")?, link.attribute("Target")?)))
        .collect();
    let sheets = elements(workbook.root(), "sheet").map(|sheet| {
        let id = sheet
            .attributes()
            .find(|a| a.name() == "id" && a.namespace().is_some());
        let target = id.and_then(|id| targets.get(id.value()));
        let target = target.ok_or("a sheet has no part of its own")?;
        let path = match target.strip_prefix('/') {
            Some(absolute) => absolute.to_owned(),
            None => format!("xl/{target}"),
        };
        let text = archive.text(&path)?;
        let cells = parsed(&text)?;
        Ok(Sheet {
            name: sheet.attribute("name").unwrap_or_default().to_owned(),
            rows: rows(&cells, &shared, &dates)?,
            without_result: without_result(&cells),
            plain_decimals: true,
            said: Vec::new(),
        })
    });
    sheets.collect()
}

fn parsed(text: &str) -> Result<Document<'_>> {
    Document::parse(text).map_err(|error| format!("not valid XML: {error}"))
}

fn elements<'a, 'i: 'a>(
    node: Node<'a, 'i>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'i>> {
    node.descendants()
        .filter(move |n| n.tag_name().name() == name)
}

/// A text, of several runs or one; phonetic runs left out.
fn words(node: Node<'_, '_>) -> String {
    let texts = elements(node, "t").filter(|t| t.ancestors().all(|a| a.tag_name().name() != "rPh"));
    texts.filter_map(|t| t.text()).collect()
}

fn shared_texts(text: &str) -> Result<Vec<String>> {
    Ok(elements(parsed(text)?.root(), "si").map(words).collect())
}

fn rows(sheet: &Document<'_>, shared: &[String], dates: &Dates) -> Result<Vec<Vec<String>>> {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for row in elements(sheet.root(), "row") {
        // rows and cells may leave their place unsaid: then they follow the one before
        let at = match row.attribute("r").map(str::parse::<usize>) {
            Some(Ok(number)) if (1..=LARGEST[0]).contains(&number) => number - 1,
            None => rows.len(),
            _ => return Err("a row has no valid number".to_owned()),
        };
        let mut cells: Vec<String> = Vec::new();
        for cell in elements(row, "c") {
            let column = match cell.attribute("r") {
                Some(name) => column(name).ok_or("a cell has no valid name")?,
                None => cells.len(),
            };
            if cells.len() <= column {
                cells.resize(column + 1, String::new());
            }
            cells[column] = value(cell, shared, dates)?;
        }
        if rows.len() <= at {
            rows.resize(at + 1, Vec::new());
        }
        rows[at] = cells;
    }
    Ok(rows)
}

/// The first cell with a formula whose result is not stored: programs that write workbooks without computing them leave it out. An empty
/// text is a result.
fn without_result(sheet: &Document<'_>) -> Option<String> {
    let child = |cell: &Node<'_, '_>, name: &str| {
        let found = cell.children().find(|n| n.tag_name().name() == name);
        found.map(|n| n.text().unwrap_or_default().trim().to_owned())
    };
    let lacks_result = |cell: &Node<'_, '_>| {
        cell.attribute("t") != Some("str")
            && child(cell, "f").is_some()
            && child(cell, "v").is_none_or(|result| result.is_empty())
    };
    let found = elements(sheet.root(), "c").find(lacks_result)?;
    Some(found.attribute("r").unwrap_or("a cell").to_owned())
}

fn value(cell: Node<'_, '_>, shared: &[String], dates: &Dates) -> Result<String> {
    let written = || {
        let v = cell.children().find(|n| n.tag_name().name() == "v");
        v.and_then(|v| v.text()).unwrap_or_default().trim()
    };
    Ok(match cell.attribute("t") {
        Some("s") => {
            let text = written()
                .parse::<usize>()
                .ok()
                .and_then(|at| shared.get(at));
            text.ok_or("a cell names a text that is not there")?
                .trim()
                .to_owned()
        }
        Some("inlineStr") => words(cell).trim().to_owned(),
        // 26.5 may stand there as 26.499999999999996: numbers by their shortest digits
        None | Some("n") => written().parse::<f64>().map_or_else(
            |_| written().to_owned(),
            |number| (dates.shown(cell, number)).unwrap_or_else(|| number.to_string()),
        ),
        _ => written().to_owned(),
    })
}

/// The column of a cell's name, counted from 0: 27 of `AB12`.
fn column(name: &str) -> Option<usize> {
    let letters = name.bytes().take_while(u8::is_ascii_uppercase);
    let number = letters.fold(0usize, |n, b| {
        n.saturating_mul(26) + usize::from(b - b'A') + 1
    });
    (1..=LARGEST[1]).contains(&number).then(|| number - 1)
}

/// The parts of a zip archive: name, method, packed bytes.
struct Archive<'b> {
    parts: BTreeMap<String, (u16, &'b [u8])>,
}

impl<'b> Archive<'b> {
    fn open(bytes: &'b [u8]) -> Result<Self> {
        let broken = || "it is no .xlsx workbook (no valid zip archive)".to_owned();
        let two = |at: usize| Some(u16::from_le_bytes(bytes.get(at..at + 2)?.try_into().ok()?));
        let four = |at: usize| Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
        // the end record stands last, before a comment of at most 65535 bytes
        let from = bytes.len().saturating_sub(22 + 65_535);
        let end = (from..bytes.len().saturating_sub(21))
            .rev()
            .find(|&at| four(at) == Some(0x0605_4b50))
            .ok_or_else(broken)?;
        let read = || -> Option<BTreeMap<String, (u16, &'b [u8])>> {
            let count = two(end + 10)?;
            let mut at = four(end + 16)? as usize;
            let mut parts = BTreeMap::new();
            for _ in 0..count {
                (four(at)? == 0x0201_4b50).then_some(())?;
                let (method, packed) = (two(at + 10)?, four(at + 20)? as usize);
                let [name, extra, comment] = [28, 30, 32].map(|i| two(at + i).map(usize::from));
                let (name, extra, comment) = (name?, extra?, comment?);
                let local = four(at + 42)? as usize;
                let title =
                    String::from_utf8_lossy(bytes.get(at + 46..at + 46 + name)?).into_owned();
                // the local header's own extra field may have another length
                let data =
                    local + 30 + usize::from(two(local + 26)?) + usize::from(two(local + 28)?);
                parts.insert(title, (method, bytes.get(data..data.checked_add(packed)?)?));
                at += 46 + name + extra + comment;
            }
            Some(parts)
        };
        Ok(Self {
            parts: read().ok_or_else(broken)?,
        })
    }

    fn part(&self, name: &str) -> Option<&(u16, &'b [u8])> {
        self.parts.get(name)
    }

    /// A part as text.
    fn text(&self, name: &str) -> Result<String> {
        let &(method, packed) = self
            .part(name)
            .ok_or_else(|| format!("it has no part {name}"))?;
        let mut text = String::new();
        let unpacked = match method {
            0 => packed.take(LARGEST_PART).read_to_string(&mut text),
            8 => DeflateDecoder::new(packed)
                .take(LARGEST_PART)
                .read_to_string(&mut text),
            other => return Err(format!("{name} is packed by the method {other}")),
        };
        unpacked.map_err(|error| format!("{name}: {error}"))?;
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_counted_in_letters() {
        assert_eq!(
            ["A1", "Z3", "AB12", "XFD1"].map(column),
            [Some(0), Some(25), Some(27), Some(16_383)]
        );
        assert_eq!([column("12"), column("AAAA1"), column("")], [None; 3]);
    }

    #[test]
    fn formulas_without_a_stored_result_are_found() {
        let found = |cells: &str| {
            let text =
                format!("<worksheet><sheetData><row r='2'>{cells}</row></sheetData></worksheet>");
            without_result(&parsed(&text).unwrap())
        };
        for none in ["<c r='C2'><f>B2*2</f><v/></c>", "<c r='C2'><f>B2*2</f></c>"] {
            assert_eq!(found(none).as_deref(), Some("C2"), "{none}");
        }
        for stored in [
            "<c r='C2'><f>B2*2</f><v>4</v></c>",
            "<c r='C2' t='str'><f>\"\"</f><v/></c>",
            "<c r='C2'><v>4</v></c>",
        ] {
            assert_eq!(found(stored), None, "{stored}");
        }
    }

    #[test]
    fn what_is_no_workbook_is_refused() {
        for bytes in [&b""[..], b"PK", b"test,member\n", &[0u8; 100]] {
            assert!(sheets(bytes).is_err());
        }
    }
}
