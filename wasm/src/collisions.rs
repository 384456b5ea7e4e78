//! What planners ask of the robot's shapes, with what its links carry: among its own links, or among obstacles.

use std::str::FromStr;

use serde::Deserialize;
use serde_json::{Value, json};
use urdd_robot::{
    EdgeSettings, FirstContact, ObstacleDistance, Obstruction, Overlap, PairDistance, Queries,
    RobotError, ShapeKind,
};

use crate::bodies::{Attached, Body};

/// A kind of shapes: `pieces` by default.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub struct Kind(pub ShapeKind);

impl Default for Kind {
    fn default() -> Self {
        Kind(ShapeKind::Pieces)
    }
}

impl TryFrom<String> for Kind {
    type Error = <ShapeKind as FromStr>::Err;

    fn try_from(name: String) -> Result<Self, Self::Error> {
        name.parse().map(Kind)
    }
}

/// Between which shapes.
#[derive(Default, Deserialize)]
pub struct Among {
    #[serde(default)]
    pub kind: Kind,
    /// What links carry.
    #[serde(default)]
    pub attached: Vec<Attached>,
    /// Names of links and attached objects whose pairs are left out.
    #[serde(default)]
    pub without: Vec<[String; 2]>,
    /// Names of links and attached objects that are left out, among obstacles too.
    #[serde(default)]
    pub without_bodies: Vec<String>,
    /// The pairs of a shape of the robot and an obstacle; without, the robot's own pairs.
    pub obstacles: Option<Vec<Body>>,
}

/// A query, with the vocabulary of [`Queries`].
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum About {
    /// Whether shapes touch.
    InCollision { q: Vec<f64> },
    /// The `k` nearest pairs, with their distances and closest points.
    Nearest { q: Vec<f64>, k: usize },
    /// Whether a pair is at most `margin` apart, in metres.
    IsWithin { q: Vec<f64>, margin: f64 },
    /// Where a straight motion is blocked, 0 to 1; null if it is free. It need not be the first such part.
    BlockedEdge(Edge),
    /// Where it is blocked first, and the last part before that is known to be free: `free` and `blocked`; null if it is
    /// free.
    FirstContact(Edge),
    /// As `nearest`, each with `gradient`: m/rad or m/m for each DOF; null where the two touch.
    Gradients { q: Vec<f64>, k: usize },
    /// The pairs that touch or overlap: `depth`, `direction` and `gradient`.
    Penetrations { q: Vec<f64> },
}

/// A straight motion: sampled with a `resolution` (metres of motion), proved without.
#[derive(Deserialize)]
pub struct Edge {
    start: Vec<f64>,
    end: Vec<f64>,
    #[serde(default)]
    margin: f64,
    resolution: Option<f64>,
    /// Whether the kinematic loops of the robot may be open on the way.
    #[serde(default)]
    open_loops: bool,
}

impl Edge {
    fn settings(&self) -> EdgeSettings {
        let Edge { margin, resolution, open_loops, .. } = *self;
        EdgeSettings { margin, resolution, open_loops }
    }
}

impl About {
    /// The answer for the robot's own pairs, or for those of a shape of the robot and an obstacle. `pair` is a pair's value.
    pub fn answer<Q: Queries>(
        &self,
        shapes: &Q,
        pair: fn(&Q::Pair) -> Value,
    ) -> Result<Value, RobotError> {
        Ok(match self {
            About::InCollision { q } => shapes.in_collision(q)?.into(),
            About::Nearest { q, k } => shapes.nearest(q, *k)?.iter().map(pair).collect(),
            About::IsWithin { q, margin } => shapes.is_within(q, *margin)?.into(),
            About::BlockedEdge(edge) => {
                shapes.blocked_edge(&edge.start, &edge.end, &edge.settings())?.into()
            }
            About::FirstContact(edge) => {
                contact(shapes.first_contact(&edge.start, &edge.end, &edge.settings())?)
            }
            About::Gradients { q, k } => {
                let found = shapes.gradients(q, *k)?.into_iter();
                found.map(|found| with(pair(&found.pair), found.gradient)).collect()
            }
            About::Penetrations { q } => overlaps(shapes.penetrations(q)?, pair),
        })
    }
}

/// A pair of the robot's shapes.
pub fn pair(pair: &PairDistance) -> Value {
    json!({
        "links": pair.links.iter().map(|name| name.to_string()).collect::<Vec<_>>(),
        "pieces": pair.pieces,
        "distance": pair.distance,
        "relative": pair.relative,
        "points": pair.points,
    })
}

/// A pair of a shape of the robot and an obstacle.
pub fn to_obstacle(pair: &ObstacleDistance) -> Value {
    json!({
        "link": &*pair.link,
        "piece": pair.piece,
        "obstacle": &*pair.obstacle,
        "distance": pair.distance,
        "points": pair.points,
    })
}

fn contact(found: Option<FirstContact>) -> Value {
    let Some(FirstContact { free, blocked, obstruction, .. }) = found else { return Value::Null };
    let obstruction = match obstruction {
        Obstruction::Open => "open",
        Obstruction::Branch => "branch",
        _ => "contact",
    };
    json!({ "free": free, "blocked": blocked, "obstruction": obstruction })
}

fn with(mut value: Value, gradient: Option<Vec<f64>>) -> Value {
    value["gradient"] = json!(gradient);
    value
}

fn overlaps<P>(found: Vec<Overlap<P>>, pair: impl Fn(&P) -> Value) -> Value {
    let value = |found: Overlap<P>| {
        let mut value = with(pair(&found.pair), Some(found.gradient));
        value["depth"] = json!(found.depth);
        value["direction"] = json!(found.direction);
        value
    };
    found.into_iter().map(value).collect()
}
