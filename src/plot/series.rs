//! The series of a run: what was sampled in time, or the residual of an iteration.

use crate::result::quantity as q;
use crate::result::{Axis, Curve, Dash, Figure, Panel, Series};

/// Points of a line: more are no finer on paper.
const DRAWN: usize = 2000;

/// A figure for each column of the series of the run `name` that has something to draw.
#[must_use]
pub fn series_figures(series: &Series, name: &str) -> Vec<Figure> {
    let time = series.get(&q::TIME);
    let (x, along): (Vec<Option<f64>>, _) = match time {
        Some(time) => (time.to_vec(), &q::TIME),
        None => (series.axis().into_iter().map(Some).collect(), &q::ITERATION),
    };
    let every = x.len().div_ceil(DRAWN).max(1);
    let figure = |quantity: &'static q::Quantity| {
        let values = series.get(quantity)?;
        let points: Vec<_> = x.iter().zip(values).step_by(every).map(|(x, y)| (*x).zip(*y)).collect();
        if points.iter().flatten().count() < 3 {
            return None;
        }
        let log = quantity.name == q::RESIDUAL.name;
        let y =
            if log { Axis::log(quantity.title, quantity.unit) } else { Axis::linear(quantity.title, quantity.unit) };
        let curve = Curve { points, line: Some(Dash::Solid), ..Curve::default() };
        Some(Figure {
            stem: format!("series_{}", quantity.name),
            caption: format!("{name}: {} over the {}.", quantity.title, along.title),
            y,
            panels: vec![Panel { x: Axis::linear(along.title, along.unit), curves: vec![curve] }],
            levels: Vec::new(),
            tint_below: None,
        })
    };
    let drawn = series.quantities().filter(|quantity| ![q::TIME.name, q::ITERATION.name].contains(&quantity.name));
    drawn.filter_map(figure).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::result::Scale;

    #[test]
    fn what_is_sampled_is_drawn_over_the_time_and_a_residual_over_iterations() {
        let mut sampled = Series::new(vec![0.0, 1.0, 2.0]).unwrap();
        sampled.push(&q::TIME, vec![Some(0.5), Some(1.0), Some(1.5)]).unwrap();
        sampled.push(&q::RATE_IN_TIME, vec![Some(1e-4), Some(-2e-4), Some(3e-4)]).unwrap();
        sampled.push(&q::LEVEL_IN_TIME, vec![Some(0.1), None, None]).unwrap();
        let figures = series_figures(&sampled, "waves");
        assert_eq!(figures.iter().map(|f| f.stem.as_str()).collect::<Vec<_>>(), ["series_transport_rate_m2_s"]);
        assert_eq!(figures[0].panels[0].curves[0].points[1], Some((1.0, -2e-4)));
        assert_eq!(figures[0].caption, "waves: transport rate over the time.");
        let mut solved = Series::new((1..=9000).map(f64::from).collect()).unwrap();
        solved.push(&q::RESIDUAL, (1..=9000).map(|i| Some(1.0 / f64::from(i))).collect()).unwrap();
        let figures = series_figures(&solved, "bed");
        assert_eq!(figures[0].y.scale, Scale::Log);
        assert_eq!(figures[0].panels[0].curves[0].points.len(), 1800);
    }
}
