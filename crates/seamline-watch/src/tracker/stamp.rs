//! What tells one state of a file from another without reading it.

use std::fs::Metadata;
use std::os::unix::fs::MetadataExt;

/// What tells one state of a file from another. Times are those of the file system, in seconds and
/// nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// Length in bytes.
    pub size: u64,
    /// When the content was written last; programs may set it to what they like.
    pub modified: (i64, i64),
    /// When the content or anything else of the file changed last; nobody can set it.
    pub changed: (i64, i64),
    /// Device and inode: another file renamed into the place has others.
    pub identity: (u64, u64),
}

impl Stamp {
    /// The stamp of what a path led to.
    pub fn of(metadata: &Metadata) -> Self {
        Self {
            size: metadata.len(),
            modified: (metadata.mtime(), metadata.mtime_nsec()),
            changed: (metadata.ctime(), metadata.ctime_nsec()),
            identity: (metadata.dev(), metadata.ino()),
        }
    }

    /// Is this the same content as `other`, moved or copied by somebody who keeps the time it was written?
    pub fn is_moved(&self, other: &Self) -> bool {
        let same_device = self.identity.0 == other.identity.0;
        self.size == other.size
            && self.modified == other.modified
            && (!same_device || self.identity == other.identity)
    }

    /// The stamp as a word. Without the device, whose number may be another after the next start.
    pub fn word(&self) -> String {
        let (m, m_ns) = self.modified;
        let (c, c_ns) = self.changed;
        let inode = self.identity.1;
        format!("{}.{m}.{m_ns}.{c}.{c_ns}.{inode}", self.size)
    }
}
