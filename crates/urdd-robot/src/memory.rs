//! How much memory there is.

use std::fs;

/// Results below this size are not compared with the memory that there is: reading it takes longer than making them, bytes.
const SMALL: usize = 64 << 20;

/// Whether this many bytes may be allocated and filled. An allocation alone does not tell on Linux: it succeeds, and the
/// system ends the process once it fills more than there is.
pub fn has_room(bytes: usize) -> bool {
    bytes < SMALL || available().is_none_or(|available| bytes as u64 <= available)
}

/// The bytes that this process can still take: those of the system, and of its control group (version 2), where both are
/// known. `None` on other systems than Linux.
fn available() -> Option<u64> {
    let number = |path: &str| fs::read_to_string(path).ok()?.trim().parse::<u64>().ok();
    let of_group = || {
        let most = number("/sys/fs/cgroup/memory.max")?;
        Some(most.saturating_sub(number("/sys/fs/cgroup/memory.current")?))
    };
    let of_system = fs::read_to_string("/proc/meminfo").ok()?;
    let of_system = of_system.lines().find_map(|line| {
        let kibibytes = line.strip_prefix("MemAvailable:")?.trim();
        let kibibytes = kibibytes.strip_suffix("kB")?.trim().parse::<u64>().ok()?;
        Some(kibibytes << 10)
    })?;
    Some(of_group().map_or(of_system, |of_group| of_group.min(of_system)))
}
