//! A robot with spheres for its links. What the module says of them is computed here, from SPEC 8.9 and for boxes alone.

use serde_json::{Value, json};
use urdd_format::registry::ModuleKind;
use urdd_format::urdf::{Axis, JointType};

use super::core::{Core, link_transforms, sampled_configuration};
use super::fixture::Fixture;
use super::meshes::{Meshes, Point, Solid, TRIANGLES, cross, dot, minus};
use super::robot::{Robot, collision, cuboid, joint, limit, link, origin, solid_box};
use super::shapes::boxes_touch;
use super::transform::{Transform, apply, norm};

/// Name of the module.
pub const SPHERES: &str = "link_shapes_spheres_module";

/// Number of sampled configurations of the base.
pub const SAMPLES: u32 = 200;

/// A sphere, with its outer one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Centre in the link's frame, m.
    pub at: Point,
    /// Radius, m.
    pub radius: f64,
    /// The sphere of the same link in the outer level.
    pub outer: Option<usize>,
}

/// A level before its figures are known.
#[derive(Debug, Clone)]
pub struct Level {
    pub is_given: bool,
    pub covers: bool,
    pub outer: Option<usize>,
    /// The spheres of each link.
    pub balls: Vec<Vec<Ball>>,
    pub ignored: Vec<[usize; 2]>,
}

/// A post whose halves reach into each other, a two-link arm that can fold back onto it, a flange without a shape, a slider
/// beside it, and a camera far away.
pub fn robot() -> Robot {
    let mut robot = Robot::new("arm with spheres");
    robot.overlap = 0.02;
    for (name, size, at, rpy) in [
        ("post", [0.2, 0.2, 0.2], [0.0; 3], [0.0; 3]),
        ("arm", [0.3, 0.05, 0.05], [0.15, 0.0, 0.0], [0.0; 3]),
        ("tip", [0.3, 0.04, 0.04], [0.15, 0.0, 0.0], [0.2, -0.1, 0.3]),
        ("flange", [0.0; 3], [0.0; 3], [0.0; 3]),
        ("slider", [0.1, 0.1, 0.1], [0.0; 3], [0.0; 3]),
        ("camera", [0.04, 0.05, 0.06], [0.0, 0.01, 0.0], [0.0; 3]),
    ] {
        let mut link = link(name);
        link.inertial = Some(solid_box(1.0, [0.1; 3]));
        if size[0] > 0.0 {
            link.collision = vec![collision(origin(at, rpy), cuboid(size))];
        }
        robot.urdf.links.push(link);
    }
    for (name, joint_type, parent, child, at) in [
        ("shoulder", JointType::Revolute, "post", "arm", [0.0, 0.0, 0.3]),
        ("elbow", JointType::Revolute, "arm", "tip", [0.3, 0.0, 0.0]),
        ("mount", JointType::Fixed, "tip", "flange", [0.3, 0.0, 0.0]),
        ("slide", JointType::Prismatic, "post", "slider", [0.4, 0.0, 0.0]),
        ("stand", JointType::Fixed, "post", "camera", [-0.8, 0.0, 0.0]),
    ] {
        let mut joint = joint(name, joint_type, parent, child);
        joint.origin = origin(at, [0.0; 3]);
        let (axis, limits) = match joint_type {
            JointType::Fixed => (None, None),
            JointType::Prismatic => (Some([0.0, 0.0, 1.0]), limit(-0.2, 0.6)),
            _ => (Some([0.0, 1.0, 0.0]), limit(-2.5, 2.5)),
        };
        joint.axis = axis.map(|xyz| Axis { xyz: Some(xyz) });
        joint.limit = limits;
        robot.urdf.joints.push(joint);
    }
    robot
}

