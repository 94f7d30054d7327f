//! `seamline inspect`: what a mesh is, and what is wrong with it.

use anyhow::Result;
use seamline_mesh::{Topology, examine};
use seamline_watch::{load, shown};
use serde_json::json;

use crate::args::InspectArgs;
use crate::outcome::{Outcome, say_failure};
use crate::say::print;

/// Says what every mesh named is; one that cannot be read is told and the others go on.
pub fn run(args: &InspectArgs) -> Result<Outcome> {
    let mut failures = 0;
    for path in &args.meshes {
        let loaded = match load(path, 0.0) {
            Ok(loaded) => loaded,
            Err(error) => {
                failures += 1;
                say_failure(path, &error, error.hint());
                continue;
            }
        };
        let mesh = &loaded.mesh;
        let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
        let findings = examine(mesh, &topology);
        if args.json {
            let format = loaded.format.name();
            print(&json!({ "path": path, "format": format, "findings": findings }))?;
        } else {
            print(&format_args!("{} ({})", shown(path), loaded.format.name()))?;
            for line in findings.lines() {
                print(&format_args!("  {line}"))?;
            }
        }
    }
    Ok(Outcome::of_failures(failures))
}
