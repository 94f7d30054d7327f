//! Curvature tensors from the normal cycle (Cohen-Steiner & Morvan 2003; paper 4.2.1).
//!
//! An edge bends the surface by its dihedral angle over its length: `E_e = beta |e| e eᵀ`. A face gets half
//! of each of its edges, `F_t = ½ Σ E_e`, and `T_t = F_t / A_t` is its curvature. Convex is positive.

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use glam::DVec3;
use rayon::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::{DihedralAngle, FaceShape, Position, SharpEdge, SymmetricTensor};
use seamline_ecs::{Column, MeshTopology};
use seamline_mesh::Topology;
use serde::{Deserialize, Serialize};

/// How a vertex gathers the tensors round it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TensorForm {
    /// The edges at the vertex over the area of its faces: the 1-ring of the paper's authors. Two thirds of
    /// the true curvature on regular meshes.
    Spokes,
    /// 3/2 of `spokes`: right on average.
    Cell,
    /// The faces at the vertex over their area: exact on prisms, however their quads are cut.
    Ring,
    /// The connected part of the surface in a ball about the vertex, edges and area clipped.
    Ball,
}

/// The tensor of one edge: `beta |e| e eᵀ`, with unit `e`.
pub fn edge_tensor(angle: f64, along: DVec3) -> SymmetricTensor {
    let length = along.length();
    if length == 0.0 || angle == 0.0 {
        return SymmetricTensor::default();
    }
    let w = angle / length;
    let v = along;
    SymmetricTensor([
        w * v.x * v.x,
        w * v.y * v.y,
        w * v.z * v.z,
        w * v.x * v.y,
        w * v.x * v.z,
        w * v.y * v.z,
    ])
}

/// `sum += factor * tensor`.
pub(crate) fn add_scaled(sum: &mut SymmetricTensor, tensor: &SymmetricTensor, factor: f64) {
    for (s, t) in sum.0.iter_mut().zip(tensor.0) {
        *s += factor * t;
    }
}

/// `tensor / divisor`, zero where there is nothing to divide by.
pub(crate) fn over(tensor: &SymmetricTensor, divisor: f64) -> SymmetricTensor {
    if divisor > 0.0 {
        SymmetricTensor(tensor.0.map(|t| t / divisor))
    } else {
        SymmetricTensor::default()
    }
}

/// What the tensors are made from.
#[derive(Clone, Copy)]
pub struct Bending<'a> {
    /// Edges and neighbours.
    pub topology: &'a Topology,
    /// One a vertex.
    pub positions: &'a [Position],
    /// One a face.
    pub shapes: &'a [FaceShape],
    /// One an edge.
    pub angles: &'a [DihedralAngle],
    /// One an edge.
    pub sharp: &'a [SharpEdge],
}

/// The columns and resources a [`Bending`] is lent from.
#[derive(SystemParam)]
pub(crate) struct BendingColumns<'w, 's> {
    topology: Res<'w, MeshTopology>,
    positions: Column<'w, 's, Position>,
    shapes: Column<'w, 's, FaceShape>,
    angles: Column<'w, 's, DihedralAngle>,
    sharp: Column<'w, 's, SharpEdge>,
}

impl BendingColumns<'_, '_> {
    pub(crate) fn lend(&self) -> Bending<'_> {
        Bending {
            topology: &self.topology.0,
            positions: &self.positions,
            shapes: &self.shapes,
            angles: &self.angles,
            sharp: &self.sharp,
        }
    }
}

impl Bending<'_> {
    /// The vector of an edge, from its lower to its higher vertex.
    pub(crate) fn along(&self, edge: u32) -> DVec3 {
        let [a, b] = self.topology.edge_vertices[edge as usize];
        self.positions[b as usize].0 - self.positions[a as usize].0
    }

    /// The tensor of an edge.
    pub(crate) fn edge(&self, edge: u32) -> SymmetricTensor {
        edge_tensor(self.angles[edge as usize].0, self.along(edge))
    }
}

/// What is gathered of the edges round an element: all of them, those that are not sharp, or both.
pub trait Gathered: Clone + Copy + Default + Send + Sync {
    /// `self += factor * edge`.
    fn add_edge(&mut self, bending: &Bending, edge: u32, factor: f64);
    /// `self += other`.
    fn add(&mut self, other: &Self);
    /// Over an area; zero where there is none.
    fn over(&self, divisor: f64) -> Self;
}

/// A tensor with every edge counted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Full(pub SymmetricTensor);

/// A tensor with the sharp edges left out.
#[derive(Clone, Copy, Debug, Default)]
pub struct Smooth(pub SymmetricTensor);

/// A tensor with every edge counted, and one with the sharp edges left out.
#[derive(Clone, Copy, Debug, Default)]
pub struct TensorPair {
    /// All edges.
    pub full: SymmetricTensor,
    /// Sharp edges count zero.
    pub smooth: SymmetricTensor,
}

