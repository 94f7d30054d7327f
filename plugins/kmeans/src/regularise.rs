//! Cluster regularisation: small clusters and similar ones are merged (paper 4.2.2).

use seamline_ecs::components::{SampleCluster, SampleFeature};

use crate::cluster::{Clustering, squared_distance};

/// Merges clusters until none is small and no two are alike, the small ones first. Gives the cluster of each
/// sample, numbered from 0 without gaps, and how many there are.
///
/// Small: less than `min_share` of the samples; it joins the nearest centre. Alike: nearer than
/// `merge_share` of the diagonal of the centres' bounding box; the higher joins the lower.
pub fn regularise(
    features: &[SampleFeature],
    clustering: Clustering,
    min_share: f64,
    merge_share: f64,
) -> (Vec<SampleCluster>, usize) {
    let mut clusters = Clusters::of(&clustering);
    let small_below = min_share * features.len() as f64;
    while let Some((kept, gone)) = clusters
        .small_pair(small_below)
        .or_else(|| clusters.alike_pair(merge_share))
    {
        clusters.merge(kept, gone);
    }

    let mut numbers = vec![0; clusters.joined.len()];
    let mut count = 0;
    for (cluster, number) in numbers.iter_mut().enumerate() {
        if clusters.alive(cluster) {
            *number = count;
            count += 1;
        }
    }
    let number = |c: SampleCluster| SampleCluster(numbers[clusters.root(c.0 as usize)]);
    (
        clustering.of_sample.into_iter().map(number).collect(),
        count as usize,
    )
}

struct Clusters {
    centres: Vec<[f64; 2]>,
    sizes: Vec<usize>,
    /// The cluster each one has joined; itself while it stands.
    joined: Vec<usize>,
}

impl Clusters {
    fn of(clustering: &Clustering) -> Self {
        Self {
            centres: clustering.centres.clone(),
            sizes: clustering.sizes.clone(),
            joined: (0..clustering.sizes.len()).collect(),
        }
    }

    fn alive(&self, cluster: usize) -> bool {
        self.joined[cluster] == cluster && self.sizes[cluster] > 0
    }

    fn standing(&self) -> impl Iterator<Item = usize> + Clone {
        (0..self.joined.len()).filter(|&cluster| self.alive(cluster))
    }

    fn root(&self, mut cluster: usize) -> usize {
        while self.joined[cluster] != cluster {
            cluster = self.joined[cluster];
        }
        cluster
    }

    fn apart(&self, a: usize, b: usize) -> f64 {
        squared_distance(self.centres[a], self.centres[b]).sqrt()
    }

    fn small_pair(&self, small_below: f64) -> Option<(usize, usize)> {
        let small = self.standing().min_by_key(|&c| self.sizes[c])?;
        if self.sizes[small] as f64 >= small_below {
            return None;
        }
        let others = self.standing().filter(|&c| c != small);
        let nearest =
            others.min_by(|&a, &b| self.apart(a, small).total_cmp(&self.apart(b, small)))?;
        Some((nearest, small))
    }

    fn alike_pair(&self, merge_share: f64) -> Option<(usize, usize)> {
        let centres = self.standing().map(|c| self.centres[c]);
        let bounds = |k: usize| {
            let values = centres.clone().map(|c| c[k]);
            values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
        };
        let limit = merge_share * bounds(0).hypot(bounds(1));
        let pairs = self
            .standing()
            .flat_map(|a| self.standing().filter(move |&b| b > a).map(move |b| (a, b)));
        let nearest = pairs.min_by(|x, y| self.apart(x.0, x.1).total_cmp(&self.apart(y.0, y.1)))?;
        (self.apart(nearest.0, nearest.1) < limit).then_some(nearest)
    }

    fn merge(&mut self, kept: usize, gone: usize) {
        let (a, b) = (self.sizes[kept] as f64, self.sizes[gone] as f64);
        let blend = |k: usize| (self.centres[kept][k] * a + self.centres[gone][k] * b) / (a + b);
        self.centres[kept] = [blend(0), blend(1)];
        self.sizes[kept] += self.sizes[gone];
        self.joined[gone] = kept;
    }
}
