//! A map of a section: velocity in colour, the outline of what does not yield, the bed level.

use std::collections::BTreeMap;

use super::map::{MapPanel, Place, Trail};
use crate::result::{Axis, Dash, Field};

/// Most tiles along one direction.
const TILES: usize = 64;

/// A grid of nodes with a velocity, and a measure that is above 0.5 where the material does not yield.
pub(super) struct Grid {
    across: usize,
    pub places: Vec<Place>,
    pub speed: Vec<f64>,
    still: Vec<f64>,
    /// velocity along both axes
    vectors: Option<(Vec<f64>, Vec<f64>)>,
}

/// The map of a field with u_mixture_m_s or speed_m_s, and unyielded, as a panel, in millimetres where the section is small, the velocity in
/// units of `speed` [m/s]; `symmetric` adds the other half of the section, `bed` \[m] draws a level. None if there is nothing to draw.
#[must_use]
pub fn section_map(field: &Field, symmetric: bool, bed: Option<f64>, (title, speed): (&str, f64)) -> Option<MapPanel> {
    let grid = Grid::of(field)?;
    let high = |of: &dyn Fn(&Place) -> f64| grid.places.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let (right, top) = (high(&|p| p.0), high(&|p| p.1));
    let (unit, scale) = if top < 0.5 { ("mm", 1e3) } else { ("m", 1.0) };
    let sides: &[f64] = if symmetric { &[1.0, -1.0] } else { &[1.0] };
    let left = if symmetric { -right } else { 0.0 };
    let axis =
        |name: &str, low: f64, high: f64| Axis { ends: Some((scale * low, scale * high)), ..Axis::linear(name, unit) };
    let at = |side: f64, (y, z): Place| (side * scale * y, scale * z);
    let both = |points: &[Place], dash: Dash, bold: bool| -> Vec<Trail> {
        let mirrored = |side: &f64| points.iter().map(|p| at(*side, *p)).collect();
        sides.iter().map(|side| Trail { points: mirrored(side), dash, bold }).collect()
    };
    let mut trails: Vec<Trail> = joined(grid.outline()).iter().flat_map(|l| both(l, Dash::Solid, true)).collect();
    if let Some(level) = bed {
        let ends = grid.places.iter().filter(|p| (p.1 - level).abs() < 1e-9 * top).fold(0.0, |m: f64, p| m.max(p.0));
        trails.extend(both(&[(0.0, level), (ends, level)], Dash::Dashed, false));
    }
    let corner = |side: f64, n: usize| (at(side, grid.places[n]), grid.speed[n] / speed);
    let mut triangles = Vec::new();
    for side in sides {
        triangles.extend(grid.triangles().map(|nodes| nodes.map(|n| corner(*side, n))));
    }
    Some(MapPanel {
        title: title.into(),
        x: axis("y", left, right),
        y: axis("z", 0.0, top),
        triangles,
        arrows: grid.arrows().into_iter().map(|(a, b)| (at(1.0, a), at(1.0, b))).collect(),
        trails,
    })
}

/// Pieces of lines, joined where they meet.
fn joined(pieces: Vec<(Place, Place)>) -> Vec<Vec<Place>> {
    let key = |p: Place| (p.0.to_bits(), p.1.to_bits());
    let mut ends: BTreeMap<(u64, u64), Vec<usize>> = BTreeMap::new();
    for (k, (a, b)) in pieces.iter().enumerate().filter(|(_, (a, b))| a != b) {
        ends.entry(key(*a)).or_default().push(k);
        ends.entry(key(*b)).or_default().push(k);
    }
    let mut used = vec![false; pieces.len()];
    let mut lines = Vec::new();
    // Lines with a loose end first, rings after them.
    let loose = |k: usize| [pieces[k].0, pieces[k].1].iter().any(|p| ends.get(&key(*p)).is_none_or(|e| e.len() == 1));
    let order = (0..pieces.len()).filter(|k| loose(*k)).chain(0..pieces.len());
    for k in order {
        if used[k] || pieces[k].0 == pieces[k].1 {
            continue;
        }
        used[k] = true;
        let (mut a, mut b) = pieces[k];
        if ends.get(&key(b)).is_none_or(|e| e.len() == 1) {
            (a, b) = (b, a);
        }
        let mut line = vec![a, b];
        while let Some(next) = ends.get(&key(b)).and_then(|e| e.iter().find(|k| !used[**k])) {
            used[*next] = true;
            let (c, d) = pieces[*next];
            b = if c == b { d } else { c };
            line.push(b);
        }
        lines.push(line);
    }
    lines
}

