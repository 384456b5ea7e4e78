//! Whether the editor still runs. An editor that crashes leaves a server whose input may stay open.

/// A process.
#[derive(Debug, Clone, Copy)]
pub struct Process {
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    id: rustix::process::Pid,
}

impl Process {
    /// The process of a number; `None` if there is none that can be seen, as from within a container: then nobody can
    /// tell when it ends.
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    pub fn find(id: u32) -> Option<Self> {
        let id = rustix::process::Pid::from_raw(i32::try_from(id).ok()?)?;
        let process = Process { id };
        process.is_running().then_some(process)
    }

    /// Whether it runs. A process of another user counts as running.
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    pub fn is_running(self) -> bool {
        let sent = rustix::process::test_kill_process(self.id);
        !matches!(sent, Err(rustix::io::Errno::SRCH))
    }

    /// Elsewhere, the end of the input is the only sign.
    #[cfg(not(any(target_os = "linux", target_os = "macos")))]
    pub fn find(_: u32) -> Option<Self> {
        None
    }

    /// See [`Process::find`].
    #[cfg(not(any(target_os = "linux", target_os = "macos")))]
    pub fn is_running(self) -> bool {
        true
    }
}
