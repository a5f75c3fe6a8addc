//! Ducts and cavity: closed forms, agreement of the methods, and a second solver, a cone program.

mod cavity;
mod cone;
mod ducts;
mod whole;

use crate::case::CaseError;
use crate::model::Checked;
use crate::models::builtin;
use crate::models::section::program::{Program, length};
use crate::result::{Context, Outcome};

impl<const D: usize, const N: usize> Program<D, N> {
    /// `x K x/2 - b x + sum t |B x + c|`, with the rates of strain `g` of `x`.
    fn value(&self, x: &[f64], g: &[[f64; D]]) -> f64 {
        let mut kx = vec![0.0; self.size()];
        self.pattern.multiply(&self.base, x, &mut kx);
        let smooth: f64 = (0..x.len()).map(|i| x[i] * (0.5 * kx[i] - self.load[i])).sum();
        smooth + self.points.iter().zip(g).map(|(p, g)| p.carried * length(g)).sum::<f64>()
    }
}

fn load(case: &str, set: &[&str]) -> Result<Checked, CaseError> {
    builtin().load(case, &set.iter().map(|&change| change.to_owned()).collect::<Vec<_>>())
}

fn run(case: &str, set: &[&str]) -> Outcome {
    Context::quiet(|context| load(case, set).unwrap().1.run(context)).unwrap()
}
