//! Shapes of bodies: what is seen, and what collides.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use nalgebra::{Isometry3, Matrix3, Translation3};
use urdd_directory::account::Charged;
use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;
use urdd_geometry::read::{Part, Texture};
use urdd_geometry::write::{obj, stl};
use urdd_source::gate::Gate;
use urdd_usd::Value;

use super::assets::Assets;
use super::form::{Faces, Form, Problem, bounding, faces, form, look, reach, rubbed};
use super::frames::{Made, clean};
use super::scene::{Scene, flag, is_shape, is_square, number, split, word};
use crate::features::{self, Tally};
use crate::model::{Asset, Geometry, Material, Shape, Use};
use crate::place::{Fallible, Placing};

/// Bytes of a mesh in memory for each number of it, about: triangles, their hull, what is written; and of a copy.
const MESH: usize = 60;
const COPY: usize = 8;
/// What makes two meshes one: where their points, counts and indices are in memory, what they are stretched by, and how
/// their faces are turned.
type MeshKey = ([usize; 3], [u64; 9], bool);

pub struct Shapes<'a, 's> {
    scene: &'a Scene<'s>,
    assets: Assets<'a>,
    /// Meshes that were read: instances share them.
    read: HashMap<MeshKey, Arc<Faces>>,
    /// The shapes that collide, by body: the prim, the shape in the frame of the link, and the mesh of it.
    pub solids: HashMap<usize, Vec<Solid>>,
}

/// A part of a mesh that is seen.
struct Seen {
    /// That of a subset.
    name: Option<String>,
    mesh: Mesh,
    /// Places in an image, one for each vertex.
    uv: Vec<[f64; 2]>,
    material: Option<Material>,
}

pub struct Solid {
    pub prim: usize,
    pub pose: Isometry3<f64>,
    pub geometry: Geometry,
    pub mesh: Option<Arc<Mesh>>,
}

impl<'a, 's> Shapes<'a, 's> {
    pub fn new(scene: &'a Scene<'s>, gate: &'a Gate) -> Self {
        Shapes { scene, assets: Assets::new(gate), read: HashMap::new(), solids: HashMap::new() }
    }

    pub fn into_assets(self) -> Charged<Asset> {
        self.assets.into_all()
    }

    pub fn add(&mut self, made: &mut Made, tally: &mut Tally) -> Fallible<()> {
        for (at, prim) in self.scene.stage.prims.iter().enumerate() {
            if !is_shape(prim) {
                continue;
            }
            let collider = self.scene.collider[at].map(|at| self.scene.prim(at));
            let collides = collider.is_some_and(|of| flag(of, "physics:collisionEnabled", true));
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
        // In the frame of the link: its rotation and place, and what it is stretched by, in m.
        scene.frame(prim)?;
        let link = Translation3::from(-made.shifts[index]) * scene.frame(body)?.0.inverse();
        let world = &scene.world[prim];
        let place_in = link * nalgebra::Point3::from(world.fixed_view::<3, 1>(0, 3) * scene.metre);
        let linear = link.rotation.to_rotation_matrix().matrix()
            * world.fixed_view::<3, 3>(0, 0).into_owned()
            * scene.metre;
        let (rotation, scale) = split(&linear);
        let frame = clean(Isometry3::from_parts(Translation3::from(place_in), rotation));
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
                        (material, uv): (_, Vec<[f64; 2]>),
                        name: &str,
                        tally: &mut Tally|
         -> Fallible<()> {
            let (pose, geometry, mesh) = match form {
                Form::Nothing => return Ok(()),
                Form::Plain(pose, geometry) => (frame * pose, geometry, None),
                Form::Meshed(mesh) => {
                    let file = format!("{link_name}_{name}");
                    let asset = this.asset(&mesh, uv, &file, prim, tally)?;
                    let Some(asset) = asset else { return Ok(()) };
                    (frame, Geometry::Mesh { asset, scale: [1.0; 3] }, Some(Arc::new(mesh)))
                }
            };
            if used != Use::Visual {
                let solid = Solid { prim, pose, geometry: geometry.clone(), mesh };
                this.solids.entry(index).or_default().push(solid);
            }
            let shape =
                Shape { name: Some(name.to_owned()), used, pose, geometry, material, place };
            let pushed = made.bodies[index].shapes.push(shape, this.assets.gate.account());
            pushed.at(place)
        };
        if &*of.type_name != "Mesh" {
            let form = form(of, &stretch, tally);
            let used = match (collides, is_seen) {
                (true, true) => Use::Both,
                (true, false) => Use::Collision,
                (false, _) => Use::Visual,
            };
            let (material, image) =
                if is_seen { look(scene, prim, None, tally) } else { (None, None) };
            if image.is_some() {
                unplaced(scene, prim, tally);
            }
            return push(self, used, form, (material, Vec::new()), &name, tally);
        }
        let faces = match self.faces(prim, &stretch)? {
            Ok(faces) => faces,
            Err(problem) => {
                let text = format!("the mesh `{name}` is left out: {problem}");
                tally.say(features::MISSING_MESHES, place, text);
                return Ok(());
            }
        };
        tally.count(features::MESHES);
        let is_of_mujoco = word(of, "mjc:inertia").is_some();
        if collides {
            let said = [Some(prim), scene.collider[prim]].into_iter().flatten();
            let said = said.map(|at| scene.prim(at)).find(|of| of.has("PhysicsMeshCollisionAPI"));
            let form = match said.and_then(|of| word(of, "physics:approximation")) {
                Some("convexHull") => {
                    let hull = ConvexHull::new(&faces.mesh.vertices).map(ConvexHull::into_mesh);
                    Form::Meshed(hull.unwrap_or_else(|_| faces.mesh.clone()))
                }
                Some("boundingCube") => bounding(&faces.mesh, Geometry::Box),
                Some("boundingSphere") => {
                    bounding(&faces.mesh, |_| Geometry::Sphere(reach(&faces.mesh)))
                }
                _ => Form::Meshed(faces.mesh.clone()),
            };
            push(self, Use::Collision, form, (None, Vec::new()), &name, tally)?;
            // MuJoCo weighs the mesh, whatever collides for it.
            let solid = self.solids.get_mut(&index).and_then(|solids| solids.last_mut());
            if let Some(solid) = solid.filter(|of| of.prim == prim && is_of_mujoco) {
                (solid.pose, solid.mesh) = (frame, Some(Arc::new(faces.mesh.clone())));
            }
        }
        if is_seen {
            for part in self.parts(prim, &faces, tally)? {
                let name = part.name.map_or(name.clone(), |part| format!("{name}_{part}"));
                let form = Form::Meshed(part.mesh);
                push(self, Use::Visual, form, (part.material, part.uv), &name, tally)?;
            }
        }
        Ok(())
    }

    fn faces(
        &mut self,
        prim: usize,
        stretch: &Matrix3<f64>,
    ) -> Fallible<Result<Arc<Faces>, Problem>> {
        let of = self.scene.prim(prim);
        let shape = of.properties.iter().filter(|of| !of.name.contains("normals"));
        let numbers = shape.filter_map(|of| of.value.as_ref()?.numbers());
        let numbers: usize = numbers.map(<[f64]>::len).sum();
        let address = |name| {
            let numbers = of.value(name).and_then(Value::numbers);
            numbers.map_or(0, |numbers| numbers.as_ptr().addr())
        };
        let mut bits = [0; 9];
        bits.iter_mut().zip(stretch.iter()).for_each(|(bits, of)| *bits = of.to_bits());
        let key = (
            ["points", "faceVertexCounts", "faceVertexIndices"].map(address),
            bits,
            word(of, "orientation") == Some("leftHanded"),
        );
        let known = self.read.get(&key).cloned();
        let cost = if known.is_some() { COPY } else { MESH };
        self.assets.gate.account().charge(cost * numbers).at(self.scene.place(prim))?;
        if let Some(known) = known {
            return Ok(Ok(known));
        }
        Ok(faces(of, stretch).map(|faces| {
            let faces = Arc::new(faces);
            self.read.insert(key, Arc::clone(&faces));
            faces
        }))
    }

    /// The parts of a mesh that have materials of their own, and the rest.
    fn parts(&mut self, prim: usize, faces: &Faces, tally: &mut Tally) -> Fallible<Vec<Seen>> {
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
            let is_own = |face| own.contains(&face);
            let part = self.painted((prim, Some(*child)), faces, &is_own, tally)?;
            taken.extend(own);
            if !part.mesh.triangles.is_empty() {
                tally.count(features::SUBMESHES);
                all.push(part);
            }
        }
        if taken.len() < faces.of_triangle.len() {
            let rest = self.painted((prim, None), faces, &|face| !taken.contains(&face), tally)?;
            if all.is_empty() || !rest.mesh.triangles.is_empty() {
                all.push(rest);
            }
        }
        Ok(all)
    }