/// A level around each box, one that covers by spheres around parts of the boxes, and one that a person gave.
pub fn levels() -> Vec<Level> {
    let meshes = Meshes::new(&robot());
    let solids = meshes.solids.iter();
    let parts =
        solids.map(|solids| solids.as_ref().map_or_else(Vec::new, |of| around_parts(&of.whole)));
    let covering = Level {
        is_given: false,
        covers: true,
        outer: Some(0),
        balls: parts.collect(),
        ignored: Vec::new(),
    };
    let ball = |x: f64, y: f64, z: f64, radius: f64| Ball { at: [x, y, z], radius, outer: Some(0) };
    let given = Level {
        is_given: true,
        covers: false,
        outer: Some(0),
        balls: vec![
            vec![ball(0.0, 0.0, 0.01, 0.105)],
            vec![
                ball(0.05, 0.0, 0.0, 0.03),
                ball(0.15, 0.0, 0.0, 0.035),
                ball(0.27, 0.0, 0.0, 0.035),
            ],
            // Two are equal.
            vec![
                ball(0.06, 0.0, 0.0, 0.025),
                ball(0.06, 0.0, 0.0, 0.025),
                ball(0.2, 0.01, 0.0, 0.03),
            ],
            vec![],
            vec![ball(0.0, 0.0, 0.0, 0.1)],
            vec![],
        ],
        ignored: vec![[1, 4]],
    };
    let centres = meshes.solids.iter().map(|of| of.as_ref().map(|of| of.whole.centre));
    let first = centres.enumerate().map(|(link, at)| {
        let Some(at) = at else { return Vec::new() };
        let inner = covering.balls[link].iter().chain(&given.balls[link]);
        let reaches = inner.map(|ball| norm(minus(ball.at, at)) + ball.radius);
        vec![Ball { at, radius: reaches.fold(0.0, f64::max), outer: None }]
    });
    let first = Level {
        is_given: false,
        covers: true,
        outer: None,
        balls: first.collect(),
        ignored: Vec::new(),
    };
    vec![first, covering, given]
}

/// Spheres around the parts of a box that is cut along its first axis, into four.
fn around_parts(solid: &Solid) -> Vec<Ball> {
    let of = Box3::of(solid);
    let half = [0, 1, 2].map(|axis| (of.high[axis] - of.low[axis]) / 2.0);
    let radius = norm([half[0] / 4.0, half[1], half[2]]);
    let part = |k: usize| {
        let along = half[0] * (k as f64 * 0.5 - 0.75);
        let middle = [0, 1, 2].map(|axis| (of.high[axis] + of.low[axis]) / 2.0);
        let at = of.placed([middle[0] + along, middle[1], middle[2]]);
        Ball { at, radius, outer: Some(0) }
    };
    (0..4).map(part).collect()
}

/// A box by its bounds in a frame of its own.
struct Box3 {
    centre: Point,
    rows: [[f64; 3]; 3],
    low: Point,
    high: Point,
}

impl Box3 {
    fn of(solid: &Solid) -> Self {
        let mut of =
            Box3 { centre: solid.centre, rows: solid.rotation(), low: [0.0; 3], high: [0.0; 3] };
        for corner in solid.corners {
            let local = of.local(corner);
            of.low = [0, 1, 2].map(|axis| of.low[axis].min(local[axis]));
            of.high = [0, 1, 2].map(|axis| of.high[axis].max(local[axis]));
        }
        of
    }

    fn local(&self, point: Point) -> Point {
        let way = minus(point, self.centre);
        [0, 1, 2].map(|axis| (0..3).map(|row| self.rows[row][axis] * way[row]).sum())
    }

    fn placed(&self, local: Point) -> Point {
        [0, 1, 2].map(|row| self.centre[row] + dot(self.rows[row], local))
    }

    /// The distance of a point; 0 inside.
    fn distance(&self, point: Point) -> f64 {
        let local = self.local(point);
        norm([0, 1, 2].map(|k| (self.low[k] - local[k]).max(local[k] - self.high[k]).max(0.0)))
    }

    /// How deep inside a point is; negative outside.
    fn depth(&self, point: Point) -> f64 {
        let local = self.local(point);
        let depths = (0..3).map(|k| (local[k] - self.low[k]).min(self.high[k] - local[k]));
        depths.fold(f64::INFINITY, f64::min)
    }
}

