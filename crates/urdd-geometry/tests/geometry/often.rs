//! The cost of files that repeat one thing very often, or that name very many things.

use urdd_geometry::Mesh;
use urdd_geometry::decompose::{Settings, decompose};
use urdd_geometry::primitives::cuboid;
use urdd_geometry::read::{NoteCode, Scene, read};

fn read_obj(text: &str) -> Scene {
    read(text.as_bytes(), "a.obj", &mut |_| None).expect("an OBJ")
}

/// Pieces of a surface are those of its triangles, however often the file repeats each.
#[test]
fn a_triangle_that_is_said_often_makes_what_it_makes_once() {
    let mut once = cuboid([1.0, 0.2, 0.3]);
    once.append(&cuboid([0.2, 1.0, 0.3]));
    let often = Mesh {
        // Each time beginning with a different corner.
        triangles: (0..500)
            .flat_map(|n| {
                once.triangles.iter().map(move |t| {
                    let mut t = *t;
                    t.rotate_left(n % 3);
                    t
                })
            })
            .collect(),
        vertices: once.vertices.clone(),
    };
    let settings = Settings::default();
    let found = decompose(&once, &settings);
    assert!(found.pieces.len() > 1);
    assert_eq!(decompose(&often, &settings), found);
}

#[test]
fn a_material_without_a_face_is_no_part() {
    let names: String = (0..5000).map(|n| format!("usemtl m{n}\n")).collect();
    let scene = read_obj(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{names}f 1 2 3\n"));
    assert_eq!(scene.parts.len(), 1);
    assert_eq!(scene.parts[0].material.as_deref(), Some("m4999"));
    assert!(scene.notes.iter().all(|note| note.code != NoteCode::Assumed));
}

#[test]
fn materials_beyond_the_limit_keep_their_triangles() {
    let faces: String = (0..6000).map(|n| format!("usemtl m{n}\nf 1 2 3\n")).collect();
    let scene = read_obj(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{faces}"));
    assert!(scene.parts.len() <= 4097, "{}", scene.parts.len());
    assert_eq!(scene.triangle_count(), 6000);
    let without = scene.parts.iter().find(|part| part.material.is_none());
    assert!(without.is_some_and(|part| part.mesh.triangles.len() >= 6000 - 4097));
    assert!(scene.notes.iter().any(|note| note.code == NoteCode::Assumed));
}

#[test]
fn libraries_beyond_the_limit_are_not_asked_for() {
    let names: Vec<String> = (0..1500).map(|n| format!("{n}.mtl")).collect();
    let lines: String = names.iter().map(|name| format!("mtllib {name}\n")).collect();
    for libraries in [lines, format!("mtllib {}\n", names.join(" "))] {
        let text = format!("{libraries}v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
        let mut asked = 0;
        let mut fetch = |_: &str| {
            asked += 1;
            None
        };
        let scene = read(text.as_bytes(), "a.obj", &mut fetch).expect("an OBJ");
        assert_eq!((scene.triangle_count(), scene.side_files.len()), (1, 1000));
        // Twice for each line, which may be one name with spaces.
        assert!(asked <= 2000, "{asked}");
        assert_eq!(scene.notes.len(), 50);
    }
}

/// Each polygon gives as many triangles as it has corners, less two, by ear clipping or as a fan.
#[test]
fn many_tangled_polygons_are_cut_within_bounds() {
    let corners = 3000;
    let mut text = String::new();
    for polygon in 0..80_u64 {
        for corner in 0..corners {
            // Arbitrary self-intersecting positions: the bits of a product.
            let mixed = (polygon * corners + corner).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let (x, y) = (mixed >> 40 & 0xffff, mixed >> 20 & 0xffff);
            text += &format!("v {x} {y} 0\n");
        }
        text += "f";
        for corner in 1..=corners {
            text += &format!(" -{corner}");
        }
        text += "\n";
    }
    let start = std::time::Instant::now();
    let scene = read_obj(&text);
    assert!(scene.triangle_count() > 0);
    // Ear clipping alone takes more than a minute here.
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
}
