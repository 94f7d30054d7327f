//! Which triangles lie in one plane.

use std::f64::consts::PI;

use glam::DVec3;

use crate::ground::Ground;
use crate::pieces::NONE;
use crate::triangles::Triangles;

/// The flat piece of each face: from the largest triangle down, each takes in the triangles connected to it whose
/// corners lie within `tolerance` of its plane and whose normals agree, as far as a sliver's can. Faces with a number in
/// `settled` are together with those of the same number, and with no others; these pieces come first.
pub(crate) fn grow_flat(ground: Ground, tolerance: f64, settled: &[u32]) -> Vec<u32> {
    let triangles = ground.triangles;
    let (mut of_face, mut count) = renumbered(settled);
    let mut members = Vec::new();
    for &seed in &triangles.by_area {
        if of_face[seed as usize] != NONE {
            continue;
        }
        let mut plane = (
            triangles.normals[seed as usize],
            triangles.centroids[seed as usize],
        );
        members.clear();
        members.push(seed);
        of_face[seed as usize] = count;
        loop {
            let fitted = members.len();
            spread_flat(ground, tolerance, plane, count, &mut members, &mut of_face);
            // A plane known from few triangles errs far away from them.
            if members.len() < 2 * fitted {
                break;
            }
            plane = mean_plane(triangles, &members);
        }
        count += 1;
    }
    of_face
}

/// Numbers without gaps in place of others, in their order, and how many there are.
fn renumbered(numbers: &[u32]) -> (Vec<u32>, u32) {
    let given = || numbers.iter().copied().filter(|&n| n != NONE);
    let mut renumbered = vec![NONE; given().max().map_or(0, |most| most as usize + 1)];
    for number in given() {
        renumbered[number as usize] = 0;
    }
    let mut count = 0;
    for number in renumbered.iter_mut().filter(|number| **number == 0) {
        *number = count;
        count += 1;
    }
    let rows = numbers.iter();
    let rows = rows.map(|&n| renumbered.get(n as usize).copied().unwrap_or(NONE));
    (rows.collect(), count)
}

/// Lets a flat piece take in the triangles in its plane, given by normal and point.
fn spread_flat(
    ground: Ground,
    tolerance: f64,
    (normal, point): (DVec3, DVec3),
    piece: u32,
    members: &mut Vec<u32>,
    of_face: &mut [u32],
) {
    let Ground {
        positions,
        triangles,
        topology,
        ..
    } = ground;
    let in_plane = |face: u32| {
        let lean = ground.lean(face);
        let face = face as usize;
        let away = (triangles.normals[face] - normal).length();
        let sure = triangles.heights[face].max(f64::MIN_POSITIVE);
        let agrees = away <= 0.004 + 4.0 * tolerance / sure
            && (triangles.normals[face].dot(normal) >= (PI / 3.0 + lean).min(PI).cos()
                || triangles.areas[face] == 0.0);
        agrees
            && topology.triangles[face]
                .iter()
                .all(|&v| (positions[v as usize] - point).dot(normal).abs() <= tolerance)
    };
    let mut at = 0;
    while at < members.len() {
        let face = members[at];
        at += 1;
        for edge in topology.face_edges[face as usize] {
            if let Some(across) = topology.neighbour(face, edge)
                && of_face[across as usize] == NONE
                && in_plane(across)
            {
                of_face[across as usize] = piece;
                members.push(across);
            }
        }
    }
}

fn mean_plane(triangles: &Triangles, faces: &[u32]) -> (DVec3, DVec3) {
    let [mut normal, mut point] = [DVec3::ZERO; 2];
    let mut area = 0.0;
    for &face in faces {
        let own = triangles.areas[face as usize];
        normal += triangles.normals[face as usize] * own;
        point += triangles.centroids[face as usize] * own;
        area += own;
    }
    (normal.normalize_or_zero(), point / area)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_order_and_have_no_gaps() {
        let numbers = [9, NONE, 4, 9, 6, NONE];
        assert_eq!(renumbered(&numbers), (vec![2, NONE, 0, 2, 1, NONE], 3));
        assert_eq!(renumbered(&[NONE]), (vec![NONE], 0));
    }
}
