//! `urdd_robot`: a robot asked about itself, against closed forms, differences and other ways to the same number.

mod cancelled;
mod command;
mod inverse;
mod motion;
mod nearness;
mod opening;
mod world;

use testkit::robots::{made, made_of, our_robots};
