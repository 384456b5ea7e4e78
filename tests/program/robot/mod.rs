//! `urdd_robot`: queries of a robot, compared with closed forms, finite differences and other methods.

mod cancelled;
mod carrying;
mod changing;
mod command;
mod inverse;
mod motion;
mod nearness;
mod opening;
mod planning;
mod world;

use testkit::robots::{made, made_of, our_robots};
