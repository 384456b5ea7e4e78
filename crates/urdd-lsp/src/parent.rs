//! Whether the editor still runs. An editor that crashes leaves a server whose input may stay open.

/// A process, by its number.
#[derive(Debug, Clone, Copy)]
pub struct Process(u32);

impl Process {
    /// The process of a number; `None` if there is none that can be seen, as from within a container: then nobody can
    /// tell when it ends.
    pub fn find(id: u32) -> Option<Self> {
        let process = Process(id);
        process.is_running().then_some(process)
    }

    /// Whether it runs. A process of another user counts as running.
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    pub fn is_running(self) -> bool {
        let id = i32::try_from(self.0).ok().and_then(rustix::process::Pid::from_raw);
        let sent = id.map(rustix::process::test_kill_process);
        sent.is_some_and(|sent| sent != Err(rustix::io::Errno::SRCH))
    }

    /// Elsewhere, none can be seen: the end of the input is the only sign.
    #[cfg(not(any(target_os = "linux", target_os = "macos")))]
    pub fn is_running(self) -> bool {
        false
    }
}
