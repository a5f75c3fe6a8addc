//! The numbers of a solved duct, in the units of the model.

use super::duct::{Divided, Filling};
use super::element::quadratic;
use super::program::length;
use super::solve::Solution;
use crate::models::exact::bed_results::Maximum;

/// Velocity over the largest one below which material counts as being at rest.
const REST: f64 = 1e-6;
/// Stress over yield stress beyond which it makes no difference.
const LARGE: f64 = 2.0;
/// Missing share of the yield stress from which on grains without viscosity count as standing.
const STANDS: f64 = 1e-6;

/// Numbers in the units of the model.
#[derive(Clone, Debug)]
pub struct Numbers {
    /// integral of the velocity over the section
    pub flow_rate: f64,
    /// mean velocity over the section above the bed, the whole one without a bed
    pub clear: f64,
    /// integral of the velocity of the grains over the bed
    pub grains: f64,
    /// largest velocity, on the symmetry plane
    pub u_max: Maximum,
    /// area that moves without shear
    pub plug: f64,
    /// area at rest
    pub dead: f64,
    /// depth of the moving grains on the symmetry plane
    pub mobile: f64,
    /// fluid stress at the bed level, on the symmetry plane
    pub tau_bed: f64,
    /// share of the elements around a node that do not yield
    pub unyielded: Vec<f64>,
    /// stress over yield stress at the nodes, 2 where it is more or where there is none; not for grains without viscosity,
    /// whose stress is the yield stress wherever they move
    pub stress: Option<Vec<f64>>,
    /// dissipation over the work of the drive, minus 1
    pub power: f64,
}

impl Numbers {
    /// The numbers of a solution.
    #[must_use]
    pub fn of(solution: &Solution) -> Self {
        let divided = &solution.divided;
        let (mesh, x) = (&divided.mesh, &solution.solved.x);
        let (u, w) = (divided.velocity(x), divided.grains(x));
        let u_max = largest(divided, &u);
        let Areas { plug, dead, unyielded, stress } = areas(solution, &w, REST * u_max.value);
        let level = divided.duct.bed().unwrap_or(0.0);
        let moves = divided.integral(&w, 0..mesh.bed_rows) > REST * u_max.value;
        let mobile = match &solution.line {
            Some(line) => level - line[0],
            None if moves => level,
            None => 0.0,
        };
        let above = |u: &[f64]| divided.integral(u, mesh.bed_rows..mesh.rows);
        Self {
            clear: above(&u) / above(&vec![1.0; u.len()]),
            flow_rate: divided.integral(&u, 0..mesh.rows),
            grains: divided.integral(&w, 0..mesh.bed_rows),
            u_max,
            plug,
            dead,
            mobile,
            tau_bed: if mesh.bed_rows > 0 { slope(divided, &u, mesh.bed_rows, -1.0) } else { 0.0 },
            unyielded,
            stress,
            power: power(solution),
        }
    }
}

/// The largest velocity on the symmetry plane: top of the parabola through the largest node and its neighbours.
fn largest(divided: &Divided, u: &[f64]) -> Maximum {
    let mesh = &divided.mesh;
    let (_, up) = mesh.lines();
    let at = |j: usize| (mesh.position(mesh.node(0, j)).1, u[mesh.node(0, j)]);
    let top = (1..up - 1).max_by(|a, b| at(*a).1.total_cmp(&at(*b).1)).unwrap_or(1);
    let ((za, a), (zb, b), (zc, c)) = (at(top - 1), at(top), at(top + 1));
    let (left, right) = ((b - a) / (zb - za), (c - b) / (zc - zb));
    let curvature = (right - left) / (zc - za);
    if curvature >= 0.0 {
        return Maximum { level: zb, value: b };
    }
    let z = (0.5 * (za + zb) - 0.5 * left / curvature).clamp(za, zc);
    Maximum { level: z, value: a + (z - za) * (left + curvature * (z - zb)) }
}

/// Derivative of the velocity along z on the symmetry plane, in row `row`, at `t` in -1..1 of its height.
fn slope(divided: &Divided, u: &[f64], row: usize, t: f64) -> f64 {
    let mesh = &divided.mesh;
    let nodes: [usize; 3] = std::array::from_fn(|k| mesh.node(0, 2 * row + k));
    let (_, d) = quadratic(t);
    let sum = |of: &dyn Fn(usize) -> f64| -> f64 { (0..3).map(|k| d[k] * of(nodes[k])).sum() };
    sum(&|node| u[node]) / sum(&|node| mesh.position(node).1)
}

