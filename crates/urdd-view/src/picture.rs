//! A picture of a robot, rendered in software: for the gallery, and for `urdd picture`.
//!
//! Orthographic projection, one light and a depth buffer, rendered at twice the size and averaged. The same robot gives
//! the same bytes.

use nalgebra::{Isometry3, Point3, Vector3};

use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_generate::Selection;
use urdd_robot::{LinkVisual, Robot, RobotError};

/// Greatest width and height, pixels.
pub const MAX_SIDE: u32 = 2048;
/// Samples for each pixel, along each axis.
const FINER: usize = 2;
/// The colour of parts without one.
const PLAIN: [f64; 3] = [0.52, 0.55, 0.6];
/// The brightness of an unlit facet, as a fraction of its colour.
const DARKEST: f64 = 0.16;
/// Minimum brightness of a colour, so that a black robot is visible on a dark page.
const LEAST: f64 = 0.01;
/// The margin at each side, as a fraction of the picture.
const MARGIN: f64 = 0.06;

/// How a robot is drawn.
pub struct Drawing {
    /// Width and height, pixels: 1 to [`MAX_SIDE`] each.
    pub size: [u32; 2],
    /// The direction from the robot to the viewer, in the root link's frame. A picture from above or below has y to the
    /// top.
    pub from: [f64; 3],
}

impl Default for Drawing {
    /// A card of the gallery, from the page's initial viewpoint.
    fn default() -> Self {
        Drawing { size: [320, 240], from: [1.0, -0.75, 0.45] }
    }
}

/// A triangle in the picture's axes (right, up, towards the viewer), and its colour.
struct Facet {
    corners: [Vector3<f64>; 3],
    color: [f64; 3],
}

/// The picture of a robot in a configuration, as PNG with a transparent background; `None` if it has nothing to show.
///
/// # Errors
/// [`RobotError`] if the robot cannot be read, for a configuration that is not one of it, and after a cancellation: very
/// many triangles, each as large as the picture, take hours.
pub fn png(
    robot: &Robot,
    configuration: &[f64],
    drawing: &Drawing,
    cancellation: &Cancellation,
) -> Result<Option<Vec<u8>>, RobotError> {
    let axes = axes(drawing.from);
    let poses = robot.link_poses(configuration)?;
    let mut facets = Vec::new();
    for visual in visuals(robot)? {
        let Some(pose) = poses.get(visual.link) else { continue };
        for part in &visual.parts {
            let color = part.color.map_or(PLAIN, |[r, g, b, _]| [r, g, b]);
            let places: Vec<Vector3<f64>> =
                part.mesh.vertices.iter().map(|vertex| in_picture(&axes, pose, *vertex)).collect();
            for triangle in &part.mesh.triangles {
                let corners = triangle.map(|k| places[k as usize]);
                if corners.iter().all(|corner| corner.iter().all(|x| x.is_finite())) {
                    facets.push(Facet { corners, color });
                }
            }
        }
    }
    let size = drawing.size.map(|side| side.clamp(1, MAX_SIDE));
    let [width, height] = size.map(|side| side as usize);
    let pixels = drawn(&facets, width, height, cancellation)?;
    Ok(pixels.and_then(|pixels| encoded(&pixels, size)))
}

/// What the page's first picture, the joints and the sliders need of a URDD: the core class, and plain meshes.
pub fn modules() -> Selection {
    Selection::parse(["plain_meshes"]).unwrap_or_else(|_| Selection::all())
}

/// The picture of a robot on its card; `None` if it has nothing to show, or cannot be read.
pub(crate) fn card(robot: &Robot, cancellation: &Cancellation) -> Option<Vec<u8>> {
    let zero = robot.configurations().ok()?.zero();
    png(robot, &zero, &Drawing::default(), cancellation).ok().flatten()
}

/// The plain meshes, or what the URDF says where a URDD has none.
fn visuals(robot: &Robot) -> Result<Vec<LinkVisual>, RobotError> {
    match robot.visuals() {
        Err(RobotError::Missing(_)) => robot.source_visuals(),
        visuals => visuals,
    }
}

