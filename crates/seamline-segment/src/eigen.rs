//! Principal curvatures and directions of a curvature tensor.

use glam::DVec3;
use seamline_ecs::components::{Principal, SymmetricTensor};

/// Principal curvatures with their unit directions.
#[derive(Clone, Copy, Debug, Default)]
pub struct PrincipalFrame {
    /// Principal values.
    pub k: Principal,
    /// Direction of least curvature. An edge's tensor acts along the edge, so this is the eigenvector of the
    /// greatest eigenvalue.
    pub d_min: DVec3,
    /// Direction of greatest curvature.
    pub d_max: DVec3,
}

impl PrincipalFrame {
    /// From the two eigenvalues and their vectors: the greater in magnitude is the greatest curvature and
    /// lies along the other's direction.
    fn sorted(first: (f64, DVec3), second: (f64, DVec3)) -> Self {
        let (big, small) = if first.0.abs() >= second.0.abs() {
            (first, second)
        } else {
            (second, first)
        };
        let k = Principal {
            k_max: big.0.abs(),
            k_min: small.0 * big.0.signum(),
        };
        Self {
            k,
            d_min: big.1,
            d_max: small.1,
        }
    }
}

/// The frame of a tensor restricted to the plane across `normal` (unit).
///
/// Needed wherever there is a tangent plane: on a cylinder two eigenvalues of the free tensor are zero, and
/// the direction of greatest curvature would be arbitrary. A zero normal gives the free frame.
pub fn tangent_principal_frame(tensor: &SymmetricTensor, normal: DVec3) -> PrincipalFrame {
    if normal == DVec3::ZERO {
        return free_principal_frame(tensor);
    }
    let (e1, e2) = normal.any_orthonormal_pair();
    let (t1, t2) = (apply(tensor, e1), apply(tensor, e2));
    let (m11, m12, m22) = (e1.dot(t1), e1.dot(t2), e2.dot(t2));
    let (middle, half) = ((m11 + m22) / 2.0, (m11 - m22) / 2.0);
    let radius = half.hypot(m12);
    let angle = 0.5 * m12.atan2(half);
    let plus = e1 * angle.cos() + e2 * angle.sin();
    PrincipalFrame::sorted(
        (middle + radius, plus),
        (middle - radius, normal.cross(plus)),
    )
}

/// The frame of a tensor by its two eigenvalues greatest in magnitude, for vertices without a tangent
/// plane.
pub fn free_principal_frame(tensor: &SymmetricTensor) -> PrincipalFrame {
    two_greatest::<true>(tensor)
}

/// The values of [`free_principal_frame`], to the last bit, without the directions.
pub fn free_principal_values(tensor: &SymmetricTensor) -> Principal {
    if tensor.0 == [0.0; 6] {
        return Principal::default();
    }
    two_greatest::<false>(tensor).k
}

fn two_greatest<const VECTORS: bool>(tensor: &SymmetricTensor) -> PrincipalFrame {
    let mut pairs = eigen::<VECTORS>(tensor);
    pairs.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    PrincipalFrame::sorted(pairs[0], pairs[1])
}

fn apply(&SymmetricTensor([xx, yy, zz, xy, xz, yz]): &SymmetricTensor, v: DVec3) -> DVec3 {
    DVec3::new(
        xx * v.x + xy * v.y + xz * v.z,
        xy * v.x + yy * v.y + yz * v.z,
        xz * v.x + yz * v.y + zz * v.z,
    )
}

/// Eigenvalues, and unit eigenvectors where `VECTORS` is set, by Jacobi rotations.
fn eigen<const VECTORS: bool>(
    &SymmetricTensor([xx, yy, zz, xy, xz, yz]): &SymmetricTensor,
) -> [(f64, DVec3); 3] {
    let mut a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let mut vectors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let scale: f64 = a.as_flattened().iter().map(|x| x.abs()).fold(0.0, f64::max);
    // Jacobi converges quadratically: five sweeps are seen at most, the rest is margin.
    for _ in 0..16 {
        let off = a[0][1].abs() + a[0][2].abs() + a[1][2].abs();
        if off <= scale * 1e-15 {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let s = t * c;
            for row in &mut a {
                let (kp, kq) = (row[p], row[q]);
                row[p] = c * kp - s * kq;
                row[q] = s * kp + c * kq;
            }
            let (row_p, row_q) = (a[p], a[q]);
            a[p] = [0, 1, 2].map(|k| c * row_p[k] - s * row_q[k]);
            a[q] = [0, 1, 2].map(|k| s * row_p[k] + c * row_q[k]);
            if VECTORS {
                for row in &mut vectors {
                    let (vp, vq) = (row[p], row[q]);
                    row[p] = c * vp - s * vq;
                    row[q] = s * vp + c * vq;
                }
            }
        }
    }
    [0, 1, 2].map(|i| {
        (
            a[i][i],
            DVec3::new(vectors[0][i], vectors[1][i], vectors[2][i]),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tensor_of(pairs: [(f64, DVec3); 3]) -> SymmetricTensor {
        let mut t = [0.0; 6];
        for (value, v) in pairs {
            let products = [
                v.x * v.x,
                v.y * v.y,
                v.z * v.z,
                v.x * v.y,
                v.x * v.z,
                v.y * v.z,
            ];
            for (sum, product) in t.iter_mut().zip(products) {
                *sum += value * product;
            }
        }
        SymmetricTensor(t)
    }

    proptest! {
        #[test]
        fn values_are_the_same_to_the_last_bit_with_and_without_directions(t in prop::array::uniform6(-5.0f64..5.0)) {
            let tensor = SymmetricTensor(t);
            prop_assert_eq!(free_principal_values(&tensor), free_principal_frame(&tensor).k);
        }

        #[test]
        fn eigenvalues_come_back_from_their_tensor(
            values in prop::array::uniform3(-5.0f64..5.0),
            axis in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let x = DVec3::from_array(axis);
            prop_assume!(x.length() > 0.1);
            let x = x.normalize();
            let (y, z) = x.any_orthonormal_pair();
            let mut found = eigen::<true>(&tensor_of([(values[0], x), (values[1], y), (values[2], z)])).map(|p| p.0);
            let mut expected = values;
            found.sort_by(f64::total_cmp);
            expected.sort_by(f64::total_cmp);
            for (f, e) in found.iter().zip(expected) {
                prop_assert!((f - e).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_greater_in_magnitude_is_never_negative_and_a_saddle_has_a_negative_lesser() {
        let t = tensor_of([(-3.0, DVec3::X), (1.0, DVec3::Y), (0.0, DVec3::Z)]);
        for frame in [
            tangent_principal_frame(&t, DVec3::Z),
            free_principal_frame(&t),
        ] {
            assert!((frame.k.k_max - 3.0).abs() < 1e-12);
            assert!((frame.k.k_min + 1.0).abs() < 1e-12);
            assert!(frame.d_min.dot(DVec3::X).abs() > 1.0 - 1e-12);
            assert!(frame.d_max.dot(DVec3::Y).abs() > 1.0 - 1e-12);
        }
    }
}
