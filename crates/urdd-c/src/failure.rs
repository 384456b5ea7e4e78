//! Calls: what they return, texts that cross the border and that of the last error, where the arrays of a call are; and where
//! batches run: on one pool of threads, or on the calling thread where that pool cannot answer.

use std::cell::RefCell;
use std::error::Error;
use std::ffi::c_char;
use std::mem::forget;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::ThreadPoolBuilder;

use urdd_kinematics::ConfigurationError;
use urdd_robot::RobotError;
use urdd_validate::ValidateError;

/// What a function returns. After any other than `URDD_STATUS_OK`, `urdd_error_message` says what is wrong.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// The call succeeded.
    Ok = 0,
    /// A pointer is null or not aligned, or an array that is written overlaps another one.
    Pointer = 1,
    /// A handle is not open, or of another type. Only debug builds of the library check this.
    Handle = 2,
    /// An array does not have the expected length, or it is longer than any memory.
    Length = 3,
    /// A number is NaN or infinite, or a value is not allowed.
    Value = 4,
    /// An index is out of range.
    OutOfRange = 5,
    /// A text is not UTF-8.
    Utf8 = 6,
    /// A name is unknown: of a link, joint, DOF, configuration or kind of shapes.
    UnknownName = 7,
    /// A folder, archive or file cannot be opened or read.
    Open = 8,
    /// The URDD lacks a module that the call needs.
    MissingModule = 9,
    /// A module or mesh of the URDD is unusable.
    Unusable = 10,
    /// There is not enough memory for the results.
    Memory = 11,
    /// The library is at fault: please report it.
    Internal = 12,
}

/// A status, and what the message says.
#[derive(Debug)]
pub(crate) struct Failure {
    pub status: Status,
    pub message: String,
}

impl Failure {
    pub fn new(status: Status, message: impl Into<String>) -> Self {
        Failure { status, message: message.into() }
    }
}

impl From<RobotError> for Failure {
    fn from(error: RobotError) -> Self {
        let status = match &error {
            RobotError::Open { .. } | RobotError::NoUrdd { .. } | RobotError::List(_) => {
                Status::Open
            }
            RobotError::Missing(_) => Status::MissingModule,
            RobotError::Unusable { .. }
            | RobotError::MotionOpen
            | RobotError::Metadata(_)
            | RobotError::Kinematics(_)
            | RobotError::Changed(_)
            | RobotError::Mesh { .. } => Status::Unusable,
            RobotError::Configuration(error) => return error.clone().into(),
            RobotError::Batch { .. } | RobotError::Room { .. } => Status::Length,
            RobotError::Memory { .. } => Status::Memory,
            RobotError::Unknown { .. } => Status::UnknownName,
            RobotError::OutOfRange { .. } => Status::OutOfRange,
            RobotError::OutOfBounds { .. }
            | RobotError::Target(_)
            | RobotError::Setting(_)
            | RobotError::NotClosed { .. }
            | RobotError::NotCoupled { .. }
            | RobotError::Steps { .. }
            | RobotError::Obstacle { .. }
            | RobotError::Sphere { .. }
            | RobotError::Far { .. } => Status::Value,
            _ => Status::Internal,
        };
        Failure::new(status, error.to_string())
    }
}

impl From<ConfigurationError> for Failure {
    fn from(error: ConfigurationError) -> Self {
        Failure::new(Status::Value, error.to_string())
    }
}

impl From<ValidateError> for Failure {
    fn from(error: ValidateError) -> Self {
        Failure::new(Status::Open, error.to_string())
    }
}

thread_local! {
    static LAST: RefCell<Owned> = RefCell::default();
}

/// The message of the last call of this thread that failed; empty before. It lives until the next call of this thread
/// that fails, or until the thread ends: at `exit`, and in destructors of the thread's own variables, it may be gone, and
/// a text says so.
#[unsafe(no_mangle)]
pub extern "C" fn urdd_error_message() -> Text {
    let gone =
        constant("the message is gone, because its thread is ending: only the status is left\0");
    LAST.try_with(|last| last.borrow().text()).unwrap_or(gone)
}

