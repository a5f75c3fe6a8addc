//! Figures 3, 8 and 9: flows between planes that have a closed form.

use bedload::closures::regularisation::{Regularisation, Smoothing};
use bedload::model::{OnMesh, Solve, read};
use bedload::models::exact::bed::LaminarBed;
use bedload::models::exact::ouriemi;
use bedload::models::section::{Contents, Duct, DuctFlow, Method, Outline, SectionMethod};
use bedload::result::{Axis, Context, Dash, Level, Marker, Panel, quantity as q};

use super::{DASHED, Fallible, SOLID, column, curve, draw};

/// Both definitions of the error at the nodes: the root of the mean square, and the paper's, which divides by the number of
/// nodes outside the root.
fn errors(found: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    let (sum, count) = found.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + (a - b).powi(2), n + 1.0));
    let sum: f64 = sum;
    ((sum / count).sqrt(), sum.sqrt() / count)
}

const HOW: SectionMethod =
    SectionMethod { method: Method::Newton, yield_row: true, finest: 1.0, tolerance: 1e-8, iterations: 20_000 };

/// Nodes of the symmetry plane in the units of the model: height, velocity of the mixture, velocity of the grains.
fn solve(flow: &DuctFlow, rows: usize, law: Regularisation, yield_row: bool) -> Fallible<Vec<(f64, f64, f64)>> {
    let flow = DuctFlow { regularisation: law, solver: SectionMethod { yield_row, ..HOW }, ..*flow };
    let duct = Duct(OnMesh { problem: flow, cells: rows });
    // By itself: on the coarsest and finest meshes its balances do not close well enough for a run.
    let run = Context::quiet(|context| duct.solve(context)).map_err(|failure| failure.error.to_string())?;
    let profile = run.profile.ok_or("no profile")?;
    let unit = flow.shear_scale() * flow.h;
    let (u, w) = (column(&profile, &q::U_MIXTURE), column(&profile, &q::U_PARTICLE));
    let scaled = |column: &[Option<f64>], j: usize| column.get(j).copied().flatten().unwrap_or_default() / unit;
    Ok(profile.axis().iter().enumerate().map(|(j, z)| (z / flow.h, scaled(&u, j), scaled(&w, j))).collect())
}

fn simple(lambda: f64) -> Regularisation {
    Regularisation { law: Smoothing::Simple, lambda }
}

/// A flow between planes under a fall of pressure [Pa/m]: over a bed as high as the bed says, or 1 m high.
fn between(gradient: f64, contents: Contents) -> DuctFlow {
    let h = if let Contents::Bed(bed) = &contents { bed.h } else { 1.0 };
    let (outline, regularisation, solver) = (Outline::Planes, Regularisation::EXACT, HOW);
    DuctFlow { outline, h, gradient, contents, regularisation, solver, along: None }
}

/// A fluid of unit density and viscosity with the yield stress `tau_0` [Pa].
fn bingham(tau_0: f64) -> Contents {
    Contents::Bingham { rho: 1.0, eta: 1.0, tau_0 }
}

/// Bingham fluid between planes, unit drive and viscosity: yield stress of a Bingham number on the mean velocity, and profile.
struct BinghamPlanes {
    y: f64,
}

impl BinghamPlanes {
    fn new(bn: f64) -> Self {
        let (mut low, mut high) = (0.0, 0.5);
        for _ in 0..200 {
            let y = 0.5 * (low + high);
            *(if y / (Self { y }).mean() < bn { &mut low } else { &mut high }) = y;
        }
        Self { y: 0.5 * (low + high) }
    }
    /// Sheared layers of thickness a = 1/2 - y at both planes, a plug between them.
    fn mean(&self) -> f64 {
        let a = 0.5 - self.y;
        0.5 * a * a * (1.0 - 2.0 * a) + 2.0 * a.powi(3) / 3.0
    }
    fn velocity(&self, z: f64) -> f64 {
        let (a, from_wall) = (0.5 - self.y, z.min(1.0 - z));
        if from_wall >= a { 0.5 * a * a } else { from_wall * (a - 0.5 * from_wall) }
    }
}

const MESHES: [usize; 6] = [10, 20, 40, 80, 160, 320];

