//! Where clustering starts: the max-min rule.

use rayon::prelude::*;
use seamline_ecs::components::SampleFeature;

use crate::cluster::{CHUNK, squared_distance};

/// Up to `wanted` distinct samples: first the one of smallest norm, then always the one farthest from all
/// chosen; of equals, the first. Fewer where there are fewer distinct samples.
pub fn seeds(features: &[SampleFeature], wanted: usize) -> Vec<[f64; 2]> {
    let norm = |f: &SampleFeature| squared_distance(f.0, [0.0; 2]);
    let Some(first) = features.iter().min_by(|a, b| norm(a).total_cmp(&norm(b))) else {
        return Vec::new();
    };
    let mut chosen = vec![first.0];
    let mut to_nearest = vec![f64::INFINITY; features.len()];
    while chosen.len() < wanted {
        let newest = chosen[chosen.len() - 1];
        let farthest = to_nearest
            .par_chunks_mut(CHUNK)
            .zip(features.par_chunks(CHUNK))
            .enumerate()
            .map(|(chunk, (distances, features))| {
                let mut best = (-1.0, 0);
                for (i, (distance, feature)) in distances.iter_mut().zip(features).enumerate() {
                    *distance = distance.min(squared_distance(feature.0, newest));
                    if *distance > best.0 {
                        best = (*distance, chunk * CHUNK + i);
                    }
                }
                best
            })
            .reduce(
                || (-1.0, usize::MAX),
                |a, b| {
                    if b.0 > a.0 || (b.0 == a.0 && b.1 < a.1) {
                        b
                    } else {
                        a
                    }
                },
            );
        if farthest.0 <= 0.0 {
            break;
        }
        chosen.push(features[farthest.1].0);
    }
    chosen
}
