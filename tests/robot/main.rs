//! `urdd::robot`: a robot asked about itself, against closed forms, differences and other ways to the same number.

#[path = "../support/mod.rs"]
#[allow(unused)]
mod support;

#[path = "../support/robots.rs"]
mod robots;

mod cancelled;
mod command;
mod inverse;
mod motion;
mod nearness;
mod opening;
mod world;

use robots::{made, made_of, our_robots};
