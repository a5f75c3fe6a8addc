//! Force between the fluid and the grains.

use super::role::laws;

laws! {{
    none::None,
    carman_kozeny::CarmanKozeny(..),
    dallavalle::Dallavalle(..),
    dallavalle_grain::DallavalleGrain(..),
}}