impl Grid {
    /// Two triangles of nodes in each tile of the grid.
    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let across = self.across;
        (0..self.up() - 1).flat_map(move |j| {
            (0..across - 1).flat_map(move |i| {
                let n = j * across + i;
                [[n, n + 1, n + across + 1], [n, n + across + 1, n + across]]
            })
        })
    }

    /// Velocities on a coarse raster, each with its middle where it is taken, the longest nearly as long as the meshes are wide:
    /// none reaches its neighbour or the wall.
    fn arrows(&self) -> Vec<(Place, Place)> {
        const RASTER: usize = 16;
        let Some((u, w)) = &self.vectors else { return Vec::new() };
        let ends = self.places.iter().fold((0.0_f64, 0.0_f64), |(y, z), p| (y.max(p.0), z.max(p.1)));
        let raster = |high: f64| (0..RASTER).map(move |k| high * (k as f64 + 0.5) / RASTER as f64);
        let places: Vec<Place> = raster(ends.1).flat_map(|z| raster(ends.0).map(move |y| (y, z))).collect();
        let found = places.iter().filter_map(|&place| Some((place, (self.at(u, place)?, self.at(w, place)?))));
        let found: Vec<(Place, Place)> = found.collect();
        let most = found.iter().fold(0.0_f64, |m, (_, (u, w))| m.max(u.hypot(*w)));
        let half = 0.5 * 0.95 * ends.0.min(ends.1) / (RASTER as f64 * most);
        let arrow = |((y, z), (u, w)): (Place, Place)| ((y - half * u, z - half * w), (y + half * u, z + half * w));
        found.into_iter().map(arrow).collect()
    }

    /// A field between the nodes of straight lines, bilinear.
    fn at(&self, values: &[f64], (y, z): Place) -> Option<f64> {
        let columns: Vec<f64> = self.places[..self.across].iter().map(|p| p.0).collect();
        let rows: Vec<f64> = self.places.iter().step_by(self.across).map(|p| p.1).collect();
        let between = |lines: &[f64], x: f64| {
            let i = lines.partition_point(|line| *line <= x).checked_sub(1)?.min(lines.len().checked_sub(2)?);
            Some((i, (x - lines[i]) / (lines[i + 1] - lines[i])))
        };
        let ((i, s), (j, t)) = (between(&columns, y)?, between(&rows, z)?);
        let along = |j: usize| {
            let n = j * self.across + i;
            values[n] + s * (values[n + 1] - values[n])
        };
        Some(along(j) + t * (along(j + 1) - along(j)))
    }

    pub fn of(field: &Field) -> Option<Self> {
        let across = field.across;
        let speed = field.get("u_mixture_m_s").or_else(|| field.get("speed_m_s"))?.to_vec();
        let whole = across > 2 && speed.len() > 2 * across && speed.len().is_multiple_of(across);
        // The stress is smooth where the share of elements makes steps.
        let still = match field.get("stress_over_yield") {
            Some(stress) => stress.iter().map(|s| 1.5 - s).collect(),
            None => field.get("unyielded")?.to_vec(),
        };
        let vectors = field.get("u_m_s").zip(field.get("w_m_s")).map(|(u, w)| (u.to_vec(), w.to_vec()));
        whole.then(|| Self { across, places: field.places.clone(), speed, still, vectors })
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
    pub fn tiles(&self) -> Vec<([(f64, f64); 4], f64)> {
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
    pub fn outline(&self) -> Vec<(Place, Place)> {
        const HALF: f64 = 0.5;
        let mut pieces = Vec::new();
        for [a, b, c] in self.triangles() {
            let crossing = |a: usize, b: usize| {
                // One order of both ends, so that neighbours find the same place.
                let (a, b) = (a.min(b), a.max(b));
                let (fa, fb) = (self.still[a] - HALF, self.still[b] - HALF);
                ((fa < 0.0) != (fb < 0.0)).then(|| {
                    let t = fa / (fa - fb);
                    let (p, q) = (self.places[a], self.places[b]);
                    (p.0 + t * (q.0 - p.0), p.1 + t * (q.1 - p.1))
                })
            };
            let ends: Vec<Place> = [crossing(a, b), crossing(b, c), crossing(c, a)].into_iter().flatten().collect();
            if let [from, to] = ends[..] {
                pieces.push((from, to));
            }
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_are_of_the_field_and_reach_neither_each_other_nor_the_wall() {
        // u = z, w = -y on uneven lines.
        let (y, z) = ([0.0, 0.1, 0.5, 1.0], [0.0, 0.7, 1.0]);
        let places: Vec<Place> = z.iter().flat_map(|&z| y.iter().map(move |&y| (y, z))).collect();
        let of = |value: &dyn Fn(&Place) -> f64| places.iter().map(value).collect::<Vec<f64>>();
        let columns = vec![
            ("speed_m_s".into(), of(&|p| p.0.hypot(p.1))),
            ("unyielded".into(), of(&|_| 0.0)),
            ("u_m_s".into(), of(&|p| p.1)),
            ("w_m_s".into(), of(&|p| -p.0)),
        ];
        let field = Field { across: 4, up: 3, places: places.clone(), columns };
        let arrows = Grid::of(&field).unwrap().arrows();
        assert_eq!(arrows.len(), 256);
        let long = arrows.iter().map(|(a, b)| (b.0 - a.0).hypot(b.1 - a.1)).fold(0.0, f64::max);
        assert!((long - 0.95 / 16.0).abs() < 1e-12, "{long}");
        for (a, b) in &arrows {
            let middle = (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1));
            assert!(((b.0 - a.0) * middle.0 + (b.1 - a.1) * middle.1).abs() < 1e-12, "normal to the radius");
            assert!([a.0, a.1, b.0, b.1].iter().all(|x| (0.0..=1.0).contains(x)));
        }
    }
}
