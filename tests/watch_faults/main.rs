//! What goes wrong: broken files, failing and full disks, folders that vanish, limits of the system. One costs one file
//! at most.

mod crashes;
mod disk;
mod files;
mod folders;
mod memory;

const METRICS: &str = "[http]\nlisten = \"127.0.0.1:0\"\n";
const EIO: i32 = 5;
const EBUSY: i32 = 16;
