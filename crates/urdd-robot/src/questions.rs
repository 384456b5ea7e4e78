//! What both the robot's own pairs and those with obstacles are asked, written once.

/// The methods of a type whose pairs can be [checked](crate::checked::Checked), with the type of a pair in answers.
macro_rules! questions {
    ($pair:ty, $($head:tt)+) => {
        $($head)+ {
            /// Whether any pair touches or overlaps, that is, has distance 0. Stops at the first collision.
            ///
            /// # Errors
            /// As [`Proximity::closest_points`].
            pub fn in_collision(&self, configuration: &[f64]) -> Result<bool, RobotError> {
                self.in_collision_with(configuration, &mut Workspace::default())
            }

            /// As `in_collision`, with memory that is used again: it does not allocate.
            ///
            /// # Errors
            /// As there.
            pub fn in_collision_with(
                &self,
                configuration: &[f64],
                workspace: &mut Workspace,
            ) -> Result<bool, RobotError> {
                self.is_within_with(configuration, 0.0, workspace)
            }

            /// Whether any pair is at most `margin` apart, m. Stops at the first such pair. With a margin of 0, this is
            /// `in_collision`; with another one, those of the robot's own pairs count whose links can move against each
            /// other.
            ///
            /// # Errors
            /// [`RobotError::Setting`] if the margin is negative or not finite; and as [`Proximity::closest_points`].
            pub fn is_within(&self, configuration: &[f64], margin: f64) -> Result<bool, RobotError> {
                self.is_within_with(configuration, margin, &mut Workspace::default())
            }

            /// As `is_within`, with memory that is used again: it does not allocate.
            ///
            /// # Errors
            /// As there.
            pub fn is_within_with(
                &self,
                configuration: &[f64],
                margin: f64,
                workspace: &mut Workspace,
            ) -> Result<bool, RobotError> {
                let margin = $crate::checked::check_margin(margin)?;
                self.shapes().place(configuration, &mut workspace.placed)?;
                Ok($crate::checked::any_within(self, &workspace.placed, margin))
            }

            /// The `k` nearest pairs, nearest first; all pairs if there are fewer. Ties are in the order of the pairs.
            /// Among obstacles, a pair is a shape of the robot and a convex part of an obstacle.
            ///
            /// # Errors
            /// As [`Proximity::closest_points`].
            pub fn nearest(&self, configuration: &[f64], k: usize) -> Result<Vec<$pair>, RobotError> {
                let mut all = Vec::new();
                self.nearest_with(configuration, k, &mut Workspace::default(), |one| all.push(one))?;
                Ok(all)
            }

            /// As `nearest`: calls `each` with one after another. With memory that is used again, it does not allocate.
            ///
            /// # Errors
            /// As there.
            pub fn nearest_with(
                &self,
                configuration: &[f64],
                k: usize,
                workspace: &mut Workspace,
                each: impl FnMut($pair),
            ) -> Result<(), RobotError> {
                $crate::checked::nearest(self, configuration, k, workspace, each)
            }

            /// The pairs of `nearest`, with the gradients of their distances.
            ///
            /// # Errors
            /// As there.
            pub fn gradients(
                &self,
                configuration: &[f64],
                k: usize,
            ) -> Result<Vec<Gradient<$pair>>, RobotError> {
                let (mut all, mut workspace) = (Vec::new(), Workspace::default());
                self.gradients_with(configuration, k, &mut workspace, |pair, gradient| {
                    all.push(Gradient { pair, gradient: gradient.map(<[f64]>::to_vec) });
                })?;
                Ok(all)
            }

            /// As `gradients`: calls `each` with one pair and its [gradient](Gradient::gradient) after another. With
            /// memory that is used again, it does not allocate.
            ///
            /// # Errors
            /// As there.
            pub fn gradients_with(
                &self,
                configuration: &[f64],
                k: usize,
                workspace: &mut Workspace,
                each: impl FnMut($pair, Option<&[f64]>),
            ) -> Result<(), RobotError> {
                $crate::checked::gradients(self, configuration, k, workspace, each)
            }

            /// The pairs that touch or overlap, in order, with how far they do.
            ///
            /// # Errors
            /// As [`Proximity::closest_points`].
            pub fn penetrations(
                &self,
                configuration: &[f64],
            ) -> Result<Vec<Overlap<$pair>>, RobotError> {
                let (mut all, mut workspace) = (Vec::new(), Workspace::default());
                let each = |one| all.push(one);
                $crate::checked::penetrations(self, configuration, &mut workspace, each)?;
                Ok(all)
            }

            /// Where the straight motion from `start` to `end` is blocked: a part of it, from 0 to 1, at which a pair is
            /// at most [`EdgeSettings::margin`] apart. `None` if it is free.
            ///
            /// With a resolution, configurations along the motion are checked, the end and the halves first, so that a
            /// blocked motion is found early. The answer is one of those that are blocked, and need not be the first:
            /// `first_contact` has that. Without a resolution, the motion is proved free by conservative advancement:
            /// every distance is divided by a bound on how fast it can shrink. It then needs 0.1 mm more than the margin
            /// of pairs that move against each other, and the answer is the first part where they have less.
            ///
            /// # Errors
            /// [`RobotError::Setting`] if a setting makes no sense; [`RobotError::Steps`] if the motion needs more than
            /// a million configurations, or its proof more than 100,000 steps; and as [`Proximity::closest_points`].
            pub fn blocked_edge(
                &self,
                start: &[f64],
                end: &[f64],
                settings: &EdgeSettings,
            ) -> Result<Option<f64>, RobotError> {
                self.blocked_edge_with(start, end, settings, &mut Workspace::default())
            }

            /// As `blocked_edge`, with memory that is used again.
            ///
            /// # Errors
            /// As there.
            pub fn blocked_edge_with(
                &self,
                start: &[f64],
                end: &[f64],
                settings: &EdgeSettings,
                workspace: &mut Workspace,
            ) -> Result<Option<f64>, RobotError> {
                $crate::edge::blocked(self, [start, end], settings, workspace)
            }

            /// Where the straight motion from `start` to `end` is blocked first, and how far it is free; `None` if it is
            /// free.
            ///
            /// With a resolution, the configurations of `blocked_edge` are checked in order. The part between the first
            /// that is blocked and the one before is then halved ten times: no point of the robot travels farther
            /// between [`FirstContact::free`] and [`FirstContact::blocked`] than a thousandth of the resolution. Both
            /// were checked. A contact that begins and ends between two configurations can be missed. Without a
            /// resolution, the whole motion up to `free` is proved free, and `blocked` is as in `blocked_edge`.
            ///
            /// # Errors
            /// As `blocked_edge`.
            pub fn first_contact(
                &self,
                start: &[f64],
                end: &[f64],
                settings: &EdgeSettings,
            ) -> Result<Option<FirstContact>, RobotError> {
                self.first_contact_with(start, end, settings, &mut Workspace::default())
            }

            /// As `first_contact`, with memory that is used again.
            ///
            /// # Errors
            /// As there.
            pub fn first_contact_with(
                &self,
                start: &[f64],
                end: &[f64],
                settings: &EdgeSettings,
                workspace: &mut Workspace,
            ) -> Result<Option<FirstContact>, RobotError> {
                $crate::edge::first_contact(self, [start, end], settings, workspace)
            }
        }
    };
}

pub(super) use questions;
