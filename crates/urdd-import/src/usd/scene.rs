//! A stage with what its prims inherit: where they are, which body they belong to, whether they are seen.

use nalgebra::{
    Isometry3, Matrix3, Matrix4, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3,
};
use urdd_directory::account::Account;
use urdd_usd::{Prim, Property, Stage, Value};
use urdd_xml::is_character;

use crate::fault::UsdFault;
use crate::place::{Fallible, Place, Placing, at as refused};

/// Metres of a unit where a stage does not say it: USD's own is the centimetre.
const METRE: f64 = 0.01;
/// Bytes of what a prim inherits.
const PRIM: usize = 300;
/// How a prim names its material: that which is seen, the same for a preview, that of physics.
pub const BINDINGS: [&str; 3] =
    ["material:binding", "material:binding:preview", "material:binding:physics"];

pub struct Scene<'s> {
    pub stage: &'s Stage,
    /// Metres and kilograms of a unit.
    pub metre: f64,
    pub kilogram: f64,
    /// Radians of a unit of the angles that MuJoCo alone reads.
    pub mujoco_angle: f64,
    /// Whether y is up, and not z.
    pub is_y_up: bool,
    /// Where each prim is, in units: columns, as points are.
    pub world: Vec<Matrix4<f64>>,
    /// The nearest body that a prim is, or is in.
    pub body: Vec<Option<usize>>,
    /// The prim whose `PhysicsCollisionAPI` a shape has: its own, or that of what it is in.
    pub collider: Vec<Option<usize>>,
    /// Whether a prim is rendered.
    pub is_seen: Vec<bool>,
    pub is_articulated: Vec<bool>,
    /// Whether several joints of two bodies in a prim follow each other, and do not close a chain.
    pub adds_mobility: Vec<bool>,
    /// The material that a prim has, by [`BINDINGS`].
    pub material: [Vec<Option<usize>>; 3],
    /// The offset of each line of each file.
    lines: Vec<Vec<usize>>,
}

impl<'s> Scene<'s> {
    /// What prims inherit. `texts` are those of the layers.
    pub fn of(stage: &'s Stage, texts: &[&str], account: &Account) -> Fallible<Self> {
        account.charge(PRIM * stage.prims.len()).at(Place::default())?;
        let number =
            |name: &str, default| stage.metadata(name).and_then(Value::number).unwrap_or(default);
        let (metre, kilogram) = (number("metersPerUnit", METRE), number("kilogramsPerUnit", 1.0));
        if !(metre > 0.0 && metre.is_finite() && kilogram > 0.0 && kilogram.is_finite()) {
            return Err(refused(Place::default(), UsdFault::Units));
        }
        let up = stage.metadata("upAxis").and_then(Value::text);
        let has_radians =
            (stage.prims.iter()).any(|prim| word(prim, "mjc:compiler:angle") == Some("radian"));
        let lines = texts.iter().map(|text| {
            let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
            std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect()
        });
        let mut scene = Scene {
            stage,
            metre,
            kilogram,
            mujoco_angle: if has_radians { 1.0 } else { 1f64.to_radians() },
            is_y_up: up.is_none_or(|up| **up == *"Y"),
            world: Vec::new(),
            body: Vec::new(),
            collider: Vec::new(),
            is_seen: Vec::new(),
            is_articulated: Vec::new(),
            adds_mobility: Vec::new(),
            material: Default::default(),
            lines: lines.collect(),
        };
        // Whether shapes in a prim say themselves that they collide.
        let mut has_own = vec![false; stage.prims.len()];
        for (at, prim) in stage.prims.iter().enumerate().rev() {
            if let Some(parent) = prim.parent {
                has_own[parent] |= has_own[at] || is_shape(prim) && prim.has("PhysicsCollisionAPI");
            }
        }
        for (at, prim) in stage.prims.iter().enumerate() {
            let above = prim.parent.map_or(Matrix4::identity(), |parent| scene.world[parent]);
            scene.world.push(placed(prim, &above));
            let is_body =
                prim.has("PhysicsRigidBodyAPI") && flag(prim, "physics:rigidBodyEnabled", true);
            let inherited = prim.parent.and_then(|parent| scene.body[parent]);
            scene.body.push(if is_body { Some(at) } else { inherited });
            let collides = prim.has("PhysicsCollisionAPI") && (is_shape(prim) || !has_own[at]);
            let inherited = prim.parent.and_then(|parent| scene.collider[parent]);
            let inherited = inherited.filter(|above| !is_body && !is_shape(scene.prim(*above)));
            scene.collider.push(if collides { Some(at) } else { inherited });
            let is_seen = prim.parent.is_none_or(|parent| scene.is_seen[parent])
                && word(prim, "visibility") != Some("invisible")
                && !matches!(word(prim, "purpose"), Some("guide" | "proxy"));
            scene.is_seen.push(is_seen);
            let is_articulated = prim.has("PhysicsArticulationRootAPI")
                || prim.parent.is_some_and(|parent| scene.is_articulated[parent]);
            scene.is_articulated.push(is_articulated);
            let above = prim.parent.is_some_and(|parent| scene.adds_mobility[parent]);
            scene.adds_mobility.push(flag(prim, "newton:jointsAddMobility", above));
            for (kind, name) in BINDINGS.into_iter().enumerate() {
                let above = prim.parent.and_then(|parent| scene.material[kind][parent]);
                let own = scene.target(prim, name).or(above);
                scene.material[kind].push(own);
            }
        }
        Ok(scene)
    }

