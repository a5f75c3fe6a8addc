//! A figure as PNG: drawn larger than needed and averaged, since plotters does not smooth wide lines.

use std::path::Path;

use plotters::prelude::{BitMapBackend, DrawingBackend, IntoDrawingArea};
use plotters::style::WHITE;

use super::canvas::{LINE_HEIGHT, Medium};
use super::draw::draw;
use super::layout::Layout;
use super::{PlotError, theme};
use crate::result::Figure;

/// Width of the file \[pixels].
pub(super) const WIDTH: u32 = 1600;
/// Pixels drawn per pixel written, in each direction.
pub(super) const FINER: u32 = 3;

/// Writes `figure` in the light theme as a PNG file 1600 pixels wide; `path` ends in `.png`.
///
/// # Errors
/// [`PlotError::Write`] if the file cannot be written, else as [`super::svg()`].
pub fn png(figure: &Figure, path: &Path) -> Result<(), PlotError> {
    let layout = Layout::new(figure)?;
    let height = (f64::from(WIDTH) * layout.size.1 / layout.size.0).ceil() as u32;
    let scale = f64::from(WIDTH * FINER) / layout.size.0;
    // plotters puts the base line half a line height below the top of a text
    let medium = Medium { scale, ascent: LINE_HEIGHT / 2.0, dashes_later: false, paint: theme::light };
    let fine_size = (WIDTH * FINER, height * FINER);
    let mut fine = vec![0; 3 * fine_size.0 as usize * fine_size.1 as usize];
    {
        let area = BitMapBackend::with_buffer(&mut fine, fine_size).into_drawing_area();
        area.fill(&WHITE).map_err(PlotError::drawing)?;
        draw(&area, medium, figure, &layout)?;
        area.present().map_err(PlotError::drawing)?;
    }
    let small = averaged(&fine, fine_size.0 as usize, FINER as usize);
    drop(fine);
    let failed = |message: String| PlotError::Write { path: path.into(), message };
    let mut file = BitMapBackend::new(path, (WIDTH, height));
    file.blit_bitmap((0, 0), (WIDTH, height), &small).map_err(|e| failed(e.to_string()))?;
    file.present().map_err(|e| failed(e.to_string()))
}

/// Means over squares of `n` by `n` pixels of three bytes, of an image `width` pixels wide.
pub(super) fn averaged(fine: &[u8], width: usize, n: usize) -> Vec<u8> {
    let mut sums = vec![0_u32; 3 * (width / n)];
    let mut small = Vec::with_capacity(fine.len() / (n * n));
    for band in fine.chunks_exact(3 * width * n) {
        sums.fill(0);
        for row in band.chunks_exact(3 * width) {
            for (sum, square) in sums.chunks_exact_mut(3).zip(row.chunks_exact(3 * n)) {
                for pixel in square.chunks_exact(3) {
                    for (s, &byte) in sum.iter_mut().zip(pixel) {
                        *s += u32::from(byte);
                    }
                }
            }
        }
        let count = (n * n) as u32;
        small.extend(sums.iter().map(|s| ((s + count / 2) / count) as u8));
    }
    small
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn the_file_has_the_promised_width_and_a_failure_names_its_path() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figure.png");
        png(&samples::convergence(), &path).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        assert_eq!(&bytes[1..4], b"PNG");
        let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!(number(16), 1600);
        assert!((1000..1600).contains(&number(20)), "{}", number(20));
        let missing = folder.path().join("missing").join("figure.png");
        let error = png(&samples::convergence(), &missing).unwrap_err();
        assert!(matches!(&error, PlotError::Write { path, .. } if *path == missing), "{error}");
    }

    #[test]
    fn pixels_are_averaged_by_square() {
        let row = [0, 0, 0, 9, 18, 27, 90, 90, 90, 90, 90, 90];
        assert_eq!(averaged(&[row, row].concat(), 4, 2), [5, 9, 14, 90, 90, 90]);
    }
}
