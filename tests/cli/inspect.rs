//! What a mesh is, and what can fill the stages.

use serde_json::Value;

use crate::home::{BAD_OBJ, Home};

#[test]
fn inspect_says_in_words_what_a_mesh_is_and_what_is_wrong_with_it() {
    let home = Home::new();
    home.put_sample("cylinder.obj");
    home.put(
        "fin.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 1 2\n",
    );
    let ran = home.run("inspect cylinder.obj fin.obj").ended(0);
    let (cylinder, fin) = ran.out.split_once("fin.obj (obj)\n").expect("two meshes");
    assert!(cylinder.starts_with("cylinder.obj (obj)\n"), "{cylinder}");
    assert!(
        cylinder.contains("66 faces") && cylinder.contains("closed, volume"),
        "{cylinder}"
    );
    assert!(fin.contains("1 edge with three triangles or more"), "{fin}");
    assert!(fin.contains("1 face with a repeated vertex"), "{fin}");
}

#[test]
fn inspect_gives_one_line_of_json_a_mesh_and_tells_bad_ones_apart() {
    let home = Home::new();
    home.put_sample("cylinder.obj");
    home.put_sample("torus.ply");
    home.put("bad.obj", BAD_OBJ);
    let ran = home
        .run("inspect cylinder.obj bad.obj torus.ply --json")
        .ended(1);
    let told: Vec<Value> = ran
        .out
        .lines()
        .map(|line| serde_json::from_str(line).expect("a line of JSON"))
        .collect();
    assert_eq!(told.len(), 2, "{}", ran.out);
    assert_eq!(told[0]["path"], "cylinder.obj");
    assert_eq!(told[0]["findings"]["larger_polygons"], 66);
    assert_eq!(told[0]["findings"]["euler_characteristic"], 2);
    assert_eq!(told[1]["format"], "ply-binary-little-endian");
    assert_eq!(told[1]["findings"]["euler_characteristic"], 0);
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    assert!(ran.err.contains("bad.obj: line 3"), "{}", ran.err);
    assert_eq!(home.listed("."), ["bad.obj", "cylinder.obj", "torus.ply"]);
}

#[test]
fn plugins_lists_what_can_fill_each_stage_with_its_settings() {
    let home = Home::new();
    let words = home.run("plugins").ended(0).out;
    for word in [
        "--classifier",
        "kmeans.clusters",
        "--rectifier",
        "contour-tracking.correct_below_deg",
        "none",
    ] {
        assert!(words.contains(word), "{word}: {words}");
    }
    let json = home.run("plugins --json").json();
    let listed: Vec<_> = json["plugins"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|p| (&p["stage"], &p["name"]))
        .collect();
    for (stage, name) in [("classify", "kmeans"), ("rectify", "contour-tracking")] {
        assert!(
            listed
                .iter()
                .any(|plugin| *plugin.0 == stage && *plugin.1 == name),
            "{name}: {listed:?}"
        );
    }
    let steps = json["steps"].as_array().expect("a list");
    for name in [
        "pipeline",
        "mesh",
        "sharp",
        "curvature",
        "facets",
        "merge",
        "score",
    ] {
        assert!(steps.iter().any(|step| step["name"] == name), "{name}");
        assert!(words.contains(&format!("  {name}\n")), "{name}");
    }
    for plugin in json["plugins"]
        .as_array()
        .expect("a list")
        .iter()
        .chain(steps)
    {
        let keys = plugin["schema"]["properties"]
            .as_object()
            .expect("a schema")
            .keys();
        for key in keys {
            for profile in ["cad", "lavoue2005"] {
                assert!(
                    !plugin["defaults"][profile][key].is_null(),
                    "{profile} {key}: {plugin}"
                );
            }
        }
    }
}
