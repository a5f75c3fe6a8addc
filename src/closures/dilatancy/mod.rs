//! How grains spread where they shear.

use super::role::laws;

laws! {{
    none::None,
    phi_i::PhiI(..),
    phi_iv::PhiIv(..),
}}
