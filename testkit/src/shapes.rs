//! Robot of boxes -> link shape modules. Distances between boxes are computed from their corners, edges and faces,
//! without a library.

use urdd_format::index::{Count, LinkIdx, PieceIdx};
use urdd_format::link_shapes_approximations::*;
use urdd_format::link_shapes_distance_statistics::*;
use urdd_format::link_shapes_simple_skips::*;
use urdd_format::link_shapes_skips::*;
use urdd_format::shapes::PieceShape;

use super::core::{Core, default_configuration, link_transforms, sampled_configuration};
use super::meshes::{Meshes, Point, Solid, TRIANGLES, cross, dot, minus};
use super::robot::Robot;
use super::transform::{Transform, apply, norm, rotation_of_rpy, transform, unit};

/// Number of sampled configurations in the statistics.
pub const NUM_SAMPLES: u32 = 8;

/// The link shape modules of a robot.
pub struct Shapes {
    pub approximations: LinkShapesApproximationsModule,
    pub max_distances: LinkShapesMaxDistanceFromOriginModule,
    pub statistics: LinkShapesDistanceStatisticsModule,
    pub simple_skips: LinkShapesSimpleSkipsModule,
    pub skips: LinkShapesSkipsModule,
}

impl Shapes {
    pub fn new(robot: &Robot, core: &Core, meshes: &Meshes, edits: Vec<SkipEdit>) -> Shapes {
        let full = Group::new(meshes, |solids| vec![solids.whole.clone()]);
        let pieces = Group::new(meshes, |solids| solids.pieces.clone());
        let statistics = statistics(robot, core, &full, &pieces);
        let default = [default_configuration(robot, core)];
        let default = statistics_over(robot, core, &full, &pieces, &default);
        let simple_skips = simple_skips(core, &statistics, &default);
        let skips = skips(robot, &simple_skips, edits);
        Shapes {
            approximations: LinkShapesApproximationsModule {
                full_obbs: full.first(obb),
                full_bounding_spheres: full.first(sphere),
                decomposition_obbs: pieces.each(obb),
                decomposition_bounding_spheres: pieces.each(sphere),
            },
            max_distances: LinkShapesMaxDistanceFromOriginModule {
                full_convex_hulls_maximum_distances: full.first(hull_reach),
                full_obbs_maximum_distances: full.first(obb_reach),
                full_bounding_spheres_maximum_distances: full.first(sphere_reach),
                decomposition_convex_hulls_maximum_distances: pieces.each(hull_reach),
                decomposition_obbs_maximum_distances: pieces.each(obb_reach),
                decomposition_bounding_spheres_maximum_distances: pieces.each(sphere_reach),
            },
            statistics,
            simple_skips,
            skips,
        }
    }
}

/// Solids per link: the whole boxes or the pieces.
struct Group {
    of_link: Vec<Vec<Solid>>,
}

impl Group {
    fn new(meshes: &Meshes, pick: impl Fn(&super::meshes::LinkSolids) -> Vec<Solid>) -> Group {
        let of_link = meshes.solids.iter();
        Group {
            of_link: of_link.map(|solids| solids.as_ref().map(&pick).unwrap_or_default()).collect(),
        }
    }

    fn first<T>(&self, make: impl Fn(&Solid) -> T) -> Vec<Option<T>> {
        let links = self.of_link.iter();
        links.map(|solids| solids.first().map(&make)).collect()
    }

    fn each<T>(&self, make: impl Fn(&Solid) -> T) -> Vec<Vec<T>> {
        let links = self.of_link.iter();
        links.map(|solids| solids.iter().map(&make).collect()).collect()
    }

    /// The link, piece and solid of each shape index.
    fn shapes(&self) -> Vec<(usize, usize, &Solid)> {
        let links = self.of_link.iter().enumerate();
        links
            .flat_map(|(link, solids)| {
                let solids = solids.iter().enumerate();
                solids.map(move |(piece, solid)| (link, piece, solid))
            })
            .collect()
    }
}

