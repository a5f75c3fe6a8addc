//! What a wall does to a turbulent flow.

use super::role::laws;

laws! {{
    rough::Rough(..),
}}