    /// A part of a mesh with its look, and places in its image if it has one.
    fn painted(
        &mut self,
        (prim, subset): (usize, Option<usize>),
        faces: &Faces,
        is_of: &dyn Fn(u32) -> bool,
        tally: &mut Tally,
    ) -> Fallible<Seen> {
        let (scene, place) = (self.scene, self.scene.place(prim));
        let name = subset.map(|subset| scene.name(subset).to_owned());
        let (material, image) = look(scene, prim, subset, tally);
        if let Some(image) = image {
            match faces.painted(scene.prim(prim), &image, is_of) {
                Some((mesh, uv)) => {
                    if let Some(texture) = self.assets.image(&image.file, place, tally)? {
                        tally.count(features::TEXTURES);
                        let (rgba, texture) = (Some(image.rgba), Some(texture));
                        let material = material.map(|of| Material { rgba, texture, ..of });
                        return Ok(Seen { name, mesh, uv, material });
                    }
                }
                None => unplaced(scene, prim, tally),
            }
        }
        Ok(Seen { name, mesh: faces.part(is_of), uv: Vec::new(), material })
    }

    /// A mesh as a file: STL, or OBJ where it has an image. None of a mesh without triangles.
    fn asset(
        &mut self,
        mesh: &Mesh,
        uv: Vec<[f64; 2]>,
        name: &str,
        prim: usize,
        tally: &mut Tally,
    ) -> Fallible<Option<usize>> {
        let place = self.scene.place(prim);
        let mut rounded = mesh.clone();
        rounded.round_to_f32();
        rounded.drop_non_finite();
        let is_empty = rounded.triangles.is_empty();
        let (written, ending) = match uv.is_empty() {
            true => (stl(&[Part::from(rounded)]), ".stl"),
            false => {
                let texture = Some(Texture { uv, ..Texture::default() });
                (obj(&[Part { texture, ..Part::from(rounded) }]), ".obj")
            }
        };
        if let (Ok(bytes), false) = (written, is_empty) {
            return self.assets.mesh(bytes, name, ending, place).map(Some);
        }
        let name = self.scene.name(prim);
        let text = format!("the mesh `{name}` is left out: it has no triangles");
        tally.say(features::MISSING_MESHES, place, text);
        Ok(None)
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

/// Says that an image is left out.
fn unplaced(scene: &Scene<'_>, prim: usize, tally: &mut Tally) {
    let name = scene.name(prim);
    let text =
        format!("the image on `{name}` is left out: the shape does not say where it is on it");
    tally.say(features::MISSING_MESHES, scene.place(prim), text);
}