/// The diagonal of the box along the axes around all corners.
pub fn diagonal(solids: &[Solid]) -> f64 {
    let corners = || solids.iter().flat_map(|solid| solid.corners);
    norm([0, 1, 2].map(|axis| {
        let along = || corners().map(|corner| corner[axis]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    }))
}

/// The fit of the spheres of a link (8.9.5): its four figures.
pub fn fit(solids: &[Solid], balls: &[Ball]) -> [f64; 4] {
    let boxes: Vec<Box3> = solids.iter().map(Box3::of).collect();
    let diagonal = diagonal(solids);
    let (mut max_standoff, mut sum, mut weights) = (0.0_f64, 0.0, 0.0);
    for (own, ball) in balls.iter().enumerate() {
        for k in 0..64 {
            let z = 1.0 - f64::from(2 * k + 1) / 64.0;
            let s = (1.0 - z * z).sqrt();
            let turns = 0.6180339887498949 * f64::from(k);
            let a = std::f64::consts::TAU * (turns - turns.floor());
            let way = [s * a.cos(), s * a.sin(), z];
            let point = [0, 1, 2].map(|axis| ball.at[axis] + ball.radius * way[axis]);
            let mut others = balls.iter().enumerate().filter(|(other, _)| *other != own);
            if others.any(|(_, of)| norm(minus(point, of.at)) < (1.0 - 1e-6) * of.radius) {
                continue;
            }
            let distance = boxes.iter().map(|of| of.distance(point)).fold(f64::INFINITY, f64::min);
            max_standoff = max_standoff.max(distance);
            sum += ball.radius.powi(2) * distance;
            weights += ball.radius.powi(2);
        }
    }
    let (mut out, mut all, mut max_uncovered) = (0.0, 0.0, 0.0_f64);
    for (own, solid) in solids.iter().enumerate() {
        for (point, weight) in centroids(solid, diagonal) {
            let mut others = boxes.iter().enumerate().filter(|(other, _)| *other != own);
            if others.any(|(_, of)| of.depth(point) > 1e-6 * diagonal) {
                continue;
            }
            all += weight;
            let outside = balls.iter().map(|of| norm(minus(point, of.at)) - of.radius);
            let outside = outside.fold(f64::INFINITY, f64::min);
            if outside > 1e-6 * diagonal {
                out += weight;
                max_uncovered = max_uncovered.max(outside);
            }
        }
    }
    let mean = if weights > 0.0 { sum / weights } else { 0.0 };
    [max_standoff, mean, out / all, max_uncovered]
}

/// The centroids of the parts of a box's triangles (8.9.5), each with the area of its part.
pub fn centroids(solid: &Solid, diagonal: f64) -> Vec<(Point, f64)> {
    let mut found = Vec::new();
    for triangle in TRIANGLES {
        let [a, b, c] = triangle.map(|corner| solid.corners[usize::from(corner)]);
        let [u, v] = [minus(b, a), minus(c, a)];
        let longest = norm(u).max(norm(v)).max(norm(minus(c, b)));
        let n = (15.7 * longest / diagonal).ceil();
        let weight = norm(cross(u, v)) / 2.0 / (n * n);
        // Of all places whose coordinates are 1 or 2 thirds of a part more than a whole number of parts, those within the
        // triangle.
        for i in 0..n as u32 {
            for j in 0..n as u32 {
                for thirds in [1, 2] {
                    let [x, y] = [i, j].map(|k| f64::from(3 * k + thirds));
                    if x + y < 3.0 * n {
                        let at = |k: usize| a[k] + (x * u[k] + y * v[k]) / (3.0 * n);
                        found.push(([at(0), at(1), at(2)], weight));
                    }
                }
            }
        }
    }
    found
}

/// The pairs of links that are not skipped, listed by hand: of the others, one moves or holds the other.
pub const ASKED: [[usize; 2]; 6] = [[0, 2], [1, 4], [1, 5], [2, 4], [2, 5], [4, 5]];

/// Pairs of links with spheres, each with the configurations in which they are in contact.
type Touching = Vec<([usize; 2], Vec<bool>)>;

/// In which of the sampled configurations links are in contact, by pieces and by spheres.
struct Contacts {
    collides: Vec<bool>,
    /// For each level.
    levels: Vec<Touching>,
}

fn contacts(robot: &Robot, meshes: &Meshes, levels: &[Level], samples: u32) -> Contacts {
    let core = Core::new(robot);
    let at = |k: u32| {
        let q = sampled_configuration(robot, &core, (1 << 31) + k);
        link_transforms(robot, &core, &q)
    };
    let poses: Vec<Vec<Transform>> = (0..samples).map(at).collect();
    let pieces_touch = |at: &Vec<Transform>, [a, b]: [usize; 2]| {
        let placed = |link: usize| -> Vec<[Point; 8]> {
            let pieces = meshes.solids[link].iter().flat_map(|solids| &solids.pieces);
            pieces.map(|piece| piece.corners.map(|corner| apply(&at[link], corner))).collect()
        };
        let (a, b) = (placed(a), placed(b));
        a.iter().any(|a| b.iter().any(|b| boxes_touch(a, b)))
    };
    let balls_touch = |at: &Vec<Transform>, level: &Level, [a, b]: [usize; 2]| {
        let placed = |link: usize| {
            let balls = level.balls[link].iter();
            balls.map(move |ball| (apply(&at[link], ball.at), ball.radius))
        };
        let mut pairs = placed(a).flat_map(|a| placed(b).map(move |b| (a, b)));
        pairs.any(|((p, r), (q, s))| norm(minus(p, q)) <= r + s)
    };
    let collides = poses.iter().map(|at| ASKED.iter().any(|pair| pieces_touch(at, *pair)));
    let of_level = |level: &Level| {
        let with_spheres: Vec<usize> =
            (0..level.balls.len()).filter(|link| !level.balls[*link].is_empty()).collect();
        let mut pairs = Vec::new();
        for (place, a) in with_spheres.iter().enumerate() {
            for b in &with_spheres[place + 1..] {
                let touch = poses.iter().map(|at| balls_touch(at, level, [*a, *b]));
                pairs.push(([*a, *b], touch.collect()));
            }
        }
        pairs
    };
    Contacts { collides: collides.collect(), levels: levels.iter().map(of_level).collect() }
}

/// Pairs of links, as the module lists them.
pub fn pairs(list: impl IntoIterator<Item = [usize; 2]>) -> Value {
    let pair = |[a, b]: [usize; 2]| json!({ "link_a_idx": a, "link_b_idx": b });
    list.into_iter().map(pair).collect()
}

/// The module of these levels for a robot whose pairs [`ASKED`] lists.
pub fn document(robot: &Robot, levels: &[Level], samples: u32) -> Value {
    let meshes = Meshes::new(robot);
    let found = contacts(robot, &meshes, levels, samples);
    let of_level = |(level, contacts): (&Level, &Touching)| {
        let fits = level.balls.iter().zip(&meshes.solids).map(|(balls, solids)| {
            let solids = solids.as_ref().filter(|_| !balls.is_empty())?;
            let [max, mean, fraction, uncovered] = fit(&solids.pieces, balls);
            Some(json!({
                "max_standoff": max, "mean_standoff": mean,
                "uncovered_fraction": fraction, "max_uncovered": uncovered,
            }))
        });
        let sphere = |ball: &Ball| json!({ "radius": ball.radius, "offset_xyz": ball.at, "outer_sphere_idx": ball.outer });
        let of_link = |balls: &Vec<Ball>| balls.iter().map(sphere).collect::<Value>();
        let always = contacts.iter().filter(|(_, touch)| touch.iter().all(|touch| *touch));
        let sometimes =
            contacts.iter().filter(|(_, touch)| touch.contains(&true) && touch.contains(&false));
        let asked = |pair: &[usize; 2]| ASKED.contains(pair) && !level.ignored.contains(pair);
        let touches = |k: usize| contacts.iter().any(|(pair, touch)| asked(pair) && touch[k]);
        let count = |collides: bool, touch: Option<bool>| {
            let all = found.collides.iter().enumerate();
            let counted = all.filter(|(k, is)| {
                **is == collides && touch.is_none_or(|touch| touches(*k) == touch)
            });
            counted.count()
        };
        json!({
            "origin": if level.is_given { "Given" } else { "Computed" },
            "covers": level.covers,
            "outer_level_idx": level.outer,
            "spheres": level.balls.iter().map(of_link).collect::<Value>(),
            "fits": fits.collect::<Vec<_>>(),
            "ignored_pairs": pairs(level.ignored.iter().copied()),
            "always_pairs": pairs(always.map(|(pair, _)| *pair)),
            "sometimes_pairs": pairs(sometimes.map(|(pair, _)| *pair)),
            "evaluation": {
                "num_colliding": count(true, None),
                "num_missed": count(true, Some(false)),
                "num_free": count(false, None),
                "num_false_contacts": count(false, Some(true)),
            },
        })
    };
    let levels = levels.iter().zip(&found.levels).map(of_level);
    json!({ "levels": levels.collect::<Vec<_>>(), "num_samples": samples })
}

/// The robot with the spheres of [`levels`].
pub fn fixture() -> Fixture {
    fixture_of(&robot(), &levels(), SAMPLES)
}

/// A robot with these spheres, and what is true of them.
pub fn fixture_of(robot: &Robot, levels: &[Level], samples: u32) -> Fixture {
    let mut fixture = Fixture::full_with_edits(robot, Vec::new());
    let kind = ModuleKind::LinkShapesSpheres;
    fixture.add_module(kind.folder(), document(robot, levels, samples));
    let root = fixture.doc_mut("urdd.json");
    root["urdd_version"] = json!(kind.since());
    let own = root["modules"].as_array_mut().and_then(|modules| modules.last_mut());
    let depends_on = kind.depends_on().iter().map(|kind| kind.name());
    own.expect("the module")["depends_on"] = depends_on.collect();
    fixture.relist();
    fixture.seal();
    fixture
}