// ---- Approximations and reach

fn obb(solid: &Solid) -> Obb {
    let r = solid.rotation();
    let mut half_extents = [0.0; 3];
    for corner in solid.corners {
        let from_centre = minus(corner, solid.centre);
        for (axis, half) in half_extents.iter_mut().enumerate() {
            let along = dot([r[0][axis], r[1][axis], r[2][axis]], from_centre);
            *half = along.abs().max(*half);
        }
    }
    Obb { half_extents, offset_xyz: solid.centre, offset_rpy: solid.rpy }
}

fn sphere(solid: &Solid) -> BoundingSphere {
    let radii = solid.corners.map(|corner| norm(minus(corner, solid.centre)));
    BoundingSphere { radius: radii.into_iter().fold(0.0, f64::max), offset_xyz: solid.centre }
}

fn obb_corners(obb: &Obb) -> [Point; 8] {
    let place = transform(rotation_of_rpy(obb.offset_rpy), obb.offset_xyz);
    std::array::from_fn(|number| {
        let side =
            |bit: usize| obb.half_extents[bit] * if number >> bit & 1 == 0 { -1.0 } else { 1.0 };
        apply(&place, [side(0), side(1), side(2)])
    })
}

fn farthest(corners: &[Point; 8]) -> f64 {
    corners.iter().map(|corner| norm(*corner)).fold(0.0, f64::max)
}

fn obb_reach(solid: &Solid) -> f64 {
    farthest(&obb_corners(&obb(solid)))
}

fn sphere_reach(solid: &Solid) -> f64 {
    norm(solid.centre) + sphere(solid).radius
}

/// At most the reach of the box and of the sphere, even in the last digit.
fn hull_reach(solid: &Solid) -> f64 {
    farthest(&solid.corners).min(obb_reach(solid)).min(sphere_reach(solid))
}

// ---- Distance statistics

fn statistics(
    robot: &Robot,
    core: &Core,
    full: &Group,
    pieces: &Group,
) -> LinkShapesDistanceStatisticsModule {
    let configurations: Vec<Vec<f64>> =
        (0..NUM_SAMPLES).map(|k| sampled_configuration(robot, core, k)).collect();
    statistics_over(robot, core, full, pieces, &configurations)
}

fn statistics_over(
    robot: &Robot,
    core: &Core,
    full: &Group,
    pieces: &Group,
    configurations: &[Vec<f64>],
) -> LinkShapesDistanceStatisticsModule {
    let poses: Vec<Vec<Transform>> =
        configurations.iter().map(|q| link_transforms(robot, core, q)).collect();
    let [full_convex_hulls, full_obbs, full_bounding_spheres] = three_kinds(full, &poses);
    let [piece_hulls, piece_obbs, piece_spheres] = three_kinds(pieces, &poses);
    let piece_shape = |&(link, piece, _): &(usize, usize, _)| PieceShape {
        link_idx: LinkIdx(link as u32),
        piece_idx: PieceIdx(piece as u32),
    };
    let full_shapes = full.shapes();
    LinkShapesDistanceStatisticsModule {
        num_samples: Count(configurations.len() as u32),
        full_shapes: full_shapes.iter().map(|s| LinkIdx(s.0 as u32)).collect(),
        decomposition_shapes: pieces.shapes().iter().map(piece_shape).collect(),
        full_convex_hulls,
        full_obbs,
        full_bounding_spheres,
        decomposition_convex_hulls: Some(piece_hulls),
        decomposition_obbs: Some(piece_obbs),
        decomposition_bounding_spheres: Some(piece_spheres),
    }
}

