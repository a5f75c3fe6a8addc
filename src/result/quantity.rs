//! The catalogue of everything that is reported: one name, one unit, one definition, the same in every model.

/// A reported quantity. Its `name` carries the SI unit and is the column header or the key in `summary.json`.
#[derive(Debug, PartialEq, Eq)]
pub struct Quantity {
    /// column header or result key, with its unit: `u_fluid_m_s`
    pub name: &'static str,
    /// what it is, in words: `fluid velocity`
    pub title: &'static str,
    /// the papers' symbol
    pub symbol: &'static str,
    /// SI unit as text, `1` for a pure number
    pub unit: &'static str,
    /// its exact definition
    pub definition: &'static str,
}

macro_rules! catalogue {
    ($(#[$doc:meta])* $list:ident: $($id:ident = $name:literal, $title:literal, $symbol:literal, $unit:literal, $definition:literal;)*) => {
        $(#[doc = concat!($title, ", ", $symbol, " \\[", $unit, "]: ", $definition)]
        pub static $id: Quantity =
            Quantity { name: $name, title: $title, symbol: $symbol, unit: $unit, definition: $definition };)*
        $(#[$doc])*
        pub static $list: &[&Quantity] = &[$(&$id),*];
    };
}

catalogue! {
    /// Columns of `profile.csv`, in the order in which they are written.
    COLUMNS:
    Z = "z_m", "elevation", "z", "m", "height normal to the bed; 0 at the bottom of the sediment layer, at the lower wall where there is no bed";
    PHI = "phi", "solid fraction", "φ", "1", "solid volume per total volume; 0 in clear fluid";
    U_FLUID = "u_fluid_m_s", "fluid velocity", "u_f", "m/s", "mean velocity of the fluid between the grains";
    U_PARTICLE = "u_particle_m_s", "grain velocity", "u_p", "m/s", "mean velocity of the grains; undefined where there are none";
    U_MIXTURE = "u_mixture_m_s", "mixture velocity", "U", "m/s", "volume mean (1 - φ) u_f + φ u_p";
    U_PLANES = "u_planes_m_s", "mixture velocity between planes", "U_∞", "m/s", "of the same flow without side walls";
    FLUX = "flux_m_s", "solid flux density", "φ u_p", "m/s", "solid volume crossing a unit of area per unit of time";
    TAU_VISCOUS = "tau_fluid_viscous_Pa", "viscous fluid stress", "τ_f", "Pa", "viscous shear stress of the fluid phase per total area";
    TAU_REYNOLDS = "tau_reynolds_Pa", "Reynolds stress", "R_xz", "Pa", "turbulent shear stress of the fluid phase per total area";
    TAU_PARTICLE = "tau_particle_Pa", "intergranular shear stress", "τ_p", "Pa", "shear stress carried by the grains, or by the yield stress of the material, per total area";
    P_PARTICLE = "p_particle_Pa", "particle pressure", "P_p", "Pa", "normal stress carried by the grains per total area";
    SHEAR_RATE = "shear_rate_particle_1_s", "shear rate of the grains", "|du_p/dz|", "1/s", "magnitude of the velocity gradient of the solid phase, of the material in a one-phase model";
    INERTIAL_NUMBER = "inertial_number", "inertial number", "I", "1", "d |du_p/dz| sqrt(ρ_p/P_p)";
    MIXING_LENGTH = "mixing_length_m", "mixing length", "l_m", "m", "length of the eddy-viscosity closure";
    STOKES = "stokes_number", "Stokes number", "St", "1", "free-fall over viscous rearrangement time";
    RATIO_R = "rearrangement_ratio", "rearrangement ratio", "r", "1", "free-fall over turbulent rearrangement time";
    CUMULATIVE_FLUX = "cumulative_flux_m2_s", "cumulative flux", "Π", "m²/s", "integral of the solid flux density from the bottom";
    EDDY_VISCOSITY = "eddy_viscosity_m2_s", "eddy viscosity", "ν_t", "m²/s", "kinematic eddy viscosity";
    TAU_CONTACT = "tau_particle_contact_Pa", "shear stress of enduring contacts", "τ_el", "Pa", "part of the intergranular shear stress that does not come from collisions and fluctuations";
    P_CONTACT = "p_particle_contact_Pa", "pressure of enduring contacts", "p_el", "Pa", "part of the particle pressure that does not come from collisions and fluctuations";
    RADIAL = "radial_distribution", "radial distribution function", "g₀", "1", "at contact: how much likelier than in a dilute gas two grains are to touch";
    PRODUCTION = "fluctuation_production_W_m3", "production of fluctuation energy", "τ_kin du_p/dz", "W/m³", "work of the stress of moving grains on their mean shear";
    DIFFUSION = "fluctuation_diffusion_W_m3", "diffusion of fluctuation energy", "-dq/dz", "W/m³", "what the flux of fluctuation energy brings";
    CONTACT_LOSS = "fluctuation_contact_loss_W_m3", "loss of fluctuation energy by contacts", "-Γ", "W/m³", "what contacts dissipate, positive";
    DRAG_LOSS = "fluctuation_drag_loss_W_m3", "loss of fluctuation energy by drag", "-J", "W/m³", "what the drag takes from the velocity fluctuations, positive";
    CONTACT_LOSS_DIRECT = "fluctuation_contact_loss_direct_W_m3", "power that contacts take", "Σ f·Δv/2V", "W/m³", "work of contact forces on the centres of the grains, taken where the grains are, positive; the loss by contacts is what the budget leaves";
    FLUCTUATION_FLUX = "fluctuation_flux_W_m2", "flux of fluctuation energy", "q", "W/m²", "upward";
    GRANULAR_TEMPERATURE = "granular_temperature_m2_s2", "granular temperature", "T", "m²/s²", "a third of the mean square of the grain velocity about its mean in the slice";
    RADIAL_THEORY = "radial_distribution_theory", "radial distribution by the law with friction", "g₀", "1", "of kinetic theory with friction and saltation at the state of the grains";
    RADIAL_CLASSICAL = "radial_distribution_classical", "radial distribution by the law without friction", "g₀", "1", "of kinetic theory of smooth grains at the state of the grains";
    VISCOSITY_FACTOR = "viscosity_factor", "viscosity of the grains", "F₂", "1", "τ_p/(ρ_p d T^½ |du_p/dz|)";
    VISCOSITY_FACTOR_THEORY = "viscosity_factor_theory", "viscosity of the grains with saltation", "F₂", "1", "of kinetic theory with friction and saltation at the state of the grains";
    VISCOSITY_FACTOR_CLASSICAL = "viscosity_factor_classical", "viscosity of the grains without saltation", "F₂", "1", "of kinetic theory of smooth grains at the state of the grains";
    CONDUCTIVITY_FACTOR = "conductivity_factor", "conductivity of the grains", "F₃", "1", "-q/(ρ_p d T^½ dT/dz), the slope over one diameter";
    CONDUCTIVITY_FACTOR_THEORY = "conductivity_factor_theory", "conductivity of the grains with saltation", "F₃", "1", "of kinetic theory with friction and saltation at the state of the grains";
    CONDUCTIVITY_FACTOR_CLASSICAL = "conductivity_factor_classical", "conductivity of the grains without saltation", "F₃", "1", "of kinetic theory of smooth grains at the state of the grains";
    CONTACT_FACTOR = "contact_loss_factor", "loss by contacts", "F₄", "1", "Γ d/(ρ_p T^(3/2)), Γ what the budget of the fluctuations leaves";
    CONTACT_FACTOR_DIRECT = "contact_loss_factor_direct", "loss by contacts from their power", "F₄", "1", "Γ d/(ρ_p T^(3/2)), Γ the power that contacts take";
    CONTACT_FACTOR_THEORY = "contact_loss_factor_theory", "loss by contacts with e_eff", "F₄", "1", "of kinetic theory with the effective restitution at the state of the grains";
    CONTACT_FACTOR_CLASSICAL = "contact_loss_factor_classical", "loss by contacts with e", "F₄", "1", "of kinetic theory of smooth grains at the state of the grains";
    DRAG_FACTOR = "drag_loss_factor", "loss by drag", "J d/(ρ_p T^(3/2))", "1", "work of the drag on the fluctuations over ρ_p T^(3/2)/d";
    DRAG_FACTOR_THEORY = "drag_loss_factor_theory", "loss by quadratic drag", "J d/(ρ_p T^(3/2))", "1", "of a drag that is quadratic in the slip, at the state of the grains";
    DRAG_FACTOR_CLASSICAL = "drag_loss_factor_classical", "loss by linear drag", "J d/(ρ_p T^(3/2))", "1", "of a drag that is linear in the slip, at the state of the grains";
    PHI_0 = "phi_0deg", "solid fraction at the phase 0°", "φ", "1", "at 0° of the last whole period of the waves, where the waves turn forward";
    U_FLUID_0 = "u_fluid_0deg_m_s", "fluid velocity at the phase 0°", "u_f", "m/s", "at 0° of the last whole period of the waves";
    U_PARTICLE_0 = "u_particle_0deg_m_s", "grain velocity at the phase 0°", "u_p", "m/s", "at 0° of the last whole period of the waves";
    PHI_90 = "phi_90deg", "solid fraction at the phase 90°", "φ", "1", "at 90° of the last whole period of the waves, of the fastest flow forward";
    U_FLUID_90 = "u_fluid_90deg_m_s", "fluid velocity at the phase 90°", "u_f", "m/s", "at 90° of the last whole period of the waves";
    U_PARTICLE_90 = "u_particle_90deg_m_s", "grain velocity at the phase 90°", "u_p", "m/s", "at 90° of the last whole period of the waves";
    PHI_180 = "phi_180deg", "solid fraction at the phase 180°", "φ", "1", "at 180° of the last whole period of the waves, where the waves turn backward";
    U_FLUID_180 = "u_fluid_180deg_m_s", "fluid velocity at the phase 180°", "u_f", "m/s", "at 180° of the last whole period of the waves";
    U_PARTICLE_180 = "u_particle_180deg_m_s", "grain velocity at the phase 180°", "u_p", "m/s", "at 180° of the last whole period of the waves";
    PHI_270 = "phi_270deg", "solid fraction at the phase 270°", "φ", "1", "at 270° of the last whole period of the waves, of the fastest flow backward";
    U_FLUID_270 = "u_fluid_270deg_m_s", "fluid velocity at the phase 270°", "u_f", "m/s", "at 270° of the last whole period of the waves";
    U_PARTICLE_270 = "u_particle_270deg_m_s", "grain velocity at the phase 270°", "u_p", "m/s", "at 270° of the last whole period of the waves";
    PRODUCTION_STDERR = "fluctuation_production_W_m3_stderr", "standard error of the production", "σ(τ_p du_p/dz)", "W/m³", "by block averaging";
    FLUCTUATION_FLUX_STDERR = "fluctuation_flux_W_m2_stderr", "standard error of the flux of fluctuation energy", "σ(q)", "W/m²", "by block averaging";
    CONTACT_LOSS_STDERR = "fluctuation_contact_loss_W_m3_stderr", "standard error of the loss by contacts", "σ(Γ)", "W/m³", "by block averaging";
    DRAG_LOSS_STDERR = "fluctuation_drag_loss_W_m3_stderr", "standard error of the loss by drag", "σ(J)", "W/m³", "by block averaging";
    RADIAL_STDERR = "radial_distribution_stderr", "standard error of the radial distribution function", "σ(g₀)", "1", "by block averaging";
    VISCOSITY_FACTOR_STDERR = "viscosity_factor_stderr", "standard error of the viscosity of the grains", "σ(F₂)", "1", "from those of its factors, taken as independent";
    CONDUCTIVITY_FACTOR_STDERR = "conductivity_factor_stderr", "standard error of the conductivity of the grains", "σ(F₃)", "1", "from those of its factors, taken as independent";
    CONTACT_FACTOR_STDERR = "contact_loss_factor_stderr", "standard error of the loss by contacts", "σ(F₄)", "1", "from those of its factors, taken as independent";
    CONTACT_FACTOR_DIRECT_STDERR = "contact_loss_factor_direct_stderr", "standard error of the loss by contacts from their power", "σ(F₄)", "1", "from those of its factors, taken as independent";
    DRAG_FACTOR_STDERR = "drag_loss_factor_stderr", "standard error of the loss by drag", "σ(J)", "1", "from those of its factors, taken as independent";
    U_FLUID_STDERR = "u_fluid_m_s_stderr", "standard error of the fluid velocity", "σ(u_f)", "m/s", "by block averaging";
    TAU_REYNOLDS_STDERR = "tau_reynolds_Pa_stderr", "standard error of the Reynolds stress", "σ(R_xz)", "Pa", "by block averaging";
    PHI_STDERR = "phi_stderr", "standard error of the solid fraction", "σ(φ)", "1", "by block averaging";
    U_PARTICLE_STDERR = "u_particle_m_s_stderr", "standard error of the grain velocity", "σ(u_p)", "m/s", "by block averaging";
    GRANULAR_TEMPERATURE_STDERR = "granular_temperature_m2_s2_stderr", "standard error of the granular temperature", "σ(T)", "m²/s²", "by block averaging";
    TAU_PARTICLE_STDERR = "tau_particle_Pa_stderr", "standard error of the intergranular shear stress", "σ(τ_p)", "Pa", "by block averaging";
    P_PARTICLE_STDERR = "p_particle_Pa_stderr", "standard error of the particle pressure", "σ(P_p)", "Pa", "by block averaging";
}

/// Solid fraction, velocity of the fluid and of the grains at the four phases of waves that are kept.
pub static PHASES: [[&Quantity; 3]; 4] = [
    [&PHI_0, &U_FLUID_0, &U_PARTICLE_0],
    [&PHI_90, &U_FLUID_90, &U_PARTICLE_90],
    [&PHI_180, &U_FLUID_180, &U_PARTICLE_180],
    [&PHI_270, &U_FLUID_270, &U_PARTICLE_270],
];

catalogue! {
    /// Columns of `series.csv`.
    SERIES:
    ITERATION = "iteration", "iteration", "n", "1", "evaluation of the residual by the root finder or solver";
    TIME = "time_s", "time", "t", "s", "simulated time";
    KINETIC_ENERGY = "kinetic_energy_J", "kinetic energy", "E_k", "J", "of the mobile grains, translation and rotation";
    RATE_IN_TIME = "transport_rate_m2_s", "transport rate", "q_p", "m²/s", "solid volume per unit width and time, mean since the sample before";
    SHIELDS_IN_TIME = "shields_bed", "Shields number on the moving grains", "θ_b", "1", "largest Reynolds stress of the column over (ρ_p - ρ_f) g d";
    LEVEL_IN_TIME = "bed_level_m", "bed level", "z_b", "m", "where the solid fraction, averaged over a diameter, falls to half of its largest value";
    RESIDUAL = "residual", "relative residual", "r", "1", "magnitude of the residual relative to the scale that the model states";
}

catalogue! {
    /// Keys of `results` in `summary.json`.
    RESULTS:
    SHIELDS = "shields", "Shields number", "θ", "1", "total stress on the bed over (ρ_p - ρ_f) g d: that of the drive less what side walls take, or what a lid or a plane leaves";
    U_STAR = "u_star_m_s", "friction velocity", "u_*", "m/s", "sqrt(τ/ρ_f) of the total stress on the bed, or on the wall where there is no bed";
    TRANSPORT_RATE = "transport_rate_m2_s", "transport rate", "q_p", "m²/s", "integral of φ u_p over z: solid volume without pores per unit width and time";
    TRANSPORT_RATE_MASS = "transport_rate_kg_m_s", "transport rate by mass", "ρ_p q_p", "kg/(m s)", "solid mass per unit width and time";
    TRANSPORT_RATE_BULK = "transport_rate_bulk_m2_s", "bulk transport rate", "q_p/φ", "m²/s", "transport rate with the pores of the bed";
    TRANSPORT_RATE_DIMENSIONLESS = "transport_rate_dimensionless", "dimensionless transport rate", "Q*", "1", "q_p/(d sqrt((ρ_p/ρ_f - 1) g d)), g the full gravity";
    TRANSPORT_RATE_BEADS = "transport_rate_beads_1_s", "transport rate by number", "n", "1/s", "grains that pass a cross-section of the channel per unit time";
    SHIELDS_BED = "shields_bed", "Shields number on the moving grains", "θ_b", "1", "what the model finds on the moving grains, over (ρ_p - ρ_f) g d: the largest mean Reynolds stress, or the stress at the interface of a sheet flow";
    U_STAR_BED = "u_star_bed_m_s", "friction velocity on the moving grains", "u_*b", "m/s", "sqrt(τ/ρ_f) of the stress on the moving grains";
    SHIELDS_DRIVE = "shields_drive", "Shields number of the drive", "θ_d", "1", "wanted stress on the bed, or the weight along the slope of the fluid over the bed at rest, over (ρ_p - ρ_f) g d; no side walls";
    U_STAR_DRIVE = "u_star_drive_m_s", "friction velocity of the drive", "u_*d", "m/s", "sqrt(τ/ρ_f) of the stress of the drive alone";
    SHIELDS_NOMINAL = "shields_nominal", "nominal Shields number", "θ_n", "1", "ρ_f g h_w sin(α) over (ρ_p - ρ_f) g d, h_w the water depth";
    WATER_DEPTH = "water_depth_m", "water depth", "h_w", "m", "free surface over the bed level";
    TRANSIENT = "transient_s", "transient", "t_0", "s", "time before the first sample that is averaged";
    AVERAGED_TIME = "averaged_time_s", "averaged time", "T", "s", "time over which the means are taken";
    FLUID_DISCHARGE = "fluid_discharge_m2_s", "fluid discharge", "q_f", "m²/s", "integral of (1 - φ) u_f over z, per unit width";
    DISCHARGE = "discharge_m2_s", "discharge", "q", "m²/s", "integral of the velocity over z, per unit width";
    U_MAX = "u_max_m_s", "largest velocity", "u_max", "m/s", "largest mixture velocity";
    U_MAX_LEVEL = "u_max_level_m", "level of the largest velocity", "z(u_max)", "m", "elevation of the largest mixture velocity";
    MEAN_VELOCITY = "mean_velocity_m_s", "mean velocity", "U_m", "m/s", "mean over the depth of the mixture velocity";
    MOBILE_DEPTH = "mobile_depth_m", "mobile depth", "Y", "m", "h_p - h_c: thickness of the moving grains";
    YIELD_LEVEL = "yield_level_m", "yield level", "h_c", "m", "elevation below which the grains are at rest";
    BED_LEVEL = "bed_level_m", "bed level", "h_p", "m", "elevation of the top of the grains";
    BED_LEVEL_DRIFT = "bed_level_drift_m", "change of the bed level", "Δh_p", "m", "mean level in the second half of the averaged time less that in the first";
    BED_LEVEL_REST = "bed_level_rest_m", "bed level at rest", "h_0", "m", "elevation of the top of the grains before they flow";
    FLOW_HEIGHT = "flow_height_m", "flow height", "H", "m", "elevation of the upper wall or of the free surface";
    PHI_INTERFACE = "phi_interface", "solid fraction under the interface", "φ(h_p)", "1", "limit of φ from below at the bed level";
    SLIP_VELOCITY = "slip_velocity_m_s", "slip velocity", "U - u_p", "m/s", "mixture velocity minus grain velocity in the mobile layer, where it is constant";
    DRIVE = "pressure_gradient_Pa_m", "driving pressure gradient", "-dp/dx", "Pa/m", "fall of pressure along the flow";
    DRIVE_DIMENSIONLESS = "pressure_gradient_dimensionless", "dimensionless drive", "f", "1", "-dp/dx/((ρ_p - ρ_f) g)";
    BINGHAM = "bingham_number", "Bingham number", "Bn", "1", "τ_0 H/(η U_m), on the mean velocity";
    HALF_PLUG = "half_plug_m", "half-thickness of the plug", "z_0", "m", "distance from the centre to the yield surface";
    PLUG_VELOCITY = "plug_velocity_m_s", "velocity of the plug", "u_plug", "m/s", "velocity of the unyielded core";
    INERTIAL_NUMBER_FILM = "inertial_number", "inertial number", "I", "1", "d |du/dz| sqrt(ρ_p/P_p), uniform over the film";
    SURFACE_VELOCITY = "surface_velocity_m_s", "surface velocity", "u(H)", "m/s", "velocity of the free surface";
    ROUGHNESS = "roughness_m", "equivalent roughness", "k_s", "m", "Nikuradse's equivalent sand roughness; for a sheet flow the mixing length at the bed level";
    ROUGHNESS_LENGTH = "roughness_length_m", "roughness length", "z_0", "m", "elevation at which the logarithmic profile vanishes, k_s/30";
    REYNOLDS_ROUGHNESS = "roughness_reynolds", "roughness Reynolds number", "k_s+", "1", "u_* k_s/ν";
    REYNOLDS_PARTICLE = "particle_reynolds", "particle Reynolds number", "Re_p", "1", "ρ_f |u_f - u_p| d/η with the largest slip between the phases, or |du_p/dz| d where the phases move together";
    REGULARISATION_RATE = "regularisation_error_transport_rate", "error of the transport rate by the regularisation", "Δq_p/q_p", "1", "transport rate minus that of the exact yield on the same mesh, relative to it";
    REGULARISATION_VELOCITY = "regularisation_error_velocity", "error of the velocity by the regularisation", "|ΔU|/|U|", "1", "relative L2 norm over the nodes of the velocity minus that of the exact yield on the same mesh";
    TRANSPORT_RATE_BED = "transport_rate_bed_m2_s", "transport rate of the bed layer", "q_p bed", "m²/s", "part of the transport rate below the bed level";
    TRANSPORT_RATE_SUSPENSION = "transport_rate_suspension_m2_s", "transport rate in suspension", "q_p susp", "m²/s", "part of the transport rate above the bed level";
    TRANSPORT_SHARE_BED = "transport_share_bed", "share of the bed layer", "q_p bed/q_p", "1", "part of the transport rate below the bed level over the whole";
    SHEET_THICKNESS = "sheet_thickness_m", "sheet thickness", "δ_s", "m", "bed level minus the highest level below which φ is within 0.1 % of φ_max";
    SHEET_THICKNESS_FULL = "sheet_thickness_balance_m", "sheet thickness by the momentum balance", "δ_s (32)", "m", "θ d/(μ_s φ_m cos β - (ρ_f/(ρ_p - ρ_f) + φ_m) sin β), φ_m the mean solid fraction of the sheet";
    SHEET_THICKNESS_FLAT = "sheet_thickness_flat_m", "sheet thickness by the balance without slope", "δ_s (33)", "m", "θ d/(μ_s φ_m)";
    SHEET_PHI = "sheet_phi", "mean solid fraction of the sheet", "φ_m", "1", "solid volume of the sheet over its thickness";
    STRESS_CROSSOVER = "stress_crossover", "stress crossover", "(z_x - h_c)/δ_s", "1", "height over the bottom of the sheet at which grains and fluid carry equal stresses, in sheet thicknesses";
    VISCOUS_SHARE = "viscous_share", "viscous share of the stress", "τ_f/τ", "1", "largest viscous over total shear stress in the upper half of the sheet";
    SLOPE_SINE = "slope_sine", "slope", "sin β", "1", "sine of the angle of the flow with the horizontal";
    LID_STRESS = "lid_stress_Pa", "stress of the lid", "τ_top", "Pa", "shear stress that the lid takes from the fluid";
    SOLID_VOLUME_BED = "solid_volume_bed_m", "solid volume of the bed", "V_bed", "m", "integral of φ below the bed level";
    SOLID_VOLUME_SUSPENSION = "solid_volume_suspension_m", "solid volume in suspension", "V_susp", "m", "integral of φ above the bed level";
    SUSPENSION_NUMBER = "suspension_number", "suspension number", "w_s/u_*", "1", "settling velocity over friction velocity";
    FREE_FALL_SHARE = "free_fall_share", "share in free fall", "", "1", "part of the moving solid volume of the bed layer whose rearrangement is a free fall";
    TURBULENT_SHARE = "turbulent_share", "share in turbulent fall", "", "1", "part of the moving solid volume of the bed layer whose rearrangement time is turbulent";
    CUT_EFFECT = "cut_effect", "effect of the cut", "", "1", "largest relative change of the transport rate where the buoyancy of the viscous stress is left out down to the change of type alone, or twice as deep";
    SHIELDS_LEAST = "shields_least", "least Shields number of a moving layer", "θ_0", "1", "Shields number from which on a layer of grains moves, where the flow was followed to that";
    CHANGE_OF_TYPE = "change_of_type_m", "depth of the change of type", "m_0", "m", "solid volume under the bed level down to which the equations as published are of another type";
    FLOW_RATE = "flow_rate_m3_s", "flow rate", "Q", "m³/s", "integral of the mixture velocity over the cross-section";
    FLOW_RATE_DIMENSIONLESS = "flow_rate_dimensionless", "dimensionless flow rate", "Q η/(S H³)", "1", "flow rate over S H³/η, S the stress (ρ_p - ρ_f) g H over a bed, -dp/dx H otherwise";
    BED_FLUX = "bed_flux_m3_s", "bed flux", "Q_p", "m³/s", "integral of φ u_p over the bed: solid volume without pores per unit time";
    BED_FLUX_DIMENSIONLESS = "bed_flux_dimensionless", "dimensionless bed flux", "Q_p η/(S H³)", "1", "bed flux over S H³/η";
    BED_FLUX_MASS = "bed_flux_kg_s", "bed flux by mass", "ρ_p Q_p", "kg/s", "solid mass per unit time";
    U_MAX_DIMENSIONLESS = "u_max_dimensionless", "dimensionless largest velocity", "u_max η/(S H)", "1", "largest mixture velocity over S H/η";
    SECTION_AREA = "section_area_m2", "area of the section", "A", "m²", "of the whole cross-section, bed included";
    PLUG_SHARE = "plug_share", "share of the plug", "A_plug/A", "1", "area that moves without shear over that of the section";
    YIELD_OVER_CRITICAL = "yield_over_critical", "yield stress over that which stops the flow", "τ_0/τ_c", "1", "nothing moves from 1 on; τ_c is the drive times the smallest ratio of area to rim of all parts of the section";
    DEAD_SHARE = "dead_share", "share at rest", "A_dead/A", "1", "area at rest below the yield stress over that of the section";
    STREAM_MAX = "stream_function_max", "strength of the vortex", "|ψ|/(U H)", "1", "largest magnitude of the stream function over velocity of the lid and side";
    VORTEX_Y = "vortex_y_m", "vortex centre across", "y_v", "m", "distance of the largest stream function from the wall that the lid leaves";
    VORTEX_Z = "vortex_z_m", "vortex centre above the bottom", "z_v", "m", "elevation of the largest stream function";
    UNYIELDED_SHARE = "unyielded_share", "unyielded share", "A_0/A", "1", "area below the yield stress, moving or at rest, over that of the section; extrapolated from all and half the cells, with the order of 1 that it has";
    UNYIELDED_SHARE_ERROR = "unyielded_share_error", "error of the unyielded share", "δ(A_0/A)", "1", "what the extrapolation adds, and what it differs by from that of half the cells";
    SECTION_DEVIATION = "section_deviation", "deviation of the whole duct from its section", "|Δu|/u_max", "1", "largest difference of the velocity along the flow from that of the section on the same elements, over the largest velocity";
    CROSS_FLOW = "cross_flow", "flow across the duct", "|v|/u_max", "1", "largest velocity across the whole duct over the largest one along it";
    UNEVEN_FLOW = "uneven_flow", "unevenness along the duct", "|Δ_x u|/u_max", "1", "largest deviation of the velocity from its mean along the whole duct, over the largest velocity";
    PRESSURE_DEVIATION = "pressure_deviation", "deviation of the pressure from the weight", "|Δp|/p_max", "1", "largest difference, but for a constant, of the pressure of the whole duct from the weight of the grains above, over the largest weight";
    UNKNOWNS_WHOLE = "unknowns_whole", "unknowns of the whole duct", "N_3", "1", "components of the velocity that are solved for along, across and upwards; the pressure is eliminated";
    UNKNOWNS = "unknowns", "unknowns", "N", "1", "velocities or stream functions that are solved for";
    ITERATIONS = "iterations", "iterations", "n", "1", "systems solved, on all meshes";
    DUALITY_GAP = "duality_gap", "duality gap", "G", "1", "bound of the error of the minimum over the work of the drive";
    GRAINS = "grains", "grains", "N", "1", "number of mobile grains";
    TIME_STEP = "time_step_s", "time step", "Δt", "s", "of the grains";
    TIME_STEP_RATIO = "time_step_over_limit", "time step over its stability limit", "Δt/Δt_max", "1", "limit of the grain that sets it, with its contacts at the end";
    WELL_POSEDNESS = "well_posedness", "condition of well-posedness", "C", "1", "4n² - 4n + μ²(1 - n/2)², n = I μ'/μ: above 0 the same flow is ill-posed in two and three dimensions (Barker et al. 2015)";
    FROZEN_BELOW = "frozen_below_m", "grains are frozen below", "z_h", "m", "top of the layers of the deep bed that hardly creep and are frozen, at the end";
    DRAG_LIMIT = "time_step_drag_limit_s", "longest time step that the drag bears", "Δt_d", "s", "2 m over the slope of the drag, of the grain where it is least, at the end";
    EXPLICIT_LIMIT = "fluid_step_limit_s", "longest explicit step of the fluid", "Δt_f", "s", "2 over the largest sum of magnitudes in a row of the derivatives of the momentum balance, at the end";
    COORDINATION = "coordination", "coordination number", "Z", "1", "contacts of a mobile grain with grains and walls, mean over time";
    OVERLAP = "overlap_largest", "largest overlap", "δ/d", "1", "over the sum of the radii, of all contacts at the times that are averaged";
    PHI_BULK = "phi_bulk", "solid fraction of the bed", "φ_b", "1", "mean between a quarter and three quarters of the bed";
    WEIGHT_RATIO = "weight_supported", "weight that the bottom supports", "P_p/(m g)", "1", "upward force of bottom, fixed grains and walls on the mobile grains over their weight normal to the bed, mean over time";
    FRICTION_WALLS = "bottom_friction", "friction of the bottom", "τ/P", "1", "force of bottom and walls against the flow over the normal one, mean over time: the tangent of the slope if the flow is steady";
    KINETIC_LEFT = "kinetic_energy_left", "kinetic energy left", "E_k/(m g d)", "1", "mean over the grains and the time averaged";
    RESTITUTION = "restitution", "restitution coefficient", "e", "1", "normal velocity after over before the impact";
    RESTITUTION_ERROR = "restitution_error", "error of the restitution", "Δe/e", "1", "restitution coefficient minus that of the case, relative to it";
    CONTACT_TIME = "contact_time_s", "duration of the contact", "t_c", "s", "from the first to the last step with a force";
    CONTACT_TIME_ERROR = "contact_time_error", "error of the duration", "Δt_c/t_c", "1", "duration minus that of the closed form, relative to it";
    TANGENTIAL_VELOCITY = "tangential_velocity_m_s", "tangential velocity after the impact", "v_t", "m/s", "of the grain relative to what it hits, along its motion before";
    SPIN_AFTER = "spin_1_s", "angular velocity after the impact", "ω", "1/s", "positive rolls with the motion";
    SLIP_ERROR = "gross_slip_error", "error of the gross-slip law", "Δv_t/v", "1", "tangential velocity minus v_t - μ (1 + e) v_n, relative to the velocity; defined where the contact slips throughout";
    ENERGY_GAINED = "energy_gained", "energy gained", "ΔE/E", "1", "kinetic energy after over before the impact, minus 1";
    RESTITUTION_WORST = "restitution_error_largest", "largest error of the restitution", "max |Δe|", "1", "of head-on impacts with restitution coefficients from 0.1 to 1, in both conventions, on wall, fixed and mobile grain";
    RESTITUTION_BIAS = "restitution_bias_default", "bias of the restitution at the default step", "<Δe>", "1", "mean over the moment of touch of e minus that of the case, two mobile grains, step 0.7 of the limit of the pair";
    RESTITUTION_SPREAD = "restitution_spread_default", "spread of the restitution at the default step", "max |Δe|", "1", "largest error over the moment of touch, two mobile grains, step 0.7 of the limit of the pair";
    RESTITUTION_ORDER = "restitution_order", "order of the restitution", "p", "1", "observed between 25 and 200 steps within the contact";
    CONTACT_TIME_WORST = "contact_time_error_largest", "largest error of the duration", "max |Δt_c/t_c|", "1", "of the same impacts, relative to the closed form";
    GROSS_SLIP_WORST = "gross_slip_error_largest", "largest error of the gross-slip law", "max |Δv_t/Δ|", "1", "of oblique impacts at every degree that slip throughout, relative to the change of velocity μ (1 + e) v_n";
    GROSS_SLIP_ANGLES = "gross_slip_angles", "angles of gross slip", "N", "1", "number of whole degrees at which the contact slips throughout";
    SPIN_WORST = "spin_error_largest", "largest error of the spin", "max |Δω/ω|", "1", "of the same oblique impacts, relative to (5/2) μ (1 + e) v_n/R";
    ENERGY_GAINED_WORST = "energy_gained_largest", "largest energy gained", "max ΔE/E", "1", "of impacts at 0 to 89 degrees with e_n 0.1, 0.5, 0.9, 1 and friction 0, 0.1, 0.4, 2";
    ROLLING_TIME_ERROR = "rolling_time_error", "error of the time to rolling", "Δt/t", "1", "relative to 2 v_0/(7 μ g)";
    ROLLING_VELOCITY_ERROR = "rolling_velocity_error", "error of the rolling velocity", "Δv/v", "1", "relative to (5/7) v_0, the worse of translation and rotation";
    BOUNCE_ERROR = "bounce_height_error", "error of the heights of bouncing", "max |Δh/h|", "1", "of three impacts, each relative to e² times the height before";
    STACK_ERROR = "stack_error", "error of the stack", "max |Δδ/δ|", "1", "overlaps of three grains at rest, relative to the weight that each carries over k_n";
    MOMENTUM_ERROR = "momentum_error", "drift of the momentum", "max |Δp|/Σ|p|", "1", "of a free cluster and of a periodic box, relative to the sum of magnitudes";
    ANGULAR_MOMENTUM_ERROR = "angular_momentum_error", "drift of the angular momentum", "max |ΔL|/Σ|L|", "1", "of a free cluster, relative to the sum of magnitudes";
    LEDGER_ERROR = "energy_ledger_error", "defect of the energy balance", "ΔE/E", "1", "kinetic energy against all work over a million steps, relative to the largest";
    SPRING_DEFECT = "spring_energy_defect", "defect of the spring energy", "max |ΔE|/E", "1", "kinetic and spring energy within an elastic impact at 0.7 of the limit of the pair, relative to the energy before";
    SPRING_DEFECT_FINE = "spring_energy_defect_fine", "defect of the spring energy at a tenth of the step", "max |ΔE|/E", "1", "the same at a tenth of that step";
    SPRING_ORDER = "spring_energy_order", "order of the spring energy", "p", "1", "observed between both";
    PRESSURE_ERROR = "pressure_error", "error of the static pressure", "max |ΔP|/P", "1", "particle pressure minus the weight of the grains above, both averaged over a diameter, relative to the weight of all";
    FRICTION_BULK = "friction_bulk", "friction within the flow", "τ_p/P_p", "1", "mean between a quarter and three quarters of the bed";
    INERTIAL_NUMBER_BULK = "inertial_number_bulk", "inertial number within the flow", "I", "1", "d times the difference of velocity over the height between a quarter and three quarters of the bed, times sqrt(ρ_p/P_p)";
    LAYER_BOTTOM = "layer_bottom_m", "bottom of the moving layer", "z_1", "m", "elevation below which 1 % of the grains are transported";
    LAYER_TOP = "layer_top_m", "top of the moving layer", "z_99", "m", "elevation below which 99 % of the grains are transported";
    LAYER_THICKNESS = "layer_thickness_m", "thickness of the moving layer", "δ", "m", "height within which 98 % of the grains are transported, between those with 1 % below and 1 % above";
    TEMPERATURE_MAX = "granular_temperature_max_m2_s2", "largest granular temperature", "T_max", "m²/s²", "where the solid fraction is above 0.001";
    TEMPERATURE_MAX_SCALED = "granular_temperature_max_dimensionless", "largest granular temperature, dimensionless", "T_max*", "1", "T_max/((ρ_p/ρ_f - 1) g d)";
    TEMPERATURE_MAX_LEVEL = "granular_temperature_max_level_m", "level of the largest granular temperature", "z(T_max)", "m", "elevation of the largest granular temperature";
    EFFECTIVE_RESTITUTION = "effective_restitution", "effective restitution coefficient", "e_eff", "1", "restitution coefficient in the dissipation by contacts";
    STATIC_FRICTION = "static_friction", "static friction", "μ_s", "1", "stress ratio of enduring contacts";
    GROWTH_RATE = "growth_rate_1_s", "growth rate of a disturbance", "σ", "1/s", "of the small disturbance of the steady flow that grows fastest; the flow is unstable where it is positive";
    GROWTH_RATE_ERROR = "growth_rate_error_1_s", "error of the growth rate", "δσ", "1/s", "difference from that on half the cells; the growth rate is given up to a tenth of it";
    GROWTH_FREQUENCY = "growth_frequency_1_s", "angular frequency of that disturbance", "ω", "1/s", "0 where it does not oscillate";
    RATE_MEAN = "transport_rate_mean_m2_s", "mean transport rate", "<q_p>", "m²/s", "over the second half of the simulated time";
    RATE_MEAN_SCALED = "transport_rate_mean_dimensionless", "mean dimensionless transport rate", "<Q*>", "1", "over the second half of the simulated time";
    RATE_AMPLITUDE = "transport_rate_amplitude_m2_s", "amplitude of the transport rate", "q̂_p", "m²/s", "half of largest minus smallest, over the whole periods, or the record, that are averaged";
    RATE_FORWARD = "transport_rate_forward_m2_s", "transport rate forward", "q_p+", "m²/s", "mean over the halves of the periods in which the clear fluid goes forward";
    RATE_BACKWARD = "transport_rate_backward_m2_s", "transport rate backward", "q_p-", "m²/s", "mean over the halves of the periods in which the clear fluid goes backward";
    RATE_SWING = "transport_rate_swing", "swing of the transport rate", "Δq_p/<q_p>", "1", "largest minus smallest of the samples in the second half of the simulated time, over their mean";
    SOLIDS_DRIFT = "solids_drift", "drift of the solid volume", "max |ΔV|/V", "1", "largest deviation of the solid volume from that at rest at any step, relative to it";
    STEPS = "time_steps", "time steps", "N", "1", "steps kept";
    STEPS_REFUSED = "time_steps_refused", "time steps refused", "N_0", "1", "steps taken again, shorter";
    NEWTON_ITERATIONS = "newton_iterations", "Newton iterations", "N_N", "1", "linear systems solved, of all stages";
    SOLID_VOLUME = "solid_volume_m", "solid volume", "V", "m", "integral of φ over z; of the mobile grains where they are counted";
    SEEPAGE = "seepage_velocity_m_s", "seepage velocity", "u_f(0)", "m/s", "velocity of the fluid through the lowest cell of the bed";
    WALL_PRESSURE = "wall_pressure_Pa", "pressure on the walls", "p", "Pa", "of grains between two walls, the same at every height";
    WALL_SHEAR = "wall_shear_stress_Pa", "shear stress on the walls", "τ", "Pa", "of grains between two walls, the same at every height";
    WALL_HEAT = "wall_heat_W_m2", "fluctuation energy from the walls", "q_w", "W/m²", "that enters through both walls together";
    UNLIMITED = "unlimited_from_phi", "solid fraction from which saltation limits nothing", "φ_0", "1", "lowest solid fraction of the flow at which a kinetic part of the theory is not positive";
    REYNOLDS_GAP = "reynolds_gap", "Reynolds number of the gap", "Re_h", "1", "ρ_f U h/η, U the mean velocity over the gap h that the fluid has to itself";
    REYNOLDS = "reynolds", "Reynolds number", "Re", "1", "ρ_f U_m H/η";
}

/// The catalogued quantity of that name: a column, a series or a result.
#[must_use]
pub fn find(list: &'static [&'static Quantity], name: &str) -> Option<&'static Quantity> {
    list.iter().copied().find(|q| q.name == name)
}
