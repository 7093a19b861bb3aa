//! The XML of an unstructured grid with compressed arrays behind it.
//!
//! ```text
//! <VTKFile ... compressor="vtkZLibDataCompressor" header_type="UInt64">     names, types and offsets of the arrays
//! <AppendedData encoding="raw">_ array array ...                            each: [blocks][block][last][sizes ...] zlib streams
//! ```
//! `block` bytes go into each stream before compression, `last` into the last one, 0 where that is full (VTK XML formats, "appended"
//! data). Written here because the library's own compressed files hold an empty block too many where the last one is full, and its arrays
//! stand inline in base 64, a third larger.
use std::fmt::Write as _;
use std::io::Write as _;

use flate2::{Compression, write::ZlibEncoder};

/// Bytes in each zlib stream before compression.
const BLOCK: usize = 1 << 18;

/// A kind of number that an array holds.
pub(super) trait Scalar: Copy {
    /// VTK's name of it.
    const NAME: &'static str;
    /// Appends its bytes, the least significant first.
    fn push(self, bytes: &mut Vec<u8>);
}

macro_rules! scalar {
    ($($kind:ty => $name:literal),+) => {
        $(impl Scalar for $kind {
            const NAME: &'static str = $name;
            fn push(self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }
        })+
    };
}

scalar!(f64 => "Float64", f32 => "Float32", u8 => "UInt8", i32 => "Int32");

/// An unstructured grid in the making: sections in the order point data, cell data, points, cells.
pub(super) struct Grid {
    head: String,
    data: Vec<u8>,
}

impl Grid {
    /// A grid of so many nodes and cells.
    pub(super) fn new(nodes: usize, cells: usize) -> Self {
        let head = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n\
             <Piece NumberOfPoints=\"{nodes}\" NumberOfCells=\"{cells}\">\n"
        );
        Self {
            head,
            data: Vec::new(),
        }
    }

    /// One section with its arrays.
    pub(super) fn section(&mut self, name: &str, arrays: impl FnOnce(&mut Self)) {
        let _ = writeln!(self.head, "<{name}>");
        arrays(self);
        let _ = writeln!(self.head, "</{name}>");
    }

    /// One array of `components` numbers for each node or cell.
    pub(super) fn array<T: Scalar>(&mut self, name: &str, components: usize, values: &[T]) {
        let _ = writeln!(
            self.head,
            "<DataArray type=\"{}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{}\"/>",
            T::NAME,
            self.data.len()
        );
        let mut bytes = Vec::with_capacity(size_of_val(values));
        for value in values {
            value.push(&mut bytes);
        }
        self.append(&bytes);
    }

    fn append(&mut self, bytes: &[u8]) {
        let streams: Vec<Vec<u8>> = bytes.chunks(BLOCK).map(compressed).collect();
        let last = bytes.len() % BLOCK;
        let sizes = streams.iter().map(Vec::len);
        for number in [streams.len(), BLOCK, last].into_iter().chain(sizes) {
            self.data.extend((number as u64).to_le_bytes());
        }
        self.data.extend(streams.concat());
    }

    /// The bytes of the file.
    pub(super) fn finish(self) -> Vec<u8> {
        let mut bytes = self.head.into_bytes();
        bytes.extend(b"</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
        bytes.extend(self.data);
        bytes.extend(b"\n</AppendedData>\n</VTKFile>\n");
        bytes
    }
}

/// Quickly compressed: more effort saves one per cent of measured fields.
fn compressed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder
        .write_all(bytes)
        .and_then(|()| encoder.finish())
        .unwrap_or_else(|_| unreachable!("writing to memory does not fail"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    /// Blocks that are full, the last one too, and none at all.
    #[test]
    fn arrays_come_back_whatever_their_length() {
        for length in [0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK] {
            let values: Vec<u8> = (0..length).map(|i| (i % 251) as u8).collect();
            let mut grid = Grid::new(0, 0);
            grid.array("a", 1, &values);
            let number = |at: usize| {
                let bytes = grid.data[8 * at..8 * at + 8].try_into().unwrap();
                u64::from_le_bytes(bytes) as usize
            };
            let [blocks, block, last] = [0, 1, 2].map(number);
            let full = blocks - usize::from(last > 0);
            assert_eq!(full * block + last, length);
            let mut from = 8 * (3 + blocks);
            let mut read = Vec::new();
            for i in 0..blocks {
                let stream = &grid.data[from..from + number(3 + i)];
                flate2::read::ZlibDecoder::new(stream)
                    .read_to_end(&mut read)
                    .unwrap();
                from += number(3 + i);
            }
            assert_eq!(from, grid.data.len());
            assert_eq!(read, values);
        }
    }
}
