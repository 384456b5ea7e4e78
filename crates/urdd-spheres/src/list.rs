//! Spheres that a person gave, by the names of links.

use super::model::Sphere;

/// The spheres of some links, each in its link's frame, in metres.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SphereList {
    /// Links by name, each with its spheres.
    pub links: Vec<(String, Vec<Sphere>)>,
    /// What of the list was left out, each with the reason.
    pub left_out: Vec<String>,
}

impl SphereList {
    /// For each link of a robot, its spheres. A link that stands twice has those of both.
    pub fn by_link<T: AsRef<str>>(&self, names: &[T]) -> Vec<Vec<Sphere>> {
        let mut found = vec![Vec::new(); names.len()];
        for (name, spheres) in &self.links {
            if let Some(link) = names.iter().position(|link| link.as_ref() == name) {
                found[link].extend(spheres.iter().copied());
            }
        }
        found
    }

    /// How many spheres there are.
    pub fn count(&self) -> usize {
        self.links.iter().map(|(_, spheres)| spheres.len()).sum()
    }
}
