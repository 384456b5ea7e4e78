//! Plans a motion among obstacles by RRT-Connect, and proves it free. Prints the path as CSV.
//!
//! `cargo run --release --example rrt_connect -- URDD [SEED]`

#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::error::Error;

use nalgebra::Isometry3;
use urdd_robot::{
    EdgeSettings, Obstacle, Proximity, Queries, Robot, RobotError, ShapeKind, World, WorldProximity,
};

/// The longest motion that a tree grows by, rad or m.
const STEP: f64 = 0.3;

type Checks<'a> = (&'a Proximity, &'a WorldProximity<&'a Proximity>);

/// Whether the motion from `a` to `b` touches neither the robot nor an obstacle.
pub fn is_free(
    (own, world): Checks,
    a: &[f64],
    b: &[f64],
    resolution: Option<f64>,
) -> Result<bool, RobotError> {
    let settings = EdgeSettings { margin: 0.0, resolution, ..Default::default() };
    Ok(world.blocked_edge(a, b, &settings)?.is_none()
        && own.blocked_edge(a, b, &settings)?.is_none())
}

/// A path from `start` to `goal`; `None` if none is found. `sample` gives configurations.
pub fn plan(
    checks: Checks,
    start: &[f64],
    goal: &[f64],
    mut sample: impl FnMut() -> Vec<f64>,
) -> Result<Option<Vec<Vec<f64>>>, RobotError> {
    let mut trees = [start, goal].map(|root| vec![(root.to_vec(), 0)]);
    let grow = |tree: &mut Vec<(Vec<f64>, usize)>,
                target: &[f64]|
     -> Result<Option<Vec<f64>>, RobotError> {
        let distance =
            |q: &[f64]| q.iter().zip(target).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        let near = (0..tree.len())
            .min_by(|a, b| distance(&tree[*a].0).total_cmp(&distance(&tree[*b].0)))
            .unwrap_or(0);
        let part = (STEP / distance(&tree[near].0)).min(1.0);
        let new: Vec<f64> = match part < 1.0 {
            true => tree[near].0.iter().zip(target).map(|(a, b)| a + part * (b - a)).collect(),
            false => target.to_vec(),
        };
        let free = is_free(checks, &tree[near].0, &new, Some(0.02))?;
        Ok(free.then(|| {
            tree.push((new.clone(), near));
            new
        }))
    };
    let path = |tree: &[(Vec<f64>, usize)]| {
        let mut path = vec![tree[tree.len() - 1].0.clone()];
        let mut at = tree.len() - 1;
        while at != 0 {
            at = tree[at].1;
            path.push(tree[at].0.clone());
        }
        path
    };
    for turn in 0..20_000 {
        let [a, b] = &mut trees;
        let Some(new) = grow(a, &sample())? else {
            trees.swap(0, 1);
            continue;
        };
        while let Some(reached) = grow(b, &new)? {
            if reached == new {
                let mut own = path(a);
                own.reverse();
                own.extend(path(b).into_iter().skip(1));
                if turn % 2 == 1 {
                    own.reverse()
                }
                return Ok(Some(own));
            }
        }
        trees.swap(0, 1);
    }
    Ok(None)
}

/// A table below the robot, on which the links stand that do not move, and a ball in its way.
pub fn world(robot: &Robot) -> Result<World, RobotError> {
    let table =
        Obstacle::cuboid("table", Isometry3::translation(0.0, 0.0, -0.05), [1.0, 1.0, 0.05])?;
    let ball = Obstacle::sphere("ball", [0.45, 0.1, 0.6], 0.15)?;
    let mut world = World::new([ball]);
    let still = |link: &usize| robot.dofs_between(0, *link).is_ok_and(|dofs| dofs.is_empty());
    let names = robot.link_names()?;
    let still = (0..names.len()).filter(still);
    world.put(still.fold(table, |table, link| table.ignoring(&names[link])));
    Ok(world)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let robot = Robot::open(words.next().ok_or("give a URDD")?)?;
    let seed: u64 = words.next().map_or(Ok(0), |word| word.parse())?;
    let proximity = robot.proximity(ShapeKind::Pieces)?;
    let world = proximity.world_proximity(&world(&robot)?)?;
    let checks = (&proximity, &world);
    let space = robot.configurations()?;
    let mut samples = (1_000_000 * seed..).map(|k| space.random(k));
    let mut next = || samples.next().unwrap_or_default();
    let mut free = || {
        std::iter::repeat_with(&mut next)
            .find(|q| is_free(checks, q, q, Some(1.0)) == Ok(true))
            .unwrap_or_default()
    };
    let (start, goal) = (free(), free());
    let path = plan(checks, &start, &goal, next)?.ok_or("no path was found")?;
    println!("{}", robot.dof_names()?.join(","));
    for q in &path {
        println!("{}", q.iter().map(f64::to_string).collect::<Vec<_>>().join(","));
    }
    let mut proved = true;
    for edge in path.windows(2) {
        proved &= is_free(checks, &edge[0], &edge[1], None)?;
    }
    eprintln!(
        "{} configurations; {}",
        path.len(),
        if proved { "proved free" } else { "not proved free" }
    );
    Ok(())
}