/// Runs a call. Nothing unwinds out of it.
pub(crate) fn run(act: impl FnOnce() -> Result<(), Failure>) -> Status {
    let act = || {
        ready();
        let _ = ARRAYS.try_with(|arrays| arrays.borrow_mut().clear());
        act()
    };
    let failure = match catch_unwind(AssertUnwindSafe(act)) {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(failure)) => failure,
        Err(_) => Failure::new(
            Status::Internal,
            "the library is at fault: please report what you called, with the URDD",
        ),
    };
    // A thread that ends has no text any more, and the status still tells what it can.
    let _ = LAST.try_with(|last| last.replace(Owned::new(&failure.message)));
    failure.status
}

/// A text in UTF-8: `length` bytes at `data`, and a zero byte after them. A name can contain zero bytes itself.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Text {
    /// Its first byte; never null.
    pub data: *const c_char,
    /// Number of bytes, without the zero byte.
    pub length: usize,
}

/// A text with its zero byte, which a handle or a thread owns.
#[derive(Debug, Clone)]
pub(crate) struct Owned(Box<[u8]>);

impl Owned {
    pub fn new(text: &str) -> Self {
        Owned([text.as_bytes(), b"\0"].concat().into())
    }

    /// The same text for C, alive as long as `self`.
    pub fn text(&self) -> Text {
        Text { data: self.0.as_ptr().cast(), length: self.0.len() - 1 }
    }
}

impl Default for Owned {
    fn default() -> Self {
        Owned::new("")
    }
}

/// A text of the program. `with_zero` ends with a zero byte.
pub(crate) const fn constant(with_zero: &'static str) -> Text {
    Text { data: with_zero.as_ptr().cast(), length: with_zero.len() - 1 }
}

/// Where an array of the caller's is.
#[derive(Clone, Copy)]
pub(crate) struct Span {
    pub what: &'static str,
    pub address: usize,
    pub bytes: usize,
    pub is_written: bool,
}

thread_local! {
    /// The arrays of the call that this thread is in: one that is written overlaps no other.
    static ARRAYS: RefCell<Vec<Span>> = const { RefCell::new(Vec::new()) };
}

impl Span {
    /// The first array of this call that it clashes with. It counts among them from now on.
    pub fn first_clash(self) -> Option<Span> {
        // A thread that ends has no list any more.
        let clash = ARRAYS.try_with(|arrays| {
            let mut arrays = arrays.borrow_mut();
            let other = arrays.iter().find(|other| other.clashes(&self)).copied();
            arrays.push(self);
            other
        });
        clash.ok().flatten()
    }

    /// Whether one of two arguments would be written over the other.
    fn clashes(&self, other: &Span) -> bool {
        (self.is_written || other.is_written)
            && self.what != other.what
            && self.bytes > 0
            && other.bytes > 0
            && self.address < other.address.saturating_add(other.bytes)
            && other.address < self.address.saturating_add(self.bytes)
    }
}

/// True in a child of `fork`, which has no thread of the pool, and where no thread can be started.
static ALONE: AtomicBool = AtomicBool::new(false);

#[cfg(unix)]
unsafe extern "C" {
    fn pthread_atfork(
        before: Option<extern "C" fn()>,
        parent: Option<extern "C" fn()>,
        child: Option<extern "C" fn()>,
    ) -> std::ffi::c_int;
}

extern "C" fn alone() {
    ALONE.store(true, Ordering::Relaxed);
}

/// Starts the pool at the first call. Where it cannot answer, makes this thread a pool of one.
pub(crate) fn ready() {
    static START: Once = Once::new();
    START.call_once(|| {
        // SAFETY: the function does nothing that a child may not do.
        #[cfg(unix)]
        unsafe {
            pthread_atfork(None, None, Some(alone));
        }
        // A pool that the program has already started is an error without a source, and is used.
        let started = ThreadPoolBuilder::new().build_global();
        if started.is_err_and(|error| error.source().is_some()) {
            alone();
        }
    });
    if ALONE.load(Ordering::Relaxed) && rayon::current_thread_index().is_none() {
        let one = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        // It lives as long as its thread.
        forget(one);
    }
}
