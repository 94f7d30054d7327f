//! Eigenvectors of small symmetric matrices.

/// Eigenvalues in rising order, and the unit eigenvector of each, by Jacobi's rotations.
pub(crate) fn symmetric<const N: usize>(mut m: [[f64; N]; N]) -> ([f64; N], [[f64; N]; N]) {
    let mut vectors = [[0.0; N]; N];
    for (i, row) in vectors.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for _ in 0..30 {
        let mut off = 0.0;
        let mut on = 0.0;
        for i in 0..N {
            on += m[i][i] * m[i][i];
            for j in 0..i {
                off += m[i][j] * m[i][j];
            }
        }
        if off <= on * 1e-30 {
            break;
        }
        for p in 0..N {
            for q in p + 1..N {
                rotate(&mut m, &mut vectors, p, q);
            }
        }
    }
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    order.sort_unstable_by(|&i, &j| m[i][i].total_cmp(&m[j][j]));
    (order.map(|i| m[i][i]), order.map(|i| vectors[i]))
}

/// One rotation that makes `m[p][q]` zero; row `i` of `vectors` is the `i`-th eigenvector so far.
fn rotate<const N: usize>(m: &mut [[f64; N]; N], vectors: &mut [[f64; N]; N], p: usize, q: usize) {
    if m[p][q] == 0.0 {
        return;
    }
    let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let t = if theta == 0.0 { 1.0 } else { t };
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    let turned = |[a, b]: [[f64; N]; 2]| -> [[f64; N]; 2] {
        let first = std::array::from_fn(|k| c * a[k] - s * b[k]);
        [first, std::array::from_fn(|k| s * a[k] + c * b[k])]
    };
    let [on_p, on_q] = [m[p][p] - t * m[p][q], m[q][q] + t * m[p][q]];
    let [row_p, row_q] = turned([m[p], m[q]]);
    for (k, row) in m.iter_mut().enumerate() {
        row[p] = row_p[k];
        row[q] = row_q[k];
    }
    m[p] = row_p;
    m[q] = row_q;
    [m[p][p], m[q][q]] = [on_p, on_q];
    [m[p][q], m[q][p]] = [0.0; 2];
    [vectors[p], vectors[q]] = turned([vectors[p], vectors[q]]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_matrix_times_its_eigenvector_is_the_eigenvalue_times_it(
            values in prop::array::uniform32(-1.0..1.0f64),
        ) {
            let mut m = [[0.0; 6]; 6];
            let mut values = values.into_iter();
            for i in 0..6 {
                for j in 0..=i {
                    m[i][j] = values.next().unwrap_or(0.5);
                    m[j][i] = m[i][j];
                }
            }
            let (eigenvalues, vectors) = symmetric(m);
            for (lambda, v) in eigenvalues.iter().zip(vectors) {
                for (row, v_i) in m.iter().zip(v) {
                    let product: f64 = row.iter().zip(v).map(|(a, b)| a * b).sum();
                    prop_assert!((product - lambda * v_i).abs() < 1e-12);
                }
            }
            prop_assert!(eigenvalues.is_sorted());
        }
    }
}
