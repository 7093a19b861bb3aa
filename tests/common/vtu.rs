//! Reads compressed appended arrays of a `.vtu` file, knowing nothing of how this program writes them (VTK XML formats).
#![allow(dead_code, reason = "no test uses all of it")]

use std::collections::BTreeMap;
use std::io::Read;

/// Arrays by section and name, all as doubles.
pub(crate) struct Grid(BTreeMap<String, Vec<f64>>);

impl Grid {
    /// The grid in a file's bytes.
    pub(crate) fn read(bytes: &[u8]) -> Self {
        let begin = b"<AppendedData encoding=\"raw\">";
        let at = bytes.windows(begin.len()).position(|w| w == begin).unwrap();
        let head = std::str::from_utf8(&bytes[..at]).unwrap();
        assert!(head.contains("vtkZLibDataCompressor") && head.contains("header_type=\"UInt64\""));
        assert!(head.contains("byte_order=\"LittleEndian\""));
        let data = &bytes[at + bytes[at..].iter().position(|&b| b == b'_').unwrap() + 1..];
        let mut arrays = BTreeMap::new();
        let mut section = "";
        for tag in head.split('<').skip(1) {
            let name = tag.split([' ', '>']).next().unwrap();
            if ["PointData", "CellData", "Points", "Cells"].contains(&name) {
                section = name;
            }
            if name == "DataArray" {
                let part = |key: &str| {
                    let after = tag.split_once(&format!("{key}=\"")).unwrap().1;
                    after.split('"').next().unwrap()
                };
                let offset: usize = part("offset").parse().unwrap();
                let values = numbers(part("type"), &inflated(&data[offset..]));
                arrays.insert(format!("{section}/{}", part("Name")), values);
            }
        }
        Self(arrays)
    }

    /// `PointData/stress`, `Cells/connectivity` and so on.
    pub(crate) fn array(&self, name: &str) -> Vec<f64> {
        let found = self.0.get(name);
        found.unwrap_or_else(|| panic!("no array {name}")).clone()
    }
}

fn inflated(data: &[u8]) -> Vec<u8> {
    let number = |i: usize| u64::from_le_bytes(data[8 * i..8 * i + 8].try_into().unwrap()) as usize;
    let [blocks, block, last] = [0, 1, 2].map(number);
    let mut from = 8 * (3 + blocks);
    let mut all = Vec::new();
    for i in 0..blocks {
        let before = all.len();
        let stream = &data[from..from + number(3 + i)];
        flate2::read::ZlibDecoder::new(stream)
            .read_to_end(&mut all)
            .unwrap();
        let expected = if i + 1 == blocks && last > 0 {
            last
        } else {
            block
        };
        assert_eq!(all.len() - before, expected);
        from += number(3 + i);
    }
    all
}

fn numbers(kind: &str, bytes: &[u8]) -> Vec<f64> {
    match kind {
        "Float64" => bytes
            .chunks(8)
            .map(|b| f64::from_le_bytes(b.try_into().unwrap()))
            .collect(),
        "Float32" => bytes
            .chunks(4)
            .map(|b| f32::from_le_bytes(b.try_into().unwrap()).into())
            .collect(),
        "Int32" => bytes
            .chunks(4)
            .map(|b| i32::from_le_bytes(b.try_into().unwrap()).into())
            .collect(),
        "UInt8" => bytes.iter().map(|&b| b.into()).collect(),
        other => panic!("unexpected type {other}"),
    }
}
