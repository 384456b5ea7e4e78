//! What the parts of the reader share: attributes and children, as MuJoCo asks for them, `<mujoco>` in a URDF, and masses and
//! tensors of bodies, with the limits that MuJoCo has for them.

use crate::number::{Matrix, Pose, Vector, centre, moved, sum, turned};
use crate::prelude::*;

/// The least mass, and the least moment of inertia, of a link that moves.
pub const LEAST: f64 = 1e-15;

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Release {
    /// 3.3.7.
    Three,
    /// 4.0.0.
    Four,
}

impl Release {
    /// What counts as nothing off the diagonal of a tensor.
    pub fn epsilon(self) -> f64 {
        match self {
            Release::Three => 1e-12,
            Release::Four => 0.0,
        }
    }
}

pub struct MujocoReader<'r> {
    pub release: Release,
    pub file: &'r File<'r>,
    pub effects: &'r mut Effects,
    pub settings: Settings,
    /// The names of collisions.
    pub geoms: HashSet<String>,
}

/// What `<compiler>` says.
#[derive(Default)]
pub struct Settings {
    /// Visuals are geoms too.
    pub has_visuals: bool,
    /// Only the last part of a mesh's file name counts; none if nothing is said.
    pub strips_paths: Option<bool>,
    pub mesh_folder: String,
    /// Tensors that no body can have are mended.
    pub balances: bool,
    /// Links that are fixed together stay links.
    pub keeps_fixed: bool,
    /// Inertias come from collisions, whatever inertials say.
    pub ignores_inertials: bool,
    /// The least mass and the least moment.
    pub least: [f64; 2],
}

/// The least numbers without loss, of double and of single precision.
const TINY: f64 = f64::MIN_POSITIVE;
const SINGLE_TINY: f64 = f32::MIN_POSITIVE as f64;

impl MujocoReader<'_> {
    pub fn settings(&mut self, robot: Node<'_>) -> Reading<()> {
        let Some(mujoco) = self.only(robot, "mujoco")? else { return Ok(()) };
        if let Some(compiler) = self.only(mujoco, "compiler")? {
            self.compiler(compiler)?;
        }
        if let Some(option) = self.only(mujoco, "option")? {
            self.each_number(option, &["timestep", "impratio", "tolerance", "gravity", "wind"])?;
        }
        if let Some(size) = self.only(mujoco, "size")? {
            self.each_number(size, &["njmax", "nconmax", "nstack", "nuserdata", "nkey"])?;
        }
        Ok(())
    }

    fn compiler(&mut self, compiler: Node<'_>) -> Reading<()> {
        const FLAGS: [&str; 6] =
            ["autolimits", "usethread", "fitaabb", "alignfree", "saveinertial", "discardvisual"];
        for name in FLAGS {
            self.flag(compiler, name)?;
        }
        self.keyword(compiler, "angle", &["radian", "degree"])?;
        self.keyword(compiler, "coordinate", &["local", "global"])?;
        self.each_number(compiler, &["boundmass", "boundinertia", "settotalmass"])?;
        for (name, least) in [("boundmass", 0), ("boundinertia", 1)] {
            let value = compiler.value(name).and_then(|value| whole(strtod(value.trim())));
            self.settings.least[least] = value.unwrap_or(0.0);
        }
        self.settings.has_visuals = self.flag(compiler, "discardvisual")? == Some(false);
        self.settings.strips_paths = self.flag(compiler, "strippath")?;
        self.settings.balances = self.flag(compiler, "balanceinertia")?.unwrap_or(false);
        self.settings.keeps_fixed = self.flag(compiler, "fusestatic")? == Some(false);
        self.settings.mesh_folder = compiler.value("meshdir").unwrap_or_default().to_owned();
        let ignores = self.keyword(compiler, "inertiafromgeom", &["false", "true", "auto"])?;
        self.settings.ignores_inertials = ignores == Some("true");
        Ok(())
    }

    fn flag(&mut self, node: Node<'_>, name: &str) -> Reading<Option<bool>> {
        let known =
            if name == "autolimits" { &["false", "true", "auto"][..] } else { &["false", "true"] };
        Ok(self.keyword(node, name, known)?.map(|value| value == "true"))
    }

    fn keyword<'t>(
        &mut self,
        node: Node<'t>,
        name: &str,
        known: &[&str],
    ) -> Reading<Option<&'t str>> {
        match node.attribute(name) {
            Some(value) if !known.contains(&&*value.value) => {
                self.effects.refuse(value, Fault::value(name, &value.value))
            }
            value => Ok(value.map(|value| &*value.value)),
        }
    }

    /// Attributes that are numbers, whatever their count.
    fn each_number(&mut self, node: Node<'_>, names: &[&str]) -> Reading<()> {
        for value in names.iter().filter_map(|name| node.attribute(name)) {
            if !words(&value.value).all(|word| whole(strtod(word)).is_some()) {
                return self.effects.refuse(value, Fault::not_a_number(value));
            }
        }
        Ok(())
    }
}

