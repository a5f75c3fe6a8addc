//! A flow as text in any units and at any scale.

use std::f64::consts::TAU;

/// Powers of length, density and time.
pub type Dim = [i32; 3];
pub const NONE: Dim = [0, 0, 0];
pub const LENGTH: Dim = [1, 0, 0];
pub const DENSITY: Dim = [0, 1, 0];
pub const VISCOSITY: Dim = [2, 1, -1];
pub const STRESS: Dim = [2, 1, -2];
pub const GRADIENT: Dim = [1, 1, -2];
pub const VELOCITY: Dim = [1, 0, -1];
pub const HEAT: Dim = [2, 0, -2];
pub const DISCHARGE: Dim = [2, 0, -1];
pub const RATE: Dim = [0, 0, -1];
pub const GRAVITY: Dim = [1, 0, -2];

/// Another unit of each dimension, and the power of ten by which a number in it is larger than in SI.
const UNITS: [(Dim, &str, i32); 10] = [
    (LENGTH, "mm", 3),
    (DENSITY, "g/cm3", -3),
    (VISCOSITY, "mPa s", 3),
    (STRESS, "kPa", -3),
    (GRADIENT, "Pa/cm", -2),
    (VELOCITY, "cm/s", 2),
    (HEAT, "mm2/s2", 6),
    (DISCHARGE, "cm2/s", 4),
    (GRAVITY, "cm/s2", 2),
    (NONE, "%", 2),
];

/// A value of a case.
#[derive(Clone, Debug)]
pub enum Value {
    /// a number in SI
    Number(f64, Dim),
    /// an angle \[rad], given by its tangent or in degrees
    Slope(f64),
    /// a word or a table
    Word(&'static str),
}
use Value::{Number, Slope, Word};

/// A flow: its kind, its values by key, and the models that take it with what each has in its table.
#[derive(Clone, Debug)]
pub struct Drawn {
    pub kind: &'static str,
    pub values: Vec<(&'static str, Value)>,
    pub models: Vec<(&'static str, Vec<(&'static str, Value)>)>,
}

/// In what a flow is written.
#[derive(Clone, Copy, Debug)]
pub struct Written {
    /// other units than SI
    pub other_units: bool,
    /// factors of length, density and time
    pub scale: [f64; 3],
}

/// As it was drawn.
pub const PLAIN: Written = Written { other_units: false, scale: [1.0; 3] };

/// What a factor of each of length, density and time makes of a number of the dimension `dim`.
pub fn factor(scale: [f64; 3], dim: Dim) -> f64 {
    scale.iter().zip(dim).map(|(factor, power)| factor.powi(power)).product()
}

impl Drawn {
    /// The case of one of its models.
    pub fn text(&self, model: usize, written: Written) -> String {
        let (name, tables) = &self.models[model];
        let mut text = format!("format = 2\nscene = \"{}\"\ncase.title = \"a random flow\"\n", self.kind);
        for (key, value) in &self.values {
            text += &line(key, value, written);
        }
        text += &format!("[{name}]\n");
        for (key, value) in tables {
            text += &line(key, value, written);
        }
        text
    }

    /// Whether the same number stands in it in all units: an angle in degrees is its tangent but for round-off.
    pub fn exact(&self) -> bool {
        self.values.iter().all(|(_, value)| !matches!(value, Slope(_)))
    }
}

fn line(key: &str, value: &Value, written: Written) -> String {
    match *value {
        Word(word) => format!("{key} = {word}\n"),
        Slope(angle) if written.other_units => format!("{key} = \"{} deg\"\n", angle * 360.0 / TAU),
        Slope(angle) => format!("{key} = {:?}\n{key}_definition = \"tangent\"\n", angle.tan()),
        Number(number, dim) => {
            let number = number * factor(written.scale, dim);
            let unit = UNITS.iter().find(|(of, ..)| *of == dim).filter(|_| written.other_units);
            match unit {
                Some((_, unit, shift)) => {
                    // The digits stay, so that it is the same number.
                    let text = format!("{number:e}");
                    let (digits, exponent) = text.split_once('e').unwrap();
                    format!("{key} = \"{digits}e{} {unit}\"\n", exponent.parse::<i32>().unwrap() + shift)
                }
                None => format!("{key} = {number:?}\n"),
            }
        }
    }
}
