//! A map of a section: velocity in colour, what does not yield hatched by its outline, the bed level.

use std::fmt::Write;
use std::io::BufRead;

use super::grains::{colour, scale_bar};
use crate::result::{Values, read_columns};

/// Width or height of the picture, whichever is larger [px].
const SIZE: f64 = 560.0;
/// Most tiles along one direction.
const TILES: usize = 64;

/// A grid of nodes with a velocity and the share that does not yield.
struct Grid {
    across: usize,
    places: Vec<(f64, f64)>,
    speed: Vec<f64>,
    still: Vec<f64>,
}

/// The map from the columns column, row, y_m, z_m, u_mixture_m_s or speed_m_s, unyielded; `symmetric` adds the other half of
/// the section, `bed` [m] draws a level. None if there is nothing to draw.
#[must_use]
pub fn section_svg(table: impl BufRead, symmetric: bool, bed: Option<f64>) -> Option<String> {
    let grid = Grid::read(&read_columns(table).ok()?)?;
    let high = |of: &dyn Fn(&(f64, f64)) -> f64| grid.places.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let (right, top) = (high(&|p| p.0), high(&|p| p.1));
    let left = if symmetric { -right } else { 0.0 };
    let fast = grid.speed.iter().copied().fold(0.0, f64::max);
    if !(right > left && top > 0.0 && fast.is_finite()) {
        return None;
    }
    let scale = SIZE / (right - left).max(top);
    let (width, height) = (scale * (right - left), scale * top);
    let sides: &[f64] = if symmetric { &[1.0, -1.0] } else { &[1.0] };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.1} {:.1}\" role=\"img\" \
         aria-label=\"velocity in the section, with the outline of what does not yield\">\n",
        height + 30.0
    );
    let at = |side: f64, p: (f64, f64)| (scale * (side * p.0 - left), scale * (top - p.1));
    for (corners, speed) in grid.tiles() {
        for side in sides {
            let points: Vec<String> =
                corners.iter().map(|p| at(*side, *p)).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
            let fill = colour(if fast > 0.0 { speed / fast } else { 0.0 });
            let _ = writeln!(svg, "<polygon points=\"{}\" fill=\"{fill}\" stroke=\"{fill}\"/>", points.join(" "));
        }
    }
    let mut outline = String::new();
    for (a, b) in grid.outline() {
        for side in sides {
            let ((x0, y0), (x1, y1)) = (at(*side, a), at(*side, b));
            let _ = write!(outline, "M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}");
        }
    }
    let _ = writeln!(svg, "<path d=\"{outline}\" fill=\"none\" stroke=\"#fff\" stroke-width=\"2\"/>");
    if let Some(level) = bed {
        let y = scale * (top - level);
        let _ = writeln!(
            svg,
            "<path d=\"M0 {y:.1}H{width:.1}\" stroke=\"#e0e0e0\" stroke-width=\"1\" stroke-dasharray=\"6 4\"/>"
        );
    }
    svg += &scale_bar(width, height, (0.0, fast), "");
    Some(svg + "</svg>\n")
}

impl Grid {
    fn read(columns: &[(String, Values)]) -> Option<Self> {
        let column = |name: &str| -> Option<Vec<f64>> {
            columns.iter().find(|(n, _)| n == name)?.1.iter().copied().collect::<Option<Vec<f64>>>()
        };
        let (column_of, y, z) = (column("column")?, column("y_m")?, column("z_m")?);
        let speed = column("u_mixture_m_s").or_else(|| column("speed_m_s"))?;
        let across = column_of.iter().skip(1).position(|i| *i == 0.0)? + 1;
        let whole = speed.len().is_multiple_of(across) && across > 2 && speed.len() > 2 * across;
        let still = column("unyielded")?;
        whole.then(|| Self { across, places: y.into_iter().zip(z).collect(), speed, still })
    }

    fn up(&self) -> usize {
        self.speed.len() / self.across
    }

    /// Lines of nodes that bound the tiles along one direction.
    fn lines(n: usize) -> Vec<usize> {
        let step = (n - 1).div_ceil(TILES).max(1);
        let mut lines: Vec<usize> = (0..n).step_by(step).collect();
        if lines.last() != Some(&(n - 1)) {
            lines.push(n - 1);
        }
        lines
    }

    /// Corners and mean velocity of each tile.
    fn tiles(&self) -> Vec<([(f64, f64); 4], f64)> {
        let (columns, rows) = (Self::lines(self.across), Self::lines(self.up()));
        let mut tiles = Vec::new();
        for j in rows.windows(2) {
            for i in columns.windows(2) {
                let nodes = [(i[0], j[0]), (i[1], j[0]), (i[1], j[1]), (i[0], j[1])].map(|(i, j)| j * self.across + i);
                tiles.push((nodes.map(|n| self.places[n]), nodes.iter().map(|n| self.speed[*n]).sum::<f64>() / 4.0));
            }
        }
        tiles
    }

    /// Pieces of the line on which half of what is around does not yield: along the sides of triangles of nodes.
    fn outline(&self) -> Vec<((f64, f64), (f64, f64))> {
        const HALF: f64 = 0.5;
        let mut pieces = Vec::new();
        for j in 0..self.up() - 1 {
            for i in 0..self.across - 1 {
                let n = j * self.across + i;
                for triangle in [[n, n + 1, n + self.across + 1], [n, n + self.across + 1, n + self.across]] {
                    let crossing = |a: usize, b: usize| {
                        let (fa, fb) = (self.still[a] - HALF, self.still[b] - HALF);
                        ((fa < 0.0) != (fb < 0.0)).then(|| {
                            let t = fa / (fa - fb);
                            let (p, q) = (self.places[a], self.places[b]);
                            (p.0 + t * (q.0 - p.0), p.1 + t * (q.1 - p.1))
                        })
                    };
                    let [a, b, c] = triangle;
                    let ends: Vec<(f64, f64)> =
                        [crossing(a, b), crossing(b, c), crossing(c, a)].into_iter().flatten().collect();
                    if let [from, to] = ends[..] {
                        pieces.push((from, to));
                    }
                }
            }
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_of_both_halves_an_outline_and_nothing_from_nothing() {
        let mut table = String::from("column,row,y_m,z_m,u_mixture_m_s,unyielded\n");
        for j in 0..3 {
            for i in 0..3 {
                let _ = writeln!(table, "{i},{j},{i},{j},{},{}", i + j, u8::from(j == 0));
            }
        }
        let svg = section_svg(table.as_bytes(), true, Some(1.0)).unwrap();
        assert_eq!(svg.matches("<polygon").count(), 8);
        assert!(svg.contains("M") && svg.contains("stroke-dasharray"));
        let outline = Grid::read(&read_columns(table.as_bytes()).unwrap()).unwrap().outline();
        assert!(!outline.is_empty() && outline.iter().all(|(a, b)| a.1 == 0.5 && b.1 == 0.5), "{outline:?}");
        assert!(section_svg("column,row,y_m,z_m\n".as_bytes(), true, None).is_none());
    }
}
