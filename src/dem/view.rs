//! The grains as a frame for ParaView, and as what the report draws of them.

use std::fmt::Write;

use super::grains::{Grains, Point};
use crate::result::SideView;

/// A frame of grains as VTK poly data in text: radius, velocity, angular velocity, whether fixed, name.
#[must_use]
pub fn vtp(grains: &Grains, time: f64) -> String {
    let places = grains.places();
    let n = places.len();
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n\
         <FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{time}</DataArray></FieldData>\n\
         <Piece NumberOfPoints=\"{n}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n"
    );
    let vectors = |text: &mut String, name: &str, of: &dyn Fn(usize) -> Point| {
        *text += &format!("<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"3\" format=\"ascii\">\n");
        for &i in &places {
            let [x, y, z] = of(i);
            let _ = writeln!(text, "{x:e} {y:e} {z:e}");
        }
        *text += "</DataArray>\n";
    };
    vectors(&mut text, "position_m", &|i| grains.position(i));
    text += "</Points>\n<PointData Scalars=\"radius_m\" Vectors=\"velocity_m_s\">\n";
    vectors(&mut text, "velocity_m_s", &|i| grains.velocity(i));
    vectors(&mut text, "angular_velocity_1_s", &|i| grains.spin(i));
    let scalars = |text: &mut String, kind: &str, name: &str, of: &dyn Fn(usize) -> String| {
        *text += &format!("<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">\n");
        for &i in &places {
            let _ = writeln!(text, "{}", of(i));
        }
        *text += "</DataArray>\n";
    };
    scalars(&mut text, "Float64", "radius_m", &|i| format!("{:e}", grains.radius(i)));
    scalars(&mut text, "UInt8", "fixed", &|i| u8::from(grains.is_fixed(i)).to_string());
    scalars(&mut text, "UInt32", "grain", &|i| grains.ids[i].to_string());
    text + "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n"
}

/// Grains of one slice along the flow, two diameters deep across it: enough to draw a side view.
#[must_use]
pub fn side_view(grains: &Grains) -> SideView {
    let nearest = (0..grains.len()).map(|i| grains.position(i)[1]).fold(f64::INFINITY, f64::min);
    let depth = nearest + 4.0 * grains.largest_radius();
    // The nearest last: it hides what is behind it.
    let mut places = grains.places();
    places.sort_by(|&a, &b| grains.position(b)[1].total_cmp(&grains.position(a)[1]));
    let seen = |i: usize| {
        let ([x, y, z], [u, _, _]) = (grains.position(i), grains.velocity(i));
        (y <= depth).then(|| [x, z, grains.radius(i), u])
    };
    SideView { grains: places.into_iter().filter_map(seen).collect() }
}
