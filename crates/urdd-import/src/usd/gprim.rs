//! Shapes of bodies: what is seen, and what collides.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use nalgebra::{Isometry3, Matrix3, Translation3};
use sha2::{Digest, Sha256};
use urdd_directory::account::Charged;
use urdd_directory::path::file_name;
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::read::Part;
use urdd_geometry::write::stl;
use urdd_source::gate::Gate;
use urdd_usd::Value;

use super::super::features::{self, Tally};
use super::super::model::{Asset, Geometry, Material, Shape, Use};
use super::super::refusal::{Fallible, at};
use super::form::{Form, bounding, form, reach};
use super::look::{look, rubbed};
use super::made::Made;
use super::mesh::{Faces, faces};
use super::scene::{Scene, flag, is_square, number, split, word};

/// Bytes of a mesh in memory for each number of it, about: triangles, their hull, what is written.
const MESH: usize = 60;

/// The shapes of a robot, and the meshes of these.
pub struct Shapes<'a, 's> {
    scene: &'a Scene<'s>,
    gate: &'a Gate,
    assets: Charged<Asset>,
    known: HashMap<[u8; 32], usize>,
    taken: BTreeSet<String>,
    /// The shapes that collide, by body: the prim, the shape in the frame of the link, and the mesh of it.
    pub solids: HashMap<usize, Vec<Solid>>,
}

/// A shape that collides.
pub struct Solid {
    pub prim: usize,
    pub pose: Isometry3<f64>,
    pub geometry: Geometry,
    pub mesh: Option<Arc<Mesh>>,
}

impl<'a, 's> Shapes<'a, 's> {
    pub fn new(scene: &'a Scene<'s>, gate: &'a Gate) -> Self {
        Shapes {
            scene,
            gate,
            assets: Charged::default(),
            known: HashMap::new(),
            taken: BTreeSet::new(),
            solids: HashMap::new(),
        }
    }

    /// The meshes.
    pub fn into_assets(self) -> Charged<Asset> {
        self.assets
    }

    /// Adds the shapes to their bodies.
    pub fn add(&mut self, made: &mut Made, tally: &mut Tally) -> Fallible<()> {
        for (at, prim) in self.scene.stage.prims.iter().enumerate() {
            let is_shape = matches!(
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
            );
            if !is_shape {
                if prim.has("PhysicsCollisionAPI") && self.scene.body[at].is_some() {
                    tally.unread("PhysicsCollisionAPI of prims that are not shapes");
                }
                continue;
            }
            let collides =
                prim.has("PhysicsCollisionAPI") && flag(prim, "physics:collisionEnabled", true);
            let is_seen = self.scene.is_seen[at];
            let Some(body) = self.scene.body[at] else {
                if collides {
                    tally.count(features::ALONE);
                }
                continue;
            };
            let Some(index) = made.index.get(&body).copied() else { continue };
            if collides || is_seen {
                self.shape(made, (at, body, index), collides, is_seen, tally)?;
            }
        }
        Ok(())
    }

    fn shape(
        &mut self,
        made: &mut Made,
        (prim, body, index): (usize, usize, usize),
        collides: bool,
        is_seen: bool,
        tally: &mut Tally,
    ) -> Fallible<()> {
        let (scene, of) = (self.scene, self.scene.prim(prim));
        let place = scene.place(prim);
        let numbers: usize = of
            .properties
            .iter()
            .filter_map(|one| one.value.as_ref()?.numbers())
            .map(<[f64]>::len)
            .sum();
        self.gate.account().charge(MESH * numbers).map_err(|why| at(place, why))?;
        // In the frame of the link: its rotation and place, and what it is stretched by, in m.
        scene.frame(prim)?;
        let link = Translation3::from(-made.shifts[index]) * scene.frame(body)?.0.inverse();
        let world = &scene.world[prim];
        let place_in = link * nalgebra::Point3::from(world.fixed_view::<3, 1>(0, 3) * scene.metre);
        let linear = link.rotation.to_rotation_matrix().matrix()
            * world.fixed_view::<3, 3>(0, 0).into_owned()
            * scene.metre;
        let (rotation, scale) = split(&linear);
        let frame = Isometry3::from_parts(Translation3::from(place_in), rotation);
        // What is left of the matrix in that frame: scales, and a shear.
        let stretch = match is_square(&linear) {
            true => Matrix3::from_diagonal(&scale),
            false => rotation.inverse().to_rotation_matrix().matrix() * linear,
        };
        let name = scene.name(prim).to_owned();
        let link_name = made.bodies[index].name.clone();
        let mut push = |this: &mut Self,
                        used,
                        form: Form,
                        material,
                        name: &str,
                        tally: &mut Tally|
         -> Fallible<()> {
            let (pose, geometry, mesh) = match form {
                Form::Nothing => return Ok(()),
                Form::Plain(pose, geometry) => (frame * pose, geometry, None),
                Form::Meshed(pose, mesh) => {
                    let asset = this.asset(&mesh, &format!("{link_name}_{name}"), prim, tally)?;
                    let Some(asset) = asset else { return Ok(()) };
                    (frame * pose, Geometry::Mesh { asset, scale: [1.0; 3] }, Some(Arc::new(mesh)))
                }
            };
            if used != Use::Visual {
                let solid = Solid { prim, pose, geometry: geometry.clone(), mesh };
                this.solids.entry(index).or_default().push(solid);
            }
            let shape =
                Shape { name: Some(name.to_owned()), used, pose, geometry, material, place };
            made.bodies[index].shapes.push(shape, this.gate.account()).map_err(|why| at(place, why))
        };
        if &*of.type_name != "Mesh" {
            let form = form(of, &stretch, tally);
            let used = match (collides, is_seen) {
                (true, true) => Use::Both,
                (true, false) => Use::Collision,
                (false, _) => Use::Visual,
            };
            let material = if is_seen { look(scene, prim, None, tally) } else { None };
            return push(self, used, form, material, &name, tally);
        }
        let faces = match faces(of, &stretch) {
            Ok(faces) => faces,
            Err(problem) => {
                tally.count(features::MISSING_MESHES);
                tally.remark(place, format!("the mesh `{name}` is left out: {problem}"));
                return Ok(());
            }
        };
        tally.count(features::MESHES);
        if collides {
            let form = match word(of, "physics:approximation")
                .filter(|_| of.has("PhysicsMeshCollisionAPI"))
            {
                Some("convexHull") => match ConvexHull::new(&faces.mesh.vertices) {
                    Ok(hull) => Form::Meshed(Isometry3::identity(), hull.into_mesh()),
                    Err(_) => Form::Meshed(Isometry3::identity(), faces.mesh.clone()),
                },
                Some("boundingCube") => bounding(&faces.mesh, Geometry::Box),
                Some("boundingSphere") => {
                    bounding(&faces.mesh, |_| Geometry::Sphere(reach(&faces.mesh)))
                }
                _ => Form::Meshed(Isometry3::identity(), faces.mesh.clone()),
            };
            push(self, Use::Collision, form, None, &name, tally)?;
        }
        if is_seen {
            for (part, mesh, material) in self.parts(prim, faces, tally) {
                let name = part.map_or(name.clone(), |part| format!("{name}_{part}"));
                push(
                    self,
                    Use::Visual,
                    Form::Meshed(Isometry3::identity(), mesh),
                    material,
                    &name,
                    tally,
                )?;
            }
        }
        Ok(())
    }

