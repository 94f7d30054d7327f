//! Labels of meshes, for scoring.
use seamline_mesh::{Topology, read, weld};
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let out = &args[0];
    for path in &args[1..] {
        let path = std::path::Path::new(path);
        let polygons = read(path).unwrap();
        let mesh = weld(polygons, 0.0);
        let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
        let start = std::time::Instant::now();
        let found = seamline_primitives::find(mesh.positions(), &topology);
        let name = path.file_stem().unwrap().to_string_lossy();
        eprintln!("{name} {:.0} ms {} fits {} patches", start.elapsed().as_secs_f64() * 1e3, found.fits, found.patches.len());
        let kinds: String = found.patches.iter().map(|p| match &p.surface { Some(s) => format!("{:?} ev {} {} {:?}\n", s.kind, p.evidence, p.strong, (s.a, s.b)), None => p.form.to_string() + "\n" }).collect();
        std::fs::write(format!("{out}/{name}.kinds"), kinds).unwrap();
        let text: String = found.of_face.iter().map(|l| format!("{l}\n")).collect();
        std::fs::write(format!("{out}/{name}.seg"), text).unwrap();
    }
}
