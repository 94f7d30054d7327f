//! The findings for a person to read.

use super::Findings;

impl Findings {
    /// What the mesh is, then what is wrong with it: a line each, in plain words. The second part is one
    /// line that says so if nothing is wrong.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = self.what_it_is();
        let wrong = self.what_is_wrong();
        if wrong.is_empty() {
            lines.push("nothing is wrong with it".to_owned());
        }
        lines.extend(wrong);
        lines
    }

    fn what_it_is(&self) -> Vec<String> {
        let [low, high] = self.bounding_box;
        let size = high - low;
        let mut lines = vec![
            match self.larger_polygons {
                0 => count(self.input_faces, "face", "faces") + " in the file, all triangles",
                n => format!(
                    "{} in the file, {n} of them no triangles",
                    count(self.input_faces, "face", "faces")
                ),
            },
            format!(
                "{} in the file, {} distinct",
                count(self.input_vertices, "vertex", "vertices"),
                self.distinct_vertices
            ),
            format!(
                "{}, {}, {}, Euler characteristic {}",
                count(self.triangles, "triangle", "triangles"),
                count(self.edges, "edge", "edges"),
                count(self.parts, "connected part", "connected parts"),
                self.euler_characteristic
            ),
            format!(
                "bounding box {} x {} x {}, diagonal {}",
                short(size.x),
                short(size.y),
                short(size.z),
                short(self.diagonal)
            ),
            format!(
                "from ({}, {}, {}) to ({}, {}, {})",
                short(low.x),
                short(low.y),
                short(low.z),
                short(high.x),
                short(high.y),
                short(high.z)
            ),
            format!("area {}", short(self.area)),
        ];
        if let Some(volume) = self.volume {
            lines.push(format!("closed, volume {}", short(volume)));
        } else if self.closed {
            lines.push(
                "closed, but not all turned the same way, so that it has no volume".to_owned(),
            );
        }
        lines
    }

    fn what_is_wrong(&self) -> Vec<String> {
        let mut lines = Vec::new();
        let mut say = |n: usize, one: &str, many: &str, rest: &str| {
            if n > 0 {
                lines.push(format!("{}{rest}", count(n, one, many)));
            }
        };
        let loops = format!(
            " in {}: the surface is open",
            count(self.border_loops, "loop", "loops")
        );
        say(self.border_edges, "border edge", "border edges", &loops);
        say(
            self.non_manifold_edges,
            "edge",
            "edges",
            " with three triangles or more",
        );
        say(
            self.non_manifold_vertices,
            "vertex",
            "vertices",
            " where parts touch in nothing but the vertex",
        );
        say(
            self.flipped_edges,
            "edge",
            "edges",
            " between triangles turned opposite ways",
        );
        say(
            self.duplicate_faces,
            "face",
            "faces",
            " with the vertices of an earlier face",
        );
        say(
            self.zero_area_triangles,
            "triangle",
            "triangles",
            " without area",
        );
        say(
            self.faces_without_triangle,
            "face",
            "faces",
            " with a repeated vertex, so that no triangle is left",
        );
        say(
            self.isolated_vertices,
            "vertex",
            "vertices",
            " that no triangle uses",
        );
        if self.volume.is_some_and(|volume| volume < 0.0) {
            lines.push("turned inside out: its volume is negative".to_owned());
        }
        lines
    }
}

fn count(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// Six significant digits, with an exponent where zeros would pile up.
fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor();
    if !(-4.0..9.0).contains(&exponent) {
        let text = format!("{value:.5e}");
        return match text.split_once('e') {
            Some((digits, exponent)) => format!("{}e{exponent}", trimmed(digits)),
            None => text,
        };
    }
    let decimals = (5.0 - exponent).max(0.0) as usize;
    trimmed(&format!("{value:.decimals$}")).to_owned()
}

fn trimmed(digits: &str) -> &str {
    if digits.contains('.') {
        digits.trim_end_matches('0').trim_end_matches('.')
    } else {
        digits
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::findings::tests::findings;

    #[test]
    fn numbers_are_short_at_any_size() {
        let texts = [1.0, 0.1 + 0.2, 123456.789, 1e12, -1e-12, 1234567.0].map(short);
        assert_eq!(texts, ["1", "0.3", "123457", "1e12", "-1e-12", "1234567"]);
    }

    #[test]
    fn a_lone_triangle_is_described_in_full() {
        let lines = findings(
            &[[0., 0., 0.], [3., 0., 0.], [0., 4., 0.], [9., 9., 9.]],
            &[&[0, 1, 2]],
        )
        .lines();
        assert_eq!(lines[0], "1 face in the file, all triangles");
        assert_eq!(lines[1], "4 vertices in the file, 4 distinct");
        assert!(lines.contains(&"bounding box 3 x 4 x 0, diagonal 5".to_owned()));
        assert!(lines.contains(&"3 border edges in 1 loop: the surface is open".to_owned()));
        assert!(lines.contains(&"1 vertex that no triangle uses".to_owned()));
    }
}