impl MujocoReader<'_> {
    /// The child of a name; two are refused.
    pub fn only<'t>(&mut self, node: Node<'t>, name: &str) -> Reading<Option<Node<'t>>> {
        let mut found = node.named(name);
        let first = found.next();
        match found.next() {
            Some(second) => self.effects.refuse(second, Fault::Repeated(name.into())),
            None => Ok(first),
        }
    }

    pub fn needed<'t>(&mut self, node: Node<'t>, name: &'static str) -> Reading<Node<'t>> {
        match self.only(node, name)? {
            Some(child) => Ok(child),
            None => self.effects.refuse(node, Fault::MissingElement(name)),
        }
    }

    pub fn text<'t>(&mut self, node: Node<'t>, name: &'static str) -> Reading<&'t str> {
        Ok(&self.effects.needed(node, name)?.value)
    }

    /// Numbers that may be left out; `part` is what has them.
    pub fn numbers<const N: usize>(
        &mut self,
        node: Node<'_>,
        name: &'static str,
        part: &Part,
    ) -> Reading<Option<[f64; N]>> {
        let Some(value) = node.attribute(name) else { return Ok(None) };
        let found = self.vector(value)?;
        if found.is_none() {
            self.effects.read_as(value, part, Fault::Empty(name), "the default");
        }
        Ok(found)
    }

    pub fn number(
        &mut self,
        node: Node<'_>,
        name: &'static str,
        part: &Part,
    ) -> Reading<Option<f64>> {
        Ok(self.numbers(node, name, part)?.map(|[number]: [f64; 1]| number))
    }

    pub fn needed_numbers<const N: usize>(
        &mut self,
        node: Node<'_>,
        name: &'static str,
    ) -> Reading<[f64; N]> {
        let value = self.effects.needed(node, name)?;
        match self.vector(value)? {
            Some(numbers) => Ok(numbers),
            None => self.effects.refuse(value, Fault::Empty(name)),
        }
    }

    /// Says of numbers that were read whether they are finite: those of parts that move make all that moves unstable.
    pub fn finite(&mut self, node: Node<'_>, names: &[&str]) {
        for value in names.iter().filter_map(|name| node.attribute(name)) {
            let is_finite = |word| whole(strtod(word)).is_none_or(f64::is_finite);
            if !words(&value.value).all(is_finite) {
                let fault = Fault::range(value, "must be finite");
                self.effects.read_as(value, "robot/?", fault, "a simulation that is unstable");
            }
        }
    }

    /// A colour, which is read in single precision.
    pub fn color(&mut self, color: Node<'_>) -> Reading<[f64; 4]> {
        let rgba: [f64; 4] = self.needed_numbers(color, "rgba")?;
        let is_fine = |number: &f64| {
            number.is_infinite()
                || number.is_nan()
                || (number.abs() < f64::from(f32::MAX) * (1.0 + f64::from(f32::EPSILON) / 4.0)
                    && (*number == 0.0
                        || self.release == Release::Four
                        || number.abs() >= SINGLE_TINY))
        };
        if rgba.iter().all(is_fine) {
            return Ok(rgba);
        }
        let at = color.attribute("rgba").map_or(color.start(), |rgba| rgba.range.start);
        self.effects.refuse(at, Fault::Other("`rgba` has a number that is too large or too small"))
    }

    /// Exactly N numbers; none if there is only white space.
    fn vector<const N: usize>(&mut self, value: &Attribute<'_>) -> Reading<Option<[f64; N]>> {
        let mut numbers = Vec::new();
        for word in words(&value.value) {
            let Some(number) = whole(strtod(word)) else {
                return self.effects.refuse(value, Fault::not_a_number(value));
            };
            if is_too_large(word, number)
                || (self.release == Release::Three && is_too_small(word, number))
            {
                let rule = "the program cannot have so large or small a number";
                return self.effects.refuse(value, Fault::range(value, rule));
            }
            numbers.push(number);
        }
        if numbers.is_empty() {
            return Ok(None);
        }
        match numbers.try_into() {
            Ok(numbers) => Ok(Some(numbers)),
            Err(_) => self.effects.refuse(value, Fault::count(value, N)),
        }
    }

    /// The scale of a mesh, which is read by a function of its own.
    pub fn scale(&mut self, mesh: Node<'_>) -> Reading<[f64; 3]> {
        let Some(value) = mesh.attribute("scale") else { return Ok([1.0; 3]) };
        let number = |word: &str| {
            let number = whole(strtod(word))?;
            let plain = word.strip_prefix('-').unwrap_or(word);
            let is_word = ["inf", "nan"].iter().any(|one| plain.eq_ignore_ascii_case(one));
            let is_read = number.is_finite() && !is_too_small(word, number);
            (is_word || is_read).then_some(number)
        };
        let count = words(&value.value).count();
        let numbers: Option<Vec<f64>> = words(&value.value).take(3).map(number).collect();
        match numbers.map(<[f64; 3]>::try_from) {
            None => self.effects.refuse(value, Fault::not_a_number(value)),
            Some(Ok(scale)) if count == 3 => Ok(scale),
            _ => self.effects.refuse(value, Fault::count(value, 3)),
        }
    }
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(is_space).filter(|word| !word.is_empty())
}

