//! Obstacles and attached objects in JSON.

use std::borrow::Cow;

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use serde::Deserialize;
use urdd_robot::{Obstacle, Proximity, RobotError, World};

/// A body: `{"name": "shelf", "position": [0, 0, 1], "box": {"half_extents": [1, 0.2, 0.02]}}`. Metres.
#[derive(Clone, PartialEq, Deserialize)]
pub struct Body {
    name: String,
    #[serde(flatten)]
    form: Form,
    /// Of its frame: in the root link's frame, or in that of the link which carries it.
    #[serde(default)]
    position: [f64; 3],
    #[serde(default = "no_turn")]
    quaternion_wxyz: [f64; 4],
    /// Names of links and attached objects that may touch it.
    #[serde(default)]
    ignoring: Vec<String>,
}

/// [`Obstacle::cuboid`] and its siblings. Capsules and cylinders are along the z axis.
#[derive(Clone, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Form {
    Box { half_extents: [f64; 3] },
    Sphere { radius: f64 },
    Capsule { radius: f64, half_length: f64 },
    Cylinder { radius: f64, half_length: f64 },
    Hull { points: Vec<[f64; 3]> },
    Points { points: Vec<[f64; 3]>, radius: f64 },
    HeightField { heights: Vec<f64>, columns: usize, cell: [f64; 2], thickness: f64 },
}

/// A body that a link carries.
#[derive(Clone, PartialEq, Deserialize)]
pub struct Attached {
    /// The index of the link.
    link: usize,
    #[serde(flatten)]
    body: Body,
}

fn no_turn() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

impl Body {
    fn obstacle(&self) -> Result<Obstacle, String> {
        let pose = self.pose()?;
        let name = &self.name;
        let made = match &self.form {
            Form::Box { half_extents } => Obstacle::cuboid(name, pose, *half_extents),
            Form::Sphere { radius } => Obstacle::sphere(name, self.position, *radius),
            Form::Capsule { radius, half_length } => {
                Obstacle::capsule(name, pose, *radius, *half_length)
            }
            Form::Cylinder { radius, half_length } => {
                Obstacle::cylinder(name, pose, *radius, *half_length)
            }
            Form::Hull { points } => Obstacle::hull(name, pose, points),
            Form::Points { points, radius } => Obstacle::points(name, pose, points, *radius),
            Form::HeightField { heights, columns, cell, thickness } => {
                Obstacle::height_field(name, pose, heights, *columns, *cell, *thickness)
            }
        };
        let made = made.map_err(|error| error.to_string())?;
        let ignored = self.ignoring.iter();
        Ok(ignored.fold(made, |made, link| made.ignoring(link)))
    }

    fn pose(&self) -> Result<Isometry3<f64>, String> {
        pose(self.position, self.quaternion_wxyz)
    }

    /// Whether another body is the same, elsewhere.
    fn is_moved(&self, other: &Body) -> bool {
        (&self.name, &self.form, &self.ignoring) == (&other.name, &other.form, &other.ignoring)
    }
}

/// The last obstacles that were asked about: those that stay or move are not prepared again.
#[derive(Default)]
pub struct Obstacles {
    bodies: Vec<Body>,
    world: World,
}

impl Obstacles {
    /// The world of these bodies.
    pub fn world(&mut self, bodies: &[Body]) -> Result<&World, String> {
        if self.bodies != bodies {
            let known = self.bodies.iter().zip(self.world.obstacles());
            let known: Vec<(&Body, &Obstacle)> = known.collect();
            let made = bodies.iter().map(|body| {
                match known.iter().find(|(other, _)| body.is_moved(other)) {
                    Some((other, obstacle)) if *other == body => Ok((*obstacle).clone()),
                    Some((_, obstacle)) => {
                        let moved = obstacle.at(body.pose()?);
                        moved.map_err(|error| error.to_string())
                    }
                    None => body.obstacle(),
                }
            });
            let world = World::new(made.collect::<Result<Vec<Obstacle>, String>>()?);
            (self.bodies, self.world) = (bodies.to_vec(), world);
        }
        Ok(&self.world)
    }
}

/// The robot's shapes with these objects on its links, without the pairs and bodies of these names.
pub fn carrying<'a>(
    shapes: &'a Proximity,
    attached: &[Attached],
    without: &[[String; 2]],
    without_bodies: &[String],
) -> Result<Cow<'a, Proximity>, String> {
    if attached.is_empty() && without.is_empty() && without_bodies.is_empty() {
        return Ok(Cow::Borrowed(shapes));
    }
    let said = |error: RobotError| error.to_string();
    let with = attached.iter().try_fold(shapes.clone(), |with, attached| {
        with.attach(attached.link, &attached.body.obstacle()?).map_err(said)
    })?;
    let pairs = without.iter().map(|pair| pair.each_ref().map(String::as_str));
    let with = with.without(pairs).map_err(said)?;
    let with = with.without_bodies(without_bodies.iter().map(String::as_str));
    with.map(Cow::Owned).map_err(said)
}

/// The pose of a position, in metres, and a quaternion w, x, y, z, which is normalised.
pub fn pose(position: [f64; 3], [w, x, y, z]: [f64; 4]) -> Result<Isometry3<f64>, String> {
    let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9);
    let turn = turn.ok_or("`quaternion_wxyz` is not a rotation")?;
    Ok(Isometry3::from_parts(Translation3::from(position), turn))
}
