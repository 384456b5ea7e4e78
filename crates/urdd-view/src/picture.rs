//! A small picture of a robot for the gallery, rendered in software.
//!
//! Orthographic projection from the page's initial viewpoint, one light and a depth buffer, rendered at twice the size
//! and averaged. The same robot gives the same bytes.

use nalgebra::{Isometry3, Point3, Vector3};

use urdd_robot::{LinkVisual, Robot, RobotError};

/// What the page's first picture, the joints and the sliders need of a URDD, with the core class.
pub const MODULES: &[&str] = &["plain_meshes"];

/// Size, pixels.
pub const WIDTH: usize = 320;
/// Size, pixels.
pub const HEIGHT: usize = 240;
/// Samples for each pixel, along each axis.
const FINER: usize = 2;
/// The page's initial viewing direction.
const FROM: [f64; 3] = [1.0, -0.75, 0.45];
/// The colour of parts without one.
const PLAIN: [f64; 3] = [0.52, 0.55, 0.6];
/// The brightness of an unlit facet, as a fraction of its colour.
const DARKEST: f64 = 0.16;
/// Minimum brightness of a colour, so that a black robot is visible on a dark page.
const LEAST: f64 = 0.01;
/// The margin at each side, as a fraction of the picture.
const MARGIN: f64 = 0.06;

/// A triangle in the picture's axes (right, up, towards the viewer), and its colour.
struct Facet {
    corners: [Vector3<f64>; 3],
    color: [f64; 3],
}

/// The picture of a robot in its default configuration, as PNG; `None` if it has nothing to show.
pub fn png(robot: &Robot) -> Result<Option<Vec<u8>>, RobotError> {
    let poses = robot.link_poses(&robot.configurations()?.zero())?;
    let mut facets = Vec::new();
    for visual in visuals(robot)? {
        let Some(pose) = poses.get(visual.link) else { continue };
        for part in &visual.parts {
            let color = part.color.map_or(PLAIN, |[r, g, b, _]| [r, g, b]);
            let places: Vec<Vector3<f64>> =
                part.mesh.vertices.iter().map(|vertex| in_picture(pose, *vertex)).collect();
            for triangle in &part.mesh.triangles {
                let corners = triangle.map(|k| places[k as usize]);
                if corners.iter().all(|corner| corner.iter().all(|x| x.is_finite())) {
                    facets.push(Facet { corners, color });
                }
            }
        }
    }
    Ok(drawn(&facets).and_then(|pixels| encoded(&pixels)))
}

/// The plain meshes, or what the URDF says where a URDD has none.
fn visuals(robot: &Robot) -> Result<Vec<LinkVisual>, RobotError> {
    match robot.visuals() {
        Err(RobotError::Missing(_)) => robot.source_visuals(),
        visuals => visuals,
    }
}

/// A point of a link, in the picture's axes.
fn in_picture(pose: &Isometry3<f64>, vertex: [f64; 3]) -> Vector3<f64> {
    let near = Vector3::from(FROM).normalize();
    let right = Vector3::z().cross(&near).normalize();
    let up = near.cross(&right);
    let point = pose.transform_point(&Point3::from(vertex)).coords;
    Vector3::new(point.dot(&right), point.dot(&up), point.dot(&near))
}

/// Red, green, blue and opacity of each pixel, in rows from the top.
fn drawn(facets: &[Facet]) -> Option<Vec<u8>> {
    let corners = || facets.iter().flat_map(|facet| facet.corners);
    let low = corners().reduce(|a, b| a.inf(&b))?;
    let high = corners().reduce(|a, b| a.sup(&b))?;
    let (width, height) = (WIDTH * FINER, HEIGHT * FINER);
    let room = 1.0 - 2.0 * MARGIN;
    let size = high - low;
    let scale = (room * width as f64 / size.x).min(room * height as f64 / size.y);
    if !scale.is_finite() {
        return None;
    }
    let middle = (low + high) / 2.0;
    let mut depth = vec![f64::NEG_INFINITY; width * height];
    let mut colors = vec![[0.0; 3]; width * height];
    let light = Vector3::new(0.35, 0.55, 0.76);
    for facet in facets {
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
                    colors[k] = facet.color.map(|value| shown(value * shade));
                }
            }
        }
    }
    let mut pixels = Vec::with_capacity(4 * WIDTH * HEIGHT);
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let (mut sum, mut seen) = ([0.0; 3], 0.0);
            for k in 0..FINER * FINER {
                let at = (y * FINER + k / FINER) * width + x * FINER + k % FINER;
                if depth[at] > f64::NEG_INFINITY {
                    seen += 1.0;
                    for (total, value) in sum.iter_mut().zip(colors[at]) {
                        *total += value;
                    }
                }
            }
            let byte = |value: f64| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
            pixels.extend(sum.map(|value| byte(value / f64::max(seen, 1.0))));
            pixels.push(byte(seen / (FINER * FINER) as f64));
        }
    }
    Some(pixels)
}

/// Gamma correction, close to sRGB. A square root has the same result on every machine.
fn shown(light: f64) -> f64 {
    (LEAST + (1.0 - LEAST) * light.clamp(0.0, 1.0)).sqrt()
}

fn encoded(pixels: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, WIDTH as u32, HEIGHT as u32);
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
            let pixels = drawn(&facets).expect("a picture");
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
        assert_eq!(drawn(&[]), None);
    }
}
