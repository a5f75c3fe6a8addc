//! Friction of the grains: the ratio mu = tau_p / P_p at which they shear.

use super::role::laws;

laws! {{
    coulomb::Coulomb(..),
    mu_i::MuI(..),
    mu_iv::MuIv(..),
}}