/// Figure 3: profiles and error of a Bingham fluid between planes, Bn 10.
pub fn figure_3() -> Fallible<()> {
    let planes = BinghamPlanes::new(10.0);
    let duct = between(1.0, bingham(planes.y));
    let unit = planes.mean();
    let exact = (0..=400).map(|k| f64::from(k) / 400.0).map(|z| (planes.velocity(z) / unit, z)).collect();
    let mut profiles = vec![curve("closed form", 0, SOLID, exact)];
    // lambda in units of the mean velocity over the height
    let lambda = 1e-4 * unit;
    let laws: [(&str, Regularisation, usize); 3] = [
        ("exact yield", Regularisation::EXACT, 1),
        ("λ = 1e-4", simple(lambda), 2),
        ("λ = 1e-6", simple(1e-2 * lambda), 3),
    ];
    let mut curves = Vec::new();
    println!("| elements | law | RMS error/mean velocity | the paper's definition |\n|---|---|---|---|");
    for (name, law, colour) in laws {
        let (mut rms, mut paper) = (Vec::new(), Vec::new());
        for rows in MESHES {
            let nodes = solve(&duct, rows, law, false)?;
            let (a, b) = errors(nodes.iter().map(|(z, u, _)| (u / unit, planes.velocity(*z) / unit)));
            println!("| {rows} | {name} | {a:.3e} | {b:.3e} |");
            let h = 1.0 / rows as f64;
            rms.push((h, a));
            paper.push((h, b));
            if colour == 2 && rows <= 20 {
                let marker = if rows == 10 { Marker::Circle } else { Marker::Triangle };
                let points = nodes.iter().map(|(z, u, _)| (u / unit, *z)).collect();
                profiles.push(curve(&format!("{rows} elements, λ = 1e-4"), rows / 10, (None, Some(marker)), points));
            }
        }
        let marker = [Marker::Circle, Marker::Square, Marker::Triangle][colour - 1];
        curves.push(curve(&format!("{name}, RMS"), colour, (Some(Dash::Solid), Some(marker)), rms));
        if colour == 2 {
            curves.push(curve(&format!("{name}, the paper's RMS"), colour, (Some(Dash::Dotted), None), paper));
        }
    }
    // The yield surface on a corner of elements: the closed form is a parabola and a constant in each of them.
    let fitted = between(1.0, bingham(0.3));
    let known = BinghamPlanes { y: 0.3 };
    let row = |rows: usize| -> Fallible<(f64, f64)> {
        let nodes = solve(&fitted, rows, Regularisation::EXACT, false)?;
        Ok((
            1.0 / rows as f64,
            errors(nodes.iter().map(|(z, u, _)| (u / known.mean(), known.velocity(*z) / known.mean()))).0,
        ))
    };
    curves.push(curve(
        "yield surface on an element's side",
        0,
        (Some(Dash::Dashed), Some(Marker::Circle)),
        MESHES.into_iter().map(row).collect::<Fallible<_>>()?,
    ));
    let slope = |x: f64| (x, 3e-1 * x.powi(3));
    curves.push(curve("order 3", 0, DASHED, vec![slope(0.1), slope(1.0 / 320.0)]));
    let velocity = Axis::linear("velocity over its mean", "1");
    let panel = Panel { x: velocity, curves: profiles };
    draw(
        "section_bingham_planes",
        "Bingham fluid between two planes, Bn = 10: elements and closed form (figure 3a of the paper)",
        Axis { ends: Some((0.0, 1.0)), ..Axis::linear("height z/H", "1") },
        vec![panel],
        Vec::new(),
        None,
    )?;
    let panel = Panel { x: Axis::log("height of the elements over H", "1"), curves };
    draw(
        "section_bingham_order",
        "Error at the nodes against the size of the elements, by law, with both definitions (figure 3b of the paper)",
        Axis::log("error over the mean velocity", "1"),
        vec![panel],
        Vec::new(),
        None,
    )
}

/// The bed of section 3.2 of the paper, in both forms, with its closed form.
fn planes_bed(slips: bool) -> Fallible<(DuctFlow, ouriemi::Solution)> {
    let case = if slips { "bed_ouriemi-laminar-exact" } else { "exact_1d_ouriemi_mixed" };
    let bed = read::<OnMesh<LaminarBed>>(case, &[]).map_err(|e| e.render(false))?.problem;
    let exact = ouriemi::solve(&bed, |_| {}).map_err(|e| e.to_string())?;
    Ok((between(F * bed.stress_scale() / bed.h, Contents::Bed(bed)), exact))
}

/// Drive of the bed, -dp/dx/((rho_p - rho_f) g).
const F: f64 = 0.1;
const PHI: f64 = 0.55;
const LEVEL: f64 = 0.5;

/// Velocity of the fluid from that of the mixture and of the grains.
fn fluid(z: f64, u: f64, w: f64) -> f64 {
    if z <= LEVEL { (u - PHI * w) / (1.0 - PHI) } else { u }
}

