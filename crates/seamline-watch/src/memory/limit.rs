//! What all meshes in work may take together.

use std::fs;
use std::path::{Path, PathBuf};

/// The limit in bytes: the one given, or, for 0, three quarters of what this process can have at most. That is
/// the memory of the machine, or of the container (control group) if that is less. Swap does not count.
pub fn limit(given_bytes: u64) -> u64 {
    if given_bytes > 0 {
        return given_bytes;
    }
    let system = rustix::system::sysinfo();
    // Types differ between machines.
    let machine = (system.totalram as u64).saturating_mul(u64::from(system.mem_unit.max(1)));
    let groups = fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
    let files = files_of_limits(&groups);
    let limits = files
        .iter()
        .filter_map(|file| fs::read_to_string(file).ok());
    three_quarters(least(machine, limits.filter_map(|text| bytes_in(&text))))
}

/// What of a limit is given to meshes: three quarters. The rest is for what no estimate sees, the program itself and
/// what the allocator keeps: with two meshes in work at a time that was 24 % on top of the estimates for 250,000
/// triangles, and 15 % for a million.
pub fn share_of_meshes(limit_bytes: u64) -> u64 {
    three_quarters(limit_bytes)
}

fn three_quarters(bytes: u64) -> u64 {
    bytes / 4 * 3
}

fn least(machine: u64, limits: impl Iterator<Item = u64>) -> u64 {
    limits.fold(machine, u64::min)
}

/// Where the limits of the groups of a process may stand, its own and those above it, by the text of
/// `/proc/self/cgroup`. Not all of these files exist: a container sees its own group at the top, under
/// whatever name the file has for it.
fn files_of_limits(groups: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for line in groups.lines() {
        // `0::/user.slice/a` is of version 2, `4:cpu,memory:/a` of version 1.
        let mut parts = line.splitn(3, ':');
        let (Some(_), Some(kinds), Some(group)) = (parts.next(), parts.next(), parts.next()) else {
            continue;
        };
        let (tops, name): (&[&str], _) = if kinds.is_empty() {
            (&["/sys/fs/cgroup", "/sys/fs/cgroup/unified"], "memory.max")
        } else if kinds.split(',').any(|kind| kind == "memory") {
            (&["/sys/fs/cgroup/memory"], "memory.limit_in_bytes")
        } else {
            continue;
        };
        for top in tops {
            for group in Path::new(group).ancestors() {
                let below = group.strip_prefix("/").unwrap_or(group);
                files.push(Path::new(top).join(below).join(name));
            }
        }
    }
    files
}

/// A limit as these files have it; nothing for `max`, which is none. Version 1 writes a number beyond any
/// memory for none.
fn bytes_in(text: &str) -> Option<u64> {
    text.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(groups: &str) -> Vec<String> {
        let files = files_of_limits(groups);
        files
            .iter()
            .map(|file| file.display().to_string())
            .collect()
    }

    #[test]
    fn the_groups_above_count_too() {
        assert_eq!(
            files("0::/system.slice/seamline.service\n"),
            [
                "/sys/fs/cgroup/system.slice/seamline.service/memory.max",
                "/sys/fs/cgroup/system.slice/memory.max",
                "/sys/fs/cgroup/memory.max",
                "/sys/fs/cgroup/unified/system.slice/seamline.service/memory.max",
                "/sys/fs/cgroup/unified/system.slice/memory.max",
                "/sys/fs/cgroup/unified/memory.max",
            ]
        );
    }

    #[test]
    fn of_version_1_the_group_of_memory_counts_and_no_other() {
        assert_eq!(
            files("5:cpu,memory:/docker/a\n4:cpuset:/x\n1:name=systemd:/y\n"),
            [
                "/sys/fs/cgroup/memory/docker/a/memory.limit_in_bytes",
                "/sys/fs/cgroup/memory/docker/memory.limit_in_bytes",
                "/sys/fs/cgroup/memory/memory.limit_in_bytes",
            ]
        );
        assert_eq!(files("nonsense\n\n"), [""; 0]);
    }

    #[test]
    fn limits_are_read_and_none_is_none() {
        let rows = [
            ("max\n", None),
            ("1073741824\n", Some(1 << 30)),
            ("9223372036854771712\n", Some(9_223_372_036_854_771_712)),
            ("", None),
            ("-1\n", None),
        ];
        for (text, expected) in rows {
            assert_eq!(bytes_in(text), expected, "{text:?}");
        }
    }

    #[test]
    fn the_least_of_all_counts() {
        assert_eq!(least(16 << 30, [].into_iter()), 16 << 30);
        let limits = [8 << 30, 4 << 30, 9_223_372_036_854_771_712];
        assert_eq!(least(16 << 30, limits.into_iter()), 4 << 30);
        assert_eq!(three_quarters(16 << 30), 12 << 30);
    }

    #[test]
    fn what_is_given_is_taken_and_what_is_not_is_found() {
        assert_eq!(limit(12_345), 12_345);
        let text = fs::read_to_string("/proc/meminfo").unwrap();
        let total = text.split_whitespace().nth(1).unwrap();
        let machine = total.parse::<u64>().unwrap() * 1024;
        let found = limit(0);
        assert!(found > 1 << 20 && found <= machine, "{found} of {machine}");
    }
}