fn three_kinds(group: &Group, poses: &[Vec<Transform>]) -> [DistanceStatistics; 3] {
    let shapes = group.shapes();
    let place = |at: &[Transform], link: usize, corners: [Point; 8]| {
        corners.map(|corner| apply(&at[link], corner))
    };
    let hulls = over_poses(
        &shapes,
        poses,
        |at, (link, _, solid)| place(at, *link, solid.corners),
        box_distance,
    );
    let obbs = over_poses(
        &shapes,
        poses,
        |at, (link, _, solid)| place(at, *link, obb_corners(&obb(solid))),
        box_distance,
    );
    let spheres = over_poses(
        &shapes,
        poses,
        |at, (link, _, solid)| (apply(&at[*link], solid.centre), sphere(solid).radius),
        |a, b| (norm(minus(a.0, b.0)) - a.1 - b.1).max(0.0),
    );
    [hulls, obbs, spheres]
}

fn over_poses<S, T>(
    shapes: &[S],
    poses: &[Vec<Transform>],
    place: impl Fn(&[Transform], &S) -> T,
    distance: impl Fn(&T, &T) -> f64,
) -> DistanceStatistics {
    let placed: Vec<Vec<T>> =
        poses.iter().map(|at| shapes.iter().map(|shape| place(at, shape)).collect()).collect();
    let n = shapes.len();
    let zeros = || vec![vec![0.0; n]; n];
    let (mut mean, mut min, mut max) = (zeros(), zeros(), zeros());
    for i in 0..n {
        for j in 0..i {
            let all: Vec<f64> = placed.iter().map(|at| distance(&at[i], &at[j])).collect();
            let least = all.iter().copied().fold(f64::INFINITY, f64::min);
            let most = all.iter().copied().fold(0.0, f64::max);
            let average = all.iter().sum::<f64>() / all.len() as f64;
            for (i, j) in [(i, j), (j, i)] {
                min[i][j] = least;
                max[i][j] = most;
                mean[i][j] = average.clamp(least, most); // Rounding must not move it outside the range.
            }
        }
    }
    DistanceStatistics { mean_distances: mean, min_distances: min, max_distances: max }
}

/// Distance between two boxes, given by their corners; 0 in contact.
pub fn box_distance(a: &[Point; 8], b: &[Point; 8]) -> f64 {
    if boxes_touch(a, b) {
        return 0.0;
    }
    let edges = || {
        (0..8usize).flat_map(|i| {
            let others = [i | 1, i | 2, i | 4].into_iter();
            others.filter(move |j| *j != i).map(move |j| (i, j))
        })
    };
    let mut best = f64::INFINITY;
    for (i, j) in edges() {
        for (k, l) in edges() {
            best = best.min(segment_to_segment(a[i], a[j], b[k], b[l]));
        }
    }
    for triangle in TRIANGLES {
        let of = |corners: &[Point; 8]| triangle.map(|i| corners[usize::from(i)]);
        for i in 0..8 {
            best = best.min(point_to_inside(a[i], of(b)));
            best = best.min(point_to_inside(b[i], of(a)));
        }
    }
    best
}

/// Whether two boxes touch: no separating axis exists.
pub fn boxes_touch(a: &[Point; 8], b: &[Point; 8]) -> bool {
    let sides = |c: &[Point; 8]| [1, 2, 4].map(|i| unit(minus(c[i], c[0])));
    let (sides_a, sides_b) = (sides(a), sides(b));
    let crossed = sides_a.iter().flat_map(|x| sides_b.iter().map(move |y| cross(*x, *y)));
    let axes = sides_a.iter().chain(&sides_b).copied().chain(crossed);
    let apart = |axis: Point| {
        let range = |corners: &[Point; 8]| {
            let along = corners.map(|corner| dot(corner, axis));
            along
                .into_iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
        };
        let ((low_a, high_a), (low_b, high_b)) = (range(a), range(b));
        low_a > high_b || low_b > high_a
    };
    // The cross product of nearly parallel sides is not a usable axis.
    !axes.filter(|axis| norm(*axis) > 1e-9).any(apart)
}

