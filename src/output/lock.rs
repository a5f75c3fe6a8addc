//! One writer at a time: what is being written is locked, by the system, in a hidden file beside it.

use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::error::{Holder, OutputError};
use super::ours::POINTS;
use super::path::Made;
use super::study;

/// Tries before a folder that comes and goes under other processes is given up.
const TRIES: usize = 1000;
/// Time that a process has to write its number into the lock that it has just taken.
const PATIENCE: Duration = Duration::from_millis(200);
/// First word in a lock file of ours.
const OURS: &str = "bedload";

/// A place that this process alone writes to, until this is dropped.
#[derive(Debug)]
pub(super) struct Site {
    /// `None` where the file system knows no locks
    _lock: Option<Lock>,
    /// what was made above the place
    _above: Made,
}

impl Site {
    /// Locks the resolved path `target`, a folder or a file, and makes the folders above it.
    ///
    /// # Errors
    /// [`OutputError::InUse`] with the process that holds it, [`OutputError::Unwritable`].
    pub fn take(target: &Path) -> Result<Self, OutputError> {
        let unwritable = |error| OutputError::Unwritable { path: target.into(), error };
        let (locked, inside) = files(target).map_err(unwritable)?;
        let mut last = None;
        for _ in 0..TRIES {
            // Another process may take back a folder above that it had made.
            let above = match Made::above(target) {
                Ok(above) => above,
                Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::AlreadyExists) => {
                    last = Some(error);
                    continue;
                }
                Err(error) => return Err(unwritable(error)),
            };
            let lock = match Lock::take(target, &locked) {
                Err(OutputError::Unwritable { error, .. }) if target.is_dir() && is_closed(&error) => {
                    Lock::take(target, &inside)
                }
                other => other,
            };
            match lock {
                Ok(lock) => return Ok(Self { _lock: lock, _above: above }),
                // The folder above was taken back after it was found, and may be there again by now.
                Err(OutputError::Unwritable { error, .. }) if error.kind() == ErrorKind::NotFound => last = Some(error),
                Err(error) => return Err(error),
            }
        }
        Err(unwritable(last.unwrap_or_else(|| ErrorKind::NotFound.into())))
    }
}

/// Whether a folder takes no new file.
fn is_closed(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem)
}

/// The lock file of `target`, beside it; and the one inside it, for a folder below one that takes no files. A point of a
/// study has the lock of the study.
fn files(target: &Path) -> io::Result<(PathBuf, PathBuf)> {
    let whole = std::path::absolute(target)?;
    let study = whole.parent().filter(|above| above.ends_with(POINTS)).and_then(Path::parent);
    let locked = study.filter(|folder| study::stands_in(folder)).unwrap_or(&whole);
    let mut name = OsString::from(".");
    name.push(locked.file_name().unwrap_or_default());
    name.push(".lock");
    Ok((locked.with_file_name(name), locked.join(".lock")))
}

/// Whether a file is one that marks a folder as locked.
pub(super) fn is_lock(name: &str) -> bool {
    name.starts_with('.') && name.ends_with(".lock")
}

/// A lock file, held.
#[derive(Debug)]
struct Lock {
    path: PathBuf,
    file: File,
}

