use std::process::Command;

use super::*;
use crate::test_support::in_own_namespace;

/// Each: id, parent, mount point as the file has it, type.
type Row = (u32, u32, &'static str, &'static str);

const PLAIN: [Row; 3] = [
    // As on machines that change their root at start: what lies lowest comes last.
    (22, 27, "/proc", "proc"),
    (28, 27, "/srv", "xfs"),
    (27, 1, "/", "ext4"),
];

fn text(rows: &[Row]) -> Vec<u8> {
    let line = |&(id, parent, point, kind): &Row| {
        format!("{id} {parent} 0:21 / {point} rw,relatime shared:7 master:1 - {kind} host:/x rw\n")
    };
    rows.iter().map(line).collect::<String>().into_bytes()
}

/// The type and the mount point found for `root`, with `rows` mounted besides the plain ones.
fn found(rows: &[Row], root: &str) -> Option<(String, String)> {
    let all: Vec<Row> = PLAIN.iter().chain(rows).copied().collect();
    let distrust = untrusted(&text(&all), Path::new(root))?;
    let point = distrust.mount_point.to_str().unwrap().to_owned();
    Some((distrust.kind, point))
}

#[test]
fn shares_are_found_at_the_root_and_below_it_and_nowhere_else() {
    let rows: &[(&[Row], &str, Option<(&str, &str)>)] = &[
        (&[], "/srv/inbox", None),
        (
            &[(40, 28, "/srv/inbox", "nfs4")],
            "/srv/inbox",
            Some(("nfs4", "/srv/inbox")),
        ),
        (
            &[(40, 28, "/srv/inbox", "nfs")],
            "/srv/inbox/a/b",
            Some(("nfs", "/srv/inbox")),
        ),
        (
            &[(40, 28, "/srv/inbox/vendor", "cifs")],
            "/srv/inbox",
            Some(("cifs", "/srv/inbox/vendor")),
        ),
        // A name that only begins alike, and a folder beside.
        (&[(40, 28, "/srv/inbox2", "cifs")], "/srv/inbox", None),
        (&[(40, 28, "/srv/other", "cifs")], "/srv/inbox", None),
        // A local disk within a share.
        (
            &[
                (40, 28, "/srv/share", "nfs"),
                (41, 40, "/srv/share/disk", "ext4"),
            ],
            "/srv/share/disk",
            None,
        ),
        (&[(40, 27, "/mnt", "9p")], "/mnt", Some(("9p", "/mnt"))),
        // A share mounted from one folder of itself elsewhere: a bind mount has the type.
        (
            &[(40, 28, "/srv/a", "nfs4"), (41, 28, "/srv/inbox", "nfs4")],
            "/srv/inbox",
            Some(("nfs4", "/srv/inbox")),
        ),
    ];
    for (mounts, root, expected) in rows {
        let expected = expected.map(|(kind, point)| (kind.to_owned(), point.to_owned()));
        assert_eq!(found(mounts, root), expected, "{root} among {mounts:?}");
    }
}

#[test]
fn of_mounts_over_each_other_the_last_one_counts() {
    let share_over_disk = [
        (40, 28, "/srv/inbox", "ext4"),
        (41, 40, "/srv/inbox", "nfs4"),
    ];
    assert!(found(&share_over_disk, "/srv/inbox").is_some());
    let disk_over_share = [
        (40, 28, "/srv/inbox", "nfs4"),
        (41, 40, "/srv/inbox", "ext4"),
    ];
    assert_eq!(found(&disk_over_share, "/srv/inbox"), None);
    // In whatever order they are listed.
    let [share, disk] = disk_over_share;
    assert_eq!(found(&[disk, share], "/srv/inbox"), None);
    // One mounted over a folder above it hides the share.
    let hidden = [(40, 28, "/srv/inbox", "nfs4"), (41, 28, "/srv", "tmpfs")];
    assert_eq!(found(&hidden, "/srv/inbox"), None);
    assert_eq!(found(&hidden, "/srv"), None);
}

