//! A colour for every patch.

/// Red, green and blue of a patch.
///
/// Hues go round the circle by the golden section, so that patches next to each other in number are far
/// apart in hue; brightness takes turns, so that hues that come close after a full round still differ.
pub fn patch_colour(patch: u32) -> [u8; 3] {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let hue = (f64::from(patch) * GOLDEN).fract();
    let (saturation, value) = [(0.65, 0.95), (0.85, 0.75), (0.45, 0.85)][patch as usize % 3];
    hsv(hue, saturation, value).map(|part| (255.0 * part).round() as u8)
}

fn hsv(hue: f64, saturation: f64, value: f64) -> [f64; 3] {
    [5.0, 3.0, 1.0].map(|shift| {
        let k = (shift + 6.0 * hue) % 6.0;
        value - value * saturation * k.min(4.0 - k).clamp(0.0, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_near_in_number_are_far_in_colour() {
        let distance = |a: [u8; 3], b: [u8; 3]| -> i32 {
            a.iter()
                .zip(b)
                .map(|(&x, y)| (i32::from(x) - i32::from(y)).abs())
                .sum()
        };
        for patch in 0..200 {
            for step in 1..5 {
                let far = distance(patch_colour(patch), patch_colour(patch + step));
                assert!(far > 60, "{patch} and {}: {far}", patch + step);
            }
        }
    }

    #[test]
    fn the_first_hue_is_red() {
        let [red, green, blue] = patch_colour(0);
        assert!(red > 200 && green == blue && green < 120);
    }
}
