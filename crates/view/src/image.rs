//! A picture in memory, and as PNG.

use crate::Rgb;
use std::path::Path;

/// Rows of pixels, the top row first.
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    width: usize,
    height: usize,
    pixels: Vec<Rgb>,
}

/// Why a picture could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The encoder refused it: no pixels, or too many.
    #[error("a picture of {width} x {height} pixels cannot be a PNG: {source}")]
    Encode {
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
        /// What the encoder said.
        source: png::EncodingError,
    },
    /// The file could not be written.
    #[error("cannot write the picture {path}: {source}")]
    Write {
        /// The file.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
}

impl Image {
    /// A white picture.
    pub fn white(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![[255; 3]; width * height] }
    }
    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }
    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }
    /// The pixel in column `x` and row `y`, both from the top left. Panics out of range.
    pub fn pixel(&self, x: usize, y: usize) -> Rgb {
        assert!(x < self.width && y < self.height, "pixel ({x}, {y}) of a picture of {} x {}", self.width, self.height);
        self.pixels[y * self.width + x]
    }

    /// Copies `tile` to `(x, y)`; what sticks out is lost.
    pub(crate) fn paste(&mut self, tile: &Image, x: usize, y: usize) {
        let columns = tile.width.min(self.width.saturating_sub(x));
        for row in 0..tile.height.min(self.height.saturating_sub(y)) {
            let to = (y + row) * self.width + x;
            let from = row * tile.width;
            self.pixels[to..to + columns].copy_from_slice(&tile.pixels[from..from + columns]);
        }
    }

    /// The picture of half the size whose pixels are means of 2 x 2.
    pub(crate) fn halved(&self) -> Image {
        let (width, height) = (self.width / 2, self.height / 2);
        let mean = |x: usize, y: usize| {
            let i = 2 * y * self.width + 2 * x;
            let block = [i, i + 1, i + self.width, i + self.width + 1].map(|i| self.pixels[i]);
            [0, 1, 2].map(|c| ((block.iter().map(|p| u32::from(p[c])).sum::<u32>() + 2) / 4) as u8)
        };
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| mean(x, y)).collect();
        Image { width, height, pixels }
    }

    /// All pixels, to change.
    pub(crate) fn pixels_mut(&mut self) -> &mut [Rgb] {
        &mut self.pixels
    }

    /// The picture as the bytes of a PNG file, 8 bits a channel.
    pub fn to_png_bytes(&self) -> Result<Vec<u8>, ImageError> {
        self.encode().map_err(|source| ImageError::Encode { width: self.width, height: self.height, source })
    }

    fn encode(&self) -> Result<Vec<u8>, png::EncodingError> {
        // A side beyond 32 bits becomes 0, which the encoder refuses.
        let side = |n: usize| u32::try_from(n).unwrap_or(0);
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, side(self.width), side(self.height));
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        writer.finish()?;
        Ok(bytes)
    }

    /// Writes the picture as a PNG file.
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), ImageError> {
        let path = path.as_ref();
        let bytes = self.to_png_bytes()?;
        std::fs::write(path, bytes).map_err(|source| ImageError::Write { path: path.display().to_string(), source })
    }
}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image of {} x {} pixels", self.width, self.height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_reads_back() {
        let mut image = Image::white(3, 2);
        image.pixels_mut()[4] = [10, 20, 30];
        let bytes = image.to_png_bytes().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(pixels, image.pixels.as_flattened());
    }

    #[test]
    fn what_cannot_be_written_is_an_error() {
        assert!(matches!(Image::white(0, 5).to_png_bytes(), Err(ImageError::Encode { .. })));
        assert!(matches!(Image::white(1, 1).write_png("no/such/folder/a.png"), Err(ImageError::Write { .. })));
    }

    #[test]
    fn halving_takes_means() {
        let mut image = Image::white(2, 2);
        image.pixels_mut()[0] = [0, 100, 255];
        assert_eq!(image.halved().pixel(0, 0), [191, 216, 255]);
    }
}