#[test]
fn the_file_system_the_root_lies_on_is_named_before_one_below_it() {
    let both = [
        (40, 28, "/srv/inbox", "cifs"),
        (41, 40, "/srv/inbox/a", "nfs"),
    ];
    assert_eq!(found(&both, "/srv/inbox").unwrap().0, "cifs");
}

#[test]
fn names_with_spaces_and_backslashes_are_read() {
    let odd = [(40, 28, "/srv/in\\040box\\134\\011x", "smb3")];
    let point = "/srv/in box\\\tx".to_owned();
    assert_eq!(
        found(&odd, "/srv/in box\\\tx/a"),
        Some(("smb3".to_owned(), point))
    );
    // A backslash without digits is itself.
    assert_eq!(unescape(b"a\\9b\\0"), Path::new("a\\9b\\0"));
}

#[test]
fn types_are_told_apart() {
    for kind in [
        "nfs",
        "nfs4",
        "cifs",
        "smb3",
        "smbfs",
        "9p",
        "ceph",
        "afs",
        "virtiofs",
        "vboxsf",
        "fuse",
        "fuse.sshfs",
        "fuse.rclone",
        "davfs",
        "autofs",
    ] {
        assert!(is_shared(kind), "{kind}");
    }
    for kind in [
        "ext4", "xfs", "btrfs", "zfs", "overlay", "tmpfs", "fuseblk", "f2fs", "vfat", "nfsd",
    ] {
        assert!(!is_shared(kind), "{kind}");
    }
}

#[test]
fn what_is_no_list_of_mounts_finds_nothing() {
    for text in [
        &b""[..],
        b"\n\n",
        b"1 2 3\n",
        b"x y 0:1 / / rw - nfs a b\n",
        b"\xff\xfe \\",
    ] {
        assert_eq!(untrusted(text, Path::new("/srv")), None);
    }
}

#[test]
fn a_folder_is_told_from_a_mount_point() {
    let home = tempfile::tempdir().unwrap();
    assert!(!is_mount_point(home.path()).unwrap());
    assert!(is_mount_point(Path::new("/")).unwrap());
    assert!(is_mount_point(Path::new("/proc")).unwrap());
    assert!(is_mount_point(&home.path().join("no")).is_err());
}

#[test]
fn a_real_mount_is_noticed() {
    let test = "mounts::tests::a_real_mount_is_noticed";
    let Some(inside) = in_own_namespace(test, |_| {}) else {
        return;
    };
    let folder = inside.join("in box");
    fs::create_dir_all(folder.join("a")).unwrap();
    assert!(!is_mount_point(&folder).unwrap());
    assert_eq!(trusts_events(&folder), Ok(()));

    shell("mount -t tmpfs none \"$0\" && mkdir \"$0/vendor\"", &folder);
    assert!(is_mount_point(&folder).unwrap());
    assert_eq!(trusts_events(&folder), Ok(()));

    // A FUSE file system whose program never answers: enough to be mounted.
    let options = "fd=9,rootmode=40000,user_id=0,group_id=0";
    let fuse = format!("exec 9<>/dev/fuse && mount -i -t fuse -o {options} host:/x \"$0\"");
    let vendor = folder.join("vendor");
    if !Path::new("/dev/fuse").exists() {
        eprintln!("SKIPPED: the second half of {test}: there is no /dev/fuse here");
        return;
    }
    shell(&fuse, &vendor);
    let share = Distrust {
        mount_point: vendor.clone(),
        kind: "fuse".to_owned(),
    };
    assert_eq!(trusts_events(&folder), Err(share.clone()));
    assert_eq!(trusts_events(&vendor), Err(share));
    shell("umount \"$0\"", &vendor);
    assert_eq!(trusts_events(&folder), Ok(()));
}

/// Runs a command in which `$0` is the folder.
fn shell(command: &str, folder: &Path) {
    let status = Command::new("sh")
        .arg("-c")
        .arg(command)
        .arg(folder)
        .status();
    assert!(status.is_ok_and(|status| status.success()), "{command}");
}
