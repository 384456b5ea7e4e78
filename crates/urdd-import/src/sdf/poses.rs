//! Where the frames of a scene are, and which link each moves with.

use nalgebra::Isometry3;

use super::super::refusal::{Fallible, at};
use super::fault::SdfFault;
use super::scene::{NodeKind, Scene};

/// The frames of a scene.
#[derive(Debug)]
pub struct Frames {
    /// The pose of each node in the frame of the model.
    pub poses: Vec<Isometry3<f64>>,
    /// The link that each node moves with; `None` of a model without links.
    pub links: Vec<Option<usize>>,
}

impl Frames {
    /// Resolves the names of a scene, whose first node is the model's.
    ///
    /// # Errors
    /// If a name has no meaning, or frames refer to each other in a circle.
    pub fn of(scene: &Scene) -> Fallible<Self> {
        let attached = attached(scene)?;
        let bases = bases(scene, &attached)?;
        Ok(Frames { poses: poses(scene, &bases)?, links: links(scene, &attached)? })
    }

    /// The node that a name means, in the scope of another node.
    pub fn named(scene: &Scene, node: usize, element: &str, name: &str) -> Fallible<usize> {
        let (scope, place) = (scene.nodes[node].scope, scene.nodes[node].place);
        match scene.find(scope, name) {
            Some(found) => Ok(found),
            None => {
                let model = scene.scopes[scope].name.clone();
                let (element, name) = (element.to_owned(), name.to_owned());
                Err(at(place, SdfFault::Unknown { element, name, model }))
            }
        }
    }

    /// The pose of a node in the frame of another.
    pub fn relative(&self, node: usize, to: usize) -> Isometry3<f64> {
        snapped(self.poses[to].inv_mul(&self.poses[node]))
    }
}

/// Poses that differ from none by rounding alone are none.
pub fn snapped(pose: Isometry3<f64>) -> Isometry3<f64> {
    const ROUNDING: f64 = 1e-14;
    let mut snapped = pose;
    if pose.rotation.vector().amax() < ROUNDING {
        snapped.rotation = nalgebra::UnitQuaternion::identity();
    }
    if pose.translation.vector.amax() < ROUNDING {
        snapped.translation = nalgebra::Translation3::identity();
    }
    snapped
}

/// What each node is attached to: for a model, the link or model that holds its frame.
fn attached(scene: &Scene) -> Fallible<Vec<Option<usize>>> {
    let each = scene.nodes.iter().enumerate().map(|(index, node)| match node.kind {
        NodeKind::Link(_) => Ok(None),
        NodeKind::Joint(_) => {
            let child = node.attached_to.as_deref().unwrap_or_default();
            Frames::named(scene, index, "child", child).map(Some)
        }
        NodeKind::Frame => match &node.attached_to {
            Some(name) => Frames::named(scene, index, "attached_to", name).map(Some),
            None => Ok(Some(scene.scopes[node.scope].model)),
        },
        NodeKind::Model(inside) => {
            let scope = &scene.scopes[inside];
            let named = scope.canonical.as_deref().and_then(|name| scene.find(inside, name));
            Ok(named.or(scope.first_link).or(scope.first_model))
        }
    });
    each.collect()
}

/// The node that the pose of each is relative to.
fn bases(scene: &Scene, attached: &[Option<usize>]) -> Fallible<Vec<Option<usize>>> {
    let each = scene.nodes.iter().enumerate().map(|(index, node)| {
        if index == 0 {
            return Ok(None);
        }
        if let Some(name) = &node.relative_to {
            return Frames::named(scene, index, "relative_to", name).map(Some);
        }
        Ok(match node.kind {
            NodeKind::Joint(_) => attached[index],
            NodeKind::Frame if node.attached_to.is_some() => attached[index],
            _ => Some(scene.scopes[node.scope].model),
        })
    });
    each.collect()
}

fn circle<T>(scene: &Scene, node: usize) -> Fallible<T> {
    let node = &scene.nodes[node];
    Err(at(node.place, SdfFault::Circle(node.name.clone())))
}

/// A node and those before it up to the first of which something is known, and what that is.
fn chain<T: Copy>(
    scene: &Scene,
    node: usize,
    before: &[Option<usize>],
    known: &[Option<T>],
) -> Fallible<(Vec<usize>, Option<T>)> {
    let (mut chain, mut at) = (Vec::new(), Some(node));
    while let Some(open) = at.filter(|at| known[*at].is_none()) {
        chain.push(open);
        if chain.len() > scene.nodes.len() {
            return circle(scene, node);
        }
        at = before[open];
    }
    Ok((chain, at.and_then(|at| known[at])))
}

fn poses(scene: &Scene, bases: &[Option<usize>]) -> Fallible<Vec<Isometry3<f64>>> {
    let mut own: Vec<Isometry3<f64>> = scene.nodes.iter().map(|node| node.pose).collect();
    own[0] = Isometry3::identity();
    // Models are made before what is in them: the innermost first.
    for model in (1..scene.nodes.len()).rev() {
        let NodeKind::Model(inside) = scene.nodes[model].kind else { continue };
        let Some(name) = &scene.nodes[model].placement else { continue };
        let Some(placed) = scene.find(inside, name) else {
            let (element, name) = ("placement_frame".to_owned(), name.clone());
            let unknown =
                SdfFault::Unknown { element, name, model: scene.nodes[model].name.clone() };
            return Err(at(scene.nodes[model].place, unknown));
        };
        let (mut pose, mut at, mut steps) = (Isometry3::identity(), placed, 0);
        while at != model {
            pose = own[at] * pose;
            steps += 1;
            match bases[at].filter(|_| steps <= scene.nodes.len()) {
                Some(base) => at = base,
                None => return circle(scene, model),
            }
        }
        own[model] *= pose.inverse();
    }
    let mut poses: Vec<Option<Isometry3<f64>>> = vec![None; scene.nodes.len()];
    for node in 0..scene.nodes.len() {
        let (chain, known) = chain(scene, node, bases, &poses)?;
        let mut pose = known.unwrap_or_default();
        for open in chain.into_iter().rev() {
            pose *= own[open];
            poses[open] = Some(pose);
        }
    }
    Ok(poses.into_iter().map(Option::unwrap_or_default).collect())
}

/// The link at the end of what each node is attached to.
fn links(scene: &Scene, attached: &[Option<usize>]) -> Fallible<Vec<Option<usize>>> {
    let mut links: Vec<Option<Option<usize>>> = vec![None; scene.nodes.len()];
    for node in 0..scene.nodes.len() {
        let (chain, known) = chain(scene, node, attached, &links)?;
        let last = chain.last().map(|last| scene.nodes[*last].kind);
        let link = known.unwrap_or(match last {
            Some(NodeKind::Link(link)) => Some(link),
            _ => None,
        });
        for open in chain {
            links[open] = Some(link);
        }
    }
    Ok(links.into_iter().map(Option::unwrap_or_default).collect())
}
