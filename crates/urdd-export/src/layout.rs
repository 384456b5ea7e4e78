//! Where the links of an export are in those of the URDD, and the other way round. Links of the URDD keep their numbers;
//! frames are added after them.

use std::ops::Range;

use nalgebra::Isometry3;

use crate::{Shape, Solid};
use urdd_format::urdf::Origin;
use urdd_kinematics::rotation::to_rpy;

#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub link: usize,
    pub pose: Isometry3<f64>,
}

impl Place {
    pub fn at(link: usize) -> Self {
        Place { link, pose: Isometry3::identity() }
    }
}

/// Where links are. Empty for a robot as it is in its URDD.
#[derive(Debug, Clone, Default)]
pub(super) struct Layout {
    /// By link of the URDD, the link of the export that has its mass and shapes, and its frame in that link's.
    pub content: Vec<Place>,
    /// By link of the export, its frame in that of a link of the URDD.
    pub frames: Vec<Place>,
    /// By link of the URDD, the link of the export that has its frame.
    pub frame_of: Vec<usize>,
    /// By link of the export, whether it is but a frame on its parent: without mass, shapes and links after it.
    pub is_frame: Vec<bool>,
    /// By link of the URDD, the numbers of its shapes among those of the link that has them.
    shapes: Vec<Range<usize>>,
    pub root: usize,
}

impl Layout {
    /// A robot whose links are where they are in its URDD.
    pub fn new(links: usize, root: usize) -> Self {
        let places = || (0..links).map(Place::at).collect();
        Layout {
            content: places(),
            frames: places(),
            frame_of: (0..links).collect(),
            is_frame: vec![false; links],
            shapes: Vec::new(),
            root,
        }
    }

    /// Whether the robot is as in its URDD.
    pub fn is_empty(&self) -> bool {
        self.content.is_empty()
    }

    /// Numbers the shapes of links that have those of others: their own come first. `shapes` has the links and pieces of
    /// the URDD's.
    pub fn number(&mut self, shapes: Vec<(usize, usize)>) {
        let mut counts = vec![0; self.content.len()];
        for (link, piece) in shapes {
            if let Some(count) = counts.get_mut(link) {
                *count = usize::max(*count, piece.saturating_add(1));
            }
        }
        let mut next = counts.clone();
        let numbers = |(link, (place, count)): (usize, (&Place, &usize))| {
            if place.link == link {
                return 0..*count;
            }
            let first = next[place.link];
            next[place.link] += count;
            first..first + count
        };
        self.shapes = self.content.iter().zip(&counts).enumerate().map(numbers).collect();
    }

    /// The link that has the mass and shapes of a link of the URDD.
    pub fn body(&self, link: usize) -> usize {
        self.content.get(link).map_or(link, |place| place.link)
    }

    /// Where a frame of a link of the URDD is: the link that has the mass and shapes of its link, and its pose in it.
    pub fn place(&self, link: usize, frame: &Isometry3<f64>) -> Place {
        let on = self.content.get(link).copied().unwrap_or(Place::at(link));
        Place { link: on.link, pose: on.pose * frame }
    }

    /// The link and piece of a shape of the URDD.
    pub fn shape(&self, (link, piece): (usize, usize)) -> (usize, usize) {
        (self.body(link), piece + self.shapes.get(link).map_or(0, |numbers| numbers.start))
    }

    /// The link of the URDD that a shape is of.
    pub fn source(&self, body: usize, piece: usize) -> usize {
        let mut links = self.content.iter().zip(&self.shapes);
        let found = links.position(|(at, numbers)| at.link == body && numbers.contains(&piece));
        found.unwrap_or(body)
    }

    /// The link of the export that has the frame of a link of the URDD.
    pub fn frame(&self, link: usize) -> usize {
        self.frame_of.get(link).copied().unwrap_or(link)
    }

    /// What is in links of the URDD, by link of the export: what is a body's own first.
    pub fn gather<T>(
        &self,
        mut by_link: Vec<Vec<T>>,
        place: impl Fn(usize, &Isometry3<f64>, &mut T),
    ) -> Vec<Vec<T>> {
        if self.is_empty() {
            return by_link;
        }
        let mut gathered: Vec<Vec<T>> = self.frames.iter().map(|_| Vec::new()).collect();
        for is_own in [true, false] {
            for (link, (at, content)) in self.content.iter().zip(&mut by_link).enumerate() {
                if (at.link == link) == is_own {
                    content.iter_mut().for_each(|of| place(link, &at.pose, of));
                    gathered[at.link].append(content);
                }
            }
        }
        gathered
    }

    /// Shapes of links of the URDD, by link of the export.
    pub fn gather_shapes(&self, by_link: Vec<Vec<Shape>>) -> Vec<Vec<Shape>> {
        self.gather(by_link, |link, pose, shape| {
            match &mut shape.solid {
                Solid::Convex(mesh) | Solid::Mesh(mesh) => {
                    mesh.transform(&pose.to_homogeneous());
                }
                Solid::Primitive(own, _) => *own = pose * *own,
            }
            shape.number = self.shape((link, shape.number)).1;
        })
    }

    /// The poses of the links of the export in its root, by those of the URDD in its own.
    pub fn poses(&self, poses: Vec<Isometry3<f64>>) -> Vec<Isometry3<f64>> {
        if self.is_empty() {
            return poses;
        }
        let root = self.root_at(&poses).inverse();
        self.frames.iter().map(|place| root * poses[place.link] * place.pose).collect()
    }

    /// The pose of the root in that of the URDD.
    pub fn root_at(&self, poses: &[Isometry3<f64>]) -> Isometry3<f64> {
        let place = self.frames.get(self.root);
        place.map_or(Isometry3::identity(), |place| poses[place.link] * place.pose)
    }
}

pub(super) fn origin(pose: &Isometry3<f64>) -> Origin {
    Origin {
        xyz: Some(pose.translation.vector.into()),
        rpy: Some(to_rpy(pose.rotation.to_rotation_matrix().matrix())),
        quat_xyzw: None,
    }
}
