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
        let found = seamline_primitives::find(mesh.positions(), &topology, mesh.bounding_box().map(|x| x.abs().max_element()).into_iter().fold(0.0, f64::max));
        let name = path.file_stem().unwrap().to_string_lossy();
        eprintln!("{name} {:.0} ms {:.3} exact {} patches", start.elapsed().as_secs_f64() * 1e3, found.exact_share, found.surfaces.len());
        let kinds: String = found.surfaces.iter().map(|p| match p { Some(s) => format!("{:?} ev {} {:?} {:.1e} {}\n", s.surface.kind, s.evidence, (s.surface.a, s.surface.b), s.residual, s.exact), None => "Free\n".into() }).collect();
        std::fs::write(format!("{out}/{name}.kinds"), kinds).unwrap();
        let text: String = found.of_face.iter().map(|l| format!("{l}\n")).collect();
        std::fs::write(format!("{out}/{name}.seg"), text).unwrap();
    }
}