impl Gathered for Full {
    fn add_edge(&mut self, bending: &Bending, edge: u32, factor: f64) {
        add_scaled(&mut self.0, &bending.edge(edge), factor);
    }

    fn add(&mut self, other: &Self) {
        add_scaled(&mut self.0, &other.0, 1.0);
    }

    fn over(&self, divisor: f64) -> Self {
        Self(over(&self.0, divisor))
    }
}

impl Gathered for Smooth {
    fn add_edge(&mut self, bending: &Bending, edge: u32, factor: f64) {
        if !bending.sharp[edge as usize].0 {
            add_scaled(&mut self.0, &bending.edge(edge), factor);
        }
    }

    fn add(&mut self, other: &Self) {
        add_scaled(&mut self.0, &other.0, 1.0);
    }

    fn over(&self, divisor: f64) -> Self {
        Self(over(&self.0, divisor))
    }
}

impl Gathered for TensorPair {
    fn add_edge(&mut self, bending: &Bending, edge: u32, factor: f64) {
        let tensor = bending.edge(edge);
        add_scaled(&mut self.full, &tensor, factor);
        if !bending.sharp[edge as usize].0 {
            add_scaled(&mut self.smooth, &tensor, factor);
        }
    }

    fn add(&mut self, other: &Self) {
        add_scaled(&mut self.full, &other.full, 1.0);
        add_scaled(&mut self.smooth, &other.smooth, 1.0);
    }

    fn over(&self, divisor: f64) -> Self {
        Self {
            full: over(&self.full, divisor),
            smooth: over(&self.smooth, divisor),
        }
    }
}

/// Integrated tensor `F_t` of a face: half of each of its edges, not yet over the area.
pub(crate) fn face_tensor<T: Gathered>(bending: &Bending, face: u32) -> T {
    let mut sum = T::default();
    for &edge in &bending.topology.face_edges[face as usize] {
        sum.add_edge(bending, edge, 0.5);
    }
    sum
}

/// [`face_tensor`] of every face.
pub fn face_tensors<T: Gathered>(bending: &Bending) -> Vec<T> {
    let faces = (0..bending.shapes.len() as u32).into_par_iter();
    faces
        .with_min_len(4096)
        .map(|face| face_tensor(bending, face))
        .collect()
}

/// Curvature tensor of one vertex, by `form`. A vertex without area round it gets zero.
pub(crate) fn vertex_tensor<T: Gathered>(
    bending: &Bending,
    form: TensorForm,
    ball_radius: f64,
    vertex: u32,
) -> T {
    match form {
        TensorForm::Ring => ring(bending, vertex, |face| face_tensor(bending, face)),
        TensorForm::Spokes => spokes::<T>(bending, vertex).over(area_round(bending, vertex)),
        TensorForm::Cell => spokes::<T>(bending, vertex).over(area_round(bending, vertex) / 1.5),
        TensorForm::Ball => crate::ball::ball_tensor(bending, vertex, ball_radius),
    }
}

fn area_round(bending: &Bending, vertex: u32) -> f64 {
    let faces = bending.topology.vertex_faces.row(vertex as usize).iter();
    faces.map(|&face| bending.shapes[face as usize].area).sum()
}

fn spokes<T: Gathered>(bending: &Bending, vertex: u32) -> T {
    let mut sum = T::default();
    for &edge in bending.topology.vertex_edges.row(vertex as usize) {
        sum.add_edge(bending, edge, 1.0);
    }
    sum
}

fn ring<T: Gathered>(bending: &Bending, vertex: u32, tensor_of: impl Fn(u32) -> T) -> T {
    let mut sum = T::default();
    for &face in bending.topology.vertex_faces.row(vertex as usize) {
        sum.add(&tensor_of(face));
    }
    sum.over(area_round(bending, vertex))
}

/// Curvature tensor of every vertex, by `form`; `ball_radius` serves [`TensorForm::Ball`] alone. A vertex
/// without area round it gets zero.
///
/// Cost: linear; for balls, by the number of faces in each ball.
pub fn vertex_tensors<T: Gathered>(
    bending: &Bending,
    form: TensorForm,
    ball_radius: f64,
) -> Vec<T> {
    let vertices = (0..bending.positions.len() as u32).into_par_iter();
    if form == TensorForm::Ring {
        let face_tensors: Vec<T> = face_tensors(bending);
        return vertices
            .with_min_len(2048)
            .map(|v| ring(bending, v, |face| face_tensors[face as usize]))
            .collect();
    }
    vertices
        .with_min_len(if form == TensorForm::Ball { 64 } else { 2048 })
        .map(|v| vertex_tensor(bending, form, ball_radius, v))
        .collect()
}