/// The picture's axes: right, up, towards the viewer.
fn axes(from: [f64; 3]) -> [Vector3<f64>; 3] {
    let near = Vector3::from(from).try_normalize(0.0).unwrap_or_else(Vector3::z);
    let right = Vector3::z().cross(&near).try_normalize(1e-9).unwrap_or_else(Vector3::x);
    [right, near.cross(&right), near]
}

/// A point of a link, in the picture's axes.
fn in_picture(
    [right, up, near]: &[Vector3<f64>; 3],
    pose: &Isometry3<f64>,
    vertex: [f64; 3],
) -> Vector3<f64> {
    let point = pose.transform_point(&Point3::from(vertex)).coords;
    Vector3::new(point.dot(right), point.dot(up), point.dot(near))
}

/// Red, green, blue and opacity of each pixel, in rows from the top.
fn drawn(
    facets: &[Facet],
    columns: usize,
    rows: usize,
    cancellation: &Cancellation,
) -> Result<Option<Vec<u8>>, Cancelled> {
    let corners = || facets.iter().flat_map(|facet| facet.corners);
    let ends = (corners().reduce(|a, b| a.inf(&b)), corners().reduce(|a, b| a.sup(&b)));
    let (Some(low), Some(high)) = ends else { return Ok(None) };
    let (width, height) = (columns * FINER, rows * FINER);
    let room = 1.0 - 2.0 * MARGIN;
    let size = high - low;
    let scale = (room * width as f64 / size.x).min(room * height as f64 / size.y);
    if !scale.is_finite() {
        return Ok(None);
    }
    let middle = (low + high) / 2.0;
    let mut depth = vec![f64::NEG_INFINITY; width * height];
    // Which facet is seen, and the colours of all.
    let mut seen_facets = vec![0; width * height];
    let mut colors = Vec::with_capacity(facets.len());
    let light = Vector3::new(0.35, 0.55, 0.76);
    for (number, facet) in facets.iter().enumerate() {
        cancellation.check()?;
        colors.push([0.0; 3]);
        let place = |corner: &Vector3<f64>| {
            [
                width as f64 / 2.0 + (corner.x - middle.x) * scale,
                height as f64 / 2.0 - (corner.y - middle.y) * scale,
                corner.z,
            ]
        };
        let [a, b, c] = [0, 1, 2].map(|k| place(&facet.corners[k]));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let [p, q, r] = &facet.corners;
        let Some(normal) = (q - p).cross(&(r - p)).try_normalize(0.0) else { continue };
        if area == 0.0 || !area.is_finite() {
            continue;
        }
        // Lights both sides, since the winding of meshes is not consistent.
        let normal = if normal.z < 0.0 { -normal } else { normal };
        let shade = DARKEST + (1.0 - DARKEST) * normal.dot(&light).max(0.0);
        colors[number] = facet.color.map(|value| shown(value * shade));
        let range = |values: [f64; 3], end: usize| {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            (least.floor().max(0.0) as usize)..(most.ceil().max(0.0) as usize + 1).min(end)
        };
        for y in range([a[1], b[1], c[1]], height) {
            for x in range([a[0], b[0], c[0]], width) {
                let at = [x as f64 + 0.5, y as f64 + 0.5];
                let side = |u: &[f64; 3], v: &[f64; 3]| {
                    ((v[0] - u[0]) * (at[1] - u[1]) - (v[1] - u[1]) * (at[0] - u[0])) / area
                };
                let weights = [side(&b, &c), side(&c, &a), side(&a, &b)];
                if weights.iter().any(|weight| *weight < 0.0) {
                    continue;
                }
                let z = weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2];
                let k = y * width + x;
                if z > depth[k] {
                    depth[k] = z;
                    seen_facets[k] = number as u32;
                }
            }
        }
    }
    let mut pixels = Vec::with_capacity(4 * columns * rows);
    for y in 0..rows {
        for x in 0..columns {
            let (mut sum, mut seen) = ([0.0; 3], 0.0);
            for k in 0..FINER * FINER {
                let at = (y * FINER + k / FINER) * width + x * FINER + k % FINER;
                if depth[at] > f64::NEG_INFINITY {
                    seen += 1.0;
                    for (total, value) in sum.iter_mut().zip(colors[seen_facets[at] as usize]) {
                        *total += value;
                    }
                }
            }
            let byte = |value: f64| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
            pixels.extend(sum.map(|value| byte(value / f64::max(seen, 1.0))));
            pixels.push(byte(seen / (FINER * FINER) as f64));
        }
    }
    Ok(Some(pixels))
}