impl Lock {
    /// Takes the lock `path` of `target`; `None` where the file system knows no locks. The lock is that of the system on the
    /// open file: it ends with the process, whatever ends that, and a file that is left over locks nothing.
    fn take(target: &Path, path: &Path) -> Result<Option<Self>, OutputError> {
        let unwritable = |error| OutputError::Unwritable { path: target.into(), error };
        for _ in 0..TRIES {
            if fs::symlink_metadata(path).is_ok_and(|known| !known.is_file()) {
                return Err(OutputError::ForeignFile(path.into()));
            }
            let file = File::options().read(true).write(true).create(true).truncate(false).open(path);
            // That of another user, in a shared folder, can be read and locked.
            let file =
                file.or_else(|error| if is_closed(&error) { File::open(path).map_err(|_| error) } else { Err(error) });
            let file = file.map_err(unwritable)?;
            match file.try_lock() {
                // The last holder removed the file after it was opened here: it locks nothing any more.
                Ok(()) if !is_there(&file, path) => {}
                Ok(()) => {
                    sign(&file).map_err(|_| OutputError::ForeignFile(path.into()))?;
                    return Ok(Some(Self { path: path.into(), file }));
                }
                Err(TryLockError::WouldBlock) => {
                    return Err(OutputError::InUse { path: target.into(), holder: holder(&file) });
                }
                Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Interrupted => {}
                // No reason to refuse all work on such a disk.
                Err(TryLockError::Error(_)) => return Ok(None),
            }
        }
        Err(OutputError::InUse { path: target.into(), holder: None })
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Removed while it is held: whoever has opened it finds that it is not there any more, and tries again. Elsewhere
        // than on Unix that cannot be found out, and the file stays.
        if cfg!(unix) && is_there(&self.file, &self.path) {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Whether an open file still is the one of this path.
#[cfg(unix)]
fn is_there(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let known = |found: io::Result<fs::Metadata>| found.ok().map(|found| (found.dev(), found.ino()));
    known(file.metadata()).is_some_and(|own| known(fs::symlink_metadata(path)) == Some(own))
}

#[cfg(not(unix))]
fn is_there(_: &File, _: &Path) -> bool {
    true
}

/// The first bytes of a lock file.
fn content(mut file: &File) -> io::Result<String> {
    file.seek(SeekFrom::Start(0))?;
    let mut text = String::new();
    file.take(100).read_to_string(&mut text)?;
    Ok(text)
}

/// Says in a lock file who holds it.
///
/// # Errors
/// If the file holds something else.
fn sign(mut file: &File) -> io::Result<()> {
    let text = content(file)?;
    if !(text.starts_with(OURS) || OURS.starts_with(&text)) {
        return Err(ErrorKind::InvalidData.into());
    }
    let since = jiff::Timestamp::now().strftime("%Y-%m-%dT%H:%M:%SZ");
    let name = format!("{OURS} {} {since}\n", std::process::id());
    // The lock holds without it, on a full disk.
    let _ = file.set_len(0).and_then(|()| file.seek(SeekFrom::Start(0))).and_then(|_| file.write_all(name.as_bytes()));
    Ok(())
}

/// Who holds a lock file, if it says so.
fn holder(file: &File) -> Option<Holder> {
    let begin = Instant::now();
    loop {
        let text = content(file).unwrap_or_default();
        if let [OURS, pid, since] = text.split_whitespace().collect::<Vec<_>>()[..]
            && text.ends_with('\n')
        {
            return Some(Holder { pid: pid.parse().ok()?, since: since.into() });
        }
        if begin.elapsed() > PATIENCE {
            return None;
        }
        // It has only just been taken.
        sleep(PATIENCE / 50);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn a_lock_has_one_holder_however_often_its_file_comes_and_goes() {
        let scratch = tempfile::tempdir().unwrap();
        let target = scratch.path().join("far/below/out");
        let (inside, taken, refused) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicUsize::new(0));
        std::thread::scope(|scope| {
            for _ in 0..6 {
                scope.spawn(|| {
                    for _ in 0..300 {
                        match Site::take(&target) {
                            Ok(_site) => {
                                assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0, "two holders");
                                std::thread::yield_now();
                                inside.fetch_sub(1, Ordering::SeqCst);
                                taken.fetch_add(1, Ordering::SeqCst);
                            }
                            Err(OutputError::InUse { .. }) => drop(refused.fetch_add(1, Ordering::SeqCst)),
                            Err(error) => panic!("{error}"),
                        }
                    }
                });
            }
        });
        let (taken, refused) = (taken.into_inner(), refused.into_inner());
        assert!(taken > 0 && refused > 0 && taken + refused == 1800, "{taken} taken, {refused} refused");
        assert!(fs::read_dir(scratch.path()).unwrap().count() <= 1, "more than a folder is left");
        drop(Site::take(&target).unwrap());
        assert!(!target.with_file_name(".out.lock").exists());
    }

    #[cfg(unix)]
    #[test]
    fn a_file_that_was_removed_locks_nothing() {
        let scratch = tempfile::tempdir().unwrap();
        let (target, lock) = (scratch.path().join("out"), scratch.path().join(".out.lock"));
        let site = Site::take(&target).unwrap();
        let early = File::open(&lock).unwrap();
        assert!(matches!(early.try_lock(), Err(TryLockError::WouldBlock)));
        assert!(is_there(&early, &lock));
        drop(site);
        // Now it can be locked, and means nothing, whether there is a new one or not.
        early.try_lock().unwrap();
        assert!(!is_there(&early, &lock));
        let _site = Site::take(&target).unwrap();
        assert!(!is_there(&early, &lock));
    }

    #[test]
    fn a_file_of_the_name_of_a_lock_is_not_touched() {
        let scratch = tempfile::tempdir().unwrap();
        let (target, lock) = (scratch.path().join("out"), scratch.path().join(".out.lock"));
        for content in ["mine", "bedl", "", "bedload 1 2026-01-01T00:00:00Z\n"] {
            fs::write(&lock, content).unwrap();
            match Site::take(&target) {
                Err(OutputError::ForeignFile(file)) => {
                    assert_eq!((file, content), (lock.clone(), "mine"));
                    assert_eq!(fs::read_to_string(&lock).unwrap(), "mine");
                    fs::remove_file(&lock).unwrap();
                }
                Ok(site) => {
                    assert!(content != "mine" && fs::read_to_string(&lock).unwrap().starts_with("bedload "));
                    drop(site);
                    assert!(!lock.exists(), "{content:?}");
                }
                Err(error) => panic!("{content:?}: {error}"),
            }
        }
    }
}
