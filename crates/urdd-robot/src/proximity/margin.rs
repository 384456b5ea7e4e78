//! Whether anything is nearer than a margin.

use super::{Proximity, Workspace};
use crate::edge::{Checked, any_within, check_margin};
use crate::error::RobotError;

impl Proximity {
    /// Whether any pair is at most `margin` apart, m. Stops at the first such pair. With a margin of 0, this is
    /// [`Proximity::in_collision`]; with another one, pairs count whose links can move against each other.
    ///
    /// # Errors
    /// [`RobotError::Setting`] if the margin is negative or not finite; and as [`Proximity::closest_points`].
    pub fn is_within(&self, configuration: &[f64], margin: f64) -> Result<bool, RobotError> {
        self.is_within_with(configuration, margin, &mut Workspace::default())
    }

    /// As [`Proximity::is_within`], with memory that is used again: it does not allocate.
    ///
    /// # Errors
    /// As there.
    pub fn is_within_with(
        &self,
        configuration: &[f64],
        margin: f64,
        workspace: &mut Workspace,
    ) -> Result<bool, RobotError> {
        check_margin(margin)?;
        let placed = &mut workspace.placed;
        Checked::place(self, configuration, placed)?;
        Ok(any_within(self, placed, margin))
    }
}
