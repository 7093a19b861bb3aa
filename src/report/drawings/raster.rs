//! Triangles and lines to pixels, pixels to PNG.
use crate::report::error::OutputError;

/// Pixels of one byte each, row by row from the top.
pub(super) struct Raster {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) pixels: Vec<u8>,
}

impl Raster {
    pub(super) fn new(width: usize, height: usize) -> Self {
        Raster {
            width,
            height,
            pixels: vec![0; width * height],
        }
    }

    /// Fills the pixels whose centres lie in a triangle with what `level` makes of the value interpolated linearly from its
    /// corners: (x, y, value), pixels from the upper left.
    pub(super) fn triangle(&mut self, corners: [[f64; 3]; 3], level: impl Fn(f64) -> u8) {
        let [a, b, c] = corners;
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if twice == 0.0 {
            return;
        }
        let (columns, rows) = (
            covered(corners.map(|p| p[0]), self.width),
            covered(corners.map(|p| p[1]), self.height),
        );
        for row in rows {
            let y = row as f64 + 0.5;
            for column in columns.clone() {
                let x = column as f64 + 0.5;
                let v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / twice;
                let w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / twice;
                let u = 1.0 - v - w;
                // a hair beyond, so that no pixel falls between two neighbours
                if u >= -1e-9 && v >= -1e-9 && w >= -1e-9 {
                    self.pixels[row * self.width + column] = level(u * a[2] + v * b[2] + w * c[2]);
                }
            }
        }
    }

    /// Draws a line of one pixel's width and of strength 1 to 255, kept where stronger ones are already.
    pub(super) fn line(&mut self, from: [f64; 2], to: [f64; 2], strength: f64) {
        let d = [to[0] - from[0], to[1] - from[1]];
        let length = d[0].hypot(d[1]);
        if length == 0.0 {
            return;
        }
        let widened = |axis: usize| {
            let (a, b) = (from[axis], to[axis]);
            [a.min(b) - 1.0, a.max(b) + 1.0, a]
        };
        let columns = covered(widened(0), self.width);
        for row in covered(widened(1), self.height) {
            for column in columns.clone() {
                let p = [column as f64 + 0.5 - from[0], row as f64 + 0.5 - from[1]];
                let along = ((p[0] * d[0] + p[1] * d[1]) / (length * length)).clamp(0.0, 1.0);
                let away = (p[0] - along * d[0]).hypot(p[1] - along * d[1]);
                let seen = (strength * (1.0 - away).max(0.0)) as u8;
                let pixel = &mut self.pixels[row * self.width + column];
                *pixel = (*pixel).max(seen);
            }
        }
    }

    /// As PNG with a palette of 256 colours, the first transparent.
    pub(super) fn png(&self, colors: &[[u8; 3]]) -> Result<Vec<u8>, OutputError> {
        self.encoded(colors, &[0], png::BitDepth::Eight, &self.pixels)
    }

    /// As PNG in black, the pixels' upper three bits as opacity.
    pub(super) fn shade(&self) -> Result<Vec<u8>, OutputError> {
        let rows = self.pixels.chunks(self.width);
        let packed: Vec<u8> = rows
            .flat_map(|row| row.chunks(2))
            .map(|two| (two[0] >> 5) << 4 | two.get(1).map_or(0, |second| second >> 5))
            .collect();
        let opacity: Vec<u8> = (0..8).map(|level| 36 * level).collect();
        self.encoded(&[[0; 3]; 8], &opacity, png::BitDepth::Four, &packed)
    }

    fn encoded(
        &self,
        colors: &[[u8; 3]],
        opacity: &[u8],
        depth: png::BitDepth,
        packed: &[u8],
    ) -> Result<Vec<u8>, OutputError> {
        let encoding_error = |error: png::EncodingError| OutputError::Plot {
            title: "stresses".to_owned(),
            message: error.to_string(),
        };
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(depth);
        encoder.set_palette(colors.concat());
        encoder.set_trns(opacity.to_vec());
        encoder.set_compression(png::Compression::Balanced);
        encoder.set_filter(png::Filter::NoFilter);
        let mut writer = encoder.write_header().map_err(encoding_error)?;
        writer.write_image_data(packed).map_err(encoding_error)?;
        writer.finish().map_err(encoding_error)?;
        Ok(bytes)
    }
}

/// Pixels whose centres may lie within the values.
fn covered(values: [f64; 3], size: usize) -> std::ops::Range<usize> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let first = (low - 0.5).ceil().max(0.0) as usize;
    let end = (high - 0.5).floor() + 1.0;
    first..(end.max(0.0) as usize).min(size)
}

#[cfg(test)]
mod tests {
    use super::Raster;

    /// Two triangles of a square share an edge: every pixel inside is filled, with the plane's value at its centre.
    #[test]
    fn a_plane_over_a_square() {
        let mut raster = Raster::new(20, 20);
        let corner = |x: f64, y: f64| [x, y, 3.0 * x + 2.0 * y];
        let (a, b, c, d) = (
            corner(2.0, 2.0),
            corner(18.0, 2.0),
            corner(18.0, 18.0),
            corner(2.0, 18.0),
        );
        raster.triangle([a, b, c], |v| v as u8);
        raster.triangle([a, c, d], |v| v as u8);
        for row in 0..20 {
            for column in 0..20 {
                let inside = (2..18).contains(&row) && (2..18).contains(&column);
                let value = 3.0 * (column as f64 + 0.5) + 2.0 * (row as f64 + 0.5);
                let found = raster.pixels[row * 20 + column];
                if inside {
                    // the value is a half, which rounding may take either way
                    assert!((f64::from(found) - value).abs() <= 1.0, "{row} {column}");
                } else {
                    assert_eq!(found, 0, "{row} {column}");
                }
            }
        }
    }
}