    /// The parts of a mesh that have materials of their own, and the rest.
    fn parts(
        &self,
        prim: usize,
        faces: Faces,
        tally: &mut Tally,
    ) -> Vec<(Option<String>, Mesh, Option<Material>)> {
        let scene = self.scene;
        let mut taken: BTreeSet<u32> = BTreeSet::new();
        let mut all = Vec::new();
        for child in &scene.prim(prim).children {
            let of = scene.prim(*child);
            if &*of.type_name != "GeomSubset" || of.targets("material:binding").is_empty() {
                continue;
            }
            let indices = of.value("indices").and_then(Value::numbers).unwrap_or_default();
            let own: BTreeSet<u32> = indices
                .iter()
                .map(|index| *index as u32)
                .filter(|face| !taken.contains(face))
                .collect();
            let mesh = faces.part(|face| own.contains(&face));
            taken.extend(own);
            if !mesh.triangles.is_empty() {
                tally.count(features::SUBMESHES);
                all.push((Some(of.name.to_string()), mesh, look(scene, prim, Some(*child), tally)));
            }
        }
        if all.is_empty() {
            return vec![(None, faces.mesh, look(scene, prim, None, tally))];
        }
        let rest = faces.part(|face| !taken.contains(&face));
        if !rest.triangles.is_empty() {
            all.push((None, rest, look(scene, prim, None, tally)));
        }
        all
    }

    /// A mesh as a file, once; none of a mesh without triangles.
    fn asset(
        &mut self,
        mesh: &Mesh,
        name: &str,
        prim: usize,
        tally: &mut Tally,
    ) -> Fallible<Option<usize>> {
        let place = self.scene.place(prim);
        let mut rounded = mesh.clone();
        rounded.round_to_f32();
        rounded.drop_non_finite();
        let bytes = match stl(&[Part::from(rounded.clone())]) {
            Ok(bytes) if !rounded.triangles.is_empty() => bytes,
            _ => {
                tally.count(features::MISSING_MESHES);
                tally.remark(
                    place,
                    format!(
                        "the mesh `{}` is left out: it has no triangles",
                        self.scene.name(prim)
                    ),
                );
                return Ok(None);
            }
        };
        let key: [u8; 32] = Sha256::digest(&bytes).into();
        if let Some(known) = self.known.get(&key) {
            return Ok(Some(*known));
        }
        let mut path = format!("meshes/{}", file_name(name, ".stl"));
        for number in 2.. {
            if self.taken.insert(path.to_lowercase()) {
                break;
            }
            path = format!("meshes/{}", file_name(&format!("{name}_{number}"), ".stl"));
        }
        let index = self.assets.len();
        self.known.insert(key, index);
        let asset = Asset { path, bytes: bytes.into() };
        self.assets.push(asset, self.gate.account()).map_err(|why| at(place, why))?;
        Ok(Some(index))
    }

    /// The coefficient of friction of all shapes that collide, if it is one.
    pub fn friction(&self, made: &Made, tally: &mut Tally) -> Option<f64> {
        let mut all: Vec<f64> = Vec::new();
        for solid in (0..made.bodies.len()).filter_map(|body| self.solids.get(&body)).flatten() {
            let material = rubbed(self.scene, solid.prim);
            let material =
                material.map(|at| self.scene.prim(at)).filter(|of| of.has("PhysicsMaterialAPI"));
            all.push(number(material?, "physics:dynamicFriction")?);
        }
        let first = *all.first()?;
        let is_one = all.iter().all(|friction| *friction == first);
        tally.count(if is_one { features::FRICTION } else { features::FRICTIONS });
        is_one.then_some(first)
    }
}