/// Figure 8: profiles over a bed between planes, 40 rows, lambda 1e-6, against the closed form.
pub fn figure_8() -> Fallible<()> {
    let z = |n: i32| (0..=n).map(move |k| f64::from(k) / f64::from(n));
    let mut panels = Vec::new();
    for slips in [true, false] {
        let (duct, exact) = planes_bed(slips)?;
        let nodes = solve(&duct, 40, simple(1e-6), false)?;
        let mut curves = Vec::new();
        let line = |of: &dyn Fn(f64) -> f64| z(600).map(|z| (of(z), z)).collect::<Vec<_>>();
        let below = |points: Vec<(f64, f64)>| points.into_iter().filter(|p| p.1 <= LEVEL).collect::<Vec<_>>();
        if slips {
            let f = |z: f64| fluid(z, exact.mixture(z), if z <= LEVEL { exact.particle(z) } else { 0.0 });
            curves.push(curve("closed form", 0, SOLID, line(&f)));
            curves.push(curve("", 0, SOLID, below(line(&|z| exact.particle(z.min(LEVEL))))));
            let points = nodes.iter().map(|(z, u, w)| (fluid(*z, *u, *w), *z)).collect();
            curves.push(curve("fluid", 1, (None, Some(Marker::Circle)), points));
            let points = below(nodes.iter().map(|(z, _, w)| (*w, *z)).collect());
            curves.push(curve("grains", 2, (None, Some(Marker::Square)), points));
        } else {
            curves.push(curve("closed form", 0, SOLID, line(&|z| exact.mixture(z))));
            let points = nodes.iter().map(|(z, u, _)| (*u, *z)).collect();
            curves.push(curve("mixture", 3, (None, Some(Marker::Triangle)), points));
        }
        panels.push(Panel { x: Axis::linear("velocity η/(Δρ g H²)", "1"), curves });
    }
    draw(
        "section_planes_bed",
        "Fluid over a bed between planes, 40 rows of elements, λ = 1e-6: (a) two-fluid, (b) mixed form (figure 8 of the paper)",
        Axis { ends: Some((0.0, 1.0)), ..Axis::linear("height z/H", "1") },
        panels,
        vec![Level { y: LEVEL, label: "bed level".into() }],
        Some(LEVEL),
    )
}

/// Figure 9: error over a bed between planes against the mesh, both forms, regularised and exact.
pub fn figure_9() -> Fallible<()> {
    let rows = [10, 20, 40, 80, 160, 320];
    let mut panels = Vec::new();
    for paper in [false, true] {
        let mut curves = Vec::new();
        let mut add = |name: &str, slips: bool, law: Regularisation, row: bool, grains: bool, style| -> Fallible<()> {
            let (duct, exact) = planes_bed(slips)?;
            let mut points = Vec::new();
            for n in rows {
                let nodes = solve(&duct, n, law, row)?;
                let pairs = nodes.iter().filter(|n| !grains || n.0 <= LEVEL).map(|(z, u, w)| {
                    let known = if grains { exact.particle(*z) } else { exact.mixture(*z) };
                    (if grains { *w } else { *u }, known)
                });
                let (rms, theirs) = errors(pairs);
                points.push((1.0 / n as f64, if paper { theirs } else { rms }));
            }
            let (colour, dash, marker) = style;
            curves.push(curve(name, colour, (Some(dash), Some(marker)), points));
            Ok(())
        };
        add("grains, two-fluid (1e-6)", true, simple(1e-6), false, true, (1, Dash::Solid, Marker::Circle))?;
        add("mixture, two-fluid (1e-6)", true, simple(1e-6), false, false, (1, Dash::Dashed, Marker::Square))?;
        add("mixture, mixed (1e-6)", false, simple(1e-6), false, false, (2, Dash::Solid, Marker::Triangle))?;
        add("mixture, mixed (1e-7)", false, simple(1e-7), false, false, (2, Dash::Dashed, Marker::Triangle))?;
        add("mixture, exact yield", false, Regularisation::EXACT, false, false, (3, Dash::Solid, Marker::Circle))?;
        add(
            "the same, row on the surface",
            false,
            Regularisation::EXACT,
            true,
            false,
            (3, Dash::Dotted, Marker::Square),
        )?;
        let title = if paper { "element height/H, the paper's RMS" } else { "element height/H, true RMS" };
        panels.push(Panel { x: Axis { ends: Some((2e-3, 0.15)), ..Axis::log(title, "1") }, curves });
    }
    draw(
        "section_planes_error",
        "Error over a bed between planes against the mesh: (a) root of the mean square, (b) the definition of the paper (figure 9)",
        Axis::log("error, velocity η/(Δρ g H²)", "1"),
        panels,
        Vec::new(),
        None,
    )
}
