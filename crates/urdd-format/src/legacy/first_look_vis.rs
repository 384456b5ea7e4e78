//! `first_look_vis_module` 0.0.1: a viewer's state.

use crate::types::module;

module! {
    /// Says that a person has looked at the robot in the converter's viewer. No robot data.
    pub struct FirstLookVisModule {
        /// Always null.
        pub done: (),
    }
}
