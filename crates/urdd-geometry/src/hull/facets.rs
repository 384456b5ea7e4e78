//! Converts quickhull's triangles to the hull's corners and faces, in canonical order.

use super::super::mesh::Mesh;
use super::predicates::{Point, lexicographic, side_of_plane};
use super::quickhull::Triangle;

/// Joins coplanar triangles to facets, drops points that are not corners, and triangulates the facets again.
pub fn triangulate(points: &[Point], triangles: &[Triangle]) -> Vec<[u32; 3]> {
    let (facet, facets) = facet_of_each(points, triangles);
    let is_corner = corners(points.len(), triangles, &facet);
    // The edges between facets: (facet, from, to).
    let mut outline: Vec<[u32; 3]> = Vec::new();
    for (t, triangle) in triangles.iter().enumerate() {
        for k in 0..3 {
            if facet[triangle.neighbours[k] as usize] != facet[t] {
                outline.push([facet[t], triangle.corners[k], triangle.corners[(k + 1) % 3]]);
            }
        }
    }
    outline.sort_unstable();
    let mut result = Vec::with_capacity(triangles.len());
    let mut edges = &outline[..];
    for f in 0..facets {
        let (own, rest) = edges.split_at(edges.partition_point(|edge| edge[0] <= f));
        edges = rest;
        let mut polygon = walk(own);
        polygon.retain(|p| is_corner[*p as usize]);
        // Start at the lexicographically first corner, so that the result does not depend on the triangle order.
        let by_value = |(_, p): &(usize, &u32), (_, q): &(usize, &u32)| {
            lexicographic(&points[**p as usize], &points[**q as usize])
        };
        if let Some((first, _)) = polygon.iter().enumerate().min_by(by_value) {
            polygon.rotate_left(first);
            cut(&polygon, &mut result);
        }
    }
    result
}

/// The facet of each triangle, and the number of facets.
fn facet_of_each(points: &[Point], triangles: &[Triangle]) -> (Vec<u32>, u32) {
    let mut facet = vec![u32::MAX; triangles.len()];
    let mut facets = 0;
    let mut open = Vec::new();
    for seed in 0..triangles.len() {
        if facet[seed] != u32::MAX {
            continue;
        }
        facet[seed] = facets;
        open.push(seed);
        while let Some(t) = open.pop() {
            let Triangle {
                corners,
                neighbours,
            } = &triangles[t];
            let [a, b, c] = corners.map(|i| points[i as usize]);
            for n in neighbours.map(|n| n as usize) {
                let mut others = triangles[n].corners.into_iter();
                let opposite = others.find(|p| !corners.contains(p));
                let level =
                    opposite.is_some_and(|p| side_of_plane(a, b, c, points[p as usize]).is_eq());
                if facet[n] == u32::MAX && level {
                    facet[n] = facets;
                    open.push(n);
                }
            }
        }
        facets += 1;
    }
    (facet, facets)
}

/// Whether each point is a corner of the hull, where at least three facets meet.
fn corners(points: usize, triangles: &[Triangle], facet: &[u32]) -> Vec<bool> {
    let mut meetings: Vec<(u32, u32)> = Vec::with_capacity(3 * triangles.len());
    for (triangle, f) in triangles.iter().zip(facet) {
        meetings.extend(triangle.corners.map(|p| (p, *f)));
    }
    meetings.sort_unstable();
    meetings.dedup();
    let mut is_corner = vec![false; points];
    for at_point in meetings.chunk_by(|(p, _), (q, _)| p == q) {
        is_corner[at_point[0].0 as usize] = at_point.len() >= 3;
    }
    is_corner
}

/// The corners along a closed loop of edges (facet, from, to), sorted by `from`.
fn walk(edges: &[[u32; 3]]) -> Vec<u32> {
    let mut polygon = Vec::with_capacity(edges.len());
    let mut edge = edges.first();
    while let Some([_, from, to]) = edge {
        polygon.push(*from);
        if polygon.len() == edges.len() {
            break;
        }
        edge = edges
            .binary_search_by_key(to, |e| e[1])
            .ok()
            .map(|e| &edges[e]);
    }
    polygon
}

/// Triangulates a convex polygon by repeated bisection. Of the simple methods, it gives the fewest thin triangles on
/// round faces.
fn cut(polygon: &[u32], triangles: &mut Vec<[u32; 3]>) {
    let [first, .., last] = *polygon else { return };
    if polygon.len() < 3 {
        return;
    }
    let middle = polygon.len() / 2;
    triangles.push([first, polygon[middle], last]);
    cut(&polygon[..=middle], triangles);
    cut(&polygon[middle..], triangles);
}

/// The mesh in canonical order: vertices sorted by value, each triangle rotated to start at its lowest index, triangles
/// sorted.
pub fn canonical(points: &[Point], triangles: Vec<[u32; 3]>) -> Mesh {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let mut order = used.clone();
    order.sort_unstable_by(|p, q| lexicographic(&points[*p as usize], &points[*q as usize]));
    let mut rank = vec![0; used.len()];
    let position = |p: u32| used.partition_point(|q| *q < p);
    for (new, p) in order.iter().enumerate() {
        rank[position(*p)] = new as u32;
    }
    let mut triangles: Vec<[u32; 3]> = triangles
        .into_iter()
        .map(|triangle| {
            let mut corners = triangle.map(|p| rank[position(p)]);
            let lowest = (0..3).min_by_key(|k| corners[*k]).unwrap_or(0);
            corners.rotate_left(lowest);
            corners
        })
        .collect();
    triangles.sort_unstable();
    let vertices = order.iter().map(|p| points[*p as usize]).collect();
    Mesh {
        vertices,
        triangles,
    }
}
