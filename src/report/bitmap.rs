//! PNG beside SVG, the same on every machine: the font is in the program.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use super::error::OutputError;

/// Pixels for one of the SVG file.
const SCALE: usize = 2;
/// DejaVu Sans 2.37: Latin, Greek, Cyrillic and what formulas need; its licence stands beside it.
const FONT: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    Arc::new(fonts)
});

/// The drawing on white.
///
/// # Errors
/// [`OutputError::Plot`] if it is no SVG document.
pub(super) fn of_svg(name: &str, svg: &str) -> Result<Vec<u8>, OutputError> {
    over(name, svg, SCALE, |_, _| {})
}

/// The drawing, `scale` pixels for one of the SVG file, over what `under` paints: width of the picture in pixels, its opaque
/// RGBA bytes, white at first.
///
/// # Errors
/// [`OutputError::Plot`] if it is no SVG document.
pub(super) fn over(
    name: &str,
    svg: &str,
    scale: usize,
    under: impl FnOnce(usize, &mut [u8]),
) -> Result<Vec<u8>, OutputError> {
    let failed = |message: String| OutputError::Plot {
        title: name.to_owned(),
        message,
    };
    let options = Options {
        font_family: "DejaVu Sans".to_owned(),
        fontdb: FONTS.clone(),
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|error| failed(error.to_string()))?;
    let size = tree.size().to_int_size();
    let pixels = |length: u32| length * scale as u32;
    let mut picture = Pixmap::new(pixels(size.width()), pixels(size.height()))
        .ok_or_else(|| failed("it has no size".to_owned()))?;
    picture.fill(Color::WHITE);
    under(picture.width() as usize, picture.data_mut());
    resvg::render(
        &tree,
        Transform::from_scale(scale as f32, scale as f32),
        &mut picture.as_mut(),
    );
    encoded(&picture).map_err(|error| failed(error.to_string()))
}

/// An opaque picture as a PNG file: three bytes for a pixel, compressed by the fastest means that still makes small files of drawings.
fn encoded(picture: &Pixmap) -> Result<Vec<u8>, png::EncodingError> {
    let opaque = picture.data().as_chunks::<4>().0.iter();
    let colors: Vec<u8> = opaque.flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    encoder.write_header()?.write_image_data(&colors)?;
    Ok(bytes)
}
