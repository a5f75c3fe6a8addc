//! Advice on a laminar flow over a bed: closed form or mesh, one velocity or two, constant friction or μ(I_v).

use super::{Advice, Least, Number, Scene, Term, share};
use crate::problem::{Drive, LaminarBed};
use crate::result::quantity as q;
use crate::units::significant;

const CHAUCHAT: &str = "Chauchat & Medale (2010), section 3.2";
/// Carman-Kozeny constant where the case has no drag.
const K_CK: f64 = 180.0;

pub(super) fn advise(scene: &Scene<'_>, bed: &LaminarBed, exact: bool) -> Advice {
    let solved = scene.solve(&[]);
    let result = |name: &str| solved.as_ref().and_then(|results| results.get(name));
    let f = match bed.drive {
        Drive::PressureGradient(fall) => Some(fall * bed.h / bed.stress_scale()),
        Drive::Shields(_) => None,
    };
    let e = bed.viscosity.relative(bed.phi);
    let mut numbers = Vec::new();
    if let Some(theta) = result(q::SHIELDS.name) {
        let says = if theta < 0.09 {
            "below the onset of motion in laminar flow, about 0.12 ± 0.03"
        } else {
            "the bed moves"
        };
        numbers.push(Number { name: "Shields number θ", value: theta, says: says.into() });
    }
    if let Some(u) = result(q::MEAN_VELOCITY.name).or(result(q::U_MAX.name)) {
        let re = bed.rho_f * u * bed.h / bed.eta;
        let says = if re < 1000.0 { "laminar" } else { "not laminar: take sheet-flow or grains" };
        numbers.push(Number { name: "Reynolds number ρ_f U H/η", value: re, says: says.into() });
    }
    let mut terms: Vec<Term> = Vec::new();
    if let Some(f) = f {
        let b = (bed.friction.mu_s * bed.phi - f) / e;
        let depth = 1.0 - bed.h_p / bed.h;
        let y = depth * (-e + (e * e + f / b).sqrt());
        let k_ck = bed.drag.map_or(K_CK, |drag| drag.k_ck);
        let k = (1.0 - bed.phi).powi(3) * (bed.d / bed.h).powi(2) / (k_ck * bed.phi * bed.phi);
        let slip = 2.0 * k * bed.friction.mu_s * bed.phi / (b * y * y);
        if b > 0.0 && y > 0.0 && slip.is_finite() {
            let says = format!("slip over the velocity of the bed: {}", share(slip));
            numbers.push(Number { name: "slip number 2 K μ_s φ/(B Y²)", value: slip, says });
            let layers = y * bed.h / bed.d;
            let says = if layers > 3.0 { "a continuum of many layers" } else { "hardly a continuum: few layers move" };
            numbers.push(Number { name: "mobile layers Y H/d", value: layers, says: says.into() });
        }
    }
    if bed.drag.is_some() {
        let change = ["model.form=mixed", "closures.drag="];
        terms.extend(scene.without("slip between the phases", &change, ("one velocity for both", CHAUCHAT)));
    }
    if !exact {
        let change = ["regularisation.law=none", "regularisation.lambda=", "regularisation.lambda_scaled="];
        if let Some(term) = scene.without("smoothing of the yield", &change, ("the exact yield", CHAUCHAT)) {
            let because = format!("{}, and is no slower", term.because);
            terms.push(Term { keep: false, because, ..term });
        }
    }
    let closed = bed.rise.is_none() && bed.dilatancy.is_none();
    if let Some(rise) = bed.rise {
        let mu_s = format!("closures.friction={{ law = \"coulomb\", mu_s = {} }}", rise_free(bed));
        let source = "Aussillous et al. (2013)";
        terms.extend(scene.without(
            "rise of the friction with the shear rate",
            &[&mu_s, "closures.dilatancy="],
            ("a constant friction", source),
        ));
        numbers.push(Number {
            name: "friction rises by (μ_2 - μ_s)/μ_s",
            value: (rise.mu_2 - bed.friction.mu_s) / bed.friction.mu_s,
            says: "at most".into(),
        });
    }
    let one_velocity = terms.iter().any(|t| t.what == "slip between the phases" && !t.keep) || bed.drag.is_none();
    let form = if one_velocity { "mixed form" } else { "two-fluid form" };
    let least = if closed {
        let template = if one_velocity { "exact_1d_ouriemi_mixed" } else { "exact_1d_ouriemi" };
        let because = format!("constant friction and viscosity have a closed form; {form}");
        let same = exact && (one_velocity == bed.drag.is_none());
        Least { kind: "exact/ouriemi", because, template, overrides: (!same).then(|| values(bed, one_velocity)) }
    } else {
        let because = format!("friction or solid fraction change with the shear rate: no closed form; {form}");
        Least { kind: "laminar", because, template: "laminar_1d_muiv", overrides: None }
    };
    Advice { numbers, least, terms }
}

fn rise_free(bed: &LaminarBed) -> String {
    significant(bed.friction.mu_s, 12)
}

/// The scene in the keys of the closed form.
fn values(bed: &LaminarBed, one_velocity: bool) -> Vec<String> {
    let mut set = vec![
        format!("fluid.density={:?}", bed.rho_f),
        format!("fluid.viscosity={:?}", bed.eta),
        format!("grains.diameter={:?}", bed.d),
        format!("grains.density={:?}", bed.rho_p),
        format!("bed.level={:?}", bed.h_p),
        format!("bed.phi={:?}", bed.phi),
        format!("flow.height={:?}", bed.h),
        format!("flow.gravity={:?}", bed.g),
        format!("closures.friction.mu_s={:?}", bed.friction.mu_s),
    ];
    match bed.drive {
        Drive::PressureGradient(fall) => set.push(format!("flow.pressure_gradient={fall:?}")),
        Drive::Shields(theta) => {
            set.extend([format!("flow.shields={theta:?}"), "flow.pressure_gradient=".into()]);
        }
    }
    if let Some(drag) = bed.drag.filter(|_| !one_velocity) {
        set.push(format!("closures.drag.k_ck={:?}", drag.k_ck));
    }
    set
}
