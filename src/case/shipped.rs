//! The cases that come with the program, embedded in the binary.

/// The files, and the models of those that have several.
macro_rules! shipped {
    ($($name:literal $(: [$($model:literal),+])?),* $(,)?) => {
        /// Name and content of each file, and the models that it has if there are several; a test holds the list against the folder `cases/`.
        pub static FILES: &[(&str, &str, &[&str])] =
            &[$(($name, include_str!(concat!("../../cases/", $name, ".toml")), &[$($($model),+)?])),*];

        /// The name of each case: of its file, and of its model where the file has several.
        static NAMES: &[&[&str]] = &[$(shipped!(@names $name $($($model)+)?)),*];
    };
    (@names $name:literal) => { &[$name] };
    (@names $name:literal $($model:literal)+) => { &[$(concat!($name, "-", $model)),+] };
}

shipped![
    "bed_ouriemi": ["laminar-exact", "laminar", "duct-bed"],
    "bingham_1d_plane",
    "coupled_3d_limit_cell",
    "coupled_3d_limit_diffusion",
    "coupled_3d_limit_drag",
    "coupled_3d_limit_sink",
    "coupled_3d_shields",
    "coupled_3d_shields_quick",
    "exact_1d_aussillous",
    "exact_1d_bagnold",
    "exact_1d_bingham",
    "exact_1d_limit_posed",
    "exact_1d_loglaw",
    "exact_1d_ouriemi_mixed",
    "flow_theta02": ["sheet-flow", "two-fluid", "coupled"],
    "flow_theta02_quick",
    "flow_theta04": ["sheet-flow", "two-fluid", "coupled"],
    "flow_theta04_quick",
    "flow_theta06": ["sheet-flow", "two-fluid", "coupled"],
    "flow_theta06_quick": ["sheet-flow", "two-fluid", "coupled"],
    "flow_theta08": ["sheet-flow", "two-fluid", "coupled"],
    "flow_theta08_quick",
    "flow_theta10": ["sheet-flow", "two-fluid", "coupled"],
    "flow_theta10_quick",
    "flume_exp14",
    "flume_exp14_quick",
    "flume_exp20",
    "flume_exp20_quick",
    "flume_exp6",
    "flume_exp6_quick",
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
    "kinetic_1d_waves",
    "laminar_1d_aussillous",
    "laminar_1d_limit_bed",
    "laminar_1d_limit_lambda",
    "laminar_1d_muiv",
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

/// Names that cases had before flows were shared by models.
static FORMER: &[(&str, &str)] = &[
    ("coupled_2d_exp14", "flume_exp14"),
    ("coupled_2d_exp14_quick", "flume_exp14_quick"),
    ("coupled_2d_exp20", "flume_exp20"),
    ("coupled_2d_exp20_quick", "flume_exp20_quick"),
    ("coupled_2d_exp6", "flume_exp6"),
    ("coupled_2d_exp6_quick", "flume_exp6_quick"),
    ("coupled_3d_chassagne", "flow_theta06-coupled"),
    ("coupled_3d_chassagne_quick", "flow_theta06_quick-coupled"),
    ("coupled_3d_theta02", "flow_theta02-coupled"),
    ("coupled_3d_theta02_quick", "flow_theta02_quick"),
    ("coupled_3d_theta04", "flow_theta04-coupled"),
    ("coupled_3d_theta04_quick", "flow_theta04_quick"),
    ("coupled_3d_theta08", "flow_theta08-coupled"),
    ("coupled_3d_theta08_quick", "flow_theta08_quick"),
    ("coupled_3d_theta10", "flow_theta10-coupled"),
    ("coupled_3d_theta10_quick", "flow_theta10_quick"),
    ("exact_1d_ouriemi", "bed_ouriemi-laminar-exact"),
    ("kinetic_1d_theta02", "flow_theta02-two-fluid"),
    ("kinetic_1d_theta04", "flow_theta04-two-fluid"),
    ("kinetic_1d_theta06", "flow_theta06-two-fluid"),
    ("kinetic_1d_theta08", "flow_theta08-two-fluid"),
    ("kinetic_1d_theta10", "flow_theta10-two-fluid"),
    ("laminar_1d_ouriemi", "bed_ouriemi-laminar"),
    ("sheet_1d_theta06", "flow_theta06-sheet-flow"),
];

/// A shipped case: its file, and the model that its name chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shipped {
    /// name of the file
    pub file: &'static str,
    /// content of the file
    pub content: &'static str,
    /// the model, if the name has one
    pub model: Option<&'static str>,
}

/// The shipped case of that name: of a file, of a file and one of its models, or a former one.
#[must_use]
pub fn find(name: &str) -> Option<Shipped> {
    let name = FORMER.iter().find(|(former, _)| *former == name).map_or(name, |(_, name)| name);
    FILES.iter().find_map(|&(file, content, models)| {
        let rest = name.strip_prefix(file)?;
        let model = models.iter().copied().find(|model| rest.strip_prefix('-') == Some(model));
        (rest.is_empty() || model.is_some()).then_some(Shipped { file, content, model })
    })
}

/// Names of the shipped cases that take less than a second or so: the others follow many grains for long.
pub fn quick() -> impl Iterator<Item = &'static str> {
    const LONG: [&str; 7] = [
        "grains_",
        "coupled_",
        "flume_",
        "kinetic_1d_settling",
        "kinetic_1d_start",
        "section_3d_",
        "sheet_1d_limit_pseudotime",
    ];
    let grains = |name: &str| name.ends_with("-coupled") || name.starts_with("flow_") && name.contains("_quick");
    names().filter(move |name| !grains(name) && !LONG.iter().any(|long| name.starts_with(long)))
}

/// Names of the shipped cases: a file with several models is several cases.
pub fn names() -> impl Iterator<Item = &'static str> {
    NAMES.iter().copied().flatten().copied()
}

/// Names of the files.
pub fn files() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|(file, ..)| *file)
}
