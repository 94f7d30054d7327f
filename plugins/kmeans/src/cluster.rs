//! Lloyd's rounds: assign every sample to the nearest centre, move every centre to its samples' mean.

use rayon::prelude::*;
use seamline_ecs::components::{SampleCluster, SampleFeature};

/// Samples summed up at a time. Partial sums are added in order, so that the number of threads does not
/// change the last bit.
pub(crate) const CHUNK: usize = 4096;

/// Samples in clusters.
#[derive(Clone, Debug)]
pub struct Clustering {
    /// One a sample.
    pub of_sample: Vec<SampleCluster>,
    /// One a cluster: the mean of its samples, the seed where it has none.
    pub centres: Vec<[f64; 2]>,
    /// One a cluster.
    pub sizes: Vec<usize>,
    /// Rounds done.
    pub rounds: usize,
}

pub(crate) fn squared_distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (x, y) = (a[0] - b[0], a[1] - b[1]);
    x * x + y * y
}

/// Runs until no sample changes its cluster, `max_rounds` at most. Of two centres equally near, the lower
/// takes the sample. A cluster that loses all its samples stays where it was.
///
/// Cost: samples x clusters x rounds.
pub fn cluster(features: &[SampleFeature], seeds: Vec<[f64; 2]>, max_rounds: usize) -> Clustering {
    let mut of_sample = vec![SampleCluster(u32::MAX); features.len()];
    let mut centres = seeds;
    let mut sizes = vec![0; centres.len()];
    let mut rounds = 0;
    while rounds < max_rounds {
        rounds += 1;
        let sums = assign(features, &centres, &mut of_sample);
        for (cluster, (sum, size)) in sums.members.into_iter().enumerate() {
            sizes[cluster] = size;
            if size > 0 {
                centres[cluster] = sum.map(|s| s / size as f64);
            }
        }
        if !sums.changed {
            break;
        }
    }
    Clustering {
        of_sample,
        centres,
        sizes,
        rounds,
    }
}

struct Sums {
    members: Vec<([f64; 2], usize)>,
    changed: bool,
}

fn assign(
    features: &[SampleFeature],
    centres: &[[f64; 2]],
    of_sample: &mut [SampleCluster],
) -> Sums {
    let nothing = || Sums {
        members: vec![([0.0; 2], 0); centres.len()],
        changed: false,
    };
    let partial: Vec<Sums> = of_sample
        .par_chunks_mut(CHUNK)
        .zip(features.par_chunks(CHUNK))
        .map(|(clusters, features)| {
            let mut sums = nothing();
            for (cluster, feature) in clusters.iter_mut().zip(features) {
                let nearest = nearest(feature.0, centres);
                sums.changed |= cluster.0 != nearest;
                cluster.0 = nearest;
                let (sum, size) = &mut sums.members[nearest as usize];
                sum[0] += feature.0[0];
                sum[1] += feature.0[1];
                *size += 1;
            }
            sums
        })
        .collect();
    partial.into_iter().fold(nothing(), |mut whole, part| {
        for (to, from) in whole.members.iter_mut().zip(part.members) {
            to.0 = [to.0[0] + from.0[0], to.0[1] + from.0[1]];
            to.1 += from.1;
        }
        whole.changed |= part.changed;
        whole
    })
}

/// The nearest centre, the lower of equals. A branch here would be guessed wrongly half the time.
fn nearest(feature: [f64; 2], centres: &[[f64; 2]]) -> u32 {
    let mut best = (f64::INFINITY, 0u32);
    for (i, &centre) in centres.iter().enumerate() {
        let distance = squared_distance(feature, centre);
        let nearer = distance < best.0;
        best.0 = std::hint::select_unpredictable(nearer, distance, best.0);
        best.1 = std::hint::select_unpredictable(nearer, i as u32, best.1);
    }
    best.1
}
