//! Figures and the page of a run, from stored results alone: [`profile_figures`] makes figures of a profile, [`svg()`]
//! and [`png()`] draw them, [`report_html`] sets the page. [`shared_figures`] and [`document_html`] do so for several.

mod animation;
mod answer;
mod axis;
mod canvas;
mod document;
mod draw;
mod faults;
mod grains;
mod interface;
mod labels;
mod layout;
mod legend;
mod live;
mod map;
mod png;
mod report;
#[cfg(test)]
mod samples;
mod section;
mod section_page;
mod series;
mod several;
mod shell;
mod stated;
mod svg;
mod text;
mod theme;

use std::fmt::Display;
use std::path::PathBuf;

use crate::result::{Figure, Profile, Summary};

pub use document::{Cell, Document, Section, document_html};
pub use faults::faults;
pub use grains::grains_svg;
pub use map::{Corner, Map, MapPanel, Place, Trail, map_png};
pub use png::png;
pub use report::{Page, report_html};
pub use section::section_map;
pub use section_page::section_svg;
pub use series::series_figures;
pub use several::{Trace, shared_figures};
pub use svg::svg;

/// The figures of columns that any model may have: a line each, the file with its function `figures`.
macro_rules! figures {
    ($($file:ident,)*) => {
        $(mod $file;)*

        /// The figures of a run that its columns and numbers give, whatever its model. What they do not give gets no figure.
        #[must_use]
        pub fn profile_figures(profile: &Profile, summary: &Summary) -> Vec<Figure> {
            [$($file::figures(profile, summary)),*].concat()
        }
    };
}

figures! {
    profile,
    kinetic,
}

/// Why a figure could not be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// the embedded font is damaged: a defect of the program
    #[error("the embedded font cannot be read")]
    Font,
    /// a backend refused a drawing operation
    #[error("the figure cannot be drawn: {message}")]
    Drawing {
        /// what plotters says
        message: String,
    },
    /// the file cannot be written
    #[error("{} cannot be written: {message}", path.display())]
    Write {
        /// the file
        path: PathBuf,
        /// what the system says
        message: String,
    },
}

impl PlotError {
    fn drawing(error: impl Display) -> Self {
        Self::Drawing { message: error.to_string() }
    }
}