/// Magnitude of the shear rate of the material, or of the grains in the bed, at the node levels of the symmetry plane: the
/// mean of both sides; undefined above a bed whose grains have their own velocity.
#[must_use]
pub fn shear_rates(divided: &Divided, x: &[f64]) -> Vec<Option<f64>> {
    let mesh = &divided.mesh;
    let grains_only = matches!(divided.duct.filling, Filling::Bed { .. });
    let w = divided.grains(x);
    let rows = if grains_only { mesh.bed_rows } else { mesh.rows };
    (0..mesh.lines().1)
        .map(|j| {
            let row = j / 2;
            match (j % 2, j) {
                (1, _) if row < rows => Some(slope(divided, &w, row, 0.0).abs()),
                (0, 0) => Some(slope(divided, &w, 0, -1.0).abs()),
                (0, _) if row == rows => Some(slope(divided, &w, row - 1, 1.0).abs()),
                (0, _) if row < rows => {
                    let (below, above) = (slope(divided, &w, row - 1, 1.0), slope(divided, &w, row, -1.0));
                    Some(0.5 * (below + above).abs())
                }
                _ => None,
            }
        })
        .collect()
}

/// What does not yield.
struct Areas {
    plug: f64,
    dead: f64,
    unyielded: Vec<f64>,
    stress: Option<Vec<f64>>,
}

/// Areas that do not yield, moving and at rest, the share of the elements around each node that do not, and the mean stress of
/// those elements over their yield stress. An element does not yield where the mean of its stress is below the mean of its
/// yield stress; the stress of single points oscillates.
fn areas(solution: &Solution, w: &[f64], rest: f64) -> Areas {
    let divided = &solution.divided;
    let (program, mesh, solved) = (&divided.program, &divided.mesh, &solution.solved);
    let viscosity = match divided.duct.filling {
        Filling::Bingham(_) => Some(1.0),
        Filling::Bed { e, k: None, .. } => Some(e),
        Filling::Bed { .. } => None,
    };
    let (mut plug, mut dead, mut yielded) = (0.0, 0.0, 0.0);
    let (mut still, mut all, mut ratio) = (vec![0.0; mesh.nodes()], vec![0.0; mesh.nodes()], vec![0.0; mesh.nodes()]);
    for element in 0..mesh.elements() {
        let nodes = mesh.element(element);
        nodes.iter().for_each(|node| all[*node] += 1.0);
        let from = 9 * element;
        let Some(yielding) = program.points.get(from..from + 9) else {
            nodes.iter().for_each(|node| ratio[*node] += LARGE);
            continue;
        };
        let (mut stress, mut yields, mut area) = ([0.0; 2], 0.0, 0.0);
        for (k, point) in yielding.iter().enumerate() {
            let (g, q) = (solved.g[from + k], solved.q[from + k]);
            for d in 0..2 {
                stress[d] += point.carried * q[d] + viscosity.unwrap_or(0.0) * point.weight * g[d];
            }
            yields += point.carried;
            area += 2.0 * point.weight;
        }
        let limit = if viscosity.is_some() { yields } else { (1.0 - STANDS) * yields };
        let here = (length(&stress) / yields).min(LARGE);
        nodes.iter().for_each(|node| ratio[*node] += here);
        if length(&stress) < limit {
            nodes.iter().for_each(|node| still[*node] += 1.0);
            let speed = nodes.iter().map(|node| w[*node].abs()).sum::<f64>() / 9.0;
            *(if speed < rest { &mut dead } else { &mut plug }) += area;
        } else {
            yielded += area;
        }
    }
    // Nothing moves where nothing yields, but for the creep of a regularisation.
    let bingham = matches!(divided.duct.filling, Filling::Bingham(y) if y > 0.0);
    if bingham && (yielded == 0.0 || rest == 0.0) {
        (dead, plug) = (divided.duct.shape.area(), 0.0);
    }
    let mean = |sums: &[f64]| -> Vec<f64> { sums.iter().zip(&all).map(|(s, a)| s / a).collect() };
    Areas { plug, dead, unyielded: mean(&still), stress: viscosity.is_some().then(|| mean(&ratio)) }
}

/// Dissipation over the work of the drive, minus 1; 0 where nothing moves.
fn power(solution: &Solution) -> f64 {
    let (program, solved) = (&solution.divided.program, &solution.solved);
    let mut kx = vec![0.0; program.size()];
    program.pattern.multiply(&program.base, &solved.x, &mut kx);
    let viscous: f64 = kx.iter().zip(&solved.x).map(|(k, x)| k * x).sum();
    let plastic: f64 = (program.points.iter().zip(&solved.g).zip(&solved.q))
        .map(|((p, g), q)| p.carried * g.iter().zip(q).map(|(g, q)| g * q).sum::<f64>())
        .sum();
    let work: f64 = program.load.iter().zip(&solved.x).map(|(b, x)| b * x).sum();
    if work > 0.0 { (viscous + plastic) / work - 1.0 } else { 0.0 }
}