    pub fn prim(&self, at: usize) -> &'s Prim {
        &self.stage.prims[at]
    }

    /// Where a prim is in its file.
    pub fn place(&self, at: usize) -> Place {
        let (file, line) = self.stage.prims[at].place;
        let lines = self.lines.get(file);
        let offset = lines.and_then(|lines| lines.get((line as usize).checked_sub(1)?));
        Place { file, offset: offset.copied().unwrap_or_default() }
    }

    /// The frame of a prim, in m, without its scale; and its scale.
    pub fn frame(&self, at: usize) -> Fallible<(Isometry3<f64>, Vector3<f64>)> {
        let matrix = &self.world[at];
        let (rotation, scale) = split(&matrix.fixed_view::<3, 3>(0, 0).into_owned());
        if !scale.iter().all(|part| part.is_finite() && *part != 0.0) {
            return Err(refused(self.place(at), UsdFault::Scale(self.stage.path(at))));
        }
        let place = matrix.fixed_view::<3, 1>(0, 3) * self.metre;
        Ok((Isometry3::from_parts(Translation3::from(place), rotation), scale))
    }

    /// A relationship's first target that is there.
    pub fn target(&self, prim: &Prim, name: &str) -> Option<usize> {
        prim.targets(name).iter().find_map(|path| self.stage.find(path))
    }

    /// The name that a prim shows, or its own, or one for all: the first that XML can hold.
    pub fn name(&self, at: usize) -> &'s str {
        let prim = self.prim(at);
        let shown = prim.field("displayName").and_then(Value::text).map(|name| &**name);
        let mut names = [shown, Some(&*prim.name)].into_iter().flatten();
        names.find(|name| is_name(name)).unwrap_or("unnamed")
    }
}

/// Whether a name can stand in a URDF: it has no control characters, which a text of USD escapes.
pub fn is_name(name: &str) -> bool {
    let is_plain = |c: char| is_character(c) && !c.is_control();
    !name.trim().is_empty() && name.chars().all(is_plain)
}

/// Whether a prim is a frame alone, by Newton's schema or MuJoCo's, whatever shape it has.
pub fn is_site(prim: &Prim) -> bool {
    prim.has("NewtonSiteAPI") || prim.has("MjcSiteAPI")
}

pub fn is_shape(prim: &Prim) -> bool {
    !is_site(prim)
        && matches!(
            &*prim.type_name,
            "Cube"
                | "Sphere"
                | "Cylinder"
                | "Capsule"
                | "Cone"
                | "Mesh"
                | "Plane"
                | "Cylinder_1"
                | "Capsule_1"
                | "BasisCurves"
                | "Points"
                | "NurbsPatch"
                | "TetMesh"
                | "PointInstancer"
        )
}

/// The rotation and the scales along the axes of a matrix. A mirror is a scale below 0 along x.
pub fn split(matrix: &Matrix3<f64>) -> (UnitQuaternion<f64>, Vector3<f64>) {
    let mut scale = Vector3::from_fn(|axis, _| matrix.column(axis).norm());
    if matrix.determinant() < 0.0 {
        scale.x = -scale.x;
    }
    let columns = Matrix3::from_columns(&[0, 1, 2].map(|axis| matrix.column(axis) / scale[axis]));
    // Of columns that are at right angles, these are they; of others, the nearest.
    let rotation = match is_square(matrix) {
        true => Rotation3::from_matrix_unchecked(columns),
        false => Rotation3::from_matrix_eps(&columns, 1e-15, 100, Rotation3::identity()),
    };
    (UnitQuaternion::from_rotation_matrix(&rotation), scale)
}

/// Whether the columns of a matrix are at right angles, within what single precision gives.
pub fn is_square(matrix: &Matrix3<f64>) -> bool {
    const NEAR: f64 = 1e-5;
    let [x, y, z] = [0, 1, 2].map(|axis| matrix.column(axis).into_owned());
    [(x, y), (y, z), (z, x)].iter().all(|(a, b)| a.dot(b).abs() <= NEAR * a.norm() * b.norm())
}

