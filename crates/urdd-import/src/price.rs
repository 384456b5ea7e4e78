//! What the entries of a model are charged.

use urdd_directory::account::Cost;

use super::model::{
    Apart, Asset, Body, Closing, Configuration, Coupled, GazeboElement, Joint, JointValue, Shape,
};

/// What comes of an entry, bytes: in memory, in the URDF and in its companions, and in what reads these.
pub const ENTRY: usize = 3000;
/// The same, of a value of a joint or a pair.
pub const PART: usize = 500;
/// The same, of each byte of a name.
pub const LETTER: usize = 12;

impl Cost for Body {
    fn cost(&self) -> usize {
        ENTRY + LETTER * self.name.len()
    }
}

impl Cost for Joint {
    fn cost(&self) -> usize {
        let leader = self.mimic.as_ref().map(|of| &of.joint);
        let others = leader.into_iter().chain(&self.actuator.name);
        ENTRY + LETTER * (self.name.len() + others.map(String::len).sum::<usize>())
    }
}

impl Cost for Shape {
    fn cost(&self) -> usize {
        let material = self.material.as_ref().and_then(|material| material.name.as_ref());
        ENTRY + LETTER * self.name.iter().chain(material).map(String::len).sum::<usize>()
    }
}

impl Cost for Asset {
    fn cost(&self) -> usize {
        self.path.len() + self.bytes.len()
    }
}

impl Cost for Configuration {
    fn cost(&self) -> usize {
        ENTRY + LETTER * self.name.len()
    }
}

impl Cost for JointValue {
    fn cost(&self) -> usize {
        PART + LETTER * self.name.len()
    }
}

impl Cost for Apart {
    fn cost(&self) -> usize {
        PART
    }
}

impl Cost for Closing {
    fn cost(&self) -> usize {
        ENTRY + LETTER * self.name.as_ref().map_or(0, String::len)
    }
}

impl Cost for Coupled {
    fn cost(&self) -> usize {
        let names = self.name.iter().chain(self.terms.iter().map(|(name, _)| name));
        ENTRY + LETTER * names.map(String::len).sum::<usize>()
    }
}

impl Cost for GazeboElement {
    fn cost(&self) -> usize {
        ENTRY + LETTER * self.0.len()
    }
}
