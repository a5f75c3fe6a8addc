//! The cases that come with the program, embedded in the binary.

macro_rules! shipped {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../cases/", $name, ".toml")))),*]
    };
}

/// Name and content of each shipped case; a test holds the list against the folder `cases/`.
pub static CASES: &[(&str, &str)] = shipped![
    "bingham_1d_plane",
    "coupled_2d_exp14",
    "coupled_2d_exp14_quick",
    "coupled_2d_exp20",
    "coupled_2d_exp20_quick",
    "coupled_2d_exp6",
    "coupled_2d_exp6_quick",
    "coupled_3d_chassagne",
    "coupled_3d_chassagne_quick",
    "coupled_3d_limit_cell",
    "coupled_3d_limit_diffusion",
    "coupled_3d_limit_drag",
    "coupled_3d_limit_sink",
    "coupled_3d_shields",
    "coupled_3d_shields_quick",
    "coupled_3d_theta02",
    "coupled_3d_theta02_quick",
    "coupled_3d_theta04",
    "coupled_3d_theta04_quick",
    "coupled_3d_theta08",
    "coupled_3d_theta08_quick",
    "coupled_3d_theta10",
    "coupled_3d_theta10_quick",
    "exact_1d_aussillous",
    "exact_1d_bagnold",
    "exact_1d_bingham",
    "exact_1d_limit_posed",
    "exact_1d_loglaw",
    "exact_1d_ouriemi",
    "exact_1d_ouriemi_mixed",
    "grains_2d_column",
    "grains_3d_bed",
    "grains_3d_bed_quick",
    "grains_3d_chute",
    "grains_3d_limit_step",
    "impact_1d_headon",
    "impact_1d_headon_tension",
    "impact_2d_oblique",
    "impact_2d_spinning",
    "kinetic_1d_d3",
    "kinetic_1d_d9",
    "kinetic_1d_e03",
    "kinetic_1d_e05",
    "kinetic_1d_e09",
    "kinetic_1d_limit_restitution",
    "kinetic_1d_mu00",
    "kinetic_1d_mu01",
    "kinetic_1d_mu02",
    "kinetic_1d_mu06",
    "kinetic_1d_mu08",
    "kinetic_1d_mu15",
    "kinetic_1d_r1375",
    "kinetic_1d_r175",
    "kinetic_1d_r40",
    "kinetic_1d_settling",
    "kinetic_1d_settling_oil",
    "kinetic_1d_shear",
    "kinetic_1d_start",
    "kinetic_1d_theta02",
    "kinetic_1d_theta04",
    "kinetic_1d_theta06",
    "kinetic_1d_theta08",
    "kinetic_1d_theta10",
    "kinetic_1d_waves",
    "laminar_1d_aussillous",
    "laminar_1d_limit_bed",
    "laminar_1d_limit_lambda",
    "laminar_1d_muiv",
    "laminar_1d_ouriemi",
    "section_2d_cavity_bn0",
    "section_2d_cavity_bn2",
    "section_2d_cavity_bn20",
    "section_2d_cavity_bn5",
    "section_2d_cavity_bn50",
    "section_2d_circle",
    "section_2d_circle_bed",
    "section_2d_square",
    "section_2d_square_bed",
    "section_3d_square_bed",
    "sheet_1d_cowen",
    "sheet_1d_limit_cut_a",
    "sheet_1d_limit_cut_b",
    "sheet_1d_limit_mesh",
    "sheet_1d_limit_newton",
    "sheet_1d_limit_pseudotime",
    "sheet_1d_limit_slope_a",
    "sheet_1d_limit_slope_b",
    "sheet_1d_sumer82",
    "sheet_1d_sumer91",
    "sheet_1d_sumer99",
    "sheet_1d_theta06",
    "sheet_1d_type_a",
    "sheet_1d_type_b",
    "trial_1d_bouncing",
    "trial_1d_headon",
    "trial_1d_springs",
    "trial_1d_stack",
    "trial_2d_oblique",
    "trial_2d_rolling",
    "trial_3d_cluster",
    "trial_3d_ledger",
    "two_fluid_1d_avalanche",
];

/// Content of the shipped case of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static str> {
    CASES.iter().find(|(n, _)| *n == name).map(|(_, content)| *content)
}

/// Names of the shipped cases that take less than a second or so: the others follow many grains for long.
pub fn quick() -> impl Iterator<Item = &'static str> {
    names().filter(|name| {
        !["grains_", "coupled_", "kinetic_1d_settling", "kinetic_1d_start", "section_3d_", "sheet_1d_limit_pseudotime"]
            .iter()
            .any(|long| name.starts_with(long))
    })
}

/// Names of the shipped cases.
pub fn names() -> impl Iterator<Item = &'static str> {
    CASES.iter().map(|(name, _)| *name)
}
