//! `<compiler>`: how the rest of a model is read; and orientations, which are read by it.

use std::ops::RangeInclusive;

use nalgebra::{
    Isometry3, Matrix3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3,
};

use super::reading::{Attributes, Element, View, wrong};
use crate::fault::MjcfFault;
use crate::place::{Fallible, Place, at};

/// How a model is read.
#[derive(Debug, Clone)]
pub struct Compiler {
    /// The radians of a number that is an angle.
    pub angle: f64,
    /// The axes of Euler angles, in order; in capitals: fixed ones.
    pub euler: [char; 3],
    /// Whether a range is a limit where nothing else is said.
    pub has_auto_limits: bool,
    pub mesh_folder: String,
    pub texture_folder: String,
    /// Whether folders are cut off the names of files.
    pub strips_paths: bool,
    /// Whether masses come from shapes; none: where a body says no mass.
    pub from_shapes: Option<bool>,
    pub mass_groups: RangeInclusive<i64>,
    pub balances: bool,
    pub least_mass: f64,
    pub least_inertia: f64,
    pub total_mass: Option<f64>,
    pub discards_visuals: bool,
    pub fits_boxes: bool,
}

/// How a model and those that it attaches are read: each by its own settings.
pub struct Compilers {
    all: Vec<Compiler>,
    /// The model that each file is of. Never falls: the files of a model follow each other.
    models: Vec<usize>,
}

impl Compilers {
    /// What the `<compiler>`s of the models say, the last one last. `models` has the model of each file.
    pub fn of(root: &Element, models: Vec<usize>) -> Fallible<Self> {
        let count = models.last().map_or(1, |last| last + 1);
        let all = (0..count).map(|_| Compiler::new()).collect();
        let mut compilers = Compilers { all, models };
        for element in root.all("compiler") {
            let model = compilers.model(element.place);
            compilers.all[model].read(element)?;
        }
        Ok(compilers)
    }

    fn model(&self, place: Place) -> usize {
        self.models.get(place.file).copied().unwrap_or(0)
    }

    /// How the model is read that has a place.
    pub fn at(&self, place: Place) -> &Compiler {
        &self.all[self.model(place)]
    }

    /// The first file of the model that has a place.
    pub fn first_file(&self, place: Place) -> usize {
        let model = self.model(place);
        self.models.partition_point(|of| *of < model)
    }
}

impl Compiler {
    /// How a model is read that says nothing.
    pub fn new() -> Self {
        Compiler {
            angle: 1.0_f64.to_radians(),
            euler: ['x', 'y', 'z'],
            has_auto_limits: true,
            mesh_folder: String::new(),
            texture_folder: String::new(),
            strips_paths: false,
            from_shapes: None,
            mass_groups: 0..=5,
            balances: false,
            least_mass: 0.0,
            least_inertia: 0.0,
            total_mass: None,
            discards_visuals: false,
            fits_boxes: false,
        }
    }

    /// Whether a range is a limit, by the attribute that says it and what that says: 0 for false, 1 for true.
    pub fn is_limit(
        &self,
        element: &Element,
        (attribute, said): (&'static str, Option<usize>),
        ends: [f64; 2],
    ) -> Fallible<bool> {
        match said {
            Some(which @ (0 | 1)) => Ok(which == 1),
            _ if ends == [0.0; 2] => Ok(false),
            _ if self.has_auto_limits => Ok(ends[0] < ends[1]),
            _ => {
                let element_name = element.tag.clone();
                let fault = MjcfFault::NoLimited { element: element_name, attribute };
                Err(at(element.place, fault))
            }
        }
    }

    fn read(&mut self, element: &Element) -> Fallible<()> {
        let coordinate = element.word("coordinate", &["local", "global"], "`local`")?;
        if coordinate == Some(1) {
            return Err(at(element.place, MjcfFault::GlobalCoordinates));
        }
        if let Some(which) = element.word("angle", &["radian", "degree"], "`radian` or `degree`")? {
            self.angle = if which == 0 { 1.0 } else { 1.0_f64.to_radians() };
        }
        if let Some(text) = element.get("eulerseq") {
            let axes: Vec<char> = text.chars().filter(|axis| "xyzXYZ".contains(*axis)).collect();
            let axes = <[char; 3]>::try_from(axes).ok().filter(|_| text.len() == 3);
            self.euler =
                axes.ok_or_else(|| wrong(element, "eulerseq", "three of x, y, z, X, Y, Z"))?;
        }
        if let Some(folder) = element.get("assetdir") {
            self.mesh_folder = folder.to_owned();
            self.texture_folder = folder.to_owned();
        }
        for (name, folder) in
            [("meshdir", &mut self.mesh_folder), ("texturedir", &mut self.texture_folder)]
        {
            if let Some(text) = element.get(name) {
                text.clone_into(folder);
            }
        }
        for (name, setting) in [
            ("autolimits", &mut self.has_auto_limits),
            ("strippath", &mut self.strips_paths),
            ("balanceinertia", &mut self.balances),
            ("discardvisual", &mut self.discards_visuals),
            ("fitaabb", &mut self.fits_boxes),
        ] {
            *setting = element.flag(name)?.unwrap_or(*setting);
        }
        let words = ["false", "true", "auto"];
        let from = element.word("inertiafromgeom", &words, "`false`, `true` or `auto`")?;
        self.from_shapes =
            from.map_or(self.from_shapes, |which| [Some(false), Some(true), None][which]);
        if let Some([first, last]) = element.numbers::<2>("inertiagrouprange")? {
            #[expect(clippy::cast_possible_truncation, reason = "groups are few")]
            let groups = first.ceil() as i64..=last.floor() as i64;
            self.mass_groups = groups;
        }
        for (name, least) in
            [("boundmass", &mut self.least_mass), ("boundinertia", &mut self.least_inertia)]
        {
            *least = element.number(name)?.unwrap_or(*least);
        }
        if let Some(total) = element.number("settotalmass")? {
            self.total_mass = (total > 0.0).then_some(total);
        }
        Ok(())
    }
}

const WAYS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];
/// Vectors that are shorter have no direction.
const SHORT: f64 = 1e-14;

