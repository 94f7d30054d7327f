//! Histograms: smoothing, and the valleys between their peaks.

/// The heights after smoothing by a Gaussian whose standard deviation is so many bins. The sum stays: what
/// would fall off an end is mirrored back.
pub fn smooth(heights: &[f64], deviation: f64) -> Vec<f64> {
    let reach = (4.0 * deviation).ceil() as i64;
    if reach == 0 || heights.is_empty() {
        return heights.to_vec();
    }
    let kernel: Vec<f64> = (-reach..=reach)
        .map(|offset| (-0.5 * (offset as f64 / deviation).powi(2)).exp())
        .collect();
    let whole: f64 = kernel.iter().sum();
    let count = heights.len() as i64;
    let mirrored = |at: i64| {
        let round = at.rem_euclid(2 * count);
        round.min(2 * count - 1 - round) as usize
    };
    let mut smoothed = vec![0.0; heights.len()];
    for (bin, &height) in heights
        .iter()
        .enumerate()
        .filter(|(_, height)| **height > 0.0)
    {
        for (offset, weight) in (-reach..).zip(&kernel) {
            smoothed[mirrored(bin as i64 + offset)] += height * weight / whole;
        }
    }
    smoothed
}

/// The bins at which to cut a histogram: one in the middle of the lowest stretch of each valley. A dip is a
/// valley if it is lower than `below_share` of the lower of the two peaks beside it; the shallowest dips go
/// first, so that a peak is measured without the ripples on its slopes.
pub fn valleys(heights: &[f64], below_share: f64) -> Vec<usize> {
    let mut peaks = Vec::new();
    let mut dips: Vec<usize> = Vec::new();
    for (start, end, is_peak) in turns(heights) {
        let middle = (start + end) / 2;
        if is_peak {
            peaks.push(heights[middle]);
        } else if !peaks.is_empty() {
            dips.push(middle);
        }
    }
    // After the last peak it only falls.
    dips.truncate(peaks.len().saturating_sub(1));
    loop {
        let depth = |at: usize| heights[dips[at]] / peaks[at].min(peaks[at + 1]);
        let shallowest = (0..dips.len()).max_by(|&a, &b| depth(a).total_cmp(&depth(b)));
        match shallowest {
            Some(at) if depth(at) >= below_share => {
                dips.remove(at);
                let lower = if peaks[at] < peaks[at + 1] {
                    at
                } else {
                    at + 1
                };
                peaks.remove(lower);
            }
            _ => return dips,
        }
    }
}

/// Stretches of equal height that are higher or lower than what lies on both sides, peaks and dips in turn.
/// Beyond the ends there is nothing.
fn turns(heights: &[f64]) -> Vec<(usize, usize, bool)> {
    let mut turns = Vec::new();
    let (mut start, mut rises) = (0, true);
    for bin in 1..=heights.len() {
        let next = heights.get(bin).copied().unwrap_or(-1.0);
        if next == heights[bin - 1] {
            continue;
        }
        let goes_up = next > heights[bin - 1];
        if rises != goes_up {
            turns.push((start, bin - 1, rises));
        }
        (start, rises) = (bin, goes_up);
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn between_two_peaks_lies_one_valley_in_the_middle_of_the_gap() {
        assert_eq!(valleys(&[3.0, 0.0, 0.0, 0.0, 5.0], 0.5), [2]);
        assert_eq!(valleys(&[0.0, 2.0, 1.0, 4.0, 0.0], 0.6), [2]);
    }

    #[test]
    fn a_dip_that_is_not_deep_enough_is_none() {
        assert!(valleys(&[2.0, 1.0, 4.0], 0.5).is_empty());
        assert_eq!(valleys(&[2.0, 1.0, 4.0], 0.51), [1]);
    }

    #[test]
    fn ripples_on_a_peak_do_not_hide_the_valley_beside_it() {
        let heights = [1.0, 8.0, 7.0, 9.0, 8.5, 10.0, 2.0, 3.0, 2.9, 9.0];
        assert_eq!(valleys(&heights, 0.5), [6]);
    }

    #[test]
    fn one_peak_slopes_and_nothing_have_no_valley() {
        for heights in [
            &[][..],
            &[0.0],
            &[1.0],
            &[1.0, 2.0, 3.0],
            &[3.0, 1.0],
            &[2.0, 2.0],
        ] {
            assert!(valleys(heights, 1.0).is_empty(), "{heights:?}");
        }
    }

    proptest! {
        #[test]
        fn smoothing_keeps_the_sum_and_does_not_raise_the_highest(
            heights in prop::collection::vec(0.0f64..10.0, 1..60),
            deviation in 0.0f64..20.0,
        ) {
            let smoothed = smooth(&heights, deviation);
            let sum = |heights: &[f64]| heights.iter().sum::<f64>();
            prop_assert!((sum(&smoothed) - sum(&heights)).abs() < 1e-9 * (1.0 + sum(&heights)));
            let highest = |heights: &[f64]| heights.iter().copied().fold(0.0, f64::max);
            prop_assert!(highest(&smoothed) <= highest(&heights) + 1e-9);
        }

        #[test]
        fn every_valley_is_as_deep_as_was_asked(
            heights in prop::collection::vec(0.0f64..10.0, 1..60),
            share in 0.0f64..1.0,
        ) {
            let cuts = valleys(&heights, share);
            prop_assert!(cuts.is_sorted());
            let ends: Vec<_> = [0].into_iter().chain(cuts.iter().copied()).chain([heights.len()]).collect();
            let peaks: Vec<f64> = ends
                .windows(2)
                .map(|part| heights[part[0]..part[1]].iter().copied().fold(0.0, f64::max))
                .collect();
            for (at, &cut) in cuts.iter().enumerate() {
                prop_assert!(heights[cut] < share * peaks[at].min(peaks[at + 1]));
            }
        }
    }
}
