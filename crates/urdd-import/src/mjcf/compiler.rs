//! `<compiler>`: how the rest of a model is read.

use std::ops::RangeInclusive;

use super::super::place::Place;
use super::super::refusal::{Fallible, at};
use super::element::Element;
use super::fault::MjcfFault;
use super::reading::{Attributes, wrong};

/// When masses come from shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FromShapes {
    /// Never.
    Never,
    /// Always.
    Always,
    /// Where a body says no mass.
    Auto,
}

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
    pub from_shapes: FromShapes,
    /// The groups of shapes that have mass.
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
            from_shapes: FromShapes::Auto,
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
        self.from_shapes = match from {
            Some(0) => FromShapes::Never,
            Some(1) => FromShapes::Always,
            Some(_) => FromShapes::Auto,
            None => self.from_shapes,
        };
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
