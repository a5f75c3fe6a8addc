//! Random flows that are valid.

use crate::scene_text::Value::{self, Number, Slope, Word};
use crate::scene_text::{
    DENSITY, DISCHARGE, Drawn, GRADIENT, GRAVITY, HEAT, LENGTH, NONE, RATE, STRESS, VELOCITY, VISCOSITY,
};

/// Numbers from 0 to 1, taken one after the other.
pub struct Draw<'a>(pub std::slice::Iter<'a, f64>);

impl Draw<'_> {
    fn unit(&mut self) -> f64 {
        *self.0.next().unwrap()
    }

    /// Between two numbers, evenly.
    fn even(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Between two numbers, evenly in their logarithm.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    /// One of some.
    fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[((self.unit() * of.len() as f64) as usize).min(of.len() - 1)]
    }

    fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    /// A flow of any kind.
    pub fn flow(&mut self) -> Drawn {
        match self.even(0.0, 20.0) as usize {
            0..8 => self.open(),
            8..10 => self.lid(),
            10..15 => self.planes(),
            15 => self.narrow(),
            16..18 => self.channel(),
            18 => self.benchmark(),
            _ => self.granular(),
        }
    }

    /// Fluid, grains and bed under turbulent flow: diameter, stress scale, density of the fluid, and that of the grains over it less 1.
    fn bed(&mut self, values: &mut Vec<(&'static str, Value)>) -> (f64, f64, f64, f64) {
        let (rho, d, g) = (self.log(500.0, 2000.0), self.log(2e-4, 1e-2), self.log(1.0, 30.0));
        let (nu, s) = (self.log(1e-7, 4e-6), 1.0 + self.log(0.05, 3.0));
        values.extend([
            ("fluid.density", Number(rho, DENSITY)),
            ("fluid.viscosity", Number(rho * nu, VISCOSITY)),
            ("grains.diameter", Number(d, LENGTH)),
            ("grains.density", Number(rho * s, DENSITY)),
            ("flow.gravity", Number(g, GRAVITY)),
            ("bed.thickness", Number(d * self.even(15.0, 40.0), LENGTH)),
        ]);
        if self.chance(0.5) {
            values.push(("bed.phi", Number(self.even(0.58, 0.6), NONE)));
        }
        if self.chance(0.5) {
            values.push(("grains.restitution", Number(self.even(0.4, 0.9), NONE)));
            values.push(("grains.friction", Number(self.even(0.2, 0.8), NONE)));
        }
        (d, (s - 1.0) * rho * g * d, rho, s - 1.0)
    }

    /// A free surface; two of depth, slope and stress.
    fn open(&mut self) -> Drawn {
        let mut values = Vec::new();
        let (d, stress, rho, excess) = self.bed(&mut values);
        let theta = self.log(0.3, 1.2);
        // Not so steep that no bed rests.
        let depth = self.log(8.0, 100.0).max(theta * excess / 0.06);
        let angle = (theta * excess / depth).asin();
        if self.chance(0.3) {
            values.push(("grains.settling_velocity", Number((stress / rho).sqrt() * self.log(0.3, 2.0), VELOCITY)));
        }
        let (depth, slope) = (("flow.depth", Number(d * depth, LENGTH)), ("flow.slope", Slope(angle)));
        let shields = ("flow.shields", Number(theta, NONE));
        let u_star = ("flow.u_star", Number((theta * stress / rho).sqrt(), VELOCITY));
        values.extend(match self.even(0.0, 5.0) as usize {
            0 => [depth, slope],
            1 => [depth, shields],
            2 => [depth, u_star],
            3 => [slope, shields],
            _ => [slope, u_star],
        });
        let granular = self.one(&["\"frictional-collisional\"", "\"garzo-dufty\""]);
        let two_fluid = vec![
            ("closures.granular", Word(granular)),
            ("grid.cells", Word("60")),
            // What the paper gives in Pa belongs to its grains, and the small numbers have a dimension, too.
            ("closures.elastic.law", Word("\"johnson-jackson\"")),
            ("closures.elastic.p_0", Number(self.log(2e-4, 2e-3) * stress, STRESS)),
            ("regularisation.granular_temperature", Number(1e-7 * stress / rho, HEAT)),
            ("regularisation.shear_rate", Number(1e-7 * (stress / rho).sqrt() / d, RATE)),
        ];
        let models = vec![("sheet-flow", self.sheet()), ("two-fluid", two_fluid), ("coupled", Vec::new())];
        Drawn { kind: "bed", values, models }
    }

    fn sheet(&mut self) -> Vec<(&'static str, Value)> {
        let suspension = self.one(&["\"rouse\"", "\"none\""]);
        vec![("closures.suspension", Word(suspension)), ("grid.cells", Word("300"))]
    }

    /// Under a lid.
    fn lid(&mut self) -> Drawn {
        let mut values = Vec::new();
        let (d, stress, rho, excess) = self.bed(&mut values);
        let (theta, depth) = (self.log(0.5, 2.0), self.log(15.0, 60.0));
        let angle = (theta * self.even(1.3, 2.5) * excess / depth).min(0.06).asin();
        let shields = ("flow.shields", Number(theta, NONE));
        let u_star = ("flow.u_star", Number((theta * stress / rho).sqrt(), VELOCITY));
        let slope = ("flow.slope", Slope(angle));
        values.push(("flow.depth", Number(d * depth, LENGTH)));
        match self.even(0.0, 3.0) as usize {
            0 => values.extend([
                ("flow.top", Word("\"solved\"")),
                slope,
                if self.chance(0.5) { shields } else { u_star },
            ]),
            1 => values.extend([
                ("flow.top.law", Word("\"stress\"")),
                ("flow.top.stress", Number(0.3 * theta * stress, STRESS)),
                slope,
            ]),
            _ => values.extend([("flow.top", Word("{ law = \"colebrook-white\" }")), shields]),
        }
        Drawn { kind: "bed", values, models: vec![("sheet-flow", self.sheet())] }
    }

    /// Between side walls, which one model alone has.
    fn narrow(&mut self) -> Drawn {
        let mut drawn = self.open();
        let d = drawn.values.iter().find_map(|(key, value)| match value {
            Number(d, _) if *key == "grains.diameter" => Some(*d),
            _ => None,
        });
        drawn.values.push(("flow.width", Number(d.unwrap() * self.log(1.1, 20.0), LENGTH)));
        let wall = self.one(&["\"none\"", "\"graf-altinakar\"", "\"blasius\""]);
        drawn.models = vec![("coupled", vec![("closures.side_wall", Word(wall))])];
        drawn
    }

    /// Laminar flow between planes or in a section.
    fn planes(&mut self) -> Drawn {
        let (rho, d, g) = (self.log(500.0, 2000.0), self.log(2e-4, 1e-2), self.log(1.0, 30.0));
        let (eta, s) = (self.log(0.05, 2.0), 1.0 + self.log(0.05, 3.0));
        let (height, share) = (d * self.log(15.0, 60.0), self.even(0.3, 0.7));
        let (weight, gap) = ((s - 1.0) * rho * g, height * (1.0 - share));
        let gradient = weight * self.log(0.03, 0.15);
        let (tau, discharge) = (0.5 * gradient * gap, gradient * gap.powi(3) / (12.0 * eta));
        let mut values = vec![
            ("fluid.density", Number(rho, DENSITY)),
            ("fluid.viscosity", Number(eta, VISCOSITY)),
            ("grains.diameter", Number(d, LENGTH)),
            ("grains.density", Number(rho * s, DENSITY)),
            ("flow.gravity", Number(g, GRAVITY)),
            ("bed.thickness", Number(height * share, LENGTH)),
            ("bed.phi", Number(self.even(0.54, 0.62), NONE)),
            ("flow.depth", Number(gap, LENGTH)),
            ("flow.top", Word("\"plane\"")),
        ];
        let section = self.chance(0.2);
        let drive = if section { 0 } else { self.even(0.0, 6.0) as usize };
        values.push(match drive {
            1 => ("flow.discharge", Number(discharge, DISCHARGE)),
            2 => ("flow.mean_velocity", Number(discharge / height, VELOCITY)),
            3 => ("flow.shields", Number(tau / (weight * d), NONE)),
            4 => ("flow.u_star", Number((tau / rho).sqrt(), VELOCITY)),
            _ => ("flow.pressure_gradient", Number(gradient, GRADIENT)),
        });
        let slips = self.chance(0.4);
        let mut tables = vec![
            ("form", Word(if slips { "\"two-fluid\"" } else { "\"mixed\"" })),
            ("closures.friction.law", Word("\"coulomb\"")),
            ("closures.friction.mu_s", Number(self.even(0.25, 0.5), NONE)),
            ("closures.mixture_viscosity", Word(self.one(&["\"einstein\"", "\"clear\""]))),
        ];
        if slips {
            tables.push(("closures.drag", Word("\"carman-kozeny\"")));
        }
        let with = |more: &[(&'static str, &'static str)]| {
            [&tables[..], &more.iter().map(|&(key, word)| (key, Word(word))).collect::<Vec<_>>()].concat()
        };
        let law = ("regularisation.law", "\"none\"");
        let mut models = Vec::new();
        if section {
            values.push(match self.one(&[0, 1, 2]) {
                0 => ("flow.section", Word("{ shape = \"circle\" }")),
                1 => ("flow.section", Word("{ shape = \"rectangle\" }")),
                _ => ("flow.section.shape", Word("\"rectangle\"")),
            });
            if matches!(values.last(), Some(("flow.section.shape", _))) {
                values.push(("flow.section.width", Number(height * self.log(0.5, 3.0), LENGTH)));
            }
        } else {
            models.push(("laminar-exact", tables.clone()));
            models.push(("laminar", with(&[law, ("grid.cells", "200")])));
        }
        if matches!(drive, 0 | 5) {
            models.push(("duct-bed", with(&[law, ("grid.cells", if section { "8" } else { "32" })])));
        }
        Drawn { kind: "bed", values, models }
    }

    /// Without grains.
    fn channel(&mut self) -> Drawn {
        let (rho, eta, height) = (self.log(500.0, 2000.0), self.log(0.05, 2.0), self.log(0.01, 2.0));
        let velocity = self.log(1e-3, 1.0);
        let bingham = self.log(0.1, 30.0);
        let mut values = vec![
            ("fluid.density", Number(rho, DENSITY)),
            ("fluid.viscosity", Number(eta, VISCOSITY)),
            ("flow.depth", Number(height, LENGTH)),
        ];
        let exact = [("regularisation.law", Word("\"none\""))];
        let yields = ("fluid.yield_stress", Number(bingham * eta * velocity / height, STRESS));
        let models = match self.even(0.0, 4.0) as usize {
            0 => {
                values.extend([yields, ("flow.mean_velocity", Number(velocity, VELOCITY))]);
                vec![("bingham-exact", Vec::new()), ("bingham", exact.to_vec())]
            }
            1 => {
                let gradient = eta * velocity / height.powi(2) * (12.0 + 3.0 * bingham);
                values.extend([yields, ("flow.pressure_gradient", Number(gradient, GRADIENT))]);
                vec![("bingham-exact", Vec::new()), ("bingham", exact.to_vec())]
            }
            2 => {
                let gradient = eta * velocity / height.powi(2) * (28.0 + 6.0 * bingham);
                let section = Word(self.one(&["{ shape = \"circle\" }", "{ shape = \"rectangle\" }"]));
                values.extend([
                    yields,
                    ("flow.section", section),
                    ("flow.pressure_gradient", Number(gradient, GRADIENT)),
                ]);
                vec![("duct", [&exact[..], &[("grid.cells", Word("8"))]].concat())]
            }
            _ => {
                values.push(("flow.u_star", Number(self.log(0.01, 0.3), VELOCITY)));
                let wall = [
                    ("closures.mixing_length.law", Word("\"prandtl\"")),
                    ("closures.wall.law", Word("\"rough\"")),
                    ("closures.wall.k_s", Number(height * self.log(0.01, 0.3), LENGTH)),
                ];
                vec![("log-law", wall.to_vec())]
            }
        };
        Drawn { kind: "channel", values, models }
    }

    /// A cavity, a shear cell.
    fn benchmark(&mut self) -> Drawn {
        let (rho, size, velocity) = (self.log(500.0, 2000.0), self.log(0.01, 2.0), self.log(1e-3, 1.0));
        if self.chance(0.5) {
            let eta = self.log(0.05, 2.0);
            let values = vec![
                ("fluid.density", Number(rho, DENSITY)),
                ("fluid.viscosity", Number(eta, VISCOSITY)),
                ("fluid.yield_stress", Number(self.log(0.1, 20.0) * eta * velocity / size, STRESS)),
            ];
            let tables = vec![
                ("geometry.height", Number(size, LENGTH)),
                ("geometry.lid_velocity", Number(velocity, VELOCITY)),
                ("regularisation.law", Word("\"none\"")),
                ("grid.cells", Word("12")),
            ];
            return Drawn { kind: "benchmark", values, models: vec![("cavity", tables)] };
        }
        let values = vec![
            ("grains.diameter", Number(size / self.even(12.0, 25.0), LENGTH)),
            ("grains.density", Number(rho, DENSITY)),
            ("grains.restitution", Number(self.even(0.7, 0.9), NONE)),
            ("grains.friction", Number(0.0, NONE)),
        ];
        let heat = velocity * velocity;
        let tables = vec![
            ("geometry.height", Number(size, LENGTH)),
            ("geometry.phi", Number(self.even(0.3, 0.5), NONE)),
            ("geometry.velocity_lower", Number(0.1 * velocity, VELOCITY)),
            ("geometry.velocity_upper", Number(velocity, VELOCITY)),
            ("geometry.temperature_lower", Number(heat * self.log(3e-3, 3e-2), HEAT)),
            ("geometry.temperature_upper", Number(heat * self.log(3e-3, 3e-2), HEAT)),
            ("closures.granular", Word("\"garzo-dufty\"")),
            ("grid.cells", Word("60")),
        ];
        Drawn { kind: "benchmark", values, models: vec![("shear-cell", tables)] }
    }

    /// Dry grains: a film in closed form, a bed grain by grain.
    fn granular(&mut self) -> Drawn {
        let d = self.log(2e-4, 1e-2);
        let values = vec![
            ("grains.diameter", Number(d, LENGTH)),
            ("grains.density", Number(self.log(1000.0, 5000.0), DENSITY)),
            ("bed.thickness", Number(d * self.even(8.0, 40.0), LENGTH)),
            ("bed.phi", Number(self.even(0.55, 0.6), NONE)),
            ("flow.gravity", Number(self.log(1.0, 30.0), GRAVITY)),
            ("flow.slope", Slope(self.even(0.37, 0.5))),
        ];
        let film = vec![("closures.friction", Word("{ law = \"mu-i\", mu_s = 0.38, mu_2 = 0.64, i_0 = 0.279 }"))];
        Drawn { kind: "granular", values, models: vec![("bagnold-film", film), ("dem", Vec::new())] }
    }
}
