//! Spheres in the place of a robot's shapes.

mod answer;
mod block;
mod check;
mod checker;
mod level;
mod model;
mod obstacles;
mod run;
mod screened;
mod tape;

pub use answer::{ApproximateAnswer, Approximating, Coverage, Covering, CoveringAnswer};
pub use checker::SphereChecker;
pub use level::{LinkSpheres, Sphere, SphereLevel};
pub use screened::ScreenedProximity;
