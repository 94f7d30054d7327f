use std::os::unix::fs::symlink;

use super::*;

fn folder() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    let root = home.path();
    fs::create_dir_all(root.join("a/b")).unwrap();
    fs::create_dir_all(root.join(".trash")).unwrap();
    for name in [
        "one.stl",
        "TWO.STL",
        "a/b/three.obj",
        "a/notes.txt",
        "a/four.stl.part",
        ".trash/x.stl",
        "._one.stl",
    ] {
        fs::write(root.join(name), "x").unwrap();
    }
    home
}

fn search<'a>(root: &'a Path, recursive: bool, patterns: &'a [Patterns; 2]) -> Search<'a> {
    let [include, exclude] = patterns;
    Search {
        root,
        recursive,
        include,
        exclude,
        markings: false,
    }
}

fn patterns() -> [Patterns; 2] {
    [&["*.stl", "*.obj", "*.part"][..], &["*_old.*"]].map(|of| Patterns::new(of).unwrap())
}

fn relative(root: &Path, listing: Listing) -> Vec<String> {
    assert!(listing.unreadable.is_empty());
    let relative = |file: FileFact| file.path.strip_prefix(root).unwrap().display().to_string();
    listing.files.into_iter().map(relative).collect()
}

fn names(root: &Path, recursive: bool) -> Vec<String> {
    relative(root, search(root, recursive, &patterns()).all().unwrap())
}

fn names_at(root: &Path, recursive: bool, path: &str) -> (Vec<String>, bool) {
    let mut listing = Listing::default();
    search(root, recursive, &patterns()).at(&root.join(path), &mut listing);
    let gone = !listing.gone.is_empty();
    let mut names = relative(root, listing);
    names.sort();
    (names, gone)
}

#[test]
fn finished_files_that_match_are_listed_in_order() {
    assert_eq!(
        names(folder().path(), true),
        ["TWO.STL", "a/b/three.obj", "one.stl"]
    );
}

#[test]
fn without_recursion_only_the_folder_itself_is_listed() {
    assert_eq!(names(folder().path(), false), ["TWO.STL", "one.stl"]);
}

#[test]
fn links_to_files_are_followed_and_links_to_folders_are_not() {
    let home = folder();
    symlink(home.path(), home.path().join("a/loop")).unwrap();
    symlink(home.path().join("one.stl"), home.path().join("a/link.stl")).unwrap();
    symlink(home.path().join("nowhere"), home.path().join("broken.stl")).unwrap();
    assert_eq!(
        names(home.path(), true),
        ["TWO.STL", "a/b/three.obj", "a/link.stl", "one.stl"]
    );
}

#[test]
fn pipes_and_folders_with_the_name_of_a_mesh_are_passed_over() {
    let home = folder();
    fs::create_dir(home.path().join("folder.stl")).unwrap();
    let made = std::process::Command::new("mkfifo")
        .arg(home.path().join("pipe.stl"))
        .status();
    assert!(made.is_ok_and(|status| status.success()));
    assert_eq!(
        names(home.path(), true),
        ["TWO.STL", "a/b/three.obj", "one.stl"]
    );
}

#[test]
fn odd_names_are_names() {
    let home = tempfile::tempdir().unwrap();
    for name in ["zwei Teile.stl", "neue\nZeile.stl", "Größe 1.stl"] {
        fs::write(home.path().join(name), "x").unwrap();
    }
    assert_eq!(names(home.path(), true).len(), 3);
}

#[test]
fn a_root_that_is_gone_is_an_error_and_not_an_empty_folder() {
    assert!(
        search(Path::new("no/such/folder"), true, &patterns())
            .all()
            .is_err()
    );
}

#[test]
fn folders_of_results_are_not_input() {
    let home = folder();
    fs::create_dir(home.path().join("one.stl.seamline")).unwrap();
    fs::write(home.path().join("one.stl.seamline/patches.obj"), "x").unwrap();
    assert_eq!(names(home.path(), true).len(), 3);
    for path in ["one.stl.seamline", "one.stl.seamline/patches.obj"] {
        assert_eq!(names_at(home.path(), true, path), (vec![], false));
    }
}

#[test]
fn what_is_excluded_is_not_taken_whatever_is_included() {
    let home = folder();
    fs::write(home.path().join("one_old.stl"), "x").unwrap();
    assert_eq!(names(home.path(), false), ["TWO.STL", "one.stl"]);
}

#[test]
fn a_look_at_one_place_finds_what_a_listing_finds_there() {
    let home = folder();
    let at = |path| names_at(home.path(), true, path);
    assert_eq!(at("one.stl"), (vec!["one.stl".to_owned()], false));
    assert_eq!(at("a"), (vec!["a/b/three.obj".to_owned()], false));
    assert_eq!(at(".trash/x.stl"), (vec![], false));
    assert_eq!(at("a/four.stl.part"), (vec![], false));
    assert_eq!(at("a/notes.txt"), (vec![], false));
    assert_eq!(at("a/none.stl"), (vec![], true));
    assert_eq!(
        names_at(home.path(), false, "a/b/three.obj"),
        (vec![], false)
    );
    assert_eq!(names_at(home.path(), false, "a"), (vec![], false));
}