/// Gamma correction, close to sRGB. A square root has the same result on every machine.
fn shown(light: f64) -> f64 {
    (LEAST + (1.0 - LEAST) * light.clamp(0.0, 1.0)).sqrt()
}

fn encoded(pixels: &[u8], [width, height]: [u32; 2]) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().ok()?;
    writer.write_image_data(pixels).ok()?;
    writer.finish().ok()?;
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 320;
    const HEIGHT: usize = 240;

    #[test]
    fn the_nearer_facet_is_seen() {
        let square = |z: f64, color| {
            let corner = |x: f64, y: f64| Vector3::new(x, y, z);
            let [a, b, c, d] =
                [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)].map(|(x, y)| corner(x, y));
            [[a, b, c], [a, c, d]].map(|corners| Facet { corners, color })
        };
        let red = square(1.0, [1.0, 0.0, 0.0]);
        let blue = square(0.0, [0.0, 0.0, 1.0]);
        for order in [[&red, &blue], [&blue, &red]] {
            let facets: Vec<Facet> = order
                .into_iter()
                .flatten()
                .map(|facet| Facet { corners: facet.corners, color: facet.color })
                .collect();
            let pixels = drawn(&facets, WIDTH, HEIGHT, &Cancellation::default());
            let pixels = pixels.expect("not cancelled").expect("a picture");
            let at = |x: usize, y: usize| &pixels[4 * (y * WIDTH + x)..][..4];
            let middle = at(WIDTH / 2, HEIGHT / 2);
            // Facing the viewer: the z component of the light's direction.
            let byte = |light: f64| (light.sqrt() * 255.0).round() as u8;
            let lit = 0.16 + 0.84 * 0.76_f64;
            let red = byte(0.01 + 0.99 * lit);
            assert_eq!(middle, [red, byte(0.01), byte(0.01), 255]);
            assert_eq!(at(0, 0)[3], 0, "the corner is empty");
            // A square fills the height except for the margins: 0.88 of 240 rows, so 105 or 106 on either side of the
            // middle.
            assert_eq!(at(WIDTH / 2, 120 - 104)[3], 255);
            assert_eq!(at(WIDTH / 2, 120 - 108)[3], 0);
        }
        assert_eq!(drawn(&[], WIDTH, HEIGHT, &Cancellation::default()), Ok(None));
    }

    #[test]
    fn a_cancelled_picture_ends() {
        let corners = [(0., 0.), (1., 0.), (0., 1.)].map(|(x, y)| Vector3::new(x, y, 0.0));
        let facets = [Facet { corners, color: PLAIN }];
        let cancellation = Cancellation::default();
        cancellation.cancel();
        assert_eq!(drawn(&facets, WIDTH, HEIGHT, &cancellation), Err(Cancelled));
    }

    #[test]
    fn axes_are_a_right_handed_frame_that_looks_at_the_viewer() {
        for from in [[1.0, -0.75, 0.45], [0.0, 0.0, 2.0], [0.0, 0.0, -1.0], [-3.0, 0.0, 0.0]] {
            let [right, up, near] = axes(from);
            assert!((right.cross(&up) - near).norm() < 1e-12, "{from:?}");
            assert!((near - Vector3::from(from).normalize()).norm() < 1e-12, "{from:?}");
            assert!(up.z >= 0.0, "{from:?}");
        }
        // From the front, y is to the right; from above, x is, and y to the top.
        assert!((axes([1.0, 0.0, 0.0])[0] - Vector3::y()).norm() < 1e-12);
        assert!((axes([0.0, 0.0, 1.0])[1] - Vector3::y()).norm() < 1e-12);
    }
}