/// Whether digits make a number beyond all.
fn is_too_large(word: &str, number: f64) -> bool {
    number.is_infinite() && !word.contains(['n', 'N'])
}

/// Whether digits make a number that is not 0, and that has no full precision.
fn is_too_small(word: &str, number: f64) -> bool {
    let is_hexadecimal = word.contains(['x', 'X']);
    let mut mantissa = word.split(['e', 'E']).next().unwrap_or_default().bytes();
    match number == 0.0 {
        true => !is_hexadecimal && mantissa.any(|byte| matches!(byte, b'1'..=b'9')),
        false => number.abs() < TINY,
    }
}

pub const LEAST_EIGENVALUE: f64 = 1e-14;

/// Mass, centre, tensor about the centre, and its eigenvalues from the largest to the smallest.
#[derive(Clone, Default)]
pub struct Body {
    pub mass: f64,
    pub centre: Vector,
    pub tensor: Matrix,
    pub moments: Vector,
}

impl Body {
    /// A body whose tensor is about axes of its own.
    pub fn new(mass: f64, pose: &Pose, tensor: &Matrix) -> Body {
        let tensor = turned(tensor, &pose.turn);
        Body { mass, centre: pose.xyz, tensor, moments: [0.0; 3] }
    }

    /// The body as it is seen from another place.
    pub fn placed(&self, at: &Pose) -> Body {
        Body {
            mass: self.mass,
            centre: at.place(self.centre),
            tensor: turned(&self.tensor, &at.turn),
            moments: self.moments,
        }
    }

    /// Two bodies as one.
    pub fn with(&self, other: &Body, epsilon: f64) -> Body {
        let mass = self.mass + other.mass;
        let centre = centre([self.mass, other.mass], [self.centre, other.centre]);
        let [own, others] =
            [self, other].map(|body| moved(&body.tensor, body.mass, body.centre, centre));
        let tensor = sum(&own, &others);
        Body { mass, centre, tensor, moments: eigenvalues(&tensor, epsilon) }
    }
}

/// The eigenvalues of a symmetric matrix from the largest to the smallest, by rotations that make its largest element off
/// the diagonal 0. One below `epsilon`, and a rotation that is less, is none. NaN if an element is not finite.
pub fn eigenvalues(matrix: &Matrix, epsilon: f64) -> Vector {
    const MOST: usize = 500;
    if matrix.iter().flatten().any(|value| !value.is_finite()) {
        return [f64::NAN; 3];
    }
    let mut turned = *matrix;
    for _ in 0..MOST {
        let off = |row: usize, column: usize| turned[row][column].abs();
        let (row, column, other) = if off(0, 1) > off(0, 2) && off(0, 1) > off(1, 2) {
            (0, 1, 2)
        } else if off(0, 2) > off(1, 2) {
            (0, 2, 1)
        } else {
            (1, 2, 0)
        };
        let value = turned[row][column];
        if value == 0.0 || value.abs() < epsilon {
            break;
        }
        let tau = (turned[column][column] - turned[row][row]) / (2.0 * value);
        let tangent = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
        let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
        if cosine > 1.0 - epsilon {
            break;
        }
        let sine = tangent * cosine;
        turned[row][row] -= tangent * value;
        turned[column][column] += tangent * value;
        let (first, second) = (turned[other][row], turned[other][column]);
        for (at, value) in [
            ((row, column), 0.0),
            ((other, row), cosine * first - sine * second),
            ((other, column), sine * first + cosine * second),
        ] {
            (turned[at.0][at.1], turned[at.1][at.0]) = (value, value);
        }
    }
    let mut values = [0, 1, 2].map(|axis| turned[axis][axis]);
    values.sort_by(|a, b| b.total_cmp(a));
    values
}
