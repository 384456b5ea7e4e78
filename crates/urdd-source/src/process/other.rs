//! Programs on systems other than Linux: process groups or job objects.

use std::io;
use std::process::{ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus};

use process_wrap::std::{ChildWrapper, CommandWrap};

pub(super) struct Tree(Box<dyn ChildWrapper>);

impl Tree {
    pub fn start(command: Command) -> io::Result<Tree> {
        let mut command = CommandWrap::from(command);
        #[cfg(unix)]
        command.wrap(process_wrap::std::ProcessGroup::leader());
        #[cfg(windows)]
        command.wrap(process_wrap::std::JobObject);
        command.spawn().map(Tree)
    }

    pub fn input(&mut self) -> Option<ChildStdin> {
        self.0.stdin().take()
    }

    pub fn streams(&mut self) -> (Option<ChildStdout>, Option<ChildStderr>) {
        (self.0.stdout().take(), self.0.stderr().take())
    }

    pub fn try_wait(&mut self) -> io::Result<Option<ExitStatus>> {
        self.0.try_wait()
    }

    pub fn end(&mut self) {
        // It is not an error if nothing is left.
        let _ = self.0.start_kill();
        let _ = self.0.wait();
    }
}