/// Where an element is: `pos` and its orientation.
pub fn pose(view: View<'_>, compiler: &Compiler) -> Fallible<Isometry3<f64>> {
    let position = view.numbers::<3>("pos")?.unwrap_or_default();
    let rotation = orientation(view, compiler)?.unwrap_or_default();
    Ok(Isometry3::from_parts(Translation3::from(position), rotation))
}

/// The orientation of an element, if it or its class says one.
pub fn orientation(view: View<'_>, compiler: &Compiler) -> Fallible<Option<UnitQuaternion<f64>>> {
    for element in view.chain() {
        let mut ways = WAYS.iter().filter(|way| element.get(way).is_some());
        let Some(way) = ways.next() else { continue };
        if ways.next().is_some() {
            let element_name = element.tag.clone();
            return Err(at(element.place, MjcfFault::TwoOrientations { element: element_name }));
        }
        return Ok(Some(match *way {
            "quat" => quaternion(element, "quat")?.unwrap_or_default(),
            "axisangle" => axis_angle(element, compiler)?,
            "xyaxes" => xy_axes(element)?,
            "zaxis" => {
                let [x, y, z] = element.numbers("zaxis")?.unwrap_or_default();
                z_to(direction(element, "zaxis", Vector3::new(x, y, z))?)
            }
            _ => euler(element.numbers("euler")?.unwrap_or_default(), compiler),
        }));
    }
    Ok(None)
}

/// A quaternion, w first.
pub fn quaternion(element: &Element, name: &str) -> Fallible<Option<UnitQuaternion<f64>>> {
    let Some([w, x, y, z]) = element.numbers::<4>(name)? else { return Ok(None) };
    if [w, x, y, z] == [0.0; 4] {
        return Err(wrong(element, name, "a quaternion that is not zero"));
    }
    Ok(Some(unit(Quaternion::new(w, x, y, z))))
}

/// A quaternion of length 1.
pub fn unit(quaternion: Quaternion<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::try_new(quaternion, 1e-15).unwrap_or_default()
}

pub fn euler(angles: [f64; 3], compiler: &Compiler) -> UnitQuaternion<f64> {
    let mut rotation = UnitQuaternion::identity();
    for (axis, angle) in compiler.euler.into_iter().zip(angles) {
        let about = match axis.to_ascii_lowercase() {
            'x' => Vector3::x_axis(),
            'y' => Vector3::y_axis(),
            _ => Vector3::z_axis(),
        };
        let turn = UnitQuaternion::from_axis_angle(&about, angle * compiler.angle);
        rotation = if axis.is_ascii_lowercase() { rotation * turn } else { turn * rotation };
    }
    rotation
}

/// The least rotation that takes z to a direction; from -z, half a turn about x.
pub fn z_to(direction: Unit<Vector3<f64>>) -> UnitQuaternion<f64> {
    let across = Vector3::z().cross(&direction);
    let sine = across.norm();
    let axis = if sine < 1e-10 { Vector3::x_axis() } else { Unit::new_normalize(across) };
    UnitQuaternion::from_axis_angle(&axis, sine.atan2(direction.z))
}

fn axis_angle(element: &Element, compiler: &Compiler) -> Fallible<UnitQuaternion<f64>> {
    let [x, y, z, angle] = element.numbers("axisangle")?.unwrap_or_default();
    let axis = direction(element, "axisangle", Vector3::new(x, y, z))?;
    Ok(UnitQuaternion::from_axis_angle(&axis, angle * compiler.angle))
}

fn xy_axes(element: &Element) -> Fallible<UnitQuaternion<f64>> {
    let [a, b, c, d, e, f] = element.numbers("xyaxes")?.unwrap_or_default();
    let x = direction(element, "xyaxes", Vector3::new(a, b, c))?;
    let y = Vector3::new(d, e, f);
    let y = direction(element, "xyaxes", y - x.into_inner() * x.dot(&y))?;
    let axes = Matrix3::from_columns(&[x.into_inner(), y.into_inner(), x.cross(&y)]);
    Ok(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes)))
}

fn direction(
    element: &Element,
    attribute: &str,
    vector: Vector3<f64>,
) -> Fallible<Unit<Vector3<f64>>> {
    let wanted = "axes that have a direction, and differ";
    Unit::try_new(vector, SHORT).ok_or_else(|| wrong(element, attribute, wanted))
}
