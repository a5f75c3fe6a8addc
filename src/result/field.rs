//! Fields of an outcome that are no profile: over a section, and of grains seen from the side.

use std::borrow::Cow;
use std::fmt::Write;
use std::io::BufRead;

use super::{TableError, Values, read_columns};

/// Fields on a grid of nodes, `across` by `up`, node rows one after the other.
#[derive(Clone, Debug)]
pub struct Field {
    /// nodes in a row
    pub across: usize,
    /// rows
    pub up: usize,
    /// positions (y, z) \[m]
    pub places: Vec<(f64, f64)>,
    /// columns with their names
    pub columns: Vec<(Cow<'static, str>, Vec<f64>)>,
}

impl Field {
    /// Reads what [`Field::csv`] wrote; `None` for a table of something else.
    ///
    /// # Errors
    /// As [`read_columns`].
    pub fn read(table: impl BufRead) -> Result<Option<Self>, TableError> {
        let columns = read_columns(table)?;
        Ok(Self::of(columns))
    }

    fn of(columns: Vec<(String, Values)>) -> Option<Self> {
        let known =
            |(name, values): (String, Values)| Some((Cow::Owned(name), values.into_iter().collect::<Option<_>>()?));
        let mut columns = columns.into_iter().map(known).collect::<Option<Vec<(Cow<'static, str>, Vec<f64>)>>>()?;
        let mut take = |name: &str| {
            let at = columns.iter().position(|(known, _)| known == name)?;
            Some(columns.remove(at).1)
        };
        let (column, _, y, z) = (take("column")?, take("row")?, take("y_m")?, take("z_m")?);
        let across = column.iter().skip(1).position(|i| *i == 0.0).map_or(column.len(), |i| i + 1);
        let whole = across > 0 && column.len().is_multiple_of(across);
        let up = column.len().checked_div(across)?;
        whole.then(|| Self { across, up, places: y.into_iter().zip(z).collect(), columns })
    }

    /// A field by name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|(known, _)| known == name).map(|(_, values)| values.as_slice())
    }

    /// The table: place on the grid, place in the section, fields.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = String::from("column,row,y_m,z_m");
        for (name, _) in &self.columns {
            let _ = write!(text, ",{name}");
        }
        text.push('\n');
        for (node, (y, z)) in self.places.iter().enumerate() {
            let _ = write!(text, "{},{},{y:e},{z:e}", node % self.across, node / self.across);
            for (_, values) in &self.columns {
                let _ = write!(text, ",{:e}", values[node]);
            }
            text.push('\n');
        }
        text
    }

    /// The fields as a VTK structured grid in text, with x along the flow.
    #[must_use]
    pub fn vts(&self) -> String {
        let extent = format!("0 0 0 {} 0 {}", self.across - 1, self.up - 1);
        let mut text = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"StructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
             <StructuredGrid WholeExtent=\"{extent}\">\n<Piece Extent=\"{extent}\">\n<Points>\n\
             <DataArray type=\"Float64\" Name=\"position_m\" NumberOfComponents=\"3\" format=\"ascii\">\n"
        );
        for (y, z) in &self.places {
            let _ = writeln!(text, "0 {y:e} {z:e}");
        }
        text += "</DataArray>\n</Points>\n<PointData>\n";
        for (name, values) in &self.columns {
            let _ = writeln!(text, "<DataArray type=\"Float64\" Name=\"{name}\" format=\"ascii\">");
            for value in values {
                let _ = writeln!(text, "{value:e}");
            }
            text += "</DataArray>\n";
        }
        text + "</PointData>\n</Piece>\n</StructuredGrid>\n</VTKFile>\n"
    }
}

/// Grains of one slice along the flow, the farthest from the viewer first: enough to draw a side view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SideView {
    /// x, z, radius \[m] and velocity along the flow [m/s] of each
    pub grains: Vec<[f64; 4]>,
}

impl SideView {
    /// Reads what [`SideView::csv`] wrote; a grain with a number missing is left out. `None` for a table of something else.
    ///
    /// # Errors
    /// As [`read_columns`].
    pub fn read(table: impl BufRead) -> Result<Option<Self>, TableError> {
        let columns = read_columns(table)?;
        let column = |name: &str| columns.iter().find(|(known, _)| known == name).map(|(_, values)| values);
        let named = || Some([column("x_m")?, column("z_m")?, column("radius_m")?, column("u_particle_m_s")?]);
        Ok(named().map(|[x, z, radius, u]| {
            let grain = |i: usize| Some([x[i]?, z[i]?, radius[i]?, u[i]?]);
            Self { grains: (0..x.len()).filter_map(grain).collect() }
        }))
    }

    /// The table.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = String::from("x_m,z_m,radius_m,u_particle_m_s\n");
        for [x, z, radius, u] in &self.grains {
            let _ = writeln!(text, "{x:e},{z:e},{radius:e},{u:e}");
        }
        text
    }
}
