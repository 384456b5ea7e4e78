//! Identical meshes are processed once.

use std::sync::atomic::{AtomicUsize, Ordering};

use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_generate::meshes::*;
use urdd_geometry::Mesh;
use urdd_geometry::primitives::cuboid;

#[test]
fn equal_meshes_are_worked_through_once_and_each_has_its_own() {
    let (one, other) = (cuboid([1.0, 2.0, 3.0]), cuboid([1.0, 2.0, 4.0]));
    let (again, mut moved) = (one.clone(), one.clone());
    moved.vertices[7][2] += 1e-12;
    let mut turned = one.clone();
    turned.triangles.reverse();
    let asked = AtomicUsize::new(0);
    let meshes = [&one, &other, &again, &moved, &turned, &other];
    let cancellation = Cancellation::default();
    let work = |first: usize, mesh: &Mesh| {
        assert_eq!(meshes[first], mesh);
        asked.fetch_add(1, Ordering::Relaxed);
        (mesh.vertices[7][2], mesh.triangles[0])
    };
    let found = for_each_content(&meshes, &cancellation, work).expect("all of them");
    assert_eq!(asked.load(Ordering::Relaxed), 4);
    let expected = [&one, &other, &one, &moved, &turned, &other];
    assert_eq!(found, expected.map(|mesh| (mesh.vertices[7][2], mesh.triangles[0])));
    cancellation.cancel();
    let found = for_each_content(&meshes, &cancellation, work);
    assert_eq!(found, Err(Cancelled));
    assert_eq!(asked.into_inner(), 4);
}