/// Where a prim is, by the transforms that it lists: the first is the outermost.
fn placed(prim: &Prim, above: &Matrix4<f64>) -> Matrix4<f64> {
    let mut matrix = *above;
    let order = prim.value("xformOpOrder").and_then(Value::texts).unwrap_or_default();
    for op in order {
        if &**op == "!resetXformStack!" {
            matrix = Matrix4::identity();
            continue;
        }
        let (name, is_inverse) = match op.strip_prefix("!invert!") {
            Some(name) => (name, true),
            None => (&**op, false),
        };
        let kind = name.split(':').nth(1).unwrap_or_default();
        let Some(own) = prim.property(name).and_then(|of| transform(kind, of)) else { continue };
        matrix *= if is_inverse { own.try_inverse().unwrap_or(own) } else { own };
    }
    matrix
}

fn transform(kind: &str, of: &Property) -> Option<Matrix4<f64>> {
    let axes = |name: &str| -> Option<Vector3<f64>> {
        match name {
            "X" => Some(Vector3::x()),
            "Y" => Some(Vector3::y()),
            "Z" => Some(Vector3::z()),
            _ => None,
        }
    };
    let along = |name: &str, one: f64| axes(name).map(|axis| axis * one);
    if let Some(name) = kind.strip_prefix("translate") {
        let by = if name.is_empty() { vector(of)? } else { along(name, number_of(of)?)? };
        return Some(Matrix4::new_translation(&by));
    }
    if let Some(name) = kind.strip_prefix("scale") {
        let one = Vector3::repeat(1.0);
        let by =
            if name.is_empty() { vector(of)? } else { one + along(name, number_of(of)? - 1.0)? };
        return Some(Matrix4::new_nonuniform_scaling(&by));
    }
    if let Some(name) = kind.strip_prefix("rotate") {
        if let Some(axis) = axes(name) {
            return Some(Matrix4::from_scaled_axis(axis * number_of(of)?.to_radians()));
        }
        // The first axis turns first.
        let angles = vector(of)?;
        let mut matrix = Matrix4::identity();
        for letter in name.split("").filter(|letter| !letter.is_empty()) {
            let axis = axes(letter)?;
            matrix = Matrix4::from_scaled_axis(axis * axis.dot(&angles).to_radians()) * matrix;
        }
        return Some(matrix);
    }
    match kind {
        "orient" => Some(rotation(of)?.to_homogeneous()),
        "transform" => {
            let values = of.value.as_ref()?.numbers()?;
            // Rows of USD, whose points are rows, too.
            (values.len() == 16).then(|| Matrix4::from_column_slice(values))
        }
        _ => None,
    }
}

/// Numbers of a property. Those of single precision are the shortest decimals that round to them: what was meant.
fn numbers<const N: usize>(of: &Property) -> Option<[f64; N]> {
    let values = match of.value.as_ref()? {
        Value::Number(number) => vec![*number],
        value => value.numbers()?.to_vec(),
    };
    let is_double = of.type_name.starts_with("double")
        || of.type_name.starts_with("matrix")
        || of.type_name.trim_end_matches("[]").ends_with('d');
    let short = |value: f64| match is_double || !value.is_finite() {
        true => value,
        false => format!("{}", value as f32).parse().unwrap_or(value),
    };
    values.into_iter().map(short).collect::<Vec<_>>().try_into().ok()
}

fn number_of(of: &Property) -> Option<f64> {
    numbers::<1>(of).map(|[number]| number)
}

fn vector(of: &Property) -> Option<Vector3<f64>> {
    numbers::<3>(of).map(Vector3::from)
}

fn rotation(of: &Property) -> Option<UnitQuaternion<f64>> {
    let [w, x, y, z] = numbers::<4>(of)?;
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9)
}

pub fn number(prim: &Prim, name: &str) -> Option<f64> {
    number_of(prim.property(name)?)
}

pub fn triple(prim: &Prim, name: &str) -> Option<Vector3<f64>> {
    vector(prim.property(name)?)
}

/// A rotation that a prim has; none of a quaternion of 0.
pub fn turn(prim: &Prim, name: &str) -> Option<UnitQuaternion<f64>> {
    rotation(prim.property(name)?)
}

pub fn word<'p>(prim: &'p Prim, name: &str) -> Option<&'p str> {
    prim.value(name).and_then(Value::text).map(|text| &**text)
}

pub fn flag(prim: &Prim, name: &str, default: bool) -> bool {
    prim.value(name).and_then(Value::bool).unwrap_or(default)
}
