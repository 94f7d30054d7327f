//! File systems on which the system does not tell of every change.
//!
//! Events come from the kernel of this machine. What another machine writes to a share, or what a FUSE
//! program changes behind the kernel's back, gives none. Which file system a folder lies on is read from
//! `/proc/self/mountinfo`.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::os::unix::ffi::OsStringExt;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

/// Types of file systems that others change too.
///
/// `autofs` is among them because what it will mount is not known before it is looked at.
const SHARED: [&str; 36] = [
    "9p",
    "acfs",
    "afs",
    "autofs",
    "beegfs",
    "ceph",
    "cifs",
    "coda",
    "cvfs",
    "davfs",
    "davfs2",
    "fhgfs",
    "fuse",
    "gfs",
    "gfs2",
    "glusterfs",
    "gpfs",
    "lustre",
    "ncpfs",
    "ncp",
    "nfs",
    "nfs4",
    "ocfs2",
    "orangefs",
    "panfs",
    "prl_fs",
    "pvfs2",
    "smb",
    "smb2",
    "smb3",
    "smbfs",
    "sshfs",
    "vboxsf",
    "virtiofs",
    "vmhgfs",
    "webdav",
];

/// A mounted file system that gives no event for some of its changes.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{} is of type {kind}, where changes made elsewhere give no event", .mount_point.display())]
pub struct Distrust {
    /// Where it is mounted.
    pub mount_point: PathBuf,
    /// Its type, as in `nfs4` or `fuse.sshfs`.
    pub kind: String,
}

/// Does every change in a folder, and in those below it, give an event?
///
/// Yes where the system cannot say what is mounted: the periodic listing is there for the rest.
///
/// # Errors
///
/// The file system the folder lies on if that one is shared, otherwise a shared one mounted below it.
pub fn trusts_events(root: &Path) -> Result<(), Distrust> {
    let mounted = fs::read("/proc/self/mountinfo").unwrap_or_default();
    match untrusted(&mounted, root) {
        Some(distrust) => Err(distrust),
        None => Ok(()),
    }
}

/// The same by the text of `/proc/self/mountinfo`; `root` is absolute, without links. Lines that cannot be
/// read are passed over.
pub fn untrusted(mountinfo: &[u8], root: &Path) -> Option<Distrust> {
    let lines = mountinfo.split(|&byte| byte == b'\n');
    let mounts: Vec<Mount> = lines.filter_map(Mount::read).collect();
    let below = mounts.iter().filter(|mount| {
        mount.point.starts_with(root)
            && lies_on(&mounts, &mount.point).is_some_and(|top| top.id == mount.id)
    });
    let found = lies_on(&mounts, root)
        .into_iter()
        .chain(below)
        .find(|mount| is_shared(&mount.kind))?;
    Some(Distrust {
        mount_point: found.point.clone(),
        kind: found.kind.clone(),
    })
}

/// Is something mounted at this folder? Told by its device, which is another than that of the folder above
/// it; so a folder of one file system mounted elsewhere in the same one is not noticed.
///
/// # Errors
///
/// The folder, or the one above it, cannot be looked at.
pub fn is_mount_point(path: &Path) -> io::Result<bool> {
    let here = fs::metadata(path)?;
    let above = fs::metadata(path.join(".."))?;
    let is_top_of_all = here.ino() == above.ino();
    Ok(here.dev() != above.dev() || is_top_of_all)
}

struct Mount {
    id: u32,
    parent: u32,
    point: PathBuf,
    kind: String,
}

impl Mount {
    /// `36 35 98:0 /there /here rw,noatime master:1 - ext3 /dev/root rw`: the words before the dash vary in
    /// number.
    fn read(line: &[u8]) -> Option<Self> {
        let mut words = line.split(|&byte| byte == b' ');
        let number = |word: &[u8]| std::str::from_utf8(word).ok()?.parse().ok();
        let id = number(words.next()?)?;
        let parent = number(words.next()?)?;
        let point = unescape(words.nth(2)?);
        words.find(|word| *word == b"-")?;
        let kind = String::from_utf8_lossy(words.next()?).into_owned();
        Some(Self {
            id,
            parent,
            point,
            kind,
        })
    }
}

/// Space, tab, newline and backslash are written as `\` and three octal digits.
fn unescape(word: &[u8]) -> PathBuf {
    let mut bytes = Vec::with_capacity(word.len());
    let mut rest = word;
    while let Some((&first, after)) = rest.split_first() {
        let digits = after.get(..3).filter(|_| first == b'\\');
        let code =
            digits.and_then(|digits| u8::from_str_radix(std::str::from_utf8(digits).ok()?, 8).ok());
        match code {
            Some(code) => {
                bytes.push(code);
                rest = &after[3..];
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    OsString::from_vec(bytes).into()
}

/// The mount a path leads to, found as the kernel finds it: from mount to mount, at each the first one met
/// on the way down. The order of the lines says nothing: a mount that covers another has it for parent, and
/// after a change of root the lowest mount may stand last.
fn lies_on<'a>(mounts: &'a [Mount], path: &Path) -> Option<&'a Mount> {
    let is_listed = |id: u32| mounts.iter().any(|mount| mount.id == id);
    let mut here: Option<&Mount> = None;
    for _ in 0..mounts.len() {
        let on_the_way = mounts.iter().filter(|mount| {
            path.starts_with(&mount.point)
                && match here {
                    Some(here) => mount.parent == here.id && mount.id != here.id,
                    None => mount.parent == mount.id || !is_listed(mount.parent),
                }
        });
        // Of two at one point, which do not occur, the last.
        let nearest = on_the_way.reduce(|best, mount| {
            let [depth, best_depth] = [mount, best].map(|mount| mount.point.components().count());
            if depth <= best_depth { mount } else { best }
        });
        match nearest {
            Some(mount) => here = Some(mount),
            None => break,
        }
    }
    here
}

/// `fuseblk` is FUSE on a disk of this machine (NTFS, exFAT): everybody goes through this kernel, which
/// tells. Any other FUSE may be a share.
fn is_shared(kind: &str) -> bool {
    kind.starts_with("fuse.") || SHARED.contains(&kind)
}

#[cfg(test)]
mod tests;
