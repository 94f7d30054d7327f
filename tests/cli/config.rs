//! Configurations: checked before anything is done, and described by a schema.

use crate::home::Home;

#[test]
fn a_right_configuration_is_said_back_and_nothing_is_made() {
    let home = Home::new();
    home.put("inbox/readme.txt", "");
    home.put(
        "watch.toml",
        "[[watch]]\nroot = \"inbox\"\n\n[merge]\nthreshold = 0.375\n",
    );
    let ran = home.run("config check watch.toml").ended(0);
    assert!(
        ran.out.contains("inbox") && ran.out.contains("threshold = 0.375"),
        "{}",
        ran.out
    );
    assert_eq!(ran.err, "");
    assert_eq!(home.listed("."), ["inbox", "watch.toml"]);
}

#[test]
fn a_wrong_configuration_is_told_by_file_line_and_key() {
    let home = Home::new();
    home.put("inbox/readme.txt", "");
    for (text, said) in [
        (
            "[[watch]]\nroot = \"inbox\"\nrecursiv = true\n",
            "watch.toml:3: watch.recursiv",
        ),
        (
            "[[watch]]\nroot = \"inbox/readme.txt\"\n",
            "watch.toml:2: watch.root",
        ),
        (
            "[[watch]]\nroot = \"inbox\"\nafter = \"burn\"\n",
            "watch.toml:3: watch.after",
        ),
        (
            "[[watch]]\nroot = \"inbox\"\n\n[kmeans]\n\nclusters = \"ten\"\n",
            "watch.toml:6: kmeans.clusters",
        ),
        (
            "[[watch]]\nroot = \"inbox\"\n\n[sharp]\nangle_deg = 400\n",
            "watch.toml:5: sharp.angle_deg",
        ),
        (
            "[[watch]]\nroot = \"inbox\"\n\n[kmean]\nclusters = 5\n",
            "watch.toml:4: kmean",
        ),
        (
            "[[watch]]\nroot = \"inbox\"\n\n[pipeline]\nclassifier = \"kmaens\"\n",
            "watch.toml:5: pipeline.classifier",
        ),
        ("[[watch]\n", "watch.toml:1: "),
    ] {
        home.put("watch.toml", text);
        let ran = home.run("config check watch.toml").ended(2);
        assert!(ran.err.contains(said), "{text}{}", ran.err);
        assert_eq!(ran.err.lines().count(), 1, "{text}{}", ran.err);
        assert_eq!(ran.out, "", "{text}");
    }
    assert_eq!(home.listed("."), ["inbox", "watch.toml"]);
}

#[test]
fn a_watched_folder_that_is_not_there_yet_is_right_and_said_to_be_absent() {
    let home = Home::new();
    home.put("watch.toml", "[[watch]]\nroot = \"later\"\n");
    let absent = |home: &Home| {
        let ran = home.run("config check watch.toml").ended(0);
        ran.out.contains("later, which is not there yet\n")
    };
    assert!(absent(&home));
    assert_eq!(home.listed("."), ["watch.toml"]);
    home.put("later/part.obj", "");
    assert!(!absent(&home));
}

#[test]
fn the_schema_is_json_and_names_every_table() {
    let schema = Home::new().run("config schema").json();
    let frame = ["watch", "output", "state", "quarantine", "pipeline"];
    let steps = [
        "mesh",
        "sharp",
        "curvature",
        "facets",
        "merge",
        "score",
        "kmeans",
        "contour-tracking",
    ];
    for table in frame.into_iter().chain(steps) {
        let keys = match table {
            "watch" => &schema["properties"]["watch"]["items"]["properties"],
            _ => &schema["properties"][table]["properties"],
        };
        assert!(
            keys.as_object().is_some_and(|keys| !keys.is_empty()),
            "{table}: {keys}"
        );
    }
    assert_eq!(schema["additionalProperties"], false);
}