/// Distance between segments p-q and r-s.
fn segment_to_segment(p: Point, q: Point, r: Point, s: Point) -> f64 {
    let (d1, d2, w) = (minus(q, p), minus(s, r), minus(p, r));
    let (a, e, f) = (dot(d1, d1), dot(d2, d2), dot(d2, w));
    let (b, c) = (dot(d1, d2), dot(d1, w));
    let denominator = a * e - b * b;
    let mut x = if denominator > 1e-12 * a * e {
        ((b * f - c * e) / denominator).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let mut y = (b * x + f) / e;
    if !(0.0..=1.0).contains(&y) {
        y = y.clamp(0.0, 1.0);
        x = ((b * y - c) / a).clamp(0.0, 1.0);
    }
    let between = [0, 1, 2].map(|i| w[i] + x * d1[i] - y * d2[i]);
    norm(between)
}

/// Distance of a point from a triangle if its projection is inside the triangle; infinity otherwise, where edges give
/// the distance.
fn point_to_inside(p: Point, [a, b, c]: [Point; 3]) -> f64 {
    let normal = unit(cross(minus(b, a), minus(c, a)));
    if norm(normal) == 0.0 {
        return f64::INFINITY; // A degenerate side of a flat box.
    }
    let inside = [(a, b), (b, c), (c, a)]
        .into_iter()
        .all(|(from, to)| dot(cross(minus(to, from), minus(p, from)), normal) >= 0.0);
    if inside { dot(minus(p, a), normal).abs() } else { f64::INFINITY }
}

// ---- Skips

/// Distances up to this count as contact, metres.
const CONTACT: f64 = 0.001;

fn simple_skips(
    core: &Core,
    statistics: &LinkShapesDistanceStatisticsModule,
    default: &LinkShapesDistanceStatisticsModule,
) -> LinkShapesSimpleSkipsModule {
    let (s, at_default) = (statistics, default);
    let full: Vec<LinkIdx> = s.full_shapes.clone();
    let pieces: Vec<LinkIdx> = s.decomposition_shapes.iter().map(|p| p.link_idx).collect();
    let of = |d: &DistanceStatistics, default: &DistanceStatistics, links: &[LinkIdx]| {
        let reasons: Vec<Vec<SkipReason>> = (0..links.len())
            .map(|i| (0..links.len()).map(|j| reason(core, (d, default), links, i, j)).collect())
            .collect();
        let skips: Vec<Vec<bool>> = reasons
            .iter()
            .map(|row| {
                row.iter().map(|r| matches!(r, SkipReason::SameLink | SkipReason::Always)).collect()
            })
            .collect();
        (skips, reasons)
    };
    let maybe = |d: &Option<DistanceStatistics>, default: &Option<DistanceStatistics>| {
        let both = d.as_ref().zip(default.as_ref());
        both.map(|(d, default)| of(d, default, &pieces)).unzip()
    };
    let (full_hulls, full_hull_reasons) =
        of(&s.full_convex_hulls, &at_default.full_convex_hulls, &full);
    let (full_obbs, full_obb_reasons) = of(&s.full_obbs, &at_default.full_obbs, &full);
    let (full_spheres, full_sphere_reasons) =
        of(&s.full_bounding_spheres, &at_default.full_bounding_spheres, &full);
    let (piece_hulls, piece_hull_reasons) =
        maybe(&s.decomposition_convex_hulls, &at_default.decomposition_convex_hulls);
    let (piece_obbs, piece_obb_reasons) =
        maybe(&s.decomposition_obbs, &at_default.decomposition_obbs);
    let (piece_spheres, piece_sphere_reasons) =
        maybe(&s.decomposition_bounding_spheres, &at_default.decomposition_bounding_spheres);
    LinkShapesSimpleSkipsModule {
        full_shapes: s.full_shapes.clone(),
        decomposition_shapes: s.decomposition_shapes.clone(),
        full_convex_hulls_simple_skips: full_hulls,
        full_obbs_simple_skips: full_obbs,
        full_bounding_spheres_simple_skips: full_spheres,
        decomposition_convex_hulls_simple_skips: piece_hulls,
        decomposition_obbs_simple_skips: piece_obbs,
        decomposition_bounding_spheres_simple_skips: piece_spheres,
        reasons: SkipReasons {
            full_convex_hulls: full_hull_reasons,
            full_obbs: full_obb_reasons,
            full_bounding_spheres: full_sphere_reasons,
            decomposition_convex_hulls: piece_hull_reasons,
            decomposition_obbs: piece_obb_reasons,
            decomposition_bounding_spheres: piece_sphere_reasons,
        },
    }
}

fn reason(
    core: &Core,
    (distances, default): (&DistanceStatistics, &DistanceStatistics),
    links: &[LinkIdx],
    i: usize,
    j: usize,
) -> SkipReason {
    let joined = |a: LinkIdx, b: LinkIdx| {
        let mut joints = core.chain.joints_in_chain.iter();
        joints.any(|joint| joint.parent_link_idx == a && joint.child_link_idx == b)
    };
    match () {
        () if links[i] == links[j] => SkipReason::SameLink,
        () if distances.max_distances[i][j] <= CONTACT => SkipReason::Always,
        () if joined(links[i], links[j]) || joined(links[j], links[i]) => SkipReason::Adjacent,
        () if default.max_distances[i][j] <= CONTACT => SkipReason::Default,
        () if distances.min_distances[i][j] > CONTACT => SkipReason::Never,
        () => SkipReason::None,
    }
}

fn skips(
    robot: &Robot,
    simple: &LinkShapesSimpleSkipsModule,
    edits: Vec<SkipEdit>,
) -> LinkShapesSkipsModule {
    let full: Vec<LinkIdx> = simple.full_shapes.clone();
    let pieces = simple.decomposition_shapes.iter();
    let pieces: Vec<LinkIdx> = pieces.map(|p| p.link_idx).collect();
    let edited = |reasons: &Vec<Vec<SkipReason>>, links: &[LinkIdx]| {
        let by_reason = |reason: &SkipReason| match reason {
            SkipReason::SameLink | SkipReason::Always => true,
            SkipReason::Adjacent | SkipReason::Default => true,
            SkipReason::Never | SkipReason::None => false,
        };
        let rows = reasons.iter();
        let rows = rows.map(|row| row.iter().map(by_reason).collect());
        let mut matrix: Vec<Vec<bool>> = rows.collect();
        for edit in &edits {
            let [a, b] = [&edit.link_a, &edit.link_b].map(|name| robot.link_idx(name));
            for i in 0..links.len() {
                for j in 0..links.len() {
                    let pair = [links[i].get(), links[j].get()];
                    if i != j && (pair == [a, b] || pair == [b, a]) {
                        matrix[i][j] = edit.skip;
                    }
                }
            }
        }
        matrix
    };
    let of_pieces = |reasons: &Option<Vec<Vec<SkipReason>>>| {
        let reasons = reasons.as_ref();
        reasons.map(|reasons| edited(reasons, &pieces))
    };
    let reasons = &simple.reasons;
    LinkShapesSkipsModule {
        full_shapes: simple.full_shapes.clone(),
        decomposition_shapes: simple.decomposition_shapes.clone(),
        full_convex_hulls_skips: edited(&reasons.full_convex_hulls, &full),
        full_obbs_skips: edited(&reasons.full_obbs, &full),
        full_bounding_spheres_skips: edited(&reasons.full_bounding_spheres, &full),
        decomposition_convex_hulls_skips: of_pieces(&reasons.decomposition_convex_hulls),
        decomposition_obbs_skips: of_pieces(&reasons.decomposition_obbs),
        decomposition_bounding_spheres_skips: of_pieces(&reasons.decomposition_bounding_spheres),
        skipped_reasons: vec![
            SkippedReason::SameLink,
            SkippedReason::Always,
            SkippedReason::Adjacent,
            SkippedReason::Default,
        ],
        edits,
    }
}
